"""Expressions to sympy and back: what agrees, and what is refused."""

from __future__ import annotations

import math
import subprocess
import sys
from fractions import Fraction

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

import screwkit as sk
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.border import (
    from_sympy,
    polynomial_to_sympy,
    sympy_symbol,
    text_to_sympy,
    to_sympy,
)
from screwkit.algebra.expression import Expression, Number, Pi, Symbol
from screwkit.algebra.expression_building import add, call, multiply, power, quotient
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import text
from screwkit.errors import ExpressionError

leaves = st.one_of(
    st.fractions(min_value=-9, max_value=9, max_denominator=9).map(Number),
    st.sampled_from([Symbol("r3"), Symbol("q1"), Pi()]),
)


def branches(inner: st.SearchStrategy[Expression]) -> st.SearchStrategy[Expression]:
    return st.one_of(
        st.builds(add, inner, inner),
        st.builds(multiply, inner, inner),
        st.builds(power, inner, st.integers(1, 3)),
        st.builds(lambda x: call("sin", x), inner),
        st.builds(lambda x: call("atan", x), inner),
        st.builds(
            lambda x, y: quotient(x, add(power(y, 2), Number(Fraction(1)))),
            inner,
            inner,
        ),
    )


def value(expression: sympy.Expr) -> complex:
    numbers = {s: {"r3": 0.7, "q1": 0.4}[s.name] for s in expression.free_symbols}
    return complex(expression.subs(numbers).evalf(30))


@given(st.recursive(leaves, branches, max_leaves=8))
def test_there_and_back_keeps_the_value(expression: Expression) -> None:
    out = to_sympy(expression)
    again = to_sympy(from_sympy(out))
    assert value(again) == pytest.approx(value(out), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    "written",
    [
        "r3*cos(q2) + d3*sin(q2)",
        "atan(-r3/d3)",
        "2*atan2(y, x) - pi/3",
        "sqrt(d3^2 + r3^2)/2",
        "1/(1 + x^2)",
        "asin(x) + acos(x)*tan(q1 - q2)",
    ],
)
def test_texts_survive(written: str) -> None:
    out = text_to_sympy(written)
    assert to_sympy(from_sympy(out)) == out
    names = {"r3": 0.7, "d3": 0.2, "x": 0.3, "y": 0.5, "q1": 0.4, "q2": 0.9}
    expected = eval(written.replace("^", "**"), {**vars(math), **names})
    numbers = {s: names[s.name] for s in out.free_symbols}
    assert float(out.subs(numbers)) == pytest.approx(expected)


def test_symbols_are_real_and_positive_where_declared() -> None:
    known = Assumptions(positive=frozenset({"r3"}), nonzero=frozenset({"k"}))
    assert sympy_symbol("q1").is_real
    assert not sympy_symbol("q1").is_positive
    assert sympy_symbol("r3", known).is_positive
    assert sympy_symbol("k", known).is_nonzero
    assert text_to_sympy("sqrt(r3^2)", known) == sympy_symbol("r3", known)


def test_decimals_are_the_rationals_they_denote() -> None:
    assert from_sympy(sympy.Float("0.1")) == Number(Fraction(1, 10))
    assert from_sympy(sympy.Integer(3)) == from_sympy(3) == Number(Fraction(3))
    assert from_sympy(1 / sympy.sqrt(sympy.Symbol("x"))) == parse("1/sqrt(x)")


@pytest.mark.parametrize(
    "refused",
    [
        sympy.exp(sympy.Symbol("x")),
        sympy.I,
        sympy.oo,
        sympy.nan,
        sympy.E,
        sympy.GoldenRatio,
        sympy.Symbol("x") ** sympy.Symbol("y"),
        sympy.cbrt(sympy.Symbol("x")),
        sympy.Symbol("a b"),
        sympy.Symbol("sin"),
        sympy.Function("f")(sympy.Symbol("x")),
        sympy.Matrix([1]),
        sympy.Derivative(sympy.sin(sympy.Symbol("x")), sympy.Symbol("x")),
        sympy.true,
        sympy.Dummy("x"),
        "x",
        1.5j,
        True,
    ],
    ids=str,
)
def test_what_is_not_of_the_grammar_is_refused(refused: object) -> None:
    with pytest.raises(ExpressionError):
        from_sympy(refused)


def test_depth_is_bounded() -> None:
    x = sympy.Symbol("x")
    nested = x
    for _ in range(300):
        nested = sympy.sin(nested, evaluate=False)
    with pytest.raises(ExpressionError, match="deep"):
        from_sympy(nested)


@pytest.mark.parametrize("merge", [True, False])
@pytest.mark.parametrize("name", ["nao_t14", "three_arms", "dual_puma"])
def test_polynomials_agree_with_their_texts(name: str, merge: bool) -> None:
    twists = sk.load(name).limbs[1].twists
    for column in twists.columns:
        for polynomial in column:
            direct = polynomial_to_sympy(
                twists.ring, polynomial, twists.assumptions, merge_angles=merge
            )
            read = text_to_sympy(text(twists.ring, polynomial), twists.assumptions)
            if merge:
                assert sympy.expand(direct - read) == 0
            numbers = {
                s: 0.3 + 0.1 * i
                for i, s in enumerate(
                    sorted(direct.free_symbols | read.free_symbols, key=str)
                )
            }
            difference = (direct - read).subs(numbers)
            assert abs(float(difference)) < 1e-12


def test_the_package_does_not_import_sympy_by_itself() -> None:
    code = (
        "import sys, screwkit as sk; from screwkit.questions import screws; "
        "screws(sk.load('nao_t14')); assert 'sympy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
