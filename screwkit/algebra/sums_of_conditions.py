"""What several unsolved conditions imply together, as multiples of them in a sum.

Two conditions whose leading coefficients are made equal; sums by Gauss's elimination
of monomials; and an equation multiplied until it is such a sum, by
pseudo-division by one condition after the other.

References: [CoxLittleOShea] §2.3, §6.5 (pseudo-division).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import combinations, combinations_with_replacement, count
from math import prod
from typing import Any, NamedTuple, TypeAlias

from flint import fmpq_mat

from screwkit.algebra.division import exact_quotient
from screwkit.algebra.substitution import angle_parts, linear_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

SHORT = 40
"""Terms of leading coefficients by which conditions are combined."""

LONGEST = 4_000
"""Terms of a sum, or of what is left of an equation."""

WIDEST = 500
"""Columns of a matrix of Macaulay."""

STEPS = 600
"""Pseudo-divisions of one equation."""

_History: TypeAlias = tuple[Any, ...]
"""Empty, or: history before, leading coefficient, number of the condition, quotient."""


@dataclass(frozen=True)
class Combination:
    """A sum of multiples of conditions.

    Attributes:
        value: The sum; not zero, unless it is a remainder that was asked for.
        times: By condition, what it is multiplied with; 0 where it is not needed.
        about: Of a remainder: number of the condition that was divided.
    """

    value: Polynomial
    times: tuple[Polynomial, ...]
    about: int = -1


def equal_leads(
    ring: TrigonometricRing, conditions: Sequence[Polynomial]
) -> Iterator[Combination]:
    """Sums of two conditions without the highest power of a generator in both."""
    for one, two in combinations(range(len(conditions)), 2):
        p, q = conditions[one], conditions[two]
        for index, (a, b) in enumerate(zip(p.degrees(), q.degrees(), strict=True)):
            if not a or a != b:
                continue
            first, second = (_leading(ring, c, index, int(a)) for c in (p, q))
            if min(len(first), len(second)) > SHORT:
                continue
            common = first.gcd(second)
            times = [ring.zero] * len(conditions)
            times[one], times[two] = second / common, -(first / common)
            value = ring.normal(times[one] * p + times[two] * q)
            if value != 0 and len(value) <= LONGEST:
                yield Combination(value, tuple(times))


def without_symbols(
    ring: TrigonometricRing,
    conditions: Sequence[Polynomial],
    usable: Callable[[int, Polynomial], bool] | None = None,
) -> Iterator[Combination]:
    """Conditions without a symbol that another one is linear in, by pseudo-division.

    Args:
        ring: Of the conditions.
        conditions: The conditions.
        usable: Whether to divide, by the index of the symbol and its coefficient; by
            default where that is short.  If it is given remainders may be 0.
    """
    for one, condition in enumerate(conditions):
        for index in ring.symbol_indices():
            if condition.degrees()[index] != 1:
                continue
            lead, _ = linear_parts(ring, condition, index)
            if len(lead) > SHORT or (usable and not usable(index, lead)):
                continue
            for two, other in enumerate(conditions):
                if two == one or not other.degrees()[index]:
                    continue
                times = [ring.zero] * len(conditions)
                times[two], rest = ring.one, other
                for degree in range(int(other.degrees()[index]), 0, -1):
                    top = _leading(ring, rest, index, degree)
                    factor = top * ring.context.gens()[index] ** (degree - 1)
                    times = [ring.normal(lead * t) for t in times]
                    times[one] -= factor
                    rest = ring.normal(lead * rest - factor * condition)
                    if len(rest) > LONGEST:
                        break
                if (rest != 0 or usable) and not rest.degrees()[index]:
                    yield Combination(rest, tuple(times), two)


def sums_by_elimination(
    ring: TrigonometricRing, conditions: Sequence[Polynomial], degree: int
) -> Iterator[Combination]:
    """Multiples of the conditions after Gauss's elimination of their monomials.

    Each condition is taken times all monomials up to a degree; monomials of high degree
    are eliminated first (Macaulay's matrix).  Square roots of numbers count as numbers.
    """
    factors = _monomials(ring, conditions, degree)
    rows = _multiples(ring, conditions, factors)
    if len(conditions) < 2:
        return
    found = []
    for vector in _eliminated(rows) or ():
        times = [ring.zero] * len(conditions)
        for own, row in zip(vector, rows, strict=True):
            times[row.condition] += row.factor * own
        value = ring.normal(
            sum((t * c for t, c in zip(times, conditions, strict=True)), ring.zero)
        )
        if value != 0 and sum(t != 0 for t in times) > 1:
            found.append(Combination(value, tuple(times)))
    yield from sorted(found, key=lambda own: len(own.value))


def times_constants(
    ring: TrigonometricRing,
    equation: Polynomial,
    conditions: Sequence[Polynomial],
    constants: Sequence[int],
    degree: int,
) -> Combination | None:
    """An equation times a polynomial in some symbols as a sum of multiples.

    Found by linear algebra: the multiples are by monomials up to a degree, and those of
    the equation by monomials in these symbols alone.

    Args:
        ring: Of all polynomials.
        equation: The equation.
        conditions: The conditions.
        constants: Indices of the symbols that the equation is multiplied with.
        degree: Of the monomials.
    """
    gens = ring.context.gens()
    rows = _multiples(ring, conditions, _monomials(ring, conditions, degree))
    first = len(rows)
    scales = [ring.one, *(gens[i] for i in constants)] if degree else [ring.one]
    rows += _multiples(ring, [equation], scales)
    for vector in _eliminated(rows, vanishing=True) or ():
        scale, times = ring.zero, [ring.zero] * len(conditions)
        for place, (own, row) in enumerate(zip(vector, rows, strict=True)):
            if place < first:
                times[row.condition] -= row.factor * own
            else:
                scale += row.factor * own
        if scale != 0:
            value = ring.normal(scale * equation)
            return Combination(value, tuple(times))
    return None


class _Row(NamedTuple):
    """A condition by its number, times a factor."""

    condition: int
    factor: Polynomial
    value: Polynomial


def _multiples(
    ring: TrigonometricRing,
    conditions: Sequence[Polynomial],
    factors: Sequence[Polynomial],
) -> list[_Row]:
    return [
        _Row(number, factor, ring.normal(factor * condition))
        for number, condition in enumerate(conditions)
        for factor in factors
    ]


def _eliminated(
    rows: Sequence[_Row], *, vanishing: bool = False
) -> list[list[Any]] | None:
    """By what rows are multiplied in sums with as few monomials of high degree.

    Args:
        rows: Of Macaulay's matrix.
        vanishing: Only sums that are 0, instead of all others.

    Returns:
        None where there are too many rows or monomials.
    """
    monomials = sorted(
        {tuple(map(int, e)) for row in rows for e in row.value.monoms()},
        key=lambda e: (-sum(e), e),
    )
    width = len(monomials)
    if width + len(rows) > WIDEST:
        return None
    places = {monomial: place for place, monomial in enumerate(monomials)}
    matrix = fmpq_mat(len(rows), width + len(rows))
    for place, row in enumerate(rows):
        for exponents, coefficient in row.value.to_dict().items():
            matrix[place, places[tuple(map(int, exponents))]] = coefficient
        matrix[place, width + place] = 1
    reduced, rank = matrix.rref()
    found = []
    for place in range(rank):
        is_zero = all(reduced[place, k] == 0 for k in range(width))
        if is_zero or not vanishing:
            found.append([reduced[place, width + k] for k in range(len(rows))])
    return found if not vanishing else found[::-1]


def _monomials(
    ring: TrigonometricRing, conditions: Sequence[Polynomial], degree: int
) -> list[Polynomial]:
    """In the generators that occur, up to a degree, times square roots of numbers."""
    gens = ring.context.gens()[: len(ring.names)]
    roots = {*ring.constant_generators}
    used = [
        gen
        for place, (name, gen) in enumerate(zip(ring.names, gens, strict=True))
        if name not in roots and any(c.degrees()[place] for c in conditions)
    ]
    found = [
        prod(chosen, start=ring.one)
        for size in range(degree + 1)
        for chosen in combinations_with_replacement(used, size)
    ]
    for name in roots:
        found += [factor * ring.generator(name) for factor in found]
    return found


def made_a_sum(
    ring: TrigonometricRing,
    equation: Polynomial,
    conditions: Sequence[Polynomial],
    usable: Callable[[Polynomial], bool],
) -> Combination | None:
    """A multiple of an equation that is a sum of multiples of conditions.

    Where what it is multiplied with does not vanish, it follows from the conditions.

    Args:
        ring: Of all polynomials.
        equation: The equation.
        conditions: The conditions.
        usable: Whether to multiply with a leading coefficient of a condition.
    """
    found = _as_sum(ring, equation, conditions, usable)
    if found is None:
        return None
    return Combination(ring.normal(found.value * equation), found.times)


def multiplier(
    ring: TrigonometricRing,
    equation: Polynomial,
    conditions: Sequence[Polynomial],
    usable: Callable[[Polynomial], bool],
) -> Polynomial | None:
    """What `made_a_sum` multiplies an equation with; None where it finds nothing."""
    found = _as_sum(ring, equation, conditions, usable)
    return None if found is None else found.value


def _as_sum(
    ring: TrigonometricRing,
    equation: Polynomial,
    conditions: Sequence[Polynomial],
    usable: Callable[[Polynomial], bool],
) -> Combination | None:
    """With the multiplier in place of the sum."""
    start: _History = ()
    waiting = [(0, 0, equation, ring.one, start)]
    seen: set[str] = set()
    order = count(1)
    while waiting and next(order) < STEPS:
        _, _, rest, scale, history = heappop(waiting)
        for number, condition in enumerate(conditions):
            for lead, quotient in _divisions(ring, rest, condition):
                left = ring.normal(lead * rest - quotient * condition)
                if len(left) > LONGEST or str(left) in seen or not usable(lead):
                    continue
                seen.add(str(left))
                divided: _History = (history, lead, number, quotient)
                whole = ring.normal(scale * lead)
                for last, other in enumerate(conditions):
                    exact = exact_quotient(left, other)
                    if exact is not None:
                        times = _multipliers(ring, len(conditions), divided)
                        return Combination(whole, _plus(ring, times, last, exact))
                cost = len(left) + len(whole)
                heappush(waiting, (cost, next(order), left, whole, divided))
    return None


def _multipliers(
    ring: TrigonometricRing, size: int, history: _History
) -> tuple[Polynomial, ...]:
    """What the conditions were multiplied with in some divisions, the last one first.

    Most divisions lead nowhere, so that this is not asked while they are made.
    """
    divisions = []
    while history:
        history, *last = history
        divisions.append(last)
    times = (ring.zero,) * size
    for lead, number, quotient in reversed(divisions):
        scaled = tuple(ring.normal(lead * t) for t in times)
        times = _plus(ring, scaled, number, quotient)
    return times


def _plus(
    ring: TrigonometricRing,
    times: Sequence[Polynomial],
    number: int,
    more: Polynomial,
) -> tuple[Polynomial, ...]:
    return tuple(
        ring.normal(t + more) if k == number else t for k, t in enumerate(times)
    )


def _divisions(
    ring: TrigonometricRing, value: Polynomial, condition: Polynomial
) -> Iterator[tuple[Polynomial, Polynomial]]:
    """(A, Q): A·value − Q·condition lacks a generator that both are linear in."""
    degrees = value.degrees(), condition.degrees()
    for index in ring.symbol_indices():
        if all(own[index] == 1 for own in degrees):
            lead, _ = linear_parts(ring, condition, index)
            top, _ = linear_parts(ring, value, index)
            yield _without_common(lead, top)
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, value, angle), angle_parts(ring, condition, angle)
        if parts[0] is None or parts[1] is None:
            continue
        for top, lead in zip(parts[0][:2], parts[1][:2], strict=True):
            if top != 0 and lead != 0:
                yield _without_common(lead, top)


def _without_common(lead: Polynomial, top: Polynomial) -> tuple[Polynomial, Polynomial]:
    common = lead.gcd(top)
    return lead / common, top / common


def _leading(
    ring: TrigonometricRing, value: Polynomial, index: int, degree: int
) -> Polynomial:
    """The coefficient of the highest power of a generator."""
    terms = {
        tuple(0 if i == index else e for i, e in enumerate(exponents)): coefficient
        for exponents, coefficient in value.to_dict().items()
        if exponents[index] == degree
    }
    return ring.context.from_dict(terms)
