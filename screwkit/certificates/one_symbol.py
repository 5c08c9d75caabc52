"""Expressions that are polynomials in one symbol, with rational numbers."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

from screwkit.algebra.expression import (
    Expression,
    Symbol,
)

_DEGREE = 40


def coefficients_of(
    terms: list[tuple[Fraction, Counter[Expression]]],
) -> list[Fraction] | None:
    """Of 1, x, x² …, where terms are a polynomial in one symbol; None elsewhere.

    Args:
        terms: The number and the powers of each.
    """
    atoms = {atom for _, powers in terms for atom in powers}
    if len(atoms) != 1 or not all(isinstance(atom, Symbol) for atom in atoms):
        return None
    found: dict[int, Fraction] = {}
    for number, powers in terms:
        degree = powers.total()
        found[degree] = found.get(degree, Fraction(0)) + number
    if max(found) > _DEGREE:
        return None
    return [found.get(k, Fraction(0)) for k in range(max(found) + 1)]
