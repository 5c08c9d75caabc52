"""What two conditions imply together: one unknown of both eliminated.

Two conditions P·sin φ + Q·cos φ + R = 0 on one angle fix its sine and cosine over the
determinant of their coefficients; without R that determinant vanishes.  Two conditions
in one symbol have a common root only where their resultant vanishes.  What is implied
vanishes at every common zero, and is often short or solvable where they are not.

References: [CoxLittleOShea] §3.6 (resultants).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations

from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

SHORT = 24
"""Terms of conditions that are put together."""

PAIRS = 6
"""Conditions on one angle that are put together."""

LONGEST = 60
"""Terms of conditions from which an unknown is eliminated."""

DEGREE = 4
"""In a symbol that is eliminated."""

_Linear = tuple[Polynomial, Polynomial, Polynomial]


def resolvents(
    ring: TrigonometricRing, polynomials: Sequence[Polynomial]
) -> list[Polynomial]:
    """Determinants of pairs P·sin φ + Q·cos φ, not zero, each once."""
    short = [p for p in polynomials if len(p) <= SHORT]
    found: dict[str, Polynomial] = {}
    for angle in range(len(ring.basis)):
        rows = [row for row in _linear_in(ring, short, angle) if row[2] == 0]
        for one, two in combinations(rows[:PAIRS], 2):
            _take(ring, found, one[0] * two[1] - one[1] * two[0])
    return list(found.values())


def eliminants(
    ring: TrigonometricRing, one: Polynomial, two: Polynomial
) -> list[Polynomial]:
    """What follows from two conditions without one of the unknowns they share.

    Args:
        ring: Of the conditions.
        one: A condition, in normal form.
        two: Another.
    """
    found: dict[str, Polynomial] = {}
    for angle in range(len(ring.basis)):
        rows = list(_linear_in(ring, (one, two), angle))
        if len(rows) == 2:
            _take(ring, found, _without_angle(*rows))
    degrees = one.degrees(), two.degrees()
    for index in ring.symbol_indices():
        if all(0 < d[index] <= DEGREE for d in degrees):
            _take(ring, found, one.resultant(two, ring.names[index]))
    return sorted(found.values(), key=len)


def _linear_in(
    ring: TrigonometricRing, polynomials: Iterable[Polynomial], angle: int
) -> Iterator[_Linear]:
    for polynomial in polynomials:
        parts = angle_parts(ring, polynomial, angle)
        if parts is not None:
            yield parts


def _without_angle(one: _Linear, two: _Linear) -> Polynomial:
    (p, q, r), (u, v, w) = one, two
    below = p * v - q * u
    if r == 0 and w == 0:
        return below
    sine, cosine = q * w - r * v, r * u - p * w
    return sine * sine + cosine * cosine - below * below


def _take(
    ring: TrigonometricRing, found: dict[str, Polynomial], value: Polynomial
) -> None:
    value = ring.normal(value)
    if value != 0:
        value = primitive(value)
        found[str(value)] = value
