"""What an expression is written as: the terms of a sum, and the factors of a term."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

from screwkit.algebra.expression import Expression, Number, Power, Product, Sum


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
