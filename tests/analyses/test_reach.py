"""Configurations of given places against the law of cosines and forward kinematics."""

from __future__ import annotations

from math import acos, atan2, cos, hypot, pi, sin
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import screwkit as sk
from screwkit.errors import ExpressionError, UndecidedError, UnknownNameError
from screwkit.results.reach import Reach

Array = NDArray[np.float64]

TWO_BARS = """screwkit: 1
name: two_bars
space: planar
geometry: reference
base: ground
platform: tool
links: [ground, upper, tool]
parameters: {{l1: {l1}, l2: {l2}}}
joints:
  - {{name: A, type: revolute, parent: ground, child: upper, point: [0, 0]}}
  - {{name: B, type: revolute, parent: upper, child: tool, point: [l1, 0]}}
reference_point: [l1 + l2, 0]
actuated: [A, B]
"""
SPATIAL = """screwkit: 1
name: arm
geometry: reference
base: ground
platform: hand
links: [ground, a, b, c, d, e, hand]
vectors: {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]}
joints:
  - {name: "1", type: revolute, parent: ground, child: a, axis: z, point: [0, 0, 0]}
  - {name: "2", type: revolute, parent: a, child: b, axis: y, point: [0, 0, 1]}
  - {name: "3", type: revolute, parent: b, child: c, axis: y, point: [1, 0, 1]}
  - {name: "4", type: revolute, parent: c, child: d, axis: x, point: [2, 0, 1]}
  - {name: "5", type: revolute, parent: d, child: e, axis: y, point: [2, 0, 1]}
  - {name: "6", type: revolute, parent: e, child: hand, axis: x, point: [2, 0, 1]}
reference_point: [2, 0, 1]
actuated: ["1", "2", "3", "4", "5", "6"]
"""


def written(folder: Path, text: str) -> sk.Case:
    path = folder / "arm.yaml"
    path.write_text(text, encoding="utf-8")
    return sk.load(path)


def joints_of(answer: Reach) -> list[dict[str, float]]:
    """Values of the joint variables in each configuration."""
    return [
        dict(zip(found.posture.variables, found.posture.values, strict=True))
        for found in answer.configurations
    ]


def angle_between(one: float, other: float) -> float:
    return abs((one - other + pi) % (2 * pi) - pi)


@pytest.mark.parametrize(("x", "y"), [(1.1, 0.7), (-0.4, 1.2), (0.3, -1.5)])
def test_both_elbows_of_two_bars(tmp_path: Path, x: float, y: float) -> None:
    """Law of cosines: q2 = ±acos((r² − l1² − l2²)/(2 l1 l2))."""
    answer = sk.reach(written(tmp_path, TWO_BARS.format(l1=1, l2="4/5")), (x, y))
    bend = acos((x * x + y * y - 1 - 0.64) / 1.6)
    wanted = [
        (atan2(y, x) - atan2(0.8 * sin(q), 1 + 0.8 * cos(q)), q) for q in (bend, -bend)
    ]
    found = [(joints["qA"], joints["qB"]) for joints in joints_of(answer)]
    assert len(found) == 2
    for one in wanted:
        assert any(
            angle_between(one[0], a) < 1e-9 and angle_between(one[1], b) < 1e-9
            for a, b in found
        )
    assert answer.spare == 0


def test_a_place_out_of_reach_is_told(tmp_path: Path) -> None:
    with pytest.raises(UndecidedError, match="out of reach, or hard to come to"):
        sk.reach(written(tmp_path, TWO_BARS.format(l1=1, l2=1)), (3, 0))


def test_spare_freedoms_are_counted(tmp_path: Path) -> None:
    """A point on the x axis and no more: the second coordinate stays free."""
    answer = sk.reach(
        written(tmp_path, TWO_BARS.format(l1=1, l2=1)), turned={"tool": "pi/3"}
    )
    assert answer.spare == 1
    (joints,) = joints_of(answer)[:1]
    assert angle_between(joints["qA"] + joints["qB"], pi / 3) < 1e-9


