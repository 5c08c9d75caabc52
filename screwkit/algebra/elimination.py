"""How an irreducible condition is solved, where it can be.

Three forms are solved outright: an angle up to its two sheets (``sin q4 = 0``), an
angle fixed by numbers, and a length that occurs linearly with a coefficient that cannot
vanish at the same time.  Each gives substitutions that cover all real zeros.
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.constant_angles import constant_angle_steps
from screwkit.algebra.remembered import remembered
from screwkit.algebra.substitution import (
    Substitution,
    angle_parts,
    linear_parts,
    substituted,
)
from screwkit.algebra.survey import rational_root
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
)

Steps = list[Substitution]


@remembered
def steps_of(
    ring: TrigonometricRing, assumptions: Assumptions, condition: Polynomial
) -> Steps | None:
    """One substitution per sheet; empty without real zeros; None where not solved."""
    steps = _angle_steps(ring, condition)
    if steps is None:
        steps = constant_angle_steps(ring, condition)
    if steps is None:
        steps = _symbol_steps(ring, assumptions, condition)
    return steps


def _angle_steps(ring: TrigonometricRing, condition: Polynomial) -> Steps | None:
    """P·sin φ + Q·cos φ = 0 with P² + Q² a square number: two sheets."""
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, condition, angle)
        if parts is None:
            continue
        p, q, rest = parts
        if rest != 0:
            continue
        square = ring.normal(p * p + q * q)
        if not square.is_constant():
            continue
        root = rational_root(as_fraction(square))
        if root is None:
            continue
        scale = ring.rational(1 / root)
        return [
            Substitution(
                (
                    (ring.sine_index(angle), ring.normal(-q * scale * sign)),
                    (ring.cosine_index(angle), ring.normal(p * scale * sign)),
                ),
                ring.one,
                sheet=_sheet(ring, angle, p * scale * sign, -q * scale * sign),
            )
            for sign in (1, -1)
        ]
    return None


def _sheet(
    ring: TrigonometricRing, angle: int, cosine: Polynomial, sine: Polynomial
) -> Polynomial:
    """cos(φ − φ₀) − 1, which is 0 on the sheet φ = φ₀ and −2 on the other."""
    along = ring.cosines[angle] * cosine + ring.sines[angle] * sine
    return ring.normal(along - 1)


def half_angle_steps(
    ring: TrigonometricRing,
    assumptions: Assumptions,
    condition: Polynomial,
    companions: Sequence[Polynomial],
) -> Steps | None:
    """Two linear equations in the sine and cosine of one angle: one sheet."""
    for step in half_angle_solutions(ring, condition, companions):
        if assumptions.is_nonzero(ring, step.divisor):
            return [step]
    return None


def half_angle_solutions(
    ring: TrigonometricRing, condition: Polynomial, companions: Sequence[Polynomial]
) -> Steps:
    """Solutions of such equations where the divisor is not zero, by angle."""
    found: Steps = []
    for angle in range(len(ring.basis)):
        rows = [
            row
            for e in (condition, *companions)
            if (row := angle_parts(ring, e, angle)) is not None
        ]
        if len(rows) != 2 or len(companions) != 1:
            continue
        (p, q, r), (u, v, w) = rows
        divisor = ring.normal(p * v - q * u)
        if divisor == 0:
            continue
        sine = ring.normal(q * w - r * v)
        cosine = ring.normal(r * u - p * w)
        if ring.normal(sine * sine + cosine * cosine - divisor * divisor) != 0:
            continue
        images = ((ring.sine_index(angle), sine), (ring.cosine_index(angle), cosine))
        found.append(Substitution(images, divisor))
    return found


def _symbol_steps(
    ring: TrigonometricRing, assumptions: Assumptions, condition: Polynomial
) -> Steps | None:
    """A·x + B = 0 where A and B have no common zero: x = −B/A."""
    degrees = condition.degrees()
    for index in ring.symbol_indices():
        if degrees[index] != 1:
            continue
        factor, rest = linear_parts(ring, condition, index)
        if assumptions.is_nonzero(ring, factor):
            turned = _unturned(ring, index, factor) if rest == 0 else ()
            return [Substitution(((index, -rest), *turned), factor)]
        if _never_both(ring, assumptions, factor, rest):
            return [Substitution(((index, -rest),), factor)]
    return None


def _unturned(
    ring: TrigonometricRing, index: int, divisor: Polynomial
) -> tuple[tuple[int, Polynomial], ...]:
    """The sine and cosine, over a divisor, of a symbol that is an angle too, at 0."""
    symbol = ring.context.gens()[index]
    for k, angle in ring.angles_as_numbers.items():
        if angle == symbol:
            return (ring.sine_index(k), ring.zero), (ring.cosine_index(k), divisor)
    return ()


def _never_both(
    ring: TrigonometricRing,
    assumptions: Assumptions,
    factor: Polynomial,
    rest: Polynomial,
) -> bool:
    """Whether ``factor`` = 0 implies ``rest`` ≠ 0, by solving ``factor`` = 0."""
    steps = _angle_steps(ring, factor) or constant_angle_steps(ring, factor)
    if steps is None:
        return False
    return all(
        assumptions.is_nonzero(ring, substituted(ring, [rest], step)[0])
        for step in steps
    )
