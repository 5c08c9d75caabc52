"""Polynomials freed from factors that vanish nowhere: shorter, with the same zeros.

The squared lengths of axes divide most minors of a parallel robot, and what a step of a
branch was divided by divides what comes after it.  Taken out, they leave polynomials
that are short enough to be factored.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from screwkit.algebra.branches import Branch
from screwkit.algebra.constant_multiples import is_number
from screwkit.algebra.division import Divisor
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.over_roots import square_roots
from screwkit.algebra.points import residue
from screwkit.algebra.remembered import RememberedColumns
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

FACTORED = 40
"""Terms of a polynomial up to which factoring finds such factors just as soon."""

POWERS = 3
"""Of a coordinate that a condition may divide."""

_SHORT = 6  # terms of such a coordinate

_KNOWN: Final = RememberedColumns[TrigonometricRing, list[Polynomial]]()


def without_nowhere_zero(
    ring: TrigonometricRing,
    vector: Sequence[Polynomial],
    nonvanishing: Sequence[Polynomial],
) -> list[Polynomial]:
    """A projective vector divided by what divides all its entries and has no zero.

    Args:
        ring: Of the entries, in normal form.
        vector: Not all zero, or empty.
        nonvanishing: Polynomials without a zero where the vector is looked at.
    """
    longest = max(map(len, vector), default=0)
    if (longest <= FACTORED and _is_factored(ring)) or not nonvanishing:
        return list(vector)
    given = tuple(str(polynomial) for polynomial in nonvanishing)
    found = _KNOWN.answer(
        ring, vector, given, lambda: _without(ring, vector, nonvanishing)
    )
    return [*found]


def _is_factored(ring: TrigonometricRing) -> bool:
    """Whether short polynomials are split: not over numbers such as 2 cos π/18."""
    return not ring.constant_generators or bool(square_roots(ring))


def _without(
    ring: TrigonometricRing,
    vector: Sequence[Polynomial],
    nonvanishing: Sequence[Polynomial],
) -> list[Polynomial]:
    entries = list(vector)
    layout = Layout.of(ring)
    halves = HalfAngles(ring, layout)
    order = sorted(range(len(entries)), key=lambda i: len(entries[i]))
    order = [i for i in order if entries[i] != 0]
    for polynomial in sorted(nonvanishing, key=len, reverse=True):
        if is_number(ring, polynomial):  # √3 divides everything, time and again
            continue
        divisor = Divisor(polynomial, ring, halves, layout)
        while True:
            quotients: dict[int, Polynomial] = {}
            for i in order:
                quotient = divisor.divide(entries[i])
                if quotient is None:
                    break
                quotients[i] = ring.normal(quotient)
            if len(quotients) < len(order):
                break
            entries = [quotients.get(i, value) for i, value in enumerate(entries)]
    return entries


def loses_a_direction(branch: Branch) -> bool:
    """Whether a vector that is zero nowhere would be zero on all of a branch.

    Proved: a pending condition divides each of its coordinates.
    """
    if not branch.pending:
        return False
    ring = branch.ring
    layout = Layout.of(ring)
    halves = HalfAngles(ring, layout)
    divisors = [Divisor(p.value, ring, halves, layout) for p in branch.pending]
    for vector in branch.directions:
        if any(residue(x, *point) for x in vector for point in branch.points):
            continue
        if all(_vanishes(branch, x, divisors) for x in branch.column(vector)):
            return True
    return False


def _vanishes(
    branch: Branch, polynomial: Polynomial, divisors: Sequence[Divisor]
) -> bool:
    """Whether a condition divides a polynomial, or a power of one that is short.

    Where sin p = cos p the cube of x − 2 cos p is linear in cos p, and is not factored.
    """
    power = polynomial
    for exponent in range(1, 1 + (POWERS if len(polynomial) <= _SHORT else 1)):
        if exponent > 1:
            power = branch.value(power * polynomial)
        if power == 0 or any(own.divide(power) is not None for own in divisors):
            return True
    return False


def is_excluded(branch: Branch, nonvanishing: Sequence[Polynomial]) -> bool:
    """Whether a branch is empty: something non-zero would be zero on all of it.

    Proved: a pending condition divides a polynomial without a zero on the branch, or
    what an earlier step divided by has become zero.
    """
    if any(divisor == 0 for divisor in branch.divisors):
        return True
    if not branch.pending or not nonvanishing:
        return False
    ring = branch.ring
    layout = Layout.of(ring)
    halves = HalfAngles(ring, layout)
    divisors = [Divisor(p.value, ring, halves, layout) for p in branch.pending]
    return any(
        divisor.divide(polynomial) is not None
        for divisor in divisors
        for polynomial in nonvanishing
        if not polynomial.is_constant()
    )