def turn(axis: str, angle: float) -> Array:
    c, s = cos(angle), sin(angle)
    return np.array(
        {
            "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
            "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }[axis]
    )


def wrist(joints: dict[str, float]) -> tuple[Array, Array]:
    """Place of the wrist and orientation of the hand, link by link."""
    q = [joints[f"q{k}"] for k in range(1, 7)]
    first = turn("z", q[0])
    second = first @ turn("y", q[1])
    third = second @ turn("y", q[2])
    x = np.array([1.0, 0, 0])
    place = np.array([0, 0, 1.0]) + second @ x + third @ x
    return place, third @ turn("x", q[3]) @ turn("y", q[4]) @ turn("x", q[5])


def test_a_spatial_arm_stands_where_it_is_sent(tmp_path: Path) -> None:
    """Eight configurations of a wrist-partitioned arm, each by forward kinematics."""
    aim, vector = (0.9, 0.5, 1.6), (0.2, -0.4, 0.3)
    answer = sk.reach(written(tmp_path, SPATIAL), aim, {"hand": vector})
    size = hypot(*vector)
    k = np.array(vector) / size
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    rotation = np.eye(3) + sin(size) * cross + (1 - cos(size)) * cross @ cross
    found = joints_of(answer)
    for joints in found:
        place, orientation = wrist(joints)
        assert np.allclose(place, aim, atol=1e-8)
        assert np.allclose(orientation, rotation, atol=1e-8)
    for number, one in enumerate(found):
        for other in found[:number]:
            assert max(angle_between(one[q], other[q]) for q in one) > 1e-4
    assert len(found) == 8
    assert answer.spare == 0


def test_the_two_arms_of_the_paper_have_two_elbows_each() -> None:
    """Point and both last links given: each arm is left with its two elbows."""
    answer = sk.reach(sk.load("dual_planar_3r"), (1.1, 1.3), {"a3": 0, "b3": 0})
    assert len(answer.configurations) == 4
    nearest = answer.configurations[0]
    here = sk.manipulability(sk.load("dual_planar_3r"))
    assert np.allclose(nearest.kinematic.finite, here.kinematic.finite, rtol=1e-8)


def test_wrong_names_and_numbers_are_refused() -> None:
    case = sk.load("dual_planar_3r")
    with pytest.raises(UnknownNameError, match="did you mean 'object'"):
        sk.reach(case, (1, 1), {"objekt": 0})
    with pytest.raises(ExpressionError, match="has 2 coordinates, not 4"):
        sk.reach(case, (1, 1, 1, 1))
    with pytest.raises(ExpressionError, match="unknown name 'w'"):
        sk.reach(case, (1, 1), {"a3": "w"})


@pytest.mark.parametrize(
    ("point", "turned", "said"),
    [
        ((float("nan"), 1), {}, "nan is no finite number"),
        ((float("inf"), 1), {}, "inf is no finite number"),
        ((1,), {}, "has 2 coordinates, not 1"),
        (("1/0", 1), {}, "division by zero"),
        ((1, 1), {"a3": (1, 2, 3)}, "turned by an angle, not by 3 numbers"),
        ((1, 1), {"a3": float("nan")}, "nan is no finite number"),
    ],
)
def test_what_is_no_place_is_refused(
    point: tuple[float | str, ...],
    turned: dict[str, float | tuple[float, ...]],
    said: str,
) -> None:
    with pytest.raises(ExpressionError, match=said):
        sk.reach(sk.load("dual_planar_3r"), point, turned)


def test_the_base_turns_nowhere() -> None:
    with pytest.raises(UnknownNameError, match="no movable link 'ground'"):
        sk.reach(sk.load("dual_planar_3r"), (1, 1), {"ground": 1})


@pytest.mark.parametrize("length", ["0", "-2", "1 - 1", "-sqrt(2)"])
def test_a_length_is_positive(length: str) -> None:
    case = sk.load("dual_planar_3r")
    with pytest.raises(ExpressionError, match="one radian is positive"):
        sk.manipulability(case, length=length)
    with pytest.raises(ExpressionError, match="one radian is positive"):
        sk.reach(case, (1.1, 1.3), length=length)
