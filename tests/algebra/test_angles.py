"""Sums of angles are found and written forwards."""

import pytest
from one_ring import in_one_ring

from screwkit.algebra.angles import merged, natural
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def polynomial(text: str) -> tuple[TrigonometricRing, Polynomial]:
    ring, (value,) = in_one_ring(text)
    return ring, value


@pytest.mark.parametrize(
    ("text", "terms"),
    [
        ("sin(q6 - q1)", 1),
        ("cos(q1 + q2)", 1),
        ("cos(q1 + q2 - q3)", 1),
        ("d5*sin(q2 + q3 + q4) + a2*cos(q2) + a3*cos(q2 + q3)", 3),
        ("a*sin(q1)*cos(q2) + b*cos(q1)*sin(q2)", 2),
        ("a*sin(q1)^2 + b*cos(q2)", 2),
    ],
)
def test_number_of_terms(text: str, terms: int) -> None:
    ring, value = polynomial(text)
    assert len(merged(ring, value).polynomial) == terms


def test_forms_are_ordered_and_point_forwards() -> None:
    ring, value = polynomial("sin(q1 - q6)")
    short = merged(ring, value)
    assert (("q6", 1), ("q1", -1)) in short.forms


def test_names_sort_by_number() -> None:
    assert sorted(["q10", "q2", "a"], key=natural) == ["a", "q2", "q10"]
