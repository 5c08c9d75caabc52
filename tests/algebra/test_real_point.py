"""Real points: found where there are some, proved by balls, never claimed elsewhere."""

from __future__ import annotations

from fractions import Fraction
from math import cos, sin, sqrt

import pytest

import screwkit as sk
from screwkit.algebra.branches import Branch
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.real_point import RealPoint, real_point

GIVEN = {"a": Fraction(3), "b": Fraction(1)}


def on(*texts: str, case: str = "3upu_tsai", vanishing: str = "0") -> RealPoint | None:
    """A real point of conditions in the symbols of a case."""
    assembly = sk.load(case).assembly
    ring = assembly.common_twists.ring
    conditions = tuple(ring.normal(evaluate(parse(text), ring)) for text in texts)
    branch = Branch(ring, assembly.assumptions, conditions=conditions)
    both = ring.normal(evaluate(parse(vanishing), ring))
    return real_point(branch, GIVEN, 1, equations=[both])


@pytest.mark.parametrize("name", ["x", "y"])
def test_of_two_parts_that_one_is_meant_on_which_more_vanishes(name: str) -> None:
    found = on("x*y", "z - b/2", vanishing=name)
    assert found is not None
    assert found.numbers[name] == pytest.approx(0, abs=1e-12)


def test_a_point_of_a_sphere_and_a_plane_lies_on_both() -> None:
    found = on("x^2 + y^2 + z^2 - a^2", "z - b/2")
    assert found is not None
    x, y, z = (found.numbers[name] for name in "xyz")
    assert (found.numbers["a"], found.numbers["b"]) == (3.0, 1.0)
    assert x * x + y * y + z * z == pytest.approx(9, abs=1e-12)
    assert z == pytest.approx(0.5, abs=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "x^2 + y^2 + z^2 + a",  # no real zero
        "x^2 + y^2",  # real zeros, at which the differential vanishes
        "(x - y)^2",
        "x^2 + 10^(-9)",  # nearly a zero
    ],
)
def test_nothing_is_claimed_without_proof(text: str) -> None:
    assert on(text) is None


def test_roots_are_the_positive_ones() -> None:
    found = on("x - sqrt(3)*b")
    assert found is not None
    assert found.numbers["x"] == pytest.approx(sqrt(3), abs=1e-12)


def test_angles_are_those_of_the_basis() -> None:
    assembly = sk.load("nao_t14").assembly
    ring = assembly.common_twists.ring
    condition = ring.normal(evaluate(parse("r3*cos(q2) + d3*sin(q2)"), ring))
    branch = Branch(ring, assembly.assumptions, conditions=(condition,))
    lengths = {"r3": Fraction(21, 200), "d3": Fraction(3, 200)}
    found = real_point(branch, lengths, 1)
    assert found is not None
    q2 = found.turns[ring.basis.index((("q2", 1),))]
    assert 7 * cos(q2) + sin(q2) == pytest.approx(0, abs=1e-12)
