"""Sentences that a reader stumbled over."""

from __future__ import annotations

import re

import screwkit as sk
from screwkit.case import load_text
from screwkit.terminal import text_of

LEG = """
screwkit: 1
name: leg
space: spatial
geometry: posture
base: base
platform: plate
links: [base, plate, left, right, bar, rod]
variables: {x: 1, y: 1, z: 3}
vectors: {j: [0, 1, 0], u: [1, 0, 0], w: [1, y, 0]}
points: {Q: [4, y, z]}
joints:
  - {name: P1, type: revolute, parent: base, child: left, axis: j, point: [0, 0, 0]}
  - {name: P2, type: revolute, parent: base, child: right, axis: j, point: [2, 0, 0]}
  - {name: P3, type: revolute, parent: left, child: bar, axis: j, point: [x, 0, z]}
  - {name: P4, type: revolute, parent: right, child: bar, axis: j, point: [x + 2, 0, z]}
  - {name: W, type: revolute, parent: bar, child: plate, axis: w, point: [x, 1, z]}
  - {name: U, type: universal, parent: base, child: rod, axes: [u, j], point: [5, 1, 0]}
  - {name: S, type: spherical, parent: rod, child: plate, point: Q}
actuated: [P1]
"""


def test_a_heading_has_something_below_it() -> None:
    # The redundant constraints are of the parallelogram: no contact feels them.
    answer = sk.manipulability(load_text(LEG))
    assert answer.statics.indeterminacy == 3
    assert answer.internal_force.infinite == 0
    assert "INTERNAL FORCES" not in text_of(answer)


def test_a_value_is_not_called_like_a_symbol_of_the_file() -> None:
    text = text_of(sk.manipulability(load_text(LEG)))
    assert re.search(r"exactly: λ − ([\d/]+) = 0, λ = \1\n", text)
    plain = text_of(sk.manipulability(sk.load("five_bar_15")))
    assert "exactly: x² − 41 x/4 + 5 = 0, x = " in plain


def test_an_axis_is_not_placed_by_a_point_named_by_itself() -> None:
    text = text_of(sk.screws(load_text(LEG)))
    assert "about axis U:0\n" in text
    assert "the centre of S and the common point of axes U:0 and U:1" in text


def test_what_a_distance_is_reads_as_a_sum() -> None:
    text = " ".join(text_of(sk.distance(sk.load("3rpr_planar"))).split())
    assert "the root of the sum of squares of the angle of " in text
    assert "'s rotation in radians and the shift of its origin over L; L = " in text
