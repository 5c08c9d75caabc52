"""Exact points of equations on random slices: some unknowns in numbers, one left over.

A set of dimension d meets a slice in which d unknowns have random rational values in
finitely many points.  With these values put in, all unknowns but one are eliminated,
and roots modulo a prime of what is left lead back to exact points.

References: [CoxLittleOShea] §3.1, §9.3.
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from fractions import Fraction
from itertools import islice
from typing import Final, TypeAlias

from screwkit.algebra.angle_elimination import Elimination, eliminated
from screwkit.algebra.branches import random_branch_prime
from screwkit.algebra.points import Point, residue, with_inverses
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

SLICES: Final = 6
"""Slices on which points are looked for."""

_EFFORT: Final = 300_000  # products of terms in one elimination
_KEPT: Final = 4  # unknowns that are left over in turn
_LARGEST: Final = 30  # numerators and denominators of values
_Values: TypeAlias = dict[int, Fraction]


def sliced_points(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    most: int,
) -> tuple[tuple[Point, int], ...]:
    """Exact points at which equations hold, with their primes, as far as found.

    Args:
        ring: Of the equations.
        equations: In normal form.
        given: Unknowns that any value may be given to, as dimensions.
        most: So many points are enough.
    """
    if ring.radicands:  # their values would depend on what is put in
        return ()
    met = [unknowns(ring, equation) for equation in equations]
    free = [*dict.fromkeys(u for own in met for u in own if u not in given)]
    alone = {u for own in met for u in own if len({*own} - {*given}) == 1}
    loose = [u for u in free if u not in alone]
    number = min(len(loose), max(0, len(free) - len(equations)))
    source = random.Random(20_077)
    found: list[tuple[Point, int]] = []
    for _ in range(SLICES if number or given else 1):
        chosen = source.sample(loose, number)
        values: _Values = {}
        for unknown in (*given, *chosen):
            values |= _value(ring, unknown, source)
        left = [u for u in free if u not in chosen]
        found += _on_slice(ring, equations, values, left, most - len(found), source)
        if len(found) >= most:
            break
    return tuple(found)


def _value(ring: TrigonometricRing, unknown: Unknown, source: random.Random) -> _Values:
    """A random rational value, of angles by the tangent of the half."""
    kind, number = unknown
    value = Fraction(source.randint(1, _LARGEST), source.randint(1, _LARGEST))
    if kind != "angle":
        return {number: value}
    below = 1 + value * value
    return {
        ring.sine_index(number): 2 * value / below,
        ring.cosine_index(number): (1 - value * value) / below,
    }


def _on_slice(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    values: _Values,
    left: Sequence[Unknown],
    most: int,
    source: random.Random,
) -> list[tuple[Point, int]]:
    gens = list(ring.context.gens())
    for index, value in values.items():
        gens[index] = ring.rational(value)
    pool = [primitive(e) for e in (e.compose(*gens) for e in equations) if e != 0]
    if any(equation.is_constant() for equation in pool):
        return []
    for unknown in islice([*left], _KEPT):
        plan = eliminated(ring, pool, [unknown], _EFFORT)
        if plan is not None:
            return _led_back(ring, equations, plan, values, most, source)
    return []


def _led_back(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    plan: Elimination,
    values: _Values,
    most: int,
    source: random.Random,
) -> list[tuple[Point, int]]:
    """Points of the slice, with what was put in."""
    found: list[tuple[Point, int]] = []
    for _ in range(2 * most):
        prime = random_branch_prime(source)
        point = plan.point(source, prime)
        if point is None:
            continue
        for index, value in values.items():
            below = pow(value.denominator, -1, prime)
            point[index] = value.numerator * below % prime
        point = with_inverses(ring, point, prime)
        if not any(residue(equation, point, prime) for equation in equations):
            found.append((point, prime))
        if len(found) == most:
            break
    return found
