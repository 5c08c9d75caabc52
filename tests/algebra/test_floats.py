"""Floats of one posture follow arrays of many in all."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from screwkit.algebra.batch import BatchRing
from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.expression import Symbol
from screwkit.algebra.floats import FloatRing
from screwkit.algebra.parse import parse
from screwkit.errors import UnknownNameError

VALUES = {"a": 0.7, "q": -1.3}
TEXTS = [
    "a^3 - 2/7*a",
    "sqrt(a + 2)",
    "a/(1 - a)",
    "cos(q)*sin(2*q) - tan(q)",
    "pi*a",
    "cos(pi/2) + sin(7*pi/6)",
    "cos(1/3)",
    "sin(atan2(a, 2)) + cos(acos(a))",
]


@pytest.mark.parametrize("text", TEXTS)
def test_as_arrays_of_one_posture(text: str) -> None:
    expression = parse(text, ("a", "q"))
    value = evaluate(expression, FloatRing(VALUES))
    assert type(value) is float
    assert value == pytest.approx(float(evaluate(expression, BatchRing(VALUES))))


def test_what_does_not_exist_follows_numpy() -> None:
    ring = FloatRing({})
    assert math.isnan(ring.square_root(Symbol("a"), -1.0))
    assert [ring.inverse(Symbol("a"), x) for x in (0.0, -0.0)] == [math.inf, -math.inf]


@pytest.mark.parametrize("quarter", range(-4, 9))
def test_quarter_turns_are_exact(quarter: int) -> None:
    expected = np.round(
        [math.cos(quarter * math.pi / 2), math.sin(quarter * math.pi / 2)]
    )
    assert FloatRing({}).half_turns(Fraction(quarter, 2)) == tuple(expected)
    angle = parse(f"{quarter}/2*pi" if quarter >= 0 else f"-{-quarter}/2*pi", ())
    assert cosine_sine(angle, FloatRing({})) == tuple(expected)


def test_symbols_without_a_value() -> None:
    with pytest.raises(UnknownNameError):
        FloatRing({}).symbol("a")
