"""Planar files: three equations a loop, screws of three coordinates."""

from __future__ import annotations

from pathlib import Path

import pytest

import screwkit as sk

GRIP = """
screwkit: 1
name: grip
space: planar
geometry: posture
base: g
platform: o
links: [g, a, b, o]
joints:
  - {name: A, type: revolute, parent: g, child: a, point: [0, 0]}
  - {name: B, type: revolute, parent: g, child: b, point: [4, 0]}
  - {name: ca, type: hard_finger, parent: a, child: o, point: [1, 2]}
  - {name: cb, type: point, parent: b, child: o, point: [3, 2], normal: [1, 0]}
"""
BARS = """
screwkit: 1
name: bars
space: SPACE
geometry: posture
base: g
platform: c
links: [g, a, b, c]
joints:
  - {name: A, type: revolute, parent: g, child: a, AXIS point: [0, 0ZERO]}
  - {name: B, type: revolute, parent: a, child: c, AXIS point: [1, 2ZERO]}
  - {name: C, type: revolute, parent: b, child: c, AXIS point: [4, 3ZERO]}
  - {name: D, type: revolute, parent: g, child: b, AXIS point: [5, 0ZERO]}
actuated: [A]
"""


def case(tmp_path: Path, text: str) -> sk.Case:
    file = tmp_path / "case.yaml"
    file.write_text(text, encoding="utf-8")
    return sk.load(file)


def test_screws_have_three_coordinates(tmp_path: Path) -> None:
    """A finger hinged at (0, 0) pushes on (1, 2): a force along that line."""
    answer = sk.screws(case(tmp_path, GRIP))
    first, second = answer.limbs
    assert (first.twist_dimension, first.wrench_dimension) == (2, 1)
    assert [t.coordinates for t in first.twists] == [("1", "0", "0"), ("1", "2", "-1")]
    assert [w.coordinates for w in first.wrenches] == [("1", "2", "0")]
    assert [w.kind for w in first.wrenches] == ["force"]
    assert (second.twist_dimension, second.wrench_dimension) == (3, 0)
    assert (answer.platform.twist_dimension, answer.platform.wrench_dimension) == (2, 1)
    linear = sk.screws(case(tmp_path, GRIP), order="linear")
    assert [t.coordinates for t in linear.limbs[0].twists][1] == ("2", "-1", "1")


def test_three_equations_a_loop(tmp_path: Path) -> None:
    answer = sk.mobility(case(tmp_path, GRIP))
    assert answer.counts.grubler == answer.counts.moroskine == 2
    assert (answer.loop_rank, answer.redundant_constraints) == (3, 0)
    assert answer.counts.grubler_planar is None
    assert (answer.platform.wrench_dimension, answer.platform.couples) == (1, 0)
    assert answer.full_cycle.mobility == (2,)


def test_a_planar_file_says_what_a_spatial_one_says(tmp_path: Path) -> None:
    """Of the plane; the three equations out of it are redundant in space."""
    flat = BARS.replace("SPACE", "planar").replace("AXIS", "").replace("ZERO", "")
    solid = BARS.replace("SPACE", "spatial").replace("AXIS", "axis: [0, 0, 1],")
    plane = sk.mobility(case(tmp_path, flat))
    space = sk.mobility(case(tmp_path, solid.replace("ZERO", ", 0")))
    assert plane.loop_rank == space.loop_rank == 3
    assert (plane.redundant_constraints, space.redundant_constraints) == (0, 3)
    assert plane.counts.grubler == space.counts.grubler_planar == 1
    assert plane.platform.motion_type == space.platform.motion_type == "0T1R"
    assert plane.full_cycle.mobility == space.full_cycle.mobility == (1,)
    assert plane.actuation is not None
    assert plane.actuation.remaining_mobility == 0
    assert space.platform.wrench_dimension == plane.platform.wrench_dimension + 3


@pytest.mark.parametrize("body", ["b", "c"])
def test_relative_motion_in_the_plane(tmp_path: Path, body: str) -> None:
    flat = BARS.replace("SPACE", "planar").replace("AXIS", "").replace("ZERO", "")
    found = sk.relative_motion(case(tmp_path, flat), body, "a")
    assert (found.twist_dimension, found.wrench_dimension) == (1, 2)
    assert all(
        len(screw.coordinates) == 3 for screw in (*found.twists, *found.wrenches)
    )
