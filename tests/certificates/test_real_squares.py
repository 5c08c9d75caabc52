"""Sums of squares in certificates: found, checked, and lied about."""

from __future__ import annotations

import random
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from certificates.forged import judged, limb, minor, three_joints
from loci.numeric import value

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.certificates.equations_told import Multiple, Square, Step
from screwkit.certificates.real_squares import sum_of_squares
from screwkit.certificates.records import Case, Locus, Node, Part, Reach
from screwkit.certificates.texts import RefusedError

POSITIVE = Assumptions(positive=frozenset({"a", "b"}), nonzero=frozenset({"a", "b"}))
SUMS = (
    "2 + 2*cos(p)*cos(q) - sin(p)*sin(q)",
    "a*sin(p)^2 + b*x^2",
    "x^2 + 2*x*y + 5*y^2",
    "a^2 + b^2 - 2*a*b*cos(p)",
    "x^2 + y^2 + 4*a^2 - 4*a*y",
    "-3*sin(p)^2*a - x^2*b - b*cos(q)^2*y^2",
    "x^2 + x*sqrt(3) + 1 + y^2 - 1/4",
)
NONE = ("1 + 2*cos(p)", "x^2 - y^2", "a - b*cos(p)", "x^2 + x*y")


def ring_of(written: str) -> TrigonometricRing:
    seen = SurveyRing()
    evaluate(parse(written), seen)
    for name in ("x", "y", "a", "b", "cos(p)", "cos(q)"):
        evaluate(parse(name), seen)
    return TrigonometricRing(seen)


@pytest.mark.parametrize("written", SUMS)
def test_a_multiple_is_a_sum_of_squares_at_any_posture(written: str) -> None:
    ring = ring_of(written)
    found = sum_of_squares(ring, POSITIVE, ring.normal(evaluate(parse(written), ring)))
    assert found is not None
    times = text(ring, found.times)
    squares = [(text(ring, w), text(ring, base)) for w, base in found.squares]
    source = np.random.default_rng(1)
    for _ in range(20):
        names = ("x", "y", "p", "q")
        posture = dict(zip(names, source.uniform(-3, 3, 4), strict=True))
        posture |= dict(zip(("a", "b"), source.uniform(0.1, 3, 2), strict=True))
        left = value(times, posture) * value(written, posture)
        right = [(value(w, posture), value(base, posture)) for w, base in squares]
        assert all(weight > 0 for weight, _ in right)
        assert left == pytest.approx(sum(w * base**2 for w, base in right), abs=1e-9)


@pytest.mark.parametrize("written", NONE)
def test_what_changes_its_sign_is_none(written: str) -> None:
    ring = ring_of(written)
    polynomial = ring.normal(evaluate(parse(written), ring))
    assert sum_of_squares(ring, POSITIVE, polynomial) is None


# Joints at 0, (c, 0) and (u, v²+w²): the third is on the line of the others where v and
# w are 0 alone.
FLAT = three_joints(
    "parameters: {c: {value: 1, positive: true}}\nvariables: {u: 1, v: 2, w: 3}",
    "[c, 0]",
    "[u, v^2 + w^2]",
)
HEIGHT = "v^2 + w^2"
ON_LINE = Locus(
    ("v", "w"),
    2,
    -1,
    (
        Reach(
            (
                Step("symbol", symbol="v", value="0"),
                Step("symbol", symbol="w", value="0"),
            )
        ),
    ),
)
BASES_HOLD = Multiple(0, 1, "1", {}), Multiple(1, 2, "1", {})
SQUARED = Case(
    (HEIGHT,),
    1,
    kept=Node(1, component=0, multiples=BASES_HOLD),
    times="1",
    squares=(Square("1", "v"), Square("1", "w")),
)


def proof(case: Case) -> Part:
    whole = minor(Case(("c",), 1, end="positive"), case)
    return replace(limb(ON_LINE, proof=whole), angles=())


def test_at_real_postures_all_squares_vanish() -> None:
    judged(FLAT, proof(SQUARED))


@pytest.mark.parametrize(
    ("lie", "why"),
    [
        ({"squares": ()}, "there is no condition 1"),
        ({"squares": SQUARED.squares[:1]}, "no sum of these squares"),
        ({"squares": (Square("1", "v"), Square("1", "2*w"))}, "no sum of these"),
        ({"times": ""}, "no sum of squares"),
        ({"times": "2"}, "no sum of these squares"),
        ({"squares": (*SQUARED.squares, Square("-1", "u"))}, "is not positive"),
        (
            {"squares": (*SQUARED.squares, Square("u", "0"))},
            "u, a weight, is not positive",
        ),
    ],
)
def test_other_sums_are_refused(lie: dict[str, Any], why: str) -> None:
    with pytest.raises(RefusedError, match=why):
        judged(FLAT, proof(replace(SQUARED, **lie)))


def test_a_component_is_not_covered_by_its_real_postures_alone() -> None:
    """All postures that its equations hold at are met, complex ones too."""
    kept = replace(SQUARED, kept=Node(1, sheet=True))
    cover = Node(0, condition=0, over={}, cases=(kept,))
    locus = replace(ON_LINE, equations=("v^2 + w^2", "v"), cover=cover)
    with pytest.raises(RefusedError, match="real postures"):
        judged(FLAT, replace(limb(locus), angles=()))


def test_random_sums_of_two_terms() -> None:
    source = random.Random(4)
    for _ in range(20):
        first, second = source.sample(("a*x^2", "b*y^2", "cos(p)^2", "3*sin(q)^2"), 2)
        ring = ring_of(f"{first} + {second}")
        polynomial = ring.normal(evaluate(parse(f"{first} + {second}"), ring))
        found = sum_of_squares(ring, POSITIVE, polynomial)
        assert found is not None
        assert len(found.squares) >= 2
