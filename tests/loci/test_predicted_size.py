"""Sizes of determinants, predicted and counted.

Counted are n! terms of a matrix of symbols, and the determinant of six lines with
symbols for all points, expanded here from Plücker coordinates without any limb.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial
from pathlib import Path
from typing import Any

import pytest
from loci.symbolic_platforms import six_ups, symbolic_points

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.minors import (
    combined,
    determinant,
    joined,
    minors_of,
    products_of_join,
)
from screwkit.algebra.parse import parse
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.case import Case
from screwkit.errors import TooLargeError
from screwkit.kinematics.assembly import Assembly
from screwkit.loci import wrench_sums
from screwkit.loci.predicted_size import SAMPLE, predicted_terms
from screwkit.loci.rank_drop import extensors
from screwkit.loci.wrench_sums import sum_minors
from screwkit.questions import singularities


def ring_of(names: Sequence[str]) -> TrigonometricRing:
    survey = SurveyRing()
    evaluate(parse(" + ".join(names)), survey)
    return TrigonometricRing(survey)


def test_a_matrix_of_symbols_has_as_many_terms_as_permutations() -> None:
    size = 5
    names = [[f"a{i}{k}" for i in range(size)] for k in range(size)]
    ring = ring_of([name for column in names for name in column])
    columns = [[ring.symbol(name) for name in column] for column in names]
    limbs = [{1 << i: x for i, x in enumerate(column)} for column in columns]

    def expand(limbs: Sequence[Any]) -> list[Any]:
        own = [[limb.get(1 << i, ring.zero) for i in range(size)] for limb in limbs]
        value = determinant(ring, own)
        return [] if value == 0 else [value]

    assert len(expand(limbs)[0]) == factorial(size)
    predicted = predicted_terms(ring, limbs, expand)
    assert predicted is not None
    assert predicted == pytest.approx(factorial(size), rel=0.5)


def test_what_has_few_choices_is_not_predicted() -> None:
    ring = ring_of(["a", "b", "c"])
    limbs = [{1: ring.symbol("a")}, {2: ring.symbol("b") + ring.symbol("c")}]
    assert SAMPLE > 2
    assert predicted_terms(ring, limbs, lambda limbs: []) is None


def lines_at(points: list[list[list[str]]]) -> tuple[TrigonometricRing, list[Any]]:
    """Six lines (B − A, A × B), B = t + R·b, with nine entries of R."""
    names = [x for body in points for p in body for x in p if x != "0"]
    pose = ["x", "y", "z", *(f"r{i}{j}" for i in range(3) for j in range(3))]
    ring = ring_of([*names, *pose])
    at = {"0": ring.zero, **{n: ring.symbol(n) for n in (*names, *pose)}}
    lines = []
    for above, below in zip(*reversed(points), strict=True):
        a, b = [at[x] for x in below], [at[x] for x in above]
        p = [
            at["xyz"[i]] + sum((at[f"r{i}{j}"] * b[j] for j in range(3)), ring.zero)
            for i in range(3)
        ]
        moment = [a[i - 2] * p[i - 1] - a[i - 1] * p[i - 2] for i in range(3)]
        lines.append([*(p[i] - a[i] for i in range(3)), *moment])
    return ring, lines


def test_six_struts_with_symbols_for_all_points(tmp_path: Path) -> None:
    """164 016 terms in the gauge, as many as the lines alone give; nearly predicted."""
    points = symbolic_points(gauge=True)
    assembly = Assembly(six_ups(tmp_path, points, quaternion=False))
    ring = assembly.common_twists.ring
    root, library = assembly.root(ring), assembly.library(ring)
    actuated = assembly.mechanism.actuated
    limbs = [
        extensors(
            root,
            assembly.told([j for j in limb.joints if j not in actuated]),
            5,
            library,
        )[0]
        for limb in assembly.limbs
    ]

    def expand(limbs: Sequence[Any]) -> list[Any]:
        return sum_minors(ring, limbs, ((),) * 6, 6)

    (whole,) = expand(limbs)
    other, lines = lines_at(points)
    second = determinant(other, lines)
    assert len(whole) == len(second) == 164_016
    predicted = predicted_terms(ring, limbs, expand)
    assert predicted == pytest.approx(164_016, rel=0.25)


def test_too_many_terms_are_refused_before_they_are_expanded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without the gauge some 15 million terms, of which no join is made."""
    made: list[int] = []

    def counted(ring: Any, limbs: Sequence[Any], *more: Any) -> Any:
        made.append(max(len(value) for limb in limbs for value in limb.values()))
        return combined(ring, limbs, *more)

    monkeypatch.setattr(wrench_sums, "combined", counted)
    points = symbolic_points(gauge=False)
    case = Case(six_ups(tmp_path, points, quaternion=False))
    actuation = singularities(case).actuation
    assert actuation is not None
    assert actuation.admissible
    assert not actuation.complete
    assert not actuation.components
    words = actuation.reason.split()
    assert "million terms, and was not expanded; while limbs keep" in actuation.reason
    assert "lines of one linear complex" in actuation.reason
    assert float(words[words.index("million") - 1]) == pytest.approx(15.3, rel=0.25)
    assert made
    assert max(made) <= 2  # samples of the coordinates, never all of them


def test_joins_beyond_a_limit_are_refused() -> None:
    ring = ring_of(["a", "b", "c"])
    left = {1: ring.symbol("a") + ring.symbol("b"), 2: ring.symbol("c")}
    right = {2: ring.symbol("a") + 1, 4: ring.symbol("b")}
    products = 2 * 2 + 2 * 1 + 1 * 1  # not row 2 with row 2
    assert products_of_join(left, right) == products
    assert joined(ring, left, right, products) == joined(ring, left, right)
    with pytest.raises(TooLargeError, match="products of terms"):
        joined(ring, left, right, products - 1)
    columns = [[ring.symbol("a"), ring.one], [ring.one, ring.symbol("b")]]
    assert minors_of(ring, columns)[3] == ring.symbol("a") * ring.symbol("b") - 1
