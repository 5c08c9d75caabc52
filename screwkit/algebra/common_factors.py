"""Common factors of trigonometric polynomials that a plain gcd does not see.

In Q[c, s]/(c² + s² − 1) a normal form may hide a factor: sin² is written 1 − cos².  The
irreducible factors of the shortest entry are tried on all of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import reduce
from typing import Final

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.division import Divisor
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.factors import factor
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.remembered import RememberedColumns
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LONGEST = 600
"""Terms of the shortest entry beyond which its factors are not asked for."""

_KNOWN: Final = RememberedColumns[
    FactorLibrary | TrigonometricRing, tuple[Polynomial, ...]
]()


def without_common_factors(
    ring: TrigonometricRing,
    column: Sequence[Polynomial],
    library: FactorLibrary | None = None,
) -> tuple[Polynomial, ...]:
    """A projective column without the factors that all its entries share.

    Args:
        ring: Of the entries, in normal form.
        column: Not all zero.
        library: Of the same ring; reuse one for several columns.
    """
    owner = ring if library is None else library
    return _KNOWN.answer(owner, column, None, lambda: _without(ring, column, library))


def may_vanish_together(
    ring: TrigonometricRing, values: Iterable[Polynomial], assumptions: Assumptions
) -> bool:
    """Whether polynomials that are not zero have a factor in common that may vanish.

    A condition whose coefficients they are then holds whatever its variable is.
    """
    common = reduce(lambda a, b: a.gcd(b), values)
    return not common.is_constant() and not assumptions.is_nonzero(ring, common)


def _without(
    ring: TrigonometricRing, column: Sequence[Polynomial], library: FactorLibrary | None
) -> tuple[Polynomial, ...]:
    entries = tuple(column)
    values = [value for value in entries if value != 0]
    plain = reduce(lambda a, b: a.gcd(b), sorted(values, key=len))
    if not plain.is_constant():
        entries = tuple(ring.normal(value / plain) for value in entries)
        values = [value for value in entries if value != 0]
    shortest = min(values, key=len)
    if shortest.is_constant() or len(shortest) > LONGEST or len(values) < 2:
        return entries
    layout = Layout.of(ring)
    halves = HalfAngles(ring, layout)
    for found, power in factor(ring, shortest, library).factors:
        divisor = Divisor(found.equations[0], ring, halves, layout)
        for _ in range(power):
            quotients = _quotients(divisor, entries)
            if quotients is None:
                break
            entries = tuple(ring.normal(quotient) for quotient in quotients)
    return entries


def _quotients(
    divisor: Divisor, entries: Sequence[Polynomial]
) -> list[Polynomial] | None:
    """All entries divided; None, and no more work, as soon as one cannot be."""
    found = []
    for entry in entries:
        quotient = divisor.divide(entry) if entry != 0 else entry
        if quotient is None:
            return None
        found.append(quotient)
    return found
