"""Expressions as canonical text of the file grammar.

The text of an expression in normal form parses back to an equal expression; other
trees parse back to their normal form.  Parentheses stand only where the grammar needs
them.
"""

from __future__ import annotations

from fractions import Fraction

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

_SUM, _PRODUCT, _POWER, _ATOM = range(4)


def expression_text(expression: Expression) -> str:
    """``expression`` in the grammar: ``r3*cos(q2) + d3*sin(q2)``.

    >>> from screwkit.algebra.expression_building import add, negate
    >>> expression_text(add(Symbol("q6"), negate(Symbol("q1"))))
    'q6 - q1'
    """
    return _written(expression)[0]


def _written(expression: Expression) -> tuple[str, int]:
    """The text and how tightly its loosest operator binds."""
    match expression:
        case Number(value):
            return _number(value)
        case Pi():
            return "pi", _ATOM
        case Symbol(name):
            return name, _ATOM
        case Sum(terms):
            return _sum(terms), _SUM
        case Product(factors):
            return _product(factors), _PRODUCT
        case Quotient(numerator, denominator):
            above = _at_least(numerator, _PRODUCT)
            return f"{above}/{_at_least(denominator, _POWER)}", _PRODUCT
        case Power(base, exponent):
            written = str(exponent) if exponent >= 0 else f"({exponent})"
            return f"{_at_least(base, _ATOM)}^{written}", _POWER
        case Call(function, arguments):
            inside = ", ".join(_written(argument)[0] for argument in arguments)
            return f"{function}({inside})", _ATOM


def _number(value: Fraction) -> tuple[str, int]:
    if value.denominator != 1:
        return f"{value.numerator}/{value.denominator}", _PRODUCT
    return str(value), _PRODUCT if value < 0 else _ATOM


def _at_least(expression: Expression, tightness: int) -> str:
    text, own = _written(expression)
    return text if own >= tightness else f"({text})"


def _sum(terms: tuple[Expression, ...]) -> str:
    text = _at_least(terms[0], _PRODUCT)
    for term in terms[1:]:
        written = _at_least(term, _PRODUCT)
        if written.startswith("-"):
            text += f" - {written[1:]}"
        else:
            text += f" + {written}"
    return text


def _product(factors: tuple[Expression, ...]) -> str:
    first, *rest = factors
    if not isinstance(first, Number):
        return "*".join(_factor(factor) for factor in factors)
    value = first.value
    tail = "*".join(_factor(factor) for factor in rest)
    head = {1: "", -1: "-"}.get(value.numerator, f"{value.numerator}*")
    below = f"/{value.denominator}" if value.denominator != 1 else ""
    return f"{head}{tail}{below}"


def _factor(factor: Expression) -> str:
    """A factor after the first number; a sum, quotient or sign needs parentheses."""
    return _at_least(factor, _POWER)
