"""Sums of multiples of conditions that are products on a node: what they say there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import chain, islice

from screwkit.algebra.branches import Branch
from screwkit.algebra.eliminated_sums import sums_without, without_square_roots
from screwkit.algebra.factors import Factor
from screwkit.algebra.linear_systems import has_solutions, linear_systems
from screwkit.algebra.points import residue
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.sums_by_cramer import sums_by_cramer
from screwkit.algebra.sums_of_conditions import (
    Combination,
    equal_leads,
    made_a_sum,
    sums_by_elimination,
    times_constants,
    without_symbols,
)
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.certificates.conditions import Conditions, Place
from screwkit.certificates.endings import Endings
from screwkit.certificates.equations_told import Multiple
from screwkit.certificates.steps import followed

SUMS_BY_CRAMER = 2_000
"""Of the conditions of one node, that are looked at."""


@dataclass(frozen=True)
class Sum:
    """A sum and what it is.

    Attributes:
        terms: Multiples of conditions of the way.
        factors: Of the sum on the node, with their powers.
    """

    terms: tuple[Multiple, ...]
    factors: tuple[tuple[Factor, int], ...]


def solvable_sum(known: Conditions, place: Place) -> Sum | None:
    """A sum all of whose factors can be solved or vanish nowhere; None if not found."""
    ring, values = place.branch.ring, [p.value for p in place.branch.pending]
    sums = chain(
        equal_leads(ring, values),
        sums_by_elimination(ring, values, 0),
        sums_by_elimination(ring, values, 1),
    )
    return _solvable(known, place, sums)


def sum_without_symbol(known: Conditions, place: Place) -> Sum | None:
    """As `solvable_sum`, where a symbol is taken out of a condition of any degree."""
    values = [pending.value for pending in place.branch.pending]
    return _solvable(known, place, without_symbols(place.branch.ring, values))


def _solvable(
    known: Conditions, place: Place, sums: Iterable[Combination]
) -> Sum | None:
    branch = place.branch
    for found in sums:
        value = branch.value(found.value)
        factors = [] if value == 0 else known.factors(branch, value)
        if factors and all(
            known.steps(branch, own) is not None or known.vanishes_nowhere(branch, own)
            for own, _ in factors
        ):
            numbers = [place.number(pending) for pending in branch.pending]
            return Sum(terms_of(place, numbers, found), tuple(factors))
    return None


def implied_equation(known: Endings, place: Place, *, axes: bool = False) -> Sum | None:
    """A sum that is a multiple of an equation of a component; None if not found.

    Args:
        known: Of the problem.
        place: The node.
        axes: Whether squares of axes are asked for, too.
    """
    branch = place.branch
    numbers = [n for n, (value, _) in enumerate(place.followed) if value != 0]
    values = [place.followed[number][0] for number in numbers]
    if len(values) < 2:
        return None
    for equation in _wanted(known, place, axes=axes):
        found = made_a_sum(branch.ring, equation, values, _is_free(known, place))
        if found is not None:
            factors = known.factors(branch, found.value)
            if not known.is_held(place, factors):
                return Sum(terms_of(place, numbers, found), tuple(factors))
    return None


def equation_times_dimensions(known: Conditions, place: Place) -> Sum | None:
    """A sum that is an equation of a component times dimensions; None if not found.

    These vanish where dimensions are tied to each other alone.
    """
    branch = place.branch
    values = [pending.value for pending in branch.pending]
    if len(values) < 2:
        return None
    for equation in _wanted(known, place):
        for degree in (0, 1):
            found = times_constants(
                branch.ring, equation, values, branch.dimensions, degree
            )
            if found is not None:
                numbers = [place.number(pending) for pending in branch.pending]
                factors = known.factors(branch, found.value)
                return Sum(terms_of(place, numbers, found), tuple(factors))
    return None


def paired_equation(known: Conditions, place: Place) -> Sum | None:
    """An equation of a component as a sum of the two conditions of a half-angle factor.

    The conditions are h·sin(φ/2) and h·cos(φ/2), so that the sum of their squares is
    h², and the equation is h times something.
    """
    branch = place.branch
    if len(branch.pending) < 2:
        return None
    held = {str(primitive(p.value)): n for n, p in enumerate(branch.pending)}
    for equations in known.problem.components:
        for value in followed(branch, equations)[0]:
            for own, _ in known.factors(branch, value) if value != 0 else ():
                places = [held.get(str(primitive(e)), -1) for e in own.equations]
                if len(places) < 2 or min(places) < 0:
                    continue
                found = _as_a_sum(known, branch, value, own.equations, places)
                if found is not None:
                    numbers = [place.number(pending) for pending in branch.pending]
                    whole = Factor(f"whole {value}", (primitive(value),))
                    return Sum(terms_of(place, numbers, found), ((whole, 1),))
    return None


def _as_a_sum(
    known: Conditions,
    branch: Branch,
    value: Polynomial,
    equations: Sequence[Polynomial],
    places: Sequence[int],
) -> Combination | None:
    """A value as a sum of multiples of the two equations of its half-angle factor."""
    ring = branch.ring
    square = ring.normal(sum((e * e for e in equations), ring.zero))
    times = [ring.zero] * len(branch.pending)
    total = ring.zero
    for equation, place in zip(equations, places, strict=True):
        multiplier = known.quotient(ring.normal(value * equation), square)
        if multiplier is None:
            return None
        condition = branch.pending[place].value
        number = equation.leading_coefficient() / condition.leading_coefficient()
        times[place] = multiplier * number
        total += times[place] * condition
    if ring.normal(total) != value:
        return None
    return Combination(value, tuple(times))


def sum_without_angles(known: Conditions, place: Place) -> Sum | None:
    """A sum in few unknowns, all of whose factors can be solved or vanish nowhere.

    Unknowns are taken out until one angle, or the dimensions alone, are left.
    """
    branch = place.branch
    ring, values = branch.ring, [pending.value for pending in branch.pending]
    if len(values) < 2:
        return None
    dimensions = [("x", index) for index in branch.dimensions]
    angles = {u for v in values for u in unknowns(ring, v) if u[0] == "angle"}
    for kept in ([], *([angle] for angle in sorted(angles))):
        for found in sums_without(ring, values, [*dimensions, *kept]):
            own, times = without_square_roots(ring, found)
            own = branch.value(own)
            factors = [] if own == 0 else known.factors(branch, own)
            if factors and all(
                known.vanishes_nowhere(branch, f) or known.steps(branch, f) is not None
                for f, _ in factors
            ):
                numbers = [place.number(pending) for pending in branch.pending]
                return Sum(
                    terms_of(place, numbers, Combination(own, times)), tuple(factors)
                )
    return None


def determinant_sum(known: Conditions, place: Place) -> Sum | None:
    """The determinant of two conditions that are linear in two symbols and homogeneous.

    It vanishes where one of the symbols is not 0.
    """
    branch = place.branch
    ring, values = branch.ring, [pending.value for pending in branch.pending]
    held = {str(primitive(value)) for value in values}
    if len(values) < 2:
        return None
    for system in linear_systems(ring, values):
        if len(system.symbols) > 2 or has_solutions(values, system, branch.nonzero):
            continue
        one, two = system.conditions
        kept = next(i for i in system.symbols if i in branch.nonzero)
        (other,) = {*system.symbols} - {kept}
        times = [ring.zero for _ in values]
        times[one] = linear_parts(ring, values[two], other)[0]
        times[two] = -linear_parts(ring, values[one], other)[0]
        total = ring.normal(times[one] * values[one] + times[two] * values[two])
        factors = known.factors(branch, total)
        if not any(str(primitive(f.equations[0])) in held for f, _ in factors):
            numbers = [place.number(pending) for pending in branch.pending]
            found = Combination(total, tuple(times))
            return Sum(terms_of(place, numbers, found), tuple(factors))
    return None


def sum_by_cramer(known: Conditions, place: Place) -> Sum | None:
    """A product of which some factor is solved, and the others hold fewer unknowns.

    Or one of which a factor is what a component still needs.  Of several the one that
    leaves the fewest unsolved, then the shortest.
    """
    branch = place.branch
    ring, values = branch.ring, [pending.value for pending in branch.pending]
    held = {str(primitive(value)) for value in values}
    wanted = {str(primitive(own)) for own in _wanted(known, place, axes=True)}
    best: tuple[tuple[int, ...], Combination, list[tuple[Factor, int]]] | None = None
    sums = sums_by_cramer(ring, values, branch.dimensions)
    for found in islice(sums, SUMS_BY_CRAMER):
        value = found.combination.value
        factors = known.factors(branch, value)
        if any(str(primitive(e)) in held for own, _ in factors for e in own.equations):
            continue
        zero = [own for own, _ in factors if not known.vanishes_nowhere(branch, own)]
        left = [own for own in zero if known.steps(branch, own) is None]
        new = [f for f in left if str(primitive(f.equations[0])) not in wanted]
        if len(new) == len(zero):
            continue  # no product, or none that is easier
        degrees = [own.equations[0].degrees() for own in left]
        if any(degree[i] for degree in degrees for i in found.symbols):
            continue
        cost = (
            len(new),
            len(left),
            sum(len(own.equations[0]) for own in left),
            len(value),
        )
        if best is None or cost < best[0]:
            best = cost, found.combination, factors
    if best is None:
        return None
    numbers = [place.number(pending) for pending in branch.pending]
    return Sum(terms_of(place, numbers, best[1]), tuple(best[2]))


def _wanted(known: Conditions, place: Place, *, axes: bool = False) -> list[Polynomial]:
    """Factors of equations of components that seem to hold, and are not shown to.

    Those of components of which the fewest are left come first.  With squares of axes,
    if they are asked for: where one of them is 0 nothing is.
    """
    branch = place.branch
    found = []
    squares = known.problem.axes.values() if axes and branch.points else ()
    for equations in chain(known.problem.components, ([own] for own in squares)):
        if branch.points and not known.all_vanish(equations, branch):
            continue
        left = []
        for equation in equations:
            if known.multiples(place, [equation]) is not None:
                continue
            value = followed(branch, [equation])[0][0]
            for own, _ in known.factors(branch, value):
                first, *more = own.equations
                if not more and not any(residue(first, *at) for at in branch.points):
                    left.append(first)
        if branch.points or len(left) == 1:
            found.append(left)
    return [own for left in sorted(found, key=len) for own in left]


def _is_free(known: Conditions, place: Place) -> Callable[[Polynomial], bool]:
    """Tells polynomials that do not vanish on all of a node, as far as is seen."""
    branch = place.branch
    if branch.points:
        return lambda value: not known.all_vanish([value], branch)
    held = {str(primitive(c)) for c in place.conditions}
    return lambda value: str(primitive(value)) not in held


def terms_of(
    place: Place, conditions: Sequence[int], found: Combination
) -> tuple[Multiple, ...]:
    """A sum in the terms of a certificate.

    Args:
        place: The node.
        conditions: On the way to it, by number: those that were combined.
        found: Their sum.
    """
    branch = place.branch
    return tuple(
        Multiple(
            -1,
            condition,
            text(branch.ring, times),
            place.followed[condition][1],
        )
        for condition, times in zip(conditions, found.times, strict=True)
        if times != 0
    )
