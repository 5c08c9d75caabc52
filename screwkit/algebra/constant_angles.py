"""Angles that numbers fix: a·sin φ + b·cos φ + c = 0 with numbers a, b and c.

The sine is a combination of the cosine, or the other way round, and that one satisfies
a quadratic over the numbers.  Where it is irreducible there, both its roots are alike,
and one branch speaks of both; where they are in the field they are two sheets, as of
cos φ + sin φ = 0 beside √2.  Rational numbers are compared as they are, others in
balls; that a number of a field is no square is shown by a prime at which it is none.

References: [CoxLittleOShea] §4.6; [Washington1997] §2.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import reduce
from itertools import product
from math import prod

from flint import fmpq, fmpq_mat

from screwkit.algebra.over_roots import square_roots
from screwkit.algebra.points import branch_primes, random_point, residue
from screwkit.algebra.substitution import Substitution, angle_parts
from screwkit.algebra.survey import rational_root
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
)

_PRIMES = 24  # tried for one at which a number is no square


def constant_angle_steps(
    ring: TrigonometricRing, condition: Polynomial
) -> list[Substitution] | None:
    """Substitutions where an angle is fixed by numbers; empty where it is not real.

    None where the condition is of another kind, or its roots are not told.
    """
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, condition, angle)
        if parts is None:
            continue
        if all(part.is_constant() for part in parts):
            return _by_rationals(ring, angle, *map(as_fraction, parts))
        if all(is_number(ring, part) for part in parts):
            return _by_numbers(ring, angle, *parts)
    return None


def _by_rationals(
    ring: TrigonometricRing, angle: int, a: Fraction, b: Fraction, c: Fraction
) -> list[Substitution]:
    if c * c > a * a + b * b:
        return []
    # Eliminate the one with a coefficient; the other satisfies a quadratic.
    u, v = (-b / a, -c / a) if a else (Fraction(0), -c / b)
    lead = as_fraction(ring.one) + u * u
    over = ring.rational(1 / lead)
    # x = (−u·v ± √(1 + u² − v²))/(1 + u²)
    root = root_of_rational(ring, lead - v * v)
    if root is not None:
        line = ring.rational(u), ring.rational(v)
        middle = ring.rational(u * v)
        roots = [ring.normal((s * root - middle) * over) for s in (1, -1)]
        sheets = [_sheet(ring, angle, x, line, in_sine=not a) for x in roots]
        # cos φ = 1 is a double condition, and one angle.
        return sheets if root != 0 else [replace(sheets[0], sheet=None)]
    return [
        _step(ring, angle, (ring.rational(u), ring.rational(v)), over, in_sine=not a)
    ]


def root_of_rational(ring: TrigonometricRing, number: Fraction) -> Polynomial | None:
    """The positive root of a positive number that the square roots of a ring give."""
    squares = square_roots(ring)
    for taken in product((False, True), repeat=len(squares)):
        chosen = [root for root, t in zip(squares, taken, strict=True) if t]
        size = prod(root.square for root in chosen)
        rational = rational_root(number / size)
        if rational is not None:
            gens = ring.context.gens()
            start = ring.rational(rational)
            return reduce(lambda value, r: value * gens[r.place], chosen, start)
    return None


def _sheet(
    ring: TrigonometricRing,
    angle: int,
    x: Polynomial,
    line: tuple[Polynomial, Polynomial],
    *,
    in_sine: bool,
) -> Substitution:
    """The sheet x of the cosine, or of the sine; see `_step`."""
    sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
    places = (sine, cosine) if in_sine else (cosine, sine)
    values = dict(zip(places, (x, ring.normal(x * line[0] + line[1])), strict=True))
    along = ring.cosines[angle] * values[cosine] + ring.sines[angle] * values[sine]
    images = (sine, values[sine]), (cosine, values[cosine])
    return Substitution(images, ring.one, sheet=ring.normal(along - 1))


def _by_numbers(
    ring: TrigonometricRing, angle: int, a: Polynomial, b: Polynomial, c: Polynomial
) -> list[Substitution] | None:
    """The same with irrational ones: real for certain where c is 0."""
    if c != 0:
        return None
    kept, gone = (b, a) if a != 0 else (a, b)
    u = ring.normal(-kept * inverse_number(ring, gone))
    lead = ring.normal(1 + u * u)
    if not is_no_square(ring, lead):
        return None
    over = inverse_number(ring, lead)
    return [_step(ring, angle, (u, ring.zero), over, in_sine=a == 0)]


def _step(
    ring: TrigonometricRing,
    angle: int,
    line: tuple[Polynomial, Polynomial],
    over: Polynomial,
    *,
    in_sine: bool,
) -> Substitution:
    """The cosine, or the sine, as the unknown x, and the other one as u·x + v.

    Args:
        ring: Of the condition.
        angle: That is fixed.
        line: u and v.
        over: 1/(1 + u²).
        in_sine: Whether x is the sine.
    """
    sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
    index, gone = (sine, cosine) if in_sine else (cosine, sine)
    x = ring.context.gens()[index]
    image = x * line[0] + line[1]
    relation = _normal_but(ring, (x * x + image * image - 1) * over, x * x)
    field = tuple(
        (place, len(inside) - 1, _minimal(ring, place, inside))
        for place, inside in ring.algebraic_relations
        if isinstance(inside, tuple) and relation.degrees()[place]
    )
    return Substitution(((gone, image),), ring.one, (index, 2, relation), field=field)


def _normal_but(
    ring: TrigonometricRing, value: Polynomial, leading: Polynomial
) -> Polynomial:
    """A monic quadratic with coefficients in normal form, its square left alone."""
    if value.is_constant():
        return value
    rest = value
    for place, inside in ring.algebraic_relations:
        if isinstance(inside, tuple) and rest.degrees()[place] >= len(inside) - 1:
            rest = divmod(rest, _minimal(ring, place, inside))[1]
    assert (rest - leading).degrees() != leading.degrees()
    return rest


def _minimal(
    ring: TrigonometricRing, place: int, coefficients: Sequence[int]
) -> Polynomial:
    generator = ring.context.gens()[place]
    powers = enumerate(coefficients)
    return sum((a * generator**k for k, a in powers), ring.zero)


def is_number(ring: TrigonometricRing, value: Polynomial) -> bool:
    """Whether only irrational constants occur, no unknowns."""
    constants = {ring.names.index(name) for name in ring.constant_generators}
    return all(k in constants for k, d in enumerate(value.degrees()) if d > 0)


def inverse_number(ring: TrigonometricRing, number: Polynomial) -> Polynomial:
    """1 over a number of the ring's field of constants that is not 0."""
    monomials = [ring.one]
    for place, inside in ring.algebraic_relations:
        if isinstance(inside, tuple):
            x = ring.context.gens()[place]
            powers = [x**k for k in range(len(inside) - 1)]
            monomials = [m * p for m in monomials for p in powers]
    keys = [tuple(map(int, m.monoms()[0])) for m in monomials]
    size = len(keys)
    table = fmpq_mat(size, size)
    for column, monomial in enumerate(monomials):
        product = ring.normal(number * monomial)
        for exponents, coefficient in product.to_dict().items():
            table[keys.index(tuple(map(int, exponents))), column] = coefficient
    one = fmpq_mat(size, 1, [fmpq(int(not any(key))) for key in keys])
    solved = table.solve(one)
    pairs = enumerate(monomials)
    return sum((m * ring.context.constant(solved[k, 0]) for k, m in pairs), ring.zero)


def is_no_square(ring: TrigonometricRing, number: Polynomial) -> bool:
    """Whether it is proved that a number has no root in the field of constants.

    At a prime where the field has residues a square is the square of one.
    """
    source = random.Random(len(number))
    for prime in branch_primes()[:_PRIMES]:
        point = random_point(ring, source, prime)
        if point is None:
            continue
        value = residue(number, point, prime)
        if value and pow(value, (prime - 1) // 2, prime) != 1:
            return True
    return False
