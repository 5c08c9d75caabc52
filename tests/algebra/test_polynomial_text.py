"""Canonical text is a fixed point and reads back."""

import pytest
from one_ring import in_one_ring

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.polynomial_text import equation_text, text, to_expression
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def polynomial(text: str) -> tuple[TrigonometricRing, Polynomial]:
    ring, (value,) = in_one_ring(text)
    return ring, value


@pytest.mark.parametrize(
    "written",
    [
        "0",
        "-2/3",
        "x",
        "-x/2",
        "r3*cos(q2) + d3*sin(q2)",
        "r3*cos(q7) - d3*sin(q7)",
        "sin(q6 - q1)",
        "cos(q6 - q1)",
        "2*r1*cos(q2) + d3",
        "d5*sin(q2 + q3 + q4) + a2*cos(q2) + a3*cos(q2 + q3)",
        "-cos(q4) + 1",
        "a*sin(q1)^2 + b",
        "x^2 + x*y + 1",
        "sqrt(3)*cos(q1)/2 + sin(q1)/2",
        "x*sqrt(x^2 + y^2)",
        "r1*d3*sin(q10 - q2)",
        "sin(1/2)",
    ],
)
def test_canonical_text_is_a_fixed_point(written: str) -> None:
    assert text(*polynomial(written)) == written


@pytest.mark.parametrize(
    "written",
    [
        "(a*sin(q1) + b*cos(q2 - q1))^3",
        "cos(pi/7)^2*x + sin(pi/7)",
        "-a*sin(q1)*cos(q2)^2 + sqrt(2)*sqrt(5)*b",
        "1/(x + y)*sin(q1)",
    ],
)
def test_text_reads_back(written: str) -> None:
    ring, value = polynomial(written)
    assert ring.normal(evaluate(to_expression(ring, value), ring)) == value


def test_an_equation_starts_with_a_plus() -> None:
    assert equation_text(*polynomial("d3*sin(q7) - r3*cos(q7)")) == (
        "r3*cos(q7) - d3*sin(q7)"
    )
    assert equation_text(*polynomial("1 - cos(q4)")) == "cos(q4) - 1"
