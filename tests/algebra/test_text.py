"""Writing expressions: canonical text, and the round trip as a law."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from screwkit.algebra.closed_values import closed_value
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
from screwkit.algebra.expression_building import (
    add,
    call,
    multiply,
    negate,
    power,
    quotient,
    substitute,
    symbols_of,
)
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.algebra.text import expression_text

x, y = Symbol("x"), Symbol("y")

numbers = st.fractions(-50, 50, max_denominator=30).map(Number)
atoms = st.one_of(numbers, st.just(Pi()), st.sampled_from([x, y, Symbol("r3")]))


def _quotient(parts: tuple[Expression, Expression]) -> Expression:
    above, below = parts
    return above if below == Number(Fraction(0)) else quotient(above, below)


def _power(parts: tuple[Expression, int]) -> Expression:
    base, exponent = parts
    return base if base == Number(Fraction(0)) else power(base, exponent)


expressions: st.SearchStrategy[Expression] = st.recursive(
    atoms,
    lambda inner: st.one_of(
        st.lists(inner, min_size=1, max_size=4).map(lambda terms: add(*terms)),
        st.lists(inner, min_size=1, max_size=4).map(lambda terms: multiply(*terms)),
        inner.map(negate),
        st.tuples(inner, inner).map(_quotient),
        st.tuples(inner, st.integers(-2, 2)).map(_power),
        inner.map(lambda argument: call("sin", argument)),
        inner.map(lambda argument: call("atan2", argument, Pi())),
    ),
    max_leaves=12,
)


@given(expressions)
@example(negate(add(x, y)))
@example(multiply(Number(Fraction(-1, 2)), add(x, y), power(negate(x), 2)))
@example(quotient(Number(Fraction(3, 4)), x))
@example(add(x, quotient(Number(Fraction(-1)), y)))
def test_text_parses_back_to_the_same_expression(expression: Expression) -> None:
    text = expression_text(expression)
    try:
        again = parse(text, limits=RESULT_LIMITS)
    except ZeroDivisionError:  # pragma: no cover
        pytest.fail(text)
    assert again == expression
    assert expression_text(again) == text


@given(expressions)
def test_normal_form_keeps_its_promises(expression: Expression) -> None:
    pending = [expression]
    while pending:
        match pending.pop():
            case Sum(terms):
                assert len(terms) > 1
                assert not any(isinstance(term, Sum) for term in terms)
                assert sum(isinstance(term, Number) for term in terms) <= 1
                pending.extend(terms)
            case Product(factors):
                assert len(factors) > 1
                kinds = (Product, Quotient)
                assert not any(isinstance(factor, kinds) for factor in factors)
                assert not any(isinstance(factor, Number) for factor in factors[1:])
                pending.extend(factors)
            case Quotient(above, below):
                assert not isinstance(below, Number)
                assert not isinstance(above, Quotient)
                pending.extend((above, below))
            case Power(base, exponent):
                assert exponent > 1
                pending.append(base)
            case Call(_, arguments):
                pending.extend(arguments)


@given(expressions)
def test_text_keeps_the_value(expression: Expression) -> None:
    point: dict[str, Expression] = {
        name: Number(Fraction(position + 2, 7))
        for position, name in enumerate(sorted(symbols_of(expression)))
    }
    try:
        before = closed_value(substitute(expression, point))
    except ZeroDivisionError:
        return
    text = expression_text(expression)
    after = closed_value(substitute(parse(text, limits=RESULT_LIMITS), point))
    assert (before is None) == (after is None)
    if before is not None and after is not None:
        assert after == pytest.approx(before, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    "text",
    [
        "r3*cos(q2) + d3*sin(q2)",
        "atan(-r3/d3) + pi",
        "q6 - q1",
        "-pi/2",
        "3*pi/4",
        "r1^2",
        "3/200",
        "-3/200",
        "x - y/2",
        "-(x + y)^2/z",
        "1/x^2",
        "x/(2*y)",
        "(x/y)^2",
        "x - 1/y",
        "sqrt(d3^2 + r3^2)",
    ],
)
def test_canonical_text(text: str) -> None:
    assert expression_text(parse(text)) == text


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (Product((x, Quotient(x, y))), "x*(x/y)"),
        (Power(x, -2), "x^(-2)"),
        (Quotient(x, Quotient(x, y)), "x/(x/y)"),
        (Sum((x, Sum((x, y)))), "x + (x + y)"),
        (Product((x, Number(Fraction(-1)))), "x*(-1)"),
    ],
)
def test_trees_out_of_normal_form_are_still_written_right(
    tree: Expression, text: str
) -> None:
    assert expression_text(tree) == text
