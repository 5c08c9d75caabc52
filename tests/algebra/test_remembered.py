"""Answers that are kept with their ring, and points on conditions linear in something.

What is kept is compared with what is asked anew; points are compared with the
conditions that they must meet.
"""

from __future__ import annotations

import gc
import random
import weakref
from collections.abc import Sequence

import pytest

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, Pending
from screwkit.algebra.elimination import steps_of
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factors import FactorLibrary, factor
from screwkit.algebra.parse import parse
from screwkit.algebra.points import differential, random_point, residue
from screwkit.algebra.real_zeros import vanishing_together
from screwkit.algebra.remembered import LONGEST, remembered
from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

P = 2**61 - 1


def ring_and(*texts: str) -> tuple[TrigonometricRing, list[Polynomial]]:
    """A ring with angles q1, q2, q3 and lengths a, b, c, and some of its elements."""
    survey = SurveyRing()
    every = [parse(text) for text in ("sin(q1) + sin(q2) + sin(q3) + a*b*c", *texts)]
    for one in every:
        evaluate(one, survey)
    ring = TrigonometricRing(survey)
    return ring, [ring.normal(evaluate(one, ring)) for one in every[1:]]


def test_a_question_is_asked_once_for_each_ring_and_assumption() -> None:
    asked = []

    @remembered
    def length(ring: TrigonometricRing, given: str, polynomial: Polynomial) -> int:
        asked.append((ring, given, str(polynomial)))
        return len(polynomial)

    ring, (one, other) = ring_and("a + b", "a - b")
    again, (same,) = ring_and("a + b")
    for _ in range(2):
        assert length(ring, "", one) == 2
        assert length(ring, "", other) == 2
        assert length(ring, "positive", one) == 2
        assert length(again, "", same) == 2
    assert len(asked) == 4


def test_what_is_too_long_is_not_kept() -> None:
    asked = []

    @remembered
    def length(ring: TrigonometricRing, given: str, polynomial: Polynomial) -> int:
        asked.append(given)
        return len(polynomial)

    ring, (a, b, c) = ring_and("a", "b", "c")
    long = (a + 2 * b + 3 * c + 1) ** 10
    assert len(long) > LONGEST
    assert length(ring, "", long) == length(ring, "", long) == len(long)
    assert len(asked) == 2


def test_a_ring_that_nobody_uses_goes_with_its_answers() -> None:
    ring, (value,) = ring_and("a^2 + b^2")
    assert vanishing_together(ring, Assumptions(), value) is not None
    assert steps_of(ring, Assumptions(), value) is None
    factor(ring, value, FactorLibrary(ring))
    gone = weakref.ref(ring)
    del ring, value
    gc.collect()
    assert gone() is None


def test_assumptions_are_kept_apart() -> None:
    ring, (value,) = ring_and("a + b")
    for _ in range(2):
        assert not Assumptions().is_nonzero(ring, value)
        assert Assumptions(positive=frozenset("ab")).is_nonzero(ring, value)
        assert not Assumptions(nonzero=frozenset("ab")).is_nonzero(ring, value)


def test_libraries_are_kept_apart() -> None:
    """Two rings of the same names may have other relations; texts alone are alike."""
    ring, (value,) = ring_and("a^2 - b^2")
    first, second = FactorLibrary(ring), FactorLibrary(ring)
    once, twice = factor(ring, value, first), factor(ring, value, first)
    assert once is twice
    assert factor(ring, value, second) == once
    assert once.expand(ring) == value


@pytest.mark.parametrize(
    "text",
    [
        "a*sin(q1)*cos(q2) - b*cos(q1)*sin(q3) + c",
        "sin(q1)*(a + b*cos(q3)) + cos(q1)",
        "a*sin(q1) + b",
        "cos(q1)*sin(q2) + a*sin(q2)",
    ],
)
def test_parts_of_an_angle_make_up_the_polynomial(text: str) -> None:
    ring, (value,) = ring_and(text)
    parts = angle_parts(ring, value, 0)
    assert parts is not None
    by_sine, by_cosine, rest = parts
    assert by_sine * ring.sines[0] + by_cosine * ring.cosines[0] + rest == value
    places = ring.sine_index(0), ring.cosine_index(0)
    assert not any(part.degrees()[i] > 0 for part in parts for i in places)


@pytest.mark.parametrize(
    "text", ["a*sin(q1)*cos(q1) + b", "a*cos(q1)^2 + sin(q1)", "a + sin(q2)"]
)
def test_what_is_not_linear_in_an_angle_has_no_parts(text: str) -> None:
    ring, (value,) = ring_and(text)
    assert angle_parts(ring, value, 0) is None


@pytest.mark.parametrize(
    "texts",
    [
        ["a*sin(q1) + b*cos(q1) + c"],
        ["2*sin(q1) - cos(q1) + 1"],
        ["3*sin(q1)*cos(q1) + cos(q2)"],
        ["a*b - c*sin(q2) + 5"],
        ["a^2 - b*c"],
        ["a*sin(q1) + b", "c*cos(q2) - sin(q3)*a"],
    ],
)
def test_points_meet_their_conditions(texts: Sequence[str]) -> None:
    ring, values = ring_and(*texts)
    pending = tuple(Pending(value, value) for value in values)
    branch = Branch(ring, Assumptions(), tuple(values), pending=pending)
    source = random.Random(3)
    seen = set()
    for _ in range(12):
        found = branch.point(source)
        assert found is not None
        point, prime = found
        assert not any(residue(value, point, prime) for value in values)
        for angle in range(len(ring.basis)):
            sine, cosine = (
                point[ring.sine_index(angle)],
                point[ring.cosine_index(angle)],
            )
            assert (sine * sine + cosine * cosine) % prime == 1
        seen.add(tuple(point))
    assert len(seen) == 12


def test_differentials_are_difference_quotients() -> None:
    """Modulo p a first difference divided by h is the derivative for a square in h."""
    text = "a*sin(q1)*cos(q2) + b^2*sin(q1)"
    ring, (value,) = ring_and(text)
    point = random_point(ring, random.Random(5), P)
    assert point is not None
    names = [*(dict(form) for form in ring.basis)]
    row = differential(ring, value, point, P)
    assert len(row) == len(ring.basis) + len(ring.symbols)

    def at(index: int, step: int) -> int:
        moved = list(point)
        moved[index] = (moved[index] + step) % P
        return residue(value, moved, P)

    half = pow(2, -1, P)
    for k, index in enumerate(ring.symbol_indices(), len(names)):
        assert row[k] == (at(index, 1) - at(index, -1)) * half % P
    for k in range(len(names)):
        sine, cosine = ring.sine_index(k), ring.cosine_index(k)
        turned = [
            (at(i, 1) - at(i, -1)) * half * by % P
            for i, by in ((sine, point[cosine]), (cosine, -point[sine]))
        ]
        assert row[k] == sum(turned) % P
