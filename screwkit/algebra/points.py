"""Random exact points of the exact ring, modulo a large prime.

A point gives every generator a residue so that all relations hold.  Ranks at such a
point are generic ranks; on a locus they are the generic ranks of the locus.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from functools import lru_cache
from typing import TypeAlias

from flint import fmpz, nmod_mat, nmod_poly

from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

Point: TypeAlias = list[int]
PRIME = 2**61 - 1
_ATTEMPTS = 8


def residue(value: Polynomial, point: Sequence[int], prime: int = PRIME) -> int:
    """The value of a polynomial at a point."""
    if value.is_constant():
        if value == 0:
            return 0
        constant = value.coeffs()[0]
    else:
        constant = value(*point)
    numerator, denominator = int(constant.p), int(constant.q)
    if denominator == 1:
        return numerator % prime
    return numerator * pow(denominator, -1, prime) % prime


def random_point(
    ring: TrigonometricRing, source: random.Random, prime: int = PRIME
) -> Point | None:
    """A random point, drawn again where a root does not exist mod p.

    None where no point was found, as for a prime without √3 in a ring with √3.
    """
    for _ in range(_ATTEMPTS):
        point = _attempt(ring, source, prime)
        if point is not None:
            return point
    return None


def _attempt(
    ring: TrigonometricRing, source: random.Random, prime: int
) -> Point | None:
    point = [0] * len(ring.names)
    for angle in range(len(ring.basis)):
        cosine, sine = random_angle(source, prime)
        point[ring.cosine_index(angle)], point[ring.sine_index(angle)] = cosine, sine
    for symbol in ring.symbol_indices():
        point[symbol] = source.randrange(1, prime)
    for generator, inside in ring.algebraic_relations:
        if isinstance(inside, tuple):
            roots = nmod_poly(list(inside), prime).roots()
            value = int(roots[0][0]) if roots else None
        else:
            value = root_modulo(residue(inside, point, prime), prime)
        if value is None:
            return None
        point[generator] = value
    return with_inverses(ring, point, prime)


def with_inverses(
    ring: TrigonometricRing, point: Sequence[int], prime: int = PRIME
) -> Point:
    """The point with the values that the inverses of divisors have there.

    Inner ones come first; 0 stands where the divisor vanishes.
    """
    if not ring.divisors_of:
        return list(point)
    place = {name: ring.names.index(name) for name in ring.divisors_of}
    found, open_ones = list(point), dict(ring.divisors_of)
    while open_ones:
        name = next(
            name
            for name, divisor in open_ones.items()
            if not any(divisor.degrees()[place[other]] for other in open_ones)
        )
        value = residue(open_ones.pop(name), found, prime)
        found[place[name]] = pow(value, -1, prime) if value else 0
    return found


def with_extensions(
    ring: TrigonometricRing, point: Sequence[int], prime: int = PRIME
) -> Point | None:
    """The point with the values that symbolic roots and inverses have there.

    None where a root does not exist.
    """
    found = with_inverses(ring, point, prime)
    for generator, inside in ring.algebraic_relations:
        if isinstance(inside, tuple):
            continue
        value = residue(inside, found, prime)
        if pow(found[generator], 2, prime) != value:
            root = root_modulo(value, prime)
            if root is None:
                return None
            found[generator] = root
            found = with_inverses(ring, found, prime)
    return found


def random_angle(source: random.Random, prime: int) -> tuple[int, int]:
    """(cos, sin): a random point of the circle mod p."""
    while True:
        t = source.randrange(1, prime)
        below = (1 + t * t) % prime
        if below:
            inverse = pow(below, -1, prime)
            return (1 - t * t) * inverse % prime, 2 * t * inverse % prime


def root_modulo(value: int, prime: int) -> int | None:
    """A square root mod p, or None."""
    if not value:
        return 0
    if pow(value, (prime - 1) // 2, prime) != 1:
        return None
    return int(fmpz(value).sqrtmod(prime))


def rank_at(
    columns: Sequence[Sequence[Polynomial]], point: Point, prime: int = PRIME
) -> int:
    """Rank of a matrix of polynomials, given by columns, at a point."""
    if not columns:
        return 0
    entries = [residue(entry, point, prime) for column in columns for entry in column]
    return int(nmod_mat(len(columns), len(columns[0]), entries, prime).rank())


def differential(
    ring: TrigonometricRing,
    value: Polynomial,
    point: Point,
    prime: int,
) -> list[int]:
    """Derivatives at a point: by every basis angle, then by every symbol.

    Args:
        ring: Of the polynomial.
        value: The polynomial.
        point: An exact point and its prime.
        prime: See ``point``.
    """
    degrees = value.degrees()

    def by(index: int) -> int:
        if not degrees[index]:
            return 0
        return residue(value.derivative(index), point, prime)

    row = []
    for angle in range(len(ring.basis)):
        sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
        turning = by(sine) * point[cosine] - by(cosine) * point[sine]
        row.append(turning % prime)
    return row + [by(index) for index in ring.symbol_indices()]


@lru_cache(maxsize=1)
def branch_primes() -> tuple[int, ...]:
    """Primes of 61 bits to choose from; fixed, so that answers can be repeated.

    All are 1 modulo 720720: small roots and the cosines of common angles exist.
    """
    step = 720720
    found: list[int] = []
    candidate = (2**61 // step) * step + 1
    while len(found) < 64:
        if fmpz(candidate).is_prime():
            found.append(candidate)
        candidate -= step
    return tuple(found)
