"""Which expressions are plain rational numbers, decided exactly."""

from __future__ import annotations

from fractions import Fraction
from math import prod

from screwkit.algebra.expression import (
    Expression,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
)


def rational_value(expression: Expression) -> Fraction | None:
    """The rational that an expression of rationals and + − · / ^ denotes, else None.

    >>> rational_value(Sum((Number(Fraction(1)), Power(Number(Fraction(3, 4)), 2))))
    Fraction(25, 16)
    """
    match expression:
        case Number(value):
            return value
        case Sum(terms):
            values = [rational_value(term) for term in terms]
            known = [value for value in values if value is not None]
            return sum(known, Fraction(0)) if len(known) == len(values) else None
        case Product(factors):
            values = [rational_value(factor) for factor in factors]
            known = [value for value in values if value is not None]
            return prod(known, start=Fraction(1)) if len(known) == len(values) else None
        case Power(base, exponent):
            inner = rational_value(base)
            if inner is None or (not inner and exponent < 0):
                return None
            return Fraction(inner**exponent)
        case Quotient(numerator, denominator):
            above, below = rational_value(numerator), rational_value(denominator)
            return above / below if above is not None and below else None
        case _:
            return None
