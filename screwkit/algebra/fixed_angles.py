"""Angles that an equation in numbers fixes, put into other equations.

p sin φ + q cos φ + r = 0 gives the sine by the cosine, and the cosine's square by the
cosine; so of an angle fixed in numbers one generator is left, to the first power.

References: [CoxLittleOShea] §2.3 (division).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from screwkit.algebra.points_on import unknowns
from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
    primitive,
)


@dataclass(frozen=True)
class FixedAngle:
    """What an equation in numbers says of the sine and the cosine of an angle.

    Attributes:
        equation: The equation.
        angle: Number of the angle in the basis.
        index: The generator that is replaced.
        image: By what: linear in the other.
        relation: A quadratic polynomial of the other that vanishes.
    """

    equation: Polynomial
    angle: int
    index: int
    image: Polynomial
    relation: Polynomial


def fixed_angles(
    ring: TrigonometricRing, pool: Sequence[Polynomial]
) -> tuple[FixedAngle, ...]:
    """The angles that single equations fix, each once."""
    found: dict[int, FixedAngle] = {}
    for equation in pool:
        own = unknowns(ring, equation)
        if len(own) != 1 or own[0][0] != "angle" or own[0][1] in found:
            continue
        fixed = _fixed(ring, equation, own[0][1])
        if fixed is not None:
            found[own[0][1]] = fixed
    return tuple(found.values())


def _fixed(
    ring: TrigonometricRing, equation: Polynomial, angle: int
) -> FixedAngle | None:
    parts = angle_parts(ring, equation, angle)
    if parts is None or not all(part.is_constant() for part in parts):
        return None
    by_sine, by_cosine, rest = parts
    sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
    index, kept, p, q = sine, cosine, by_sine, by_cosine
    if p == 0:
        index, kept, p, q = cosine, sine, by_cosine, by_sine
    other = ring.context.gens()[kept]
    above = -(q * other + rest)
    return FixedAngle(
        equation,
        angle,
        index,
        above * ring.rational(1 / as_fraction(p)),
        above * above + p * p * (other * other - 1),
    )


def put_in(
    ring: TrigonometricRing, pool: Sequence[Polynomial], fixed: Sequence[FixedAngle]
) -> list[Polynomial]:
    """Equations with fixed angles put in; those that fix them stay as they are."""
    fixing = [own.equation for own in fixed]
    return [*_put_in(ring, pool, fixed, fixing)]


def _put_in(
    ring: TrigonometricRing,
    pool: Sequence[Polynomial],
    fixed: Sequence[FixedAngle],
    fixing: Sequence[Polynomial],
) -> Iterator[Polynomial]:
    for equation in pool:
        if equation in fixing:
            yield equation
            continue
        value = equation
        for own in fixed:
            if ("angle", own.angle) in unknowns(ring, value):
                value = _reduced(value, own)
        if value != 0:
            yield primitive(value)


def _reduced(value: Polynomial, own: FixedAngle) -> Polynomial:
    gens = list(value.context().gens())
    gens[own.index] = own.image
    return divmod(value.compose(*gens), own.relation)[1]
