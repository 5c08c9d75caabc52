"""Distances that are known exactly: conditions that are linear in free angles.

An equation solved for one angle, with integer multiples of others beside it, is a
family of parallel planes in the space of the angles.  Where the planes of a component
are perpendicular to each other, the nearest point lies at the nearest plane of each.
The angle about one axis by which a pose turns is such an angle: what else the pose has
may stay.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import pi

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.expression import (
    ONE,
    ZERO,
    Call,
    Expression,
    Number,
    Pi,
    Product,
    Sum,
    Symbol,
)
from screwkit.algebra.expression_building import (
    add,
    call,
    multiply,
    negate,
    power,
    quotient,
    substitute,
    subtract,
    symbols_of,
)
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.algebra.text import expression_text
from screwkit.mechanism.model import Pose
from screwkit.mechanism.vanishing import is_negative, is_zero
from screwkit.results.singularities import Component
from screwkit.results.solution import Solution


@dataclass(frozen=True)
class Planes:
    """Parallel planes: an integer combination of angles at values modulo 2π.

    Attributes:
        normal: The coefficient of each angle.
        levels: Values of the combination, in symbols of the dimensions.
    """

    normal: Mapping[str, int]
    levels: tuple[Expression, ...]

    @property
    def square(self) -> int:
        """Of the length of the normal."""
        return sum(n * n for n in self.normal.values())


@dataclass(frozen=True)
class ExactNearest:
    """The nearest point of a component.

    Attributes:
        distance: In radians, as a number and as a closed expression.
        values: Of the angles that change.
    """

    distance: float
    text: str
    values: Mapping[str, float]


def planes_of(
    component: Component, angles: Collection[str], dimensions: Collection[str]
) -> tuple[Planes, ...] | None:
    """The planes that a component is the intersection of.

    Args:
        component: Of a singular locus.
        angles: Free angles.
        dimensions: Symbols that stay.

    Returns:
        None where an equation is of another kind.
    """
    if len(component.solved) != len(component.equations):
        return None
    found = []
    for solution in component.solved:
        planes = solution and _planes(solution, angles, dimensions)
        if not planes:
            return None
        found.append(planes)
    return tuple(found)


def _planes(
    solution: Solution, angles: Collection[str], dimensions: Collection[str]
) -> Planes | None:
    if solution.variable not in angles or not solution.modulo:
        return None
    levels, normal = [], None
    for text in solution.values:
        level = parse(text, limits=RESULT_LIMITS)
        parts = _linear(level, angles)
        if parts is None or not symbols_of(level) <= {*angles, *dimensions}:
            return None
        slopes, rest = parts
        own = {n: -k for n, k in slopes.items()}
        own[solution.variable] = own.get(solution.variable, 0) + 1
        own = {n: k for n, k in own.items() if k}
        if not own or normal not in (None, own):
            return None
        normal = own
        levels.append(rest)
    return None if normal is None else Planes(normal, tuple(levels))


def _linear(
    expression: Expression, angles: Collection[str]
) -> tuple[dict[str, int], Expression] | None:
    """Integer multiples of angles and what is beside them; None for anything else."""
    if not symbols_of(expression) & frozenset(angles):
        return {}, expression
    match expression:
        case Symbol(name):
            return {name: 1}, ZERO
        case Product((Number(Fraction(denominator=1) as factor), Symbol(name))):
            return {name: int(factor)}, ZERO
        case Sum(terms):
            slopes: dict[str, int] = {}
            rest: Expression = ZERO
            for term in terms:
                part = _linear(term, angles)
                if part is None:
                    return None
                for name, count in part[0].items():
                    slopes[name] = slopes.get(name, 0) + count
                rest = add(rest, part[1])
            return slopes, rest
    return None


def angle_of_turn(pose: Pose, moving: Collection[str]) -> frozenset[str]:
    """The symbol whose change is the angle by which a pose turns, if one is.

    Args:
        pose: Of the platform.
        moving: Symbols that change.

    Returns:
        Empty where several symbols turn it, one turns it otherwise, or one shifts it as
        well.
    """
    turning = _symbols_in(pose.rotation) & frozenset(moving)
    if len(turning) != 1 or turning & _symbols_in((pose.translation,)):
        return frozenset()
    (name,) = turning
    before = Symbol(f"{name}'")  # No name of a file.
    entries = [x for row in pose.rotation for x in row]
    trace = add(*(multiply(x, substitute(x, {name: before})) for x in entries))
    angle = call("cos", subtract(Symbol(name), before))
    gap = subtract(trace, add(ONE, angle, angle))
    return turning if is_zero(gap) else frozenset()


def _symbols_in(rows: Iterable[Iterable[Expression]]) -> frozenset[str]:
    """Of all entries."""
    return frozenset[str]().union(*(symbols_of(x) for row in rows for x in row))


def exact_nearest(
    planes: Sequence[Planes],
    start: Mapping[str, Expression],
    dimensions: Mapping[str, Expression],
) -> ExactNearest | None:
    """The nearest common point of planes.

    Args:
        planes: Of the component.
        start: The angles of the posture, as closed expressions.
        dimensions: Values of the symbols in the levels.

    Returns:
        None where planes are not perpendicular, or a number is no real one.
    """
    if not _perpendicular(planes):
        return None
    gaps: list[tuple[Expression, int]] = []
    values: dict[str, float] = {}
    total = 0.0
    for one in planes:
        nearest = _nearest_level(one, start, dimensions)
        if nearest is None:
            return None
        gap, size = nearest
        total += size * size / one.square
        if gap != ZERO:
            gaps.append((gap, one.square))
        for name, count in one.normal.items():
            known = values.get(name, closed_value(start[name]) or 0.0)
            values[name] = known - count * size / one.square
    return ExactNearest(float(total**0.5), expression_text(_length(gaps)), values)


def _length(gaps: Sequence[tuple[Expression, int]]) -> Expression:
    """Of a way that crosses these gaps, each with the square of its normal."""
    if not gaps:
        return ZERO
    if len(gaps) == 1:
        ((gap, square),) = gaps
        return gap if square == 1 else quotient(gap, _root(Number(Fraction(square))))
    squares = (quotient(power(gap, 2), Number(Fraction(n))) for gap, n in gaps)
    return _root(add(*squares))


def _root(expression: Expression) -> Expression:
    return call("sqrt", expression)


def _with_signs_outside(expression: Expression) -> Expression:
    """The same with -atan(x) for atan(-x), so that signs can meet."""
    match expression:
        case Sum(terms):
            return add(*map(_with_signs_outside, terms))
        case Product(factors):
            return multiply(*map(_with_signs_outside, factors))
        case Call("atan" | "asin" as odd, (argument,)):
            if is_negative(argument):
                return negate(call(odd, negate(argument)))
    return expression


def _perpendicular(planes: Sequence[Planes]) -> bool:
    return all(
        not sum(k * other.normal.get(n, 0) for n, k in one.normal.items())
        for i, one in enumerate(planes)
        for other in planes[:i]
    )


def _nearest_level(
    planes: Planes,
    start: Mapping[str, Expression],
    dimensions: Mapping[str, Expression],
) -> tuple[Expression, float] | None:
    """How far the nearest level is: positive and exact, and as a number with sign.

    The number is 0.0 only where the difference is proved to vanish.
    """
    here = add(
        *(multiply(Number(Fraction(k)), start[n]) for n, k in planes.normal.items())
    )
    best: tuple[Expression, float] | None = None
    for level in planes.levels:
        there = _with_signs_outside(substitute(level, dict(dimensions)))
        size = closed_value(subtract(here, there))
        if size is None:
            return None
        turns = multiply(Number(Fraction(2 * round(size / (2 * pi)))), Pi())
        there = add(there, turns)
        gap = subtract(here, there)
        left = closed_value(gap)
        if left is None:
            return None
        if is_zero(gap):
            return ZERO, 0.0
        if best is None or abs(left) < abs(best[1]):
            best = (gap if left > 0 else subtract(there, here)), left
    return best
