"""Whether an expression of a file is zero: for every value of its symbols, exactly.

Most are settled at a glance or at one random rational point, where a value other than
zero is a proof; what is left goes to the exact ring, whose normal form proves zero.
What neither proves stays open, and nothing is refused for it.

References: [CoxLittleOShea], §2.3 (normal forms).
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from math import comb
from typing import Final

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.evaluation import evaluate
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
from screwkit.algebra.expression_building import children, substitute, symbols_of
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.survey import SurveyRing, rational_root
from screwkit.errors import ExpressionError

_MOST_TERMS: Final = 5_000
"""Of an expression multiplied out, an upper bound; beyond it nothing is attempted."""
_CLEARLY: Final = 1e-6
_SAMPLES: Final = 8
_RIGHT_ANGLES: Final = {0: (1, 0), 1: (0, 1), 2: (-1, 0), 3: (0, -1)}


@lru_cache(maxsize=4096)
def is_zero(expression: Expression) -> bool | None:
    """Whether ``expression`` is zero for every value of its symbols.

    Returns:
        None where neither answer is proved.

    >>> is_zero(Sum((Symbol("a"), Product((Number(Fraction(-1)), Symbol("a"))))))
    True
    """
    if isinstance(expression, Number):
        return not expression.value
    if _is_plainly_nonzero(expression):
        return False
    point = _RationalPoint()
    try:
        value = evaluate(expression, point)
    except (ExpressionError, _OutsideError):
        return _by_normal_form(expression)
    if value:
        return False
    return _by_normal_form(expression) if point.drawn else True


def is_zero_at(expression: Expression, values: Mapping[str, Expression]) -> bool | None:
    """Whether ``expression`` is zero at these values of its symbols.

    Returns:
        None where neither answer is proved, or where a symbol has no value.

    Raises:
        ZeroDivisionError: If a denominator becomes the number zero.
    """
    try:
        return not evaluate(expression, _RationalPoint(values))
    except (ExpressionError, _OutsideError):
        closed = value_at(expression, values)
    return None if closed is None else is_zero(closed)


def value_at(
    expression: Expression, values: Mapping[str, Expression]
) -> Expression | None:
    """The closed expression at these values; None where a symbol has none.

    Raises:
        ZeroDivisionError: If a denominator becomes the number zero.
    """
    used = symbols_of(expression)
    if not used <= values.keys():
        return None
    return substitute(expression, {name: values[name] for name in used})


def is_negative(closed: Expression) -> bool:
    """Whether a number without symbols is certainly below zero."""
    exact = rational_value(closed)
    if exact is not None:
        return exact < 0
    value = closed_value(closed)
    return value is not None and value < -_CLEARLY


def _is_plainly_nonzero(expression: Expression) -> bool:
    match expression:
        case Number(value):
            return bool(value)
        case Pi() | Symbol() | Call("sin" | "cos", (Symbol(),)):
            return True
        case Product(parts):
            return all(map(_is_plainly_nonzero, parts))
        case Quotient(part, _) | Power(part, _):
            return _is_plainly_nonzero(part)
    return False


class _OutsideError(Exception):
    """The point has no rational value for what is asked."""


class _RationalPoint:
    """A ring of plain rationals: those given, or random ones for symbols and angles.

    Attributes:
        drawn: Whether any was.
    """

    zero, one = Fraction(0), Fraction(1)
    known = None
    plain = True

    def __init__(self, values: Mapping[str, Expression] | None = None) -> None:
        self.drawn = False
        self._values = values

    def rational(self, value: Fraction) -> Fraction:
        return value

    def symbol(self, name: str) -> Fraction:
        if self._values is not None:
            value = self._values.get(name)
            if not isinstance(value, Number):
                raise _OutsideError
            return value.value
        self.drawn = True
        return _drawn(name)

    def cosine_sine(self, angle: str) -> tuple[Fraction, Fraction]:
        if self._values is not None:
            return self.radians(self.symbol(angle))
        self.drawn = True
        half = _drawn(f"tan({angle}/2)")
        square = half * half
        return (1 - square) / (1 + square), 2 * half / (1 + square)

    def half_turns(self, count: Fraction) -> tuple[Fraction, Fraction]:
        quarters = 2 * count
        if quarters.denominator != 1:
            raise _OutsideError
        cosine, sine = _RIGHT_ANGLES[int(quarters) % 4]
        return Fraction(cosine), Fraction(sine)

    def radians(self, value: Fraction) -> tuple[Fraction, Fraction]:
        if value:
            raise _OutsideError
        return self.one, self.zero

    def square_root(self, radicand: Expression, value: Fraction) -> Fraction:
        root = rational_root(value)
        if root is None or (self.drawn and symbols_of(radicand)):
            raise _OutsideError
        return root

    def inverse(self, divisor: Expression, value: Fraction) -> Fraction:
        if not value:
            raise _OutsideError
        return 1 / value

    def normal(self, value: Fraction) -> Fraction:
        return value

    def is_zero(self, value: Fraction) -> bool:
        return not value


@lru_cache(maxsize=4096)
def _drawn(name: str) -> Fraction:
    source = random.Random(name)
    return Fraction(source.randrange(1, 1_000), source.randrange(1_001, 2_000))


def _by_normal_form(expression: Expression) -> bool | None:
    if _terms(expression) > _MOST_TERMS:
        return None
    # FLINT is loaded only for the few files that need it.
    from screwkit.algebra.trigonometric import TrigonometricRing  # noqa: PLC0415

    survey = SurveyRing()
    try:
        evaluate(expression, survey)
        ring = TrigonometricRing(survey)
        zero = ring.is_zero(ring.normal(evaluate(expression, ring)))
    except (ExpressionError, ValueError, KeyError, ZeroDivisionError):
        return None
    if zero:
        return None if _contradicted(expression) else True
    if not ring.extensions or _contradicted(expression):
        return False
    return None


def _contradicted(expression: Expression) -> bool:
    """Whether a number shows that this is not zero.

    The ring may choose the sign of a root, √(a²) = a; real values tell.
    """
    names = sorted(symbols_of(expression))
    source = random.Random(" ".join(names))
    for _ in range(_SAMPLES if names else 1):
        values: dict[str, Expression] = {
            name: Number(Fraction(source.randrange(-3_000, 3_000), 1_009))
            for name in names
        }
        try:
            value = closed_value(substitute(expression, values))
        except ZeroDivisionError:
            continue
        if value is not None and abs(value) > _CLEARLY:
            return True
    return False


def _terms(expression: Expression) -> int:
    """No fewer terms than the expression has when multiplied out."""
    below = [_terms(child) for child in children(expression)]
    match expression:
        case Sum():
            count = sum(below)
        case Power(_, exponent):
            count = comb(below[0] + abs(exponent) - 1, abs(exponent))
        case Call():
            count = 2 ** min(sum(below), 20)
        case _:
            count = 1
            for number in below:
                count *= number
    return min(count, _MOST_TERMS + 1)
