"""Files of every sort of geometry as numbers."""

from __future__ import annotations

from math import acos, atan2, cos, hypot, pi, sin
from pathlib import Path

import numpy as np
import pytest
from finite.sample_linkages import ball, model
from kinematics.arms import nao, nao_posture

from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.driven_motion import moved_to
from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.finite.table_closure import close_table
from screwkit.mechanism.files import mechanism_from_text, read_mechanism

CASES = Path(__file__).parents[2] / "cases"
TABLE = """
screwkit: 1
name: four_bar
geometry: mdh
base: base
platform: rod
links: [base, crank, rod, rocker, tip]
joints:
  - {name: A, type: revolute, parent: base, child: crank, variable: qA, mdh: {}}
  - {name: B, type: revolute, parent: crank, child: rod, variable: qB, mdh: {d: 1}}
  - {name: C, type: revolute, parent: rod, child: rocker, variable: qC, mdh: {d: 3}}
  - {name: E, type: fixed, parent: rocker, child: tip, mdh: {d: 2}}
  - {name: D, type: revolute, parent: base, child: tip, variable: qD, mdh: {d: 3}}
"""
PLACED = """
screwkit: 1
name: four_bar
geometry: GEOMETRY
base: base
platform: rod
links: [base, crank, rod, rocker]
parameters: {a: {value: 1}, b: {positive: true}}
joints:
  - {name: A, type: revolute, parent: base, child: crank, axis: [0, 0, 2],
     point: [0, 0, 0]}
  - {name: B, type: revolute, parent: crank, child: rod, axis: [0, 0, 1],
     point: [a, b, 0]}
  - {name: C, type: revolute, parent: rod, child: rocker, axis: [0, 0, -3],
     point: [4, 2, 1]}
  - {name: D, type: revolute, parent: rocker, child: base, axis: [0, 0, 1],
     point: [5, 0, 0]}
"""


def case(name: str) -> PostureModel:
    return posture_model(read_mechanism(CASES / f"{name}.yaml"))


def closed_table(crank: float) -> dict[str, float]:
    """The angles of a four-bar linkage with links 1, 3, 2 on a frame of 3."""
    x, y = 3 - cos(crank), -sin(crank)
    reach = hypot(x, y)
    rod = atan2(y, x) + acos((9 + reach**2 - 4) / (6 * reach))
    elbow = (cos(crank) + 3 * cos(rod), sin(crank) + 3 * sin(rod))
    rocker = atan2(-elbow[1], 3 - elbow[0])
    return {"qA": crank, "qB": rod - crank, "qC": rocker - rod, "qD": rocker}


@pytest.mark.parametrize("geometry", ["posture", "reference"])
def test_axes_of_any_length_give_unit_screws(geometry: str) -> None:
    mechanism = mechanism_from_text(PLACED.replace("GEOMETRY", geometry), "text")
    linkage = posture_model(mechanism, {"b": 2.0})
    assert linkage.labels == ("A", "B", "C", "D")
    assert linkage.screws[1] == pytest.approx([0, 0, 1, 2, -1, 0])
    assert linkage.screws[2] == pytest.approx([0, 0, -1, -2, 4, 0])
    assert finite_motion(linkage).mobility == (1,)
    with pytest.raises(UnknownNameError, match="'b'"):
        posture_model(mechanism)


def test_a_table_that_closes_a_loop_is_taken_where_it_closes() -> None:
    mechanism = mechanism_from_text(TABLE, "text")
    linkage = posture_model(mechanism, closed_table(0.7))
    found = finite_motion(linkage)
    assert found.mobility == (1,)
    assert found.branches[0].motion == "planar"
    moved = moved_to(linkage, {"A": 0.4})
    ends = closed_table(1.1)
    assert moved.coordinates[-1] == pytest.approx(
        [ends[name] - closed_table(0.7)[name] for name in ("qA", "qB", "qC", "qD")]
    )
    with pytest.raises(UndecidedError, match=r"loop at joint .* open"):
        posture_model(mechanism, closed_table(0.7) | {"qB": 0.0})


def test_a_table_is_closed_near_a_guess() -> None:
    mechanism = mechanism_from_text(TABLE, "text")
    wanted = closed_table(0.7)
    guess = {name: value + 0.1 for name, value in wanted.items()} | {"qA": 0.7}
    assert close_table(mechanism, guess, ["qA"]) == pytest.approx(wanted, abs=1e-12)
    with pytest.raises(UndecidedError, match=r"loop at joint .* open"):
        close_table(mechanism, {"qA": pi, "qB": 2.0, "qC": 0.0, "qD": 0.0}, wanted)


def test_arms_that_hold_a_body_are_closed_wherever_they_are() -> None:
    found = finite_motion(posture_model(nao(), nao_posture()))
    assert found.mobility == (4,)
    assert [branch.motion_type for branch in found.branches] == ["1T3R"]


def test_modes_of_dymo() -> None:
    """[Zlatanov2002]: from the home posture it leaves into translation and tilting."""
    found = finite_motion(case("dymo"))
    assert found.mobility == (3,)
    assert {branch.motion_type for branch in found.branches} == {"3T0R", "1T2R"}
    assert {branch.loop_rank for branch in found.branches} == {12}


@pytest.mark.parametrize(
    ("name", "mobility", "motion"),
    [
        ("sarrus", 1, "straight line"),
        ("delta_4r", 3, "pure translation"),
        ("h4", 12, "Schönflies"),
        ("agile_eye", 3, "rotation about a fixed point"),
        ("3upu_wrist", 3, "rotation about a fixed point"),
        ("peaucellier", 1, "planar"),
        ("rhp_screw_jack", 1, "straight line"),
    ],
)
def test_invariants_that_the_literature_gives(
    name: str, mobility: int, motion: str
) -> None:
    found = finite_motion(case(name))
    assert found.mobility == (mobility,)
    assert [branch.motion for branch in found.branches] == [motion]


def test_a_platform_in_a_singular_posture_is_shaky() -> None:
    """With its legs locked at φ = 90° the octahedral platform gives, and stays."""
    corners = [2 * pi * k / 3 for k in range(3)]
    base = np.array([(2 * cos(a), 2 * sin(a), 0.0) for a in corners])
    top = np.array(
        [(cos(a + pi / 2 + pi / 3), sin(a + pi / 2 + pi / 3), 2.0) for a in corners]
    )
    joints = []
    for k in range(3):
        for n, foot in enumerate((base[k], base[(k + 1) % 3])):
            leg = f"leg{k}{n}"
            joints += [
                ball(f"B{k}{n}", "base", leg, foot),
                ball(f"P{k}{n}", leg, "top", top[k]),
            ]
    found = finite_motion(model("base", "top", *joints))
    (branch,) = found.branches
    # Six legs spin about themselves; the seventh freedom is only instantaneous.
    assert (branch.mobility, branch.instantaneous_mobility) == (6, 7)
    assert branch.motion == "at rest"
