"""Files whose posture is special: what holds there, and what on the motion."""

from __future__ import annotations

from pathlib import Path

import pytest

import screwkit as sk
from screwkit.results.mobility import Mobility

RHOMB = """
screwkit: 1
name: rhomb
space: {space}
geometry: reference
base: b0
platform: b2
links: [b0, b1, b2, b3]
actuated: [j1]
joints:
  - {{name: j0, type: revolute, parent: b0, child: b1, point: {p0}{axis}}}
  - {{name: j1, type: revolute, parent: b1, child: b2, point: {p1}{axis}}}
  - {{name: j2, type: revolute, parent: b2, child: b3, point: {p2}{axis}}}
  - {{name: j3, type: revolute, parent: b3, child: b0, point: {p3}{axis}}}
"""

FLAT = ((0, 0), (1, 0), (2, 0), (1, 0))
"""A rhomb of side 1 laid flat, j1 on j3: two bars turn about both, or it opens."""


def answer(folder: Path, text: str) -> Mobility:
    path = folder / "case.yaml"
    path.write_text(text)
    return sk.mobility(sk.load(path))


def rhomb(space: str, turned: bool) -> str:
    """In the plane or in space; turned by the rotation of 3-4-5 and shifted."""
    places = []
    for x, y in FLAT:
        point = (3 * x - 4 * y + 7, 4 * x + 3 * y - 2) if turned else (x, y)
        places.append([*point, *([] if space == "planar" else [0])])
    axis = "" if space == "planar" else ", axis: [0, 0, 1]"
    named = {f"p{k}": place for k, place in enumerate(places)}
    return RHOMB.format(space=space, axis=axis, **named)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_flat_rhomb_is_told_on_the_motion_and_at_its_posture(
    tmp_path: Path, space: str, turned: bool
) -> None:
    """All numbers of one part of the answer are of one posture."""
    found = answer(tmp_path, rhomb(space, turned))
    assert found.on_motion
    assert (found.loop_rank, found.instantaneous_mobility) == (3, 1)
    assert found.counts.moroskine == found.partition.mobility == 1
    assert found.partition.connectivity == found.platform.twist_dimension == 1
    assert found.platform.motion_type == "0T1R"
    assert found.actuation is not None
    assert found.actuation.remaining_mobility == 0
    assert found.remaining_freedoms == ()
    there = found.at_values
    assert there is not None
    assert (there.loop_rank, there.instantaneous_mobility) == (2, 2)
    assert there.platform.motion_type == "1T1R"
    assert there.actuation is not None
    assert there.actuation.remaining_mobility == 1
    assert len(there.remaining_freedoms) == 2
    assert any("on the motion" in text for text in there.differences)


SARRUS = """
screwkit: 1
name: sarrus
geometry: reference
base: g
platform: top
links: [g, a, top, b]
joints:
  - {name: A1, type: revolute, parent: g, child: a, point: [4, 0, 0], axis: [0, 1, 0]}
  - {name: A2, type: revolute, parent: a, child: l, point: [4, 0, 1], axis: [0, 1, 0]}
  - {name: A3, type: revolute, parent: l, child: top, point: [4, 0, 2], axis: [0, 1, 0]}
  - {name: B1, type: revolute, parent: g, child: b, point: [0, 4, 0], axis: [1, 0, 0]}
  - {name: B2, type: revolute, parent: b, child: m, point: [0, 6, 1], axis: [1, 0, 0]}
  - {name: B3, type: revolute, parent: m, child: top, point: [0, 4, 2], axis: [1, 0, 0]}
""".replace("[g, a, top, b]", "[g, a, l, top, b, m]")


def test_a_platform_at_the_end_of_its_way_moves_all_the_same(tmp_path: Path) -> None:
    """One leg of a Sarrus linkage is stretched, where its straight line ends.

    The rank is that of the motion, but the platform rests to first order.
    """
    found = answer(tmp_path, SARRUS)
    assert found.on_motion
    assert found.platform.motion_type == "1T0R"
    assert found.partition.redundancy == 0
    there = found.at_values
    assert there is not None
    assert there.loop_rank == found.loop_rank == 5
    assert there.platform.motion_type == "0T0R"


def test_a_usual_posture_is_told_once(tmp_path: Path) -> None:
    """Bent like its mate, the leg lets the platform translate at the posture too."""
    found = answer(tmp_path, SARRUS.replace("[4, 0, 1]", "[6, 0, 1]"))
    assert not found.on_motion
    assert found.at_values is None
    assert found.platform.motion_type == "1T0R"
    assert len(found.remaining_freedoms) == 1
