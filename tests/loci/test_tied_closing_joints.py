"""Joints with several freedoms that close a loop, whose own variables nothing ties."""

from __future__ import annotations

from math import asin, pi, sin

import pytest

import screwkit as sk
from screwkit.case import Case, load_text

CARDAN = """
screwkit: 1
name: cardan
title: Two shafts joined by a cross
geometry: reference
base: ground
platform: driven
links: [ground, driving, driven]
joints:
  - {name: a, type: revolute, parent: ground, child: driving, point: [0, 0, 0],
     axis: [1, 0, 0]}
  - {name: u, type: universal, parent: driving, child: driven, point: [0, 0, 0],
     axes: [[0, 0, 1], CROSS]}
  - {name: b, type: revolute, parent: driven, child: ground, point: [0, 0, 0],
     axis: [3, 4, 0]}
actuated: [a]
"""

PLANAR = """
screwkit: 1
name: sliding
title: A closed chain of three hinges and a planar joint
geometry: reference
base: ground
platform: q
links: [ground, p, q, r]
joints:
  - {name: R1, type: revolute, parent: ground, child: p, point: [0, 0, 0],
     axis: [0, 0, 1], variable: q1}
  - {name: R2, type: revolute, parent: p, child: q, point: [2, 0, 0],
     axis: [0, 0, 1], variable: q2}
  - {name: E, type: planar, parent: q, child: r, point: [3, 1, 0], normal: [0, 0, 1]}
  - {name: R3, type: revolute, parent: r, child: ground, point: [1, 3, 0],
     axis: [0, 0, 1], variable: q3}
actuated: [R1, "E:0", "E:1"]
"""


def cardan(second: str) -> Case:
    return load_text(CARDAN.replace("CROSS", second))


def test_a_cardan_joint_at_less_than_a_right_angle_is_never_singular() -> None:
    """The speeds of its shafts are in a ratio between cos β and 1/cos β, here 3/5."""
    answer = sk.singularities(cardan("[-4, 3, 0]"))
    assert answer.actuation is not None
    assert all(one.complete and not one.components for one in answer.limb)
    assert answer.constraint.complete
    assert not answer.constraint.components
    assert answer.actuation.complete
    assert not answer.actuation.components


def test_a_cross_with_slanted_arms_stops_at_both_shafts() -> None:
    """Arms z and w at 45°: w turns about b at right angles to it, z about x.

    The driving shaft loses its hold where x, z and w lie in one plane: w = (±x ± z)/√2
    there, and w·b = 0 gives ±3/5 = 4/5 sin qa.  The driven one moves alone where z, w
    and b do: z·b = ±|b|/√2, 4/5 sin qa = ±1/√2.
    """
    answer = sk.singularities(cardan("[-4, 3, 5]"))
    assert answer.actuation is not None
    (limb,) = answer.limb[0].components
    (dead,) = answer.actuation.components
    for component, sine in ((limb, 3 / 4), (dead, 5 / 4 / 2**0.5)):
        assert component.example
        angle = dict(component.example)["qa"]
        assert abs(sin(angle)) == pytest.approx(sine)
        assert min(abs(abs(angle) - x) for x in (asin(sine), pi - asin(sine))) < 1e-9


def test_a_slide_of_a_planar_joint_stays_in_its_child() -> None:
    """With R1 and all of E but one slide locked q and r turn alike, about R2 and R3.

    They slide on each other along n, fixed in r, if R2 R3 is at right angles to n: with
    R2 at 2 (cos q1, sin q1), R3 at (1, 3) and n = (sin q3, cos q3).
    """
    answer = sk.singularities(load_text(PLANAR))
    assert answer.actuation is not None
    (component,) = answer.actuation.components
    assert component.equations == ("3*cos(q3) + sin(q3) - 2*sin(q1 + q3)",)
    assert answer.actuation.complete
