"""What a range may vary: weights, tied joint variables, both together; lost values.

Expected values are those of single postures, or follow by hand from the figure.
"""

from __future__ import annotations

from math import cos, pi
from pathlib import Path

import numpy as np
import pytest

import screwkit as sk
from screwkit.errors import ExpressionError, UndecidedError
from screwkit.metrics.index_function import Kind, index_function

ARM = """screwkit: 1
name: arm
space: planar
geometry: reference
base: base
platform: tool
links: [base, a, b, tool]
parameters: {m: 1, k: 2}
joints:
  - {name: A, type: revolute, parent: base, child: a, point: [0, 0]}
  - {name: B, type: revolute, parent: a, child: b, point: [1, 0]}
  - {name: C, type: revolute, parent: b, child: tool, point: [2, 0]}
actuated: [A, B, C]
reference_point: [2 + m, 0]
weights:
  twist: [1, 1/m^2, 1/m^2]
  rates: [[k, 1, 0], [1, 2, 0], [0, 0, 1]]
  wrench: [m, m, 1]
  torques: [1, k, m]
"""
FRAME = """screwkit: 1
name: frame
space: planar
geometry: {geometry}
base: ground
platform: coupler
links: [ground, a, coupler, b]
parameters: {{w: 4}}
joints:
  - {{name: A, type: revolute, parent: ground, child: a, point: [0, 0]}}
  - {{name: B, type: revolute, parent: a, child: coupler, point: [0, 1]}}
  - {{name: C, type: revolute, parent: coupler, child: b, point: [w, 1]}}
  - {{name: D, type: revolute, parent: b, child: ground, point: [w, 0]}}
actuated: [A]
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "mechanism.yaml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("kind", ["kinematic", "force"])
def test_weights_follow_what_is_varied(tmp_path: Path, kind: Kind) -> None:
    """At every point the weights of that point, as in a single posture."""
    path = written(tmp_path, ARM)
    points = [(1, 2, 0.5), (2.5, 3, 0.5), (0.75, 5, -1.25)]
    m, k, bend = (np.array(column, float) for column in zip(*points, strict=True))
    found = index_function(sk.load(path).mechanism, kind)({"m": m, "k": k, "qB": bend})
    for number, (length, stiff, angle) in enumerate(points):
        here = sk.load(
            path,
            set_values={"m": str(length), "k": str(stiff)},
            at={"qB": str(angle)},
        )
        answer = sk.manipulability(here)
        index = answer.kinematic if kind == "kinematic" else answer.force
        assert np.allclose(found[number], index.finite, rtol=1e-9)


def test_a_weight_that_stops_being_one_is_told(tmp_path: Path) -> None:
    """[[k, 1], [1, 2]] is positive definite for k > 1/2."""
    case = sk.load(written(tmp_path, ARM))
    with pytest.raises(ExpressionError, match="not positive definite"):
        sk.sweep(case, ["k=0.25:2:3"], "kinematic.min")


@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1])
def test_what_is_lost_is_nothing_and_what_is_felt_by_no_one_infinite(
    tmp_path: Path, turn: float
) -> None:
    """A stretched arm cannot move along itself, and carries any force there."""
    mechanism = sk.load(written(tmp_path, ARM)).mechanism
    bends = np.array([0.0, 0.4, pi])
    at = {"qA": np.full(3, turn), "qB": bends, "qC": np.full(3, 0.7)}
    motion = index_function(mechanism)(at)
    force = index_function(mechanism, "force")(at)
    assert (motion[[0, 2], -1] == 0).all()
    assert np.isinf(force[[0, 2], 0]).all()
    assert (motion[:, :2] > 0.01).all()
    assert motion[1, -1] > 1e-4
    assert np.isfinite(force[1]).all()
    assert np.isfinite(force[:, 1:]).all()


def test_maps_count_postures_that_are_lost(tmp_path: Path) -> None:
    found = sk.sweep(
        sk.load(written(tmp_path, ARM)), ["qB=0:1:3", "qA=0.3:1:2"], "force.max"
    )
    assert found.answer.singular == 2
    assert np.isinf(found.values[0]).all()
    assert np.isfinite(found.values[1:]).all()


@pytest.mark.parametrize("geometry", ["reference", "posture"])
@pytest.mark.parametrize("index", ["locus", "sigma_min", "kinematic.min", "force.max"])
def test_loops_follow_the_joint_that_is_varied(
    tmp_path: Path, geometry: str, index: str
) -> None:
    """A parallelogram: its cranks stay parallel, so everything is known by hand.

    With A locked the coupler is held by a hinge at B and by the bar CD: a lever of
    length w whose arm about B is w cos(qA).  The coupler moves as fast as B does.
    """
    case = sk.load(written(tmp_path, FRAME.format(geometry=geometry)))
    angles = [0.0, 0.5, 1.0]
    found = sk.sweep(case, ["qA=0:1:3", "w=3:5:2"], index).values
    for row, angle in zip(found, angles, strict=True):
        for value, width in zip(row, (3.0, 5.0), strict=True):
            if index == "locus":
                assert np.isclose(abs(value), width * cos(angle), rtol=1e-7)
            elif index == "sigma_min":
                assert np.isclose(value, _least(width, angle), rtol=1e-7)
            else:
                assert np.isclose(value, 1, rtol=1e-7)


@pytest.mark.parametrize("geometry", ["reference", "posture"])
def test_joints_stay_where_they_are_put(tmp_path: Path, geometry: str) -> None:
    """The lever of the parallelogram above, its crank held at 1/2 by ``--at``."""
    case = sk.load(written(tmp_path, FRAME.format(geometry=geometry)), at={"qA": "1/2"})
    found = sk.sweep(case, ["w=3:5:2"], "locus").values
    assert np.allclose(np.abs(found), np.array([3, 5]) * cos(0.5), rtol=1e-7)


def _least(width: float, angle: float) -> float:
    """Smallest singular value of [J_p −Gᵀ], built column by column.

    Coordinates (ω; v) at B and C of hinges B and C on the two sides, D on the ground;
    the coupler's own motion is that of its point that was at the origin.
    """
    bx, by = -np.sin(angle), np.cos(angle)
    ox, oy = bx, by - 1
    points = {"B": (bx, by), "C": (bx + width, by), "D": (width, 0.0)}

    def at(x: float, y: float, px: float, py: float) -> list[float]:
        """(v; ω) of a point p for a unit turn about (x, y)."""
        return [-(py - y), px - x, 1.0]

    rows = np.zeros((6, 6))
    rows[:3, 0] = at(*points["B"], *points["B"])
    for column, name in ((1, "C"), (2, "D")):
        rows[3:, column] = at(*points[name], *points["C"])
    for start, name in ((0, "B"), (3, "C")):
        px, py = points[name]
        rows[start : start + 3, 3:] = -np.array(
            [[oy - py, 1, 0], [px - ox, 0, 1], [1, 0, 0]]
        )
    return float(np.linalg.svd(rows, compute_uv=False)[-1])


def test_a_dead_point_is_infinite_and_no_zero(tmp_path: Path) -> None:
    """Driven at the coupler's hinge, the folded parallelogram lets the coupler go.

    With qA = π/2 all four hinges are on one line; A is locked there, and B and C can
    still turn against it: the object is not held, the value is infinite.
    """
    path = written(tmp_path, FRAME.format(geometry="reference"))
    case = sk.load(path)
    folded = sk.manipulability(sk.load(path, at={"qA": "pi/2"}))
    assert folded.kinematic.infinite == 1
    found = sk.sweep(case, [f"qA=0:{pi / 2!r}:3"], "kinematic.max")
    assert np.allclose(found.values[:2], 1)
    assert np.isinf(found.values[2])


@pytest.mark.parametrize("index", ["kinematic.min", "force.max"])
def test_nothing_to_measure_is_told(tmp_path: Path, index: str) -> None:
    """A platform that is welded to the ground, beside a loop that moves."""
    text = FRAME.format(geometry="reference").replace(
        "coupler, b]", "coupler, b, tool]"
    )
    text = text.replace("platform: coupler", "platform: tool").replace(
        "actuated",
        "  - {name: H, type: fixed, parent: ground, child: tool}\nactuated",
    )
    with pytest.raises(UndecidedError, match="has no finite value at the posture"):
        sk.sweep(sk.load(written(tmp_path, text)), ["qA=0:1:3"], index)
