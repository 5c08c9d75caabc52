"""Conditions that are products: what holds on one of their sheets is not believed."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from typing import Any

import pytest

from screwkit.algebra.all_roots import rank_at_roots
from screwkit.case import load_text
from screwkit.certificates.checking import check
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import (
    Case,
    Certificate,
    Locus,
    Node,
    Part,
    Reach,
    Sheet,
    Source,
    Step,
    Unsolved,
)
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError, read
from screwkit.certificates.written import SCHEMA

HEAD = """
screwkit: 1
name: forged
space: planar
base: ground
platform: tip
links: [ground, arm, fore, tip]
geometry: posture
"""


def three_joints(symbols: str, second: str, third: str) -> str:
    """Three revolute joints in a row; rank 3 unless they are in line."""
    return f"""{HEAD}
{symbols}
joints:
  - {{name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}}
  - {{name: "2", type: revolute, parent: arm, child: fore, point: {second}}}
  - {{name: "3", type: revolute, parent: fore, child: tip, point: {third}}}
"""


def certificate(text: str, part: Part) -> Certificate:
    return Certificate(SCHEMA, "forged", "0", Source(text), (part,))


def judged(text: str, part: Part, seed: int = 1) -> None:
    check(certificate(text, part), load_text(text).mechanism, seed)


def limb(*components: Locus, proof: Node | None = None) -> Part:
    return Part(
        "limb", "ground", ({"q": 1},), 3, components, limb="limb_1", proof=proof
    )


def minor(*cases: Case) -> Node:
    return Node(
        0, rank=3, rows=(2, 3, 4), columns=("1", "2", "3"), over={}, cases=cases
    )


def turned(sine: str, cosine: str) -> Step:
    return Step("angle", angle=0, sine=sine, cosine=cosine)


# det of the three twists: c·(a − b)·sin q.
TWO_LENGTHS = three_joints(
    "parameters: {a: 1, b: 2, c: {value: 1, positive: true}}\n"
    "variables: {q: {value: 0.3, angle: true}}",
    "[c, 0]",
    "[c + (a - b)*cos(q), (a - b)*sin(q)]",
)
IN_LINE = Locus(
    ("sin(q)",), 2, -1, (Reach((turned("0", "1"),)), Reach((turned("0", "-1"),)))
)
POSITIVE = Case(("c",), 1, end="positive")


def test_a_locus_with_a_sheet_of_full_rank_is_refused() -> None:
    """Singular where sin q = 0, not where cos q = 0; postures of the former alone."""
    judged(TWO_LENGTHS, limb(IN_LINE))
    larger = replace(IN_LINE, equations=("sin(q)*cos(q)",))
    with pytest.raises(RefusedError, match="as in general"):
        judged(TWO_LENGTHS, limb(larger))


def test_a_sheet_in_an_extension_of_the_numbers_is_met_too() -> None:
    """3·cos²q = 2 has no rational root, and modulo half of the primes none at all."""
    larger = replace(IN_LINE, equations=("sin(q)*(3*cos(q)^2 - 2)",))
    for seed in range(12):
        with pytest.raises(RefusedError, match="as in general"):
            judged(TWO_LENGTHS, limb(larger), seed)


def test_dimensions_tied_on_one_sheet_alone_are_no_end() -> None:
    """(a − b)·sin q = 0: a = b ties the dimensions, sin q = 0 does not."""
    honest = minor(
        POSITIVE,
        Case(("a - b",), 1, end="special"),
        Case(
            ("sin(q)",),
            1,
            sheets=(
                Sheet(turned("0", "1"), Node(1, component=0)),
                Sheet(turned("0", "-1"), Node(2, component=0)),
            ),
        ),
    )
    judged(TWO_LENGTHS, limb(IN_LINE, proof=honest))
    product = "(a - b)*sin(q)"
    roots = (Unsolved(product, symbol="a"),)
    hidden = minor(
        POSITIVE, Case((product,), 1, kept=Node(1, special=True, roots=roots))
    )
    with pytest.raises(RefusedError, match="free"):
        judged(TWO_LENGTHS, limb(proof=hidden))


# Joints 1 and 2 of one limb at 0 and (x, 0), joint 3 of the other at (a, b): the
# determinant is x·b.  Where x = 0 the first limb idles; where b = 0 the platform
# turns about (a, 0).
TWO_LIMBS = """
screwkit: 1
name: forged
space: planar
base: ground
platform: tip
links: [ground, arm, tip]
geometry: posture
parameters: {a: {value: 1, positive: true}}
variables: {x: 1, b: 2}
joints:
  - {name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}
  - {name: "2", type: revolute, parent: arm, child: tip, point: [x, 0]}
  - {name: "3", type: revolute, parent: ground, child: tip, point: [a, b]}
