"""What is left of conditions when unknowns are taken out, as a sum of their multiples.

The steps are those of `angle_elimination`.  Each makes new equations that are sums of
multiples of the old ones; the multipliers are carried along.

References: [CoxLittleOShea] §3.1 (elimination).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import NamedTuple

from screwkit.algebra.angle_elimination import (
    Determined,
    Solved,
    eliminated,
    parts_in,
)
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.sums_of_conditions import Combination
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

LONGEST = 4_000
"""Terms of all multipliers of one sum."""


class _Sum(NamedTuple):
    value: Polynomial
    times: tuple[Polynomial, ...]


def sums_without(
    ring: TrigonometricRing,
    conditions: Sequence[Polynomial],
    kept: Collection[Unknown],
) -> Iterator[Combination]:
    """Sums of multiples of conditions in the kept unknowns alone, where found.

    Args:
        ring: Of the conditions.
        conditions: In normal form.
        kept: Unknowns that may stay.
    """
    plan = eliminated(ring, conditions, kept, plain=True)
    if plan is None:
        return
    pool: list[_Sum] = []
    for number, own in enumerate(conditions):
        unit = [ring.zero] * len(conditions)
        unit[number] = ring.one
        if own != 0:
            pool.append(_Sum(own, tuple(unit)))
    for step in plan.steps:
        found = _stepped(ring, pool, step)
        if found is None:
            return
        pool = found
    for own in pool:
        total = ring.zero
        for times, condition in zip(own.times, conditions, strict=True):
            total += times * condition
        if ring.normal(total) == own.value:
            yield Combination(own.value, own.times)


def without_square_roots(
    ring: TrigonometricRing, found: Combination
) -> tuple[Polynomial, tuple[Polynomial, ...]]:
    """A sum times its conjugates, which is rational, and its multipliers.

    Args:
        ring: Of the sum.
        found: The sum.
    """
    value, times = found.value, found.times
    for name in ring.constant_generators:
        index = ring.names.index(name)
        if value.degrees()[index]:
            gens = list(ring.context.gens())
            gens[index] = -gens[index]
            other = value.compose(*gens)
            value = ring.normal(value * other)
            times = tuple(ring.normal(own * other) for own in times)
    return value, times


def _stepped(
    ring: TrigonometricRing, pool: Sequence[_Sum], step: Solved | Determined
) -> list[_Sum] | None:
    """The sums after one step; None where they are too long."""
    pair = step.pair if isinstance(step, Solved) else (step.equation,)
    used = []
    for equation in pair:
        own = next((s for s in pool if s.value == equation), None)
        if own is None:
            return None
        used.append(own)
    rest = [s for s in pool if not any(s is own for own in used)]
    found: list[_Sum] = []
    if isinstance(step, Solved):
        found += _meeting(ring, used, step)
    for own in rest:
        if step.unknown not in unknowns(ring, own.value):
            found.append(own)
            continue
        if not isinstance(step, Solved):
            return None  # products over both values of an angle are not carried along
        without = _put_in(ring, own, used, step)
        if without is None:
            return None
        found.append(without)
    if any(sum(map(len, own.times)) > LONGEST for own in found):
        return None
    return [_primitive(own) for own in found if own.value != 0]


def _added(ring: TrigonometricRing, *terms: tuple[Polynomial, _Sum]) -> _Sum:
    """A sum of multiples of sums."""
    value, times = ring.zero, [ring.zero] * len(terms[0][1].times)
    for factor, own in terms:
        value += factor * own.value
        times = [a + factor * b for a, b in zip(times, own.times, strict=True)]
    return _Sum(ring.normal(value), tuple(map(ring.normal, times)))


def _primitive(own: _Sum) -> _Sum:
    short = primitive(own.value)
    number = own.value.leading_coefficient() / short.leading_coefficient()
    return _Sum(short, tuple(times / number for times in own.times))


def _meeting(ring: TrigonometricRing, used: Sequence[_Sum], step: Solved) -> list[_Sum]:
    """What two equations say when their unknown is taken out."""
    one, two = used
    first, second = (parts_in(ring, own.value, step.unknown) for own in used)
    if first is None or second is None:
        return []
    kind, number = step.unknown
    if kind == "x":
        return [_added(ring, (first[0], two), (-second[0], one))]
    sine, cosine = _errors(ring, used, step)
    gens = ring.context.gens()
    (_, top), (_, side) = step.numerators
    # (D s)² + (D c)² = D²: the circle of the numerators is that of their errors.
    up = step.divisor * gens[ring.sine_index(number)] + top
    along = step.divisor * gens[ring.cosine_index(number)] + side
    return [_added(ring, (-up, sine), (-along, cosine))]


def _errors(
    ring: TrigonometricRing, used: Sequence[_Sum], step: Solved
) -> tuple[_Sum, ...]:
    """D·x less its numerator, by generator, as sums of the two equations."""
    one, two = used
    first, second = (parts_in(ring, own.value, step.unknown) for own in used)
    if first is None or second is None:
        raise ValueError("an equation that is not linear")
    if step.unknown[0] == "x":
        shorter = one if first[0] == step.divisor else two
        return (_added(ring, (ring.one, shorter)),)
    (p, q, _), (s, t, _) = first, second
    return _added(ring, (t, one), (-q, two)), _added(ring, (p, two), (-s, one))


def _put_in(
    ring: TrigonometricRing, own: _Sum, used: Sequence[_Sum], step: Solved
) -> _Sum | None:
    """An equation with the quotients put in, times their divisor."""
    parts = parts_in(ring, own.value, step.unknown)
    if parts is None:
        return None
    errors = _errors(ring, used, step)
    terms = [(-part, error) for part, error in zip(parts[:-1], errors, strict=True)]
    return _added(ring, (step.divisor, own), *terms)
