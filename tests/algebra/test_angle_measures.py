"""Constant angles that are sums and multiples of each other."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st
from one_ring import in_one_ring

from screwkit.algebra.angle_measures import Combination, common_measures
from screwkit.algebra.conversion import Conversion
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.modular import ModularRing
from screwkit.algebra.parse import parse
from screwkit.algebra.survey import SurveyRing
from screwkit.case import load_text
from screwkit.questions import mobility

ANGLES = st.lists(
    st.fractions(min_value=Fraction(1, 20), max_value=3, max_denominator=20),
    unique=True,
    max_size=4,
)


def in_measures(
    counts: Mapping[Fraction, int], of: Mapping[Fraction, Combination]
) -> Counter[Fraction]:
    total: Counter[Fraction] = Counter()
    for angle, count in counts.items():
        for measure, times in of[angle]:
            total[measure] += count * times
    return Counter({m: n for m, n in total.items() if n})


@given(ANGLES)
def test_measures_keep_angles_and_know_their_short_relations(
    angles: list[Fraction],
) -> None:
    found = common_measures(angles)
    assert all(value > 0 for value in found.values)
    for angle in angles:
        assert sum(n * m for m, n in found.of[angle]) == angle
    for value in found.values:
        assert in_measures(dict(found.made_of[value]), found.of) == {value: 1}
    for counts in product(range(-2, 3), repeat=len(angles)):
        if not sum(n * a for n, a in zip(counts, angles, strict=True)):
            told = dict(zip(angles, counts, strict=True))
            assert in_measures(told, found.of) == {}


IDENTITIES = (
    "sin(1/5) - 2*sin(1/10)*cos(1/10)",
    "cos(0.3)*cos(0.1) + sin(0.3)*sin(0.1) - cos(0.2)",
    "sin(1.1 - q)*cos(0.4) - cos(1.1 - q)*sin(0.4) - sin(0.7 - q)",
)


@pytest.mark.parametrize("text", IDENTITIES)
def test_identities_are_zero_by_polynomials_and_by_residues(text: str) -> None:
    assert in_one_ring(text)[1] == [0]
    survey = SurveyRing()
    evaluate(parse(text), survey)
    measures = common_measures(survey.constant_angles)
    assert evaluate(parse(text), ModularRing(3, measures=measures)) == 0


def test_what_is_not_zero_stays_so() -> None:
    for text in ("sin(1/5) - sin(1/10)", "cos(0.3) - cos(0.2) - cos(0.1)"):
        assert in_one_ring(text)[1] != [0]


def test_a_ring_with_other_measures_says_the_same() -> None:
    """1/5 measures 1/5 and 2/5 here, and is two times 1/10 there."""
    text = "x*sin(2/5) + cos(1/5)"
    small, (one,) = in_one_ring(text)
    large, (other, _) = in_one_ring(text, "sin(1/10)")
    assert small.constant_angles != large.constant_angles
    assert Conversion(small, large)(one) == other


CLOSED = """
screwkit: 1
name: slides
geometry: posture
base: A
platform: B
links: [A, B]
joints:
  - {name: s, type: prismatic, parent: A, child: B, axis: [cos(0.3), sin(0.3), 0]}
  - {name: t, type: prismatic, parent: A, child: B, axis: [A, B, 0]}
"""


@pytest.mark.parametrize(("turn", "freedoms"), [("0.2", 1), ("0.21", 0)])
def test_slides_that_are_parallel_by_a_sum_of_angles(turn: str, freedoms: int) -> None:
    cosine = f'"cos(0.1)*cos({turn}) - sin(0.1)*sin({turn})"'
    sine = f'"cos(0.1)*sin({turn}) + sin(0.1)*cos({turn})"'
    text = CLOSED.replace("[A, B, 0]", f"[{cosine}, {sine}, 0]")
    parallel = math.isclose(0.3, 0.1 + float(turn))
    answer = mobility(load_text(text))
    assert answer.platform.twist_dimension == freedoms == int(parallel)
