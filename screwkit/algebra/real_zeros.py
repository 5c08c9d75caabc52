"""Real zeros of sums of squares: there every term vanishes.

A polynomial whose terms all have one sign is zero only where all of them are.  Which
terms a trigonometric polynomial has depends on how squares of cosines are written, so
1 − c² is tried for s² in every angle.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from typing import Any

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

TERMS = 40
"""Of a polynomial that is looked at."""

ANGLES = 5
"""That are written in both ways."""


def vanishing_together(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> list[Polynomial] | None:
    """Polynomials that all vanish wherever a sum of terms of one sign does.

    Each is a product of different generators; 1 is among them where there is no zero.

    Args:
        ring: Of the polynomial.
        assumptions: Signs of the symbols.
        polynomial: In normal form, not zero.

    Returns:
        None where the polynomial has one term, or was not found to be such a sum.
    """
    if not 1 < len(polynomial) <= TERMS:
        return None
    degrees = polynomial.degrees()
    squared = [k for k in range(len(ring.basis)) if degrees[ring.cosine_index(k)] > 1][
        :ANGLES
    ]
    for choice in product((False, True), repeat=len(squared)):
        chosen = [k for k, taken in zip(squared, choice, strict=True) if taken]
        written = _in_sines(ring, polynomial, chosen)
        if len(written) > 1 and assumptions.has_one_sign(ring, written):
            return [_radical(ring, m) for m in _monomials(ring, written)]
    return None


def _in_sines(
    ring: TrigonometricRing, polynomial: Polynomial, angles: Iterable[int]
) -> Polynomial:
    """With the squares of these angles' cosines written as 1 − s²."""
    gens = ring.context.gens()
    for angle in angles:
        place = ring.cosine_index(angle)
        square = 1 - gens[ring.sine_index(angle)] ** 2
        parts: dict[int, dict[tuple[int, ...], Any]] = {}
        for exponents, coefficient in polynomial.to_dict().items():
            count, odd = divmod(int(exponents[place]), 2)
            rest = tuple(odd if i == place else e for i, e in enumerate(exponents))
            parts.setdefault(count, {})[rest] = coefficient
        polynomial = sum(
            (ring.context.from_dict(p) * square**n for n, p in parts.items()), ring.zero
        )
    return polynomial


def _monomials(ring: TrigonometricRing, polynomial: Polynomial) -> set[tuple[int, ...]]:
    """Of the terms, without algebraic numbers, which are not zero."""
    first = len(ring.names) - len(ring.constant_generators)
    return {tuple(map(int, e[:first])) for e in polynomial.monoms()}


def _radical(ring: TrigonometricRing, monomial: tuple[int, ...]) -> Polynomial:
    total = ring.one
    for generator, exponent in zip(ring.context.gens(), monomial, strict=False):
        if exponent:
            total = total * generator
    return total