"""


def two_limbs(proof: Node, *components: Locus) -> Part:
    return Part("actuation", "ground", (), 3, components, proof=proof)


def test_a_platform_still_on_one_sheet_alone_may_move() -> None:
    smaller = Node(
        1,
        rank=2,
        rows=(2, 4),
        columns=("1", "3"),
        over={},
        cases=(Case(("a",), 1, end="positive"),),
        roots=(Unsolved("x", symbol="x"),),
    )
    moves = Locus(
        ("b",), 2, 1, (Reach((Step("symbol", symbol="b", value="0", over="1"),)),)
    )
    at_b = Step("symbol", symbol="b", value="0", over="1")
    honest = minor(
        Case(("x",), 1, kept=smaller),
        Case(("b",), 1, sheets=(Sheet(at_b, Node(2, component=0)),)),
    )
    judged(TWO_LIMBS, two_limbs(honest, moves))
    hidden = replace(smaller, roots=(Unsolved("x*b", symbol="x"),))
    with pytest.raises(RefusedError, match="moves"):
        judged(TWO_LIMBS, two_limbs(minor(Case(("x*b",), 1, kept=hidden))))


# det: c·(5·sin q − 3), which vanishes at (3/5, 4/5) and (3/5, −4/5).
ONE_HEIGHT = three_joints(
    "parameters: {c: {value: 1, positive: true}}\n"
    "variables: {q: {value: 0.3, angle: true}}",
    "[c, 0]",
    "[cos(q), 5*sin(q) - 3]",
)


def test_both_solutions_in_numbers_are_looked_at() -> None:
    there = Reach((turned("3/5", "4/5"),))
    right = Locus(("5*sin(q) - 3", "5*cos(q) - 4"), 2, -1, (there,))
    step = Step("numbers", angle=0, numbers=("5", "0", "-3"))
    proof = minor(
        POSITIVE,
        Case(("5*sin(q) - 3",), 1, sheets=(Sheet(step, Node(1, component=0)),)),
    )
    for seed in range(40):
        with pytest.raises(RefusedError, match="vanish"):
            judged(ONE_HEIGHT, limb(right, proof=proof), seed)


# -- how sheets are met --------------------------------------------------------------


def postures(text: str = TWO_LENGTHS) -> Postures:
    return Postures(load_text(text).mechanism, limb(), random.Random(3))


@pytest.mark.parametrize(
    ("text", "factors"),
    [
        ("(a - b)*sin(q)", ("a - b", "sin(q)")),
        ("(a^2 - 2)*(c - 1)", ("a^2 - 2", "c - 1")),
        ("(a*b - c)*(1 + cos(q))*(a - 3*b)^2", ("a*b - c", "1 + cos(q)", "a - 3*b")),
        ("(a^3 - b)*(cos(q)^2 - 2*a*sin(q))", ("a^3 - b", "cos(q)^2 - 2*a*sin(q)")),
    ],
)
def test_every_factor_is_met(text: str, factors: tuple[str, ...]) -> None:
    """On each sheet that is drawn the product vanishes, and each factor on some."""
    drawn = Sheets(postures(), random.Random(4)).on(
        Way(),
        text,
        lambda _, there: (
            there.value(read(text)) == 0,
            # A value that is 0 at some of the roots alone is not asked for: it splits.
            tuple(rank_of_one(there.value(read(f))) for f in factors),
        ),
    )
    assert all(vanishes for vanishes, _ in drawn)
    for number in range(len(factors)):
        assert any(own[number] == 0 for _, own in drawn)


def rank_of_one(value: Any) -> int:
    return rank_at_roots([[value]], postures().prime)


def test_changes_are_those_of_the_solution_in_numbers() -> None:
    """With cos q = 3/5 the change of a·cos q with a is 3/5."""
    drawer = postures()
    way = Way((Step("numbers", angle=0, numbers=("0", "5", "-3")),))
    for point in islice(drawer.drawn_before(way), 3):
        changes = [row[0] for row in drawer.changes(point, way, ["a*cos(q)"])]
        assert [x for x in changes if x != 0] == [point.rational(Fraction(3, 5))]
