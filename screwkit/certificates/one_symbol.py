"""Expressions that are polynomials in one symbol, with rational numbers."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

from screwkit.algebra.expression import (
    Expression,
    Number,
    Power,
    Product,
    Sum,
    Symbol,
)

_DEGREE = 40


def terms_of(expression: Expression) -> tuple[Expression, ...]:
    """The terms of a sum; of anything else itself."""
    return expression.terms if isinstance(expression, Sum) else (expression,)


def factors_of(term: Expression) -> tuple[Fraction, Counter[Expression]]:
    """The number of a term and the powers of everything else in it."""
    number, found = Fraction(1), Counter[Expression]()
    waiting = [(term, 1)]
    while waiting:
        factor, power = waiting.pop()
        match factor:
            case Number(value):
                number *= value**power
            case Product(factors):
                waiting += [(inner, power) for inner in factors]
            case Power(base, exponent) if exponent > 0:
                waiting.append((base, power * exponent))
            case _:
                found[factor] += power
    return number, found


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
