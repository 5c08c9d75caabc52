"""Columns up to a constant of the field: the shortest one, with a proved sign."""

from __future__ import annotations

from math import cos, pi, sqrt

import pytest

from screwkit.algebra.constant_multiples import (
    integral,
    inverse,
    is_number,
    shortest_multiple,
    sign,
)
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing

FIELD = ["sqrt(3)", "sqrt(2)", "cos(pi/5)", "a", "b"]


def ring() -> TrigonometricRing:
    survey = SurveyRing()
    for written in FIELD:
        evaluate(parse(written), survey)
    return TrigonometricRing(survey)


RING = ring()


def column(*written: str) -> tuple[object, ...]:
    return tuple(RING.normal(evaluate(parse(entry), RING)) for entry in written)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (("sqrt(3)/2*a", "3*sqrt(3)*b"), ("a", "6*b")),
        (("sqrt(3)/2", "3/2"), ("1", "sqrt(3)")),
        (("0", "-2*a", "4*b"), ("0", "-a", "2*b")),
        (("(1+sqrt(2))*a", "(2+2*sqrt(2))*b"), ("a", "2*b")),
        (("(1-sqrt(2))*a", "(2-2*sqrt(2))*b"), ("-a", "-2*b")),
        (("(sqrt(2)+sqrt(3))*a", "b*(sqrt(6)+3)"), ("a", "sqrt(3)*b")),
    ],
)
def test_what_all_share_goes_away(
    given: tuple[str, ...], expected: tuple[str, ...]
) -> None:
    """Each is the given column over a positive number; the factor is seen by eye."""
    assert shortest_multiple(RING, column(*given)) == column(*expected)


@pytest.mark.parametrize(
    "written",
    ["sqrt(3)", "1+sqrt(2)", "2-sqrt(3)", "cos(pi/5)", "1+sqrt(2)*cos(pi/5)+sqrt(3)"],
)
def test_an_inverse_times_its_number_is_one(written: str) -> None:
    (number,) = column(written)
    assert RING.normal(inverse(RING, number) * number) == RING.one


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("0", 0.0),
        ("2 - sqrt(3)", 2 - sqrt(3)),
        ("sqrt(2) - sqrt(3)", sqrt(2) - sqrt(3)),
        ("cos(pi/5) - 81/100", cos(pi / 5) - 0.81),
        ("sqrt(2) - 1414213562373095/1000000000000000", 4.8e-17),
    ],
)
def test_signs_are_those_of_the_real_numbers(written: str, value: float) -> None:
    (number,) = column(written)
    assert is_number(RING, number)
    assert sign(RING, number) == (value > 0) - (value < 0)


def test_a_symbol_is_no_number() -> None:
    assert not is_number(RING, column("a*sqrt(3)")[0])


def test_the_sign_of_a_rational_multiple_stays() -> None:
    values = integral(RING, column("-3/4*a", "9/2"))
    assert [text(RING, value) for value in values] == ["-a", "6"]
