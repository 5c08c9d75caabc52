"""Numbers in the place of closed expressions: is an axis zero, is a length positive.

Checks of files use these floats, and solutions that are shown: a value that is far from
any cosine is left out. No exact result rests on them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

from screwkit.algebra.expression import (
    Call,
    Expression,
    Number,
    Pi,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse

_NEAR: Final = 1e-9  # what floats may be wrong by
_FUNCTIONS: Final[dict[str, Callable[..., float]]] = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "sqrt": math.sqrt,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "atan2": math.atan2,
}


def closed_value(expression: Expression) -> float | None:
    """The number that an expression without symbols denotes.

    Returns:
        None where there are symbols, or no real number within a float's reach.

    >>> from fractions import Fraction
    >>> closed_value(Quotient(Pi(), Number(Fraction(2))))
    1.5707963267948966
    >>> closed_value(Symbol("x"))
    """
    try:
        value = _value(expression)
    except (ValueError, OverflowError, ZeroDivisionError, KeyError):
        return None
    return value if math.isfinite(value) else None


def may_be_cosine(text: str) -> bool:
    """Whether a text may be the cosine of a real angle; kept where floats do not tell.

    >>> may_be_cosine("1/3 + sqrt(2)"), may_be_cosine("1/3 - sqrt(2)/2")
    (False, True)
    >>> may_be_cosine("x + 7")
    True
    """
    value = closed_value(parse(text, limits=RESULT_LIMITS))
    return value is None or abs(value) < 1 + _NEAR


def _value(expression: Expression) -> float:
    match expression:
        case Number(value):
            return float(value)
        case Pi():
            return math.pi
        case Symbol(name):
            raise KeyError(name)
        case Sum(terms):
            return math.fsum(map(_value, terms))
        case Product(factors):
            return math.prod(map(_value, factors))
        case Quotient(numerator, denominator):
            return _value(numerator) / _value(denominator)
        case Power(base, exponent):
            return float(_value(base) ** exponent)
        case Call(function, arguments):
            return _FUNCTIONS[function](*map(_value, arguments))
