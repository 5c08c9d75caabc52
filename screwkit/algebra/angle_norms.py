"""An angle taken out of any equations by one that is linear in its sine and cosine.

P sin + Q cos + R = 0 has two solutions, with w² = P² + Q² − R²: over D = P² + Q²,
sin is −P R ± Q w and cos is −Q R ∓ P w.  An equation holds at one of them where the
product of its values at both vanishes, which contains w² alone.

References: [CoxLittleOShea] §3.1 (elimination).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from screwkit.algebra.effort import Effort
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

LONGEST = 3_000
"""Terms of the value of an equation at a solution; beyond, it is given up."""


class _Value(NamedTuple):
    """u + v w."""

    u: Polynomial
    v: Polynomial


def without_angle(
    ring: TrigonometricRing,
    pool: Sequence[Polynomial],
    angle: int,
    place: int,
    effort: Effort,
) -> list[Polynomial] | None:
    """What equations imply without an angle; None where that is long.

    Args:
        ring: Of the equations.
        pool: In normal form.
        angle: Number of the angle in the basis.
        place: Of an equation that is linear in its sine and cosine.
        effort: What it may take.
    """
    parts = angle_parts(ring, pool[place], angle)
    if parts is None:
        return None
    p, q, r = parts
    below = ring.normal(p * p + q * q)
    square = ring.normal(below - r * r)
    if below == 0 or max(len(below), len(square)) > LONGEST:
        return None
    sine, cosine = _Value(-p * r, q), _Value(-q * r, -p)
    rest = []
    for number, equation in enumerate(pool):
        if number == place:
            continue
        if ("angle", angle) in unknowns(ring, equation):
            norm = _norm(ring, equation, angle, (sine, cosine, below, square), effort)
            if norm is None:
                return None
            equation = norm  # noqa: PLW2901 -- the same without the angle
        if equation != 0:
            rest.append(primitive(equation))
    return rest


def _norm(
    ring: TrigonometricRing,
    equation: Polynomial,
    angle: int,
    solution: tuple[_Value, _Value, Polynomial, Polynomial],
    effort: Effort,
) -> Polynomial | None:
    """The product of an equation's values at both solutions, times a power of D."""
    sine, cosine, below, square = solution
    s, c = ring.sine_index(angle), ring.cosine_index(angle)
    by_power: dict[tuple[int, int], dict[tuple[int, ...], object]] = {}
    for exponents, coefficient in equation.to_dict().items():
        key = int(exponents[s]), int(exponents[c])
        left = tuple(0 if i in (s, c) else int(e) for i, e in enumerate(exponents))
        by_power.setdefault(key, {})[left] = coefficient
    degree = max(i + k for i, k in by_power)
    total = _Value(ring.zero, ring.zero)
    for (i, k), terms in by_power.items():
        value = _Value(ring.context.from_dict(terms), ring.zero)
        for factor in (*[sine] * i, *[cosine] * k):
            cost = sum(map(len, value)) * sum(map(len, factor))
            if not effort.spend(cost):
                return None
            value = _product(ring, value, factor, square)
            if max(map(len, value)) > LONGEST:
                return None
        for _ in range(degree - i - k):
            value = _Value(ring.normal(value.u * below), ring.normal(value.v * below))
        total = _Value(total.u + value.u, total.v + value.v)
    cost = len(total.u) ** 2 + len(total.v) ** 2
    if cost > LONGEST**2 or not effort.spend(cost):
        return None
    return ring.normal(total.u * total.u - total.v * total.v * square)


def _product(
    ring: TrigonometricRing, one: _Value, other: _Value, square: Polynomial
) -> _Value:
    return _Value(
        ring.normal(one.u * other.u + ring.normal(one.v * other.v) * square),
        ring.normal(one.u * other.v + one.v * other.u),
    )
