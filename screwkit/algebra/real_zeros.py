"""Real zeros of sums of squares and the like: smaller than they look.

A polynomial whose terms all have one sign is zero only where all of them are.  Which
terms a trigonometric polynomial has depends on how 1 = s² + c² is used, so it is made
homogeneous in the angles too.  3 + cos p·cos q is zero nowhere, as cosines are at
most 1; 1 − cos p·cos q keeps its sign, and a·sin φ + b·cos φ + e where e² − a² − b² is
a square or positive, and what is quadratic in a symbol may be two squares
(`completed_squares`).
"""

from __future__ import annotations

import random
from typing import Any

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.completed_squares import completed_square
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.points import branch_primes, random_point, residue
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.remembered import remembered
from screwkit.algebra.solved_text import root_of_square
from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

TERMS = 40
"""Of a polynomial that is looked at."""

_POINTS = 8  # at which what is no square is one with a chance of 1 in 128

_HOMOGENEOUS = 2_000  # terms beyond which no further angle is made homogeneous


@remembered
def vanishing_together(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> list[Polynomial] | None:
    """What vanishes at every real zero of a polynomial that keeps its sign.

    Of a sum of terms of one sign that is every term; each is a product of different
    generators, and 1 is among them where there is no zero.

    Args:
        ring: Of the polynomial.
        assumptions: Signs of the symbols.
        polynomial: In normal form, not zero.

    Returns:
        None where the polynomial has one term, or was not found to keep its sign.
    """
    if not 1 < len(polynomial) <= TERMS:
        return None
    for written in (polynomial, homogeneous(ring, polynomial)):
        if len(written) > 1 and assumptions.has_one_sign(ring, written):
            return [_radical(ring, m) for m in _monomials(ring, written)]
    several = len(unknowns(ring, polynomial)) > 1  # one alone is solved, or is none
    if several and _sign_of_the_rest(ring, assumptions, polynomial):
        return [ring.one]
    return (
        _extremal(ring, polynomial)
        or _touching(ring, assumptions, polynomial)
        or completed_square(ring, assumptions, polynomial)
    )


def _sign_of_the_rest(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> int:
    """The sign of the terms without angles if they outweigh all others, or else 0.

    Sines and cosines are at most 1: 3·a + b + a·sin p·sin q is positive for lengths.
    """
    angles = range(len(ring.basis))
    places = {*map(ring.sine_index, angles), *map(ring.cosine_index, angles)}
    parts: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        turning = tuple(int(e) for i, e in enumerate(exponents) if i in places)
        rest = tuple(0 if i in places else int(e) for i, e in enumerate(exponents))
        parts.setdefault(turning, {})[rest] = coefficient
    still = parts.pop((0,) * len(places), None)
    if still is None or not parts:
        return 0
    left, signs = ring.zero, []
    for sign, part in ((1, still), *((-1, part) for part in parts.values())):
        size = ring.context.from_dict(part)
        own = assumptions.sign_of(ring, size)
        if not own:
            return 0
        signs.append(own)
        left += sign * own * size
    return signs[0] if assumptions.sign_of(ring, left) == 1 else 0


def _touching(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> list[Polynomial] | None:
    """Of a·sin φ + b·cos φ + e with e² − a² − b² a square: this, and the polynomial.

    A real angle needs e² ≤ a² + b²; none is where the terms say that this never holds.
    """
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, polynomial, angle)
        if parts is None or parts[2] == 0:
            continue
        if all(_is_number(ring, part) for part in parts):
            continue  # an angle in numbers is solved, or is none
        a, b, e = parts
        beyond = ring.normal(e * e - a * a - b * b)
        if _is_positive(ring, assumptions, beyond):
            return [ring.one]
        if beyond == 0 or not _may_be_square(ring, beyond):
            continue
        for written in (beyond, homogeneous(ring, beyond)):
            shape = primitive(written)
            if written.coeffs()[0] > 0 and shape.coeffs()[0] > 0:
                root = root_of_square(shape)
                if root is not None:
                    root = ring.normal(root)
                    number = _is_number(ring, root)
                    return [ring.one] if number else [root, polynomial]
    return None


def _is_positive(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> bool:
    """Whether a proof was found: by sizes, or in one angle without a zero."""
    if _sign_of_the_rest(ring, assumptions, polynomial) == 1:
        return True
    own = unknowns(ring, polynomial)
    if [kind for kind, _ in own] != ["angle"] or not never_met(ring, [polynomial]):
        return False
    angle = own[0][1]
    gens = list(ring.context.gens())
    gens[ring.sine_index(angle)], gens[ring.cosine_index(angle)] = ring.zero, ring.one
    return assumptions.sign_of(ring, polynomial.compose(*gens)) == 1


def _may_be_square(ring: TrigonometricRing, polynomial: Polynomial) -> bool:
    """Whether it is a number times a square at exact points: one class of residues."""
    source, prime = random.Random(17), branch_primes()[0]
    seen: set[bool] = set()
    for _ in range(_POINTS):
        point = random_point(ring, source, prime)
        value = 0 if point is None else residue(polynomial, point, prime)
        if value:
            seen.add(pow(value, (prime - 1) // 2, prime) == 1)
        if len(seen) > 1:
            return False
    return True


def _extremal(
    ring: TrigonometricRing, polynomial: Polynomial
) -> list[Polynomial] | None:
    """Of a number and products of sines and cosines that must all be ±1 to cancel it.

    Where a sine is ±1 its cosine is 0.
    """
    terms = {tuple(map(int, e)): c for e, c in polynomial.to_dict().items()}
    number = abs(terms.pop((0,) * len(ring.names), 0))
    if not number or number != sum(map(abs, terms.values())):
        return None
    partner: dict[int, int] = {}
    for angle in range(len(ring.basis)):
        sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
        partner |= {sine: cosine, cosine: sine}
    occurring = {i for monomial in terms for i, e in enumerate(monomial) if e}
    if not occurring <= set(partner):
        return None
    gens = ring.context.gens()
    return [gens[partner[i]] for i in sorted(occurring)]


def homogeneous(ring: TrigonometricRing, polynomial: Polynomial) -> Polynomial:
    """Made homogeneous in each angle by s² + c² = 1, where all degrees are even or odd.

    So 1 − c² becomes s².  The value is no normal form.
    """
    gens = ring.context.gens()
    for angle in range(len(ring.basis)):
        if len(polynomial) > _HOMOGENEOUS:
            break
        sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
        parts: dict[int, dict[tuple[int, ...], Any]] = {}
        for exponents, coefficient in polynomial.to_dict().items():
            degree = int(exponents[sine]) + int(exponents[cosine])
            parts.setdefault(degree, {})[exponents] = coefficient
        whole = max(parts)
        if any((whole - degree) % 2 for degree in parts):
            continue
        unit = gens[sine] ** 2 + gens[cosine] ** 2
        polynomial = sum(
            (
                ring.context.from_dict(part) * unit ** ((whole - degree) // 2)
                for degree, part in parts.items()
            ),
            ring.zero,
        )
    return polynomial


def _monomials(ring: TrigonometricRing, polynomial: Polynomial) -> set[tuple[int, ...]]:
    """Of the terms, without algebraic numbers, which are not zero."""
    return {tuple(map(int, e[: _count(ring)])) for e in polynomial.monoms()}


def _is_number(ring: TrigonometricRing, polynomial: Polynomial) -> bool:
    return _monomials(ring, polynomial) <= {(0,) * _count(ring)}


def _count(ring: TrigonometricRing) -> int:
    """Generators that are no algebraic numbers."""
    return len(ring.names) - len(ring.constant_generators)


def _radical(ring: TrigonometricRing, monomial: tuple[int, ...]) -> Polynomial:
    total = ring.one
    for generator, exponent in zip(ring.context.gens(), monomial, strict=False):
        if exponent:
            total = total * generator
    return total
