"""Angles that are numbers too, as those of helical joints: what holds between both."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import cos, sin

import pytest

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factors import factor
from screwkit.algebra.parse import parse
from screwkit.algebra.real_point import real_point
from screwkit.algebra.solve import solutions
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

ALL = "q + r + x + y + cos(q) + cos(r) + sqrt(2)"


def ring_of(text: str = ALL) -> TrigonometricRing:
    """A ring in which q and r are angles and numbers."""
    survey = SurveyRing()
    evaluate(parse(text), survey)
    return TrigonometricRing(survey)


def read(ring: TrigonometricRing, text: str) -> Polynomial:
    return ring.normal(evaluate(parse(text), ring))


def branches(ring: TrigonometricRing, texts: Sequence[str]) -> list[Branch]:
    """Where these hold, imposed one after the other."""
    found = [Branch(ring, Assumptions())]
    for text in texts:
        value = read(ring, text)
        found = [
            p
            for b in found
            for p in ([b] if b.value(value) == 0 else restricted(b, b.value(value)))
            if not b.value(value).is_constant() or b.value(value) == 0
        ]
    return found


@pytest.mark.parametrize(
    "texts",
    [
        ("cos(q)", "q + 4"),  # cos 4 is transcendental
        ("q + 4", "cos(q)"),
        ("q - sqrt(2)", "2*sin(q) - 1"),
        ("sin(q)", "q - 1"),
        ("q", "cos(q) + 1"),  # cos 0 is 1
        ("cos(q)", "q"),
        ("q - r", "r - 2", "cos(q) - 1/3"),
    ],
)
def test_a_number_whose_cosine_is_another_one_is_no_posture(
    texts: tuple[str, ...],
) -> None:
    assert branches(ring_of(), texts) == []


@pytest.mark.parametrize(
    "texts",
    [
        ("q - 1", "cos(q) - x"),
        ("q - x", "cos(q)"),
        ("cos(q)", "cos(r)", "q - r"),
        ("q", "cos(q) - 1"),
    ],
)
def test_others_are(texts: tuple[str, ...]) -> None:
    assert branches(ring_of(), texts)


@pytest.mark.parametrize("zero", ["q", "-q", "2*q", "sqrt(2)*q"])
def test_at_0_the_cosine_is_1_and_says_nothing_more(zero: str) -> None:
    ring = ring_of()
    (found,) = branches(ring, [zero, "cos(q) - 1"])
    assert found.codimension == 1
    seen, x = found.column([read(ring, "x*cos(q) + y*sin(q)"), read(ring, "x")])
    assert seen == x


def test_real_points_have_the_cosines_of_their_numbers() -> None:
    ring = ring_of()
    (found,) = branches(ring, ["x - cos(q) - q*sin(q)"])
    point = real_point(found, {}, 1)
    assert point is not None
    q = point.numbers["q"]
    assert point.numbers["x"] == pytest.approx(cos(q) + q * sin(q), abs=1e-12)
    (fixed,) = branches(ring, ["q - 1", "x - cos(q)"])
    at_1 = real_point(fixed, {"y": Fraction(1)}, 1)
    assert at_1 is not None
    assert at_1.numbers["x"] == pytest.approx(cos(1), abs=1e-12)
    # q·cos q = 4 has real zeros; that is not shown, and q, cos q are not told apart.
    (tied,) = branches(ring, ["q*cos(q) - 4"])
    assert real_point(tied, {}, 1) is None


def test_what_holds_of_an_angle_and_its_number_is_solved_for_neither() -> None:
    ring = ring_of()
    (one,) = factor(ring, read(ring, "q - 2*sin(q)")).factors
    assert solutions(ring, one[0], Assumptions()) == ()
    (two,) = factor(ring, read(ring, "q - 2*sin(r)")).factors
    assert {s.variable for s in solutions(ring, two[0], Assumptions())} == {"q", "r"}
