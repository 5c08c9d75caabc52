"""Indices at postures to which a mechanism is moved, against trigonometry in floats."""

from __future__ import annotations

import re
from math import cos, hypot, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh, null_space

import screwkit as sk
from screwkit.errors import UndecidedError

Array = NDArray[np.float64]
FIVE_BAR = """screwkit: 1
name: five
space: planar
geometry: reference
base: ground
platform: {platform}
links: [ground, a, b, c, d]
joints:
  - {{name: A, type: revolute, parent: ground, child: a, point: [0, 0]}}
  - {{name: B, type: revolute, parent: a, child: b, point: [-1, 2]}}
  - {{name: C, type: revolute, parent: b, child: c, point: [2, 4]}}
  - {{name: D, type: revolute, parent: c, child: d, point: [5, 2]}}
  - {{name: E, type: revolute, parent: ground, child: d, point: [4, 0]}}
actuated: [A, E]
reference_point: [2, 4]
"""
HAND = """screwkit: 1
name: hand
space: planar
geometry: reference
base: palm
platform: ball
links: [palm, a1, a2, b1, ball]
joints:
  - {name: "1", type: revolute, parent: palm, child: a1, point: [0, 0]}
  - {name: "2", type: revolute, parent: a1, child: a2, point: [2, 0]}
  - {name: "3", type: revolute, parent: palm, child: b1, point: [5, 0]}
  - {name: tip, type: hard_finger, parent: a2, child: ball, point: [3, 1]}
  - {name: grip, type: complete, parent: b1, child: ball, point: [4, 2]}
actuated: ["1", "3"]
reference_point: [4, 2]
"""
MDH = """screwkit: 1
name: pair
geometry: mdh
base: ground
platform: bar
links: [ground, a1, a2, a3, b1, b2, b3, bar]
joints:
  - {name: A1, type: revolute, parent: ground, child: a1, mdh: {}}
  - {name: A2, type: revolute, parent: a1, child: a2, mdh: {d: 2}}
  - {name: A3, type: revolute, parent: a2, child: a3, mdh: {d: 1}}
  - {name: B1, type: revolute, parent: ground, child: b1, mdh: {d: 3}}
  - {name: B2, type: revolute, parent: b1, child: b2, mdh: {d: 1}}
  - {name: B3, type: revolute, parent: b2, child: b3, mdh: {d: 2}}
  - {name: ga, type: fixed, parent: a3, child: bar}
  - {name: gb, type: fixed, parent: b3, child: bar}
actuated: [A1, A2, B1]
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "mechanism.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def turning(point: Array, about: Array) -> list[float]:
    """(ω; v) of a body point for a unit turn about another."""
    x, y = point - about
    return [1.0, -y, x]


def finite(j: Array, gt: Array, actuated: int) -> Array:
    """(13) where no rank is lost: det(UᵀU − λ QᵀQ) = 0."""
    basis = null_space(np.hstack([j, -gt]))
    q, u = basis[:actuated], basis[j.shape[1] :]
    return np.asarray(eigh(u.T @ u, q.T @ q, eigvals_only=True)[::-1])


def elbow(one: Array, r: float, other: Array, s: float, near: Array) -> Array:
    """The point at r from one and s from other, on the side of a third."""
    x, y = other - one
    size = hypot(x, y)
    along = (r * r - s * s + size * size) / (2 * size)
    off = np.sqrt(r * r - along * along)
    foot = one + along / size * np.array([x, y])
    normal = np.array([-y, x]) / size
    both = [foot + off * normal, foot - off * normal]
    return min(both, key=lambda p: float(np.linalg.norm(p - near)))


@pytest.mark.parametrize("platform", ["b", "c"])
@pytest.mark.parametrize(("first", "last"), [(0.2, 0.1), (-0.3, 0.25), (0.1, -0.4)])
def test_a_five_bar_that_is_driven_elsewhere(
    tmp_path: Path, platform: str, first: float, last: float
) -> None:
    """Angles count from the posture of the file; the elbow stays on its side."""
    a, b, c, d, e = map(np.array, ([0.0, 0], [-1.0, 2], [2.0, 4], [5.0, 2], [4.0, 0]))
    moved_b, moved_d = rotated(b, a, first), rotated(d, e, last)
    moved_c = elbow(moved_b, hypot(3, 2), moved_d, hypot(3, 2), c)
    here = sk.load(
        written(tmp_path, FIVE_BAR.format(platform=platform)),
        at={"qA": repr(first), "qE": repr(last)},
    )
    answer = sk.manipulability(here)
    # The bar b is held by A, B on one side, by E, D, C on the other; c likewise.
    # Its point C is the reference point of both.
    left, right = [(a, 0), (moved_b, 2)], [(e, 1), (moved_d, 4)]
    (left if platform == "c" else right).append((moved_c, 3))
    j = np.zeros((6, 5))
    for start, joints in ((0, left), (3, right)):
        for about, column in joints:
            j[start : start + 3, column] = turning(moved_c, about)
    gt = np.vstack([np.eye(3)] * 2)
    assert np.allclose(answer.kinematic.finite, finite(j, gt, 2), rtol=1e-6)
    assert not answer.posture.exact
    assert np.allclose(answer.point[:2], moved_c, atol=1e-8)
    gamma = answer.partition.gamma
    assert gamma is not None
    assert (answer.kinematic.infinite, gamma.apo_c) == (0, 2)
    assert np.allclose(
        answer.force.finite, 1 / np.array(answer.kinematic.finite)[::-1], rtol=1e-6
    )


def rotated(point: Array, about: Array, angle: float) -> Array:
    c, s = cos(angle), sin(angle)
    return np.asarray(about + np.array([[c, -s], [s, c]]) @ (point - about))


@pytest.mark.parametrize("angle", [0.3, -0.1])
def test_a_grasp_goes_with_the_finger(tmp_path: Path, angle: float) -> None:
    """The ball is fast to finger b; finger a touches it with friction in one point.

    Turning finger b by the angle takes the touched point of the ball with it, and
    finger a bends so that its tip stays there.
    """
    answer = sk.manipulability(sk.load(written(tmp_path, HAND), at={"q3": repr(angle)}))
    first, last = np.array([0.0, 0]), np.array([5.0, 0])
    tip = rotated(np.array([3.0, 1]), last, angle)
    grip = rotated(np.array([4.0, 2]), last, angle)
    middle = elbow(first, 2.0, tip, hypot(1, 1), np.array([2.0, 0]))
    j = np.zeros((5, 3))  # actuated 1, 3; passive 2
    j[:2, 0] = turning(tip, first)[1:]
    j[:2, 2] = turning(tip, middle)[1:]
    j[2:, 1] = turning(grip, last)
    gt = np.zeros((5, 3))
    x, y = tip - grip
    gt[:2] = [[-y, 1, 0], [x, 0, 1]]
    gt[2:] = np.eye(3)
    wanted = finite(j, gt, 2)
    assert np.allclose(answer.kinematic.finite, wanted, rtol=1e-6)
    assert np.allclose(answer.contacts[0].point[:2], tip, atol=1e-8)


def test_a_finger_that_is_too_short_says_where_it_ends(tmp_path: Path) -> None:
    """The touched point leaves the reach 2 + √2 of finger a: there it turns back."""
    with pytest.raises(UndecidedError, match="a dead point") as caught:
        sk.manipulability(sk.load(written(tmp_path, HAND), at={"q3": "-9/20"}))
    (said,) = re.findall(r"q3 = (-[\d.]+)", str(caught.value))
    tip = rotated(np.array([3.0, 1]), np.array([5.0, 0]), float(said))
    assert np.isclose(hypot(*tip), 2 + sqrt(2), atol=1e-4)


def test_a_table_is_exact_wherever_it_is_set(tmp_path: Path) -> None:
    """Free joint variables take any values; trigonometry places the six axes."""
    at = {"qA1": 0.4, "qA2": -0.9, "qA3": 0.2, "qB1": 1.3, "qB2": 0.5, "qB3": -0.6}
    answer = sk.manipulability(
        sk.load(written(tmp_path, MDH), at={k: repr(v) for k, v in at.items()})
    )
    a1 = np.array([0.0, 0])
    a2 = a1 + 2 * np.array([cos(0.4), sin(0.4)])
    a3 = a2 + np.array([cos(0.4 - 0.9), sin(0.4 - 0.9)])
    b1 = np.array([3.0, 0])
    b2 = b1 + np.array([cos(1.3), sin(1.3)])
    b3 = b2 + 2 * np.array([cos(1.8), sin(1.8)])
    j = np.zeros((6, 6))
    columns = [(0, a1), (0, a2), (3, b1), (0, a3), (3, b2), (3, b3)]
    for column, (start, about) in enumerate(columns):
        j[start : start + 3, column] = turning(np.zeros(2), about)
    gt = np.vstack([np.eye(3)] * 2)
    assert answer.actuated == ("A1", "A2", "B1")
    assert np.allclose(answer.kinematic.finite, finite(j, gt, 3), rtol=1e-8)


FOUR_BAR = """screwkit: 1
name: four
space: planar
geometry: reference
base: ground
platform: coupler
links: [ground, crank, rocker, coupler]
parameters:
  w: {value: 3, positive: true}
joints:
  - {name: a, type: revolute, parent: ground, child: crank, point: [0, 0]}
  - {name: b, type: revolute, parent: crank, child: coupler, point: [0, 1]}
  - {name: c, type: revolute, parent: ground, child: rocker, point: [w, 0]}
  - {name: d, type: revolute, parent: rocker, child: coupler, point: [w - 1, 2]}
actuated: [a]
reference_point: [1, 2]
"""


def test_symbols_of_a_loop_are_those_of_its_closed_posture(tmp_path: Path) -> None:
    """Joint variables that a loop ties are no symbols that one could choose.

    The lines of crank and rocker meet in I = (0, 2 w), 2 w - 1 from b and 1 from a on
    the other side: ω = -1/(2 w - 1), and the point (1, 2) has the lever (1, 2 - 2 w).
    """
    path = tmp_path / "four.yaml"
    path.write_text(FOUR_BAR, encoding="utf-8")
    here = sk.manipulability(sk.load(path))
    (motion,) = here.partition.blocks[0].motions
    assert here.partition.symbolic
    for w in (3, 5):
        value = (1 + 1 + (2 - 2 * w) ** 2) / (2 * w - 1) ** 2
        formula = here.symbolic.kinematic.replace("^", "**")
        assert eval(formula, {"x": value, "w": w}) == pytest.approx(0, abs=1e-12)
        twist = [eval(t, {"w": w}) for t in motion.twist]
        assert np.allclose(np.divide(twist, twist[0])[1:], [2 * w - 2, 1])
    assert here.kinematic.finite == pytest.approx([18 / 25])
    moved = sk.manipulability(sk.load(path, at={"qa": "0.3"}))
    assert not moved.symbolic.kinematic
    assert not moved.partition.symbolic


SLIDER = """screwkit: 1
name: slider
space: planar
geometry: posture
base: ground
platform: slider
links: [ground, crank, rod, slider]
parameters: {r: 1}
variables: {x: 3, theta: {value: 1, angle: true}}
points: {A: [r*cos(theta), r*sin(theta)], B: [x, 0]}
joints:
  - {name: a, type: revolute, parent: ground, child: crank, point: [0, 0]}
  - {name: b, type: revolute, parent: crank, child: rod, point: A}
  - {name: c, type: revolute, parent: rod, child: slider, point: B}
  - {name: d, type: prismatic, parent: ground, child: slider, axis: [1, 0]}
actuated: [a]
"""


def test_a_symbol_x_is_not_taken_for_the_value(tmp_path: Path) -> None:
    """The piston: dx/dθ = -x r sin θ/(x - r cos θ), and it does not turn at all."""
    path = tmp_path / "slider.yaml"
    path.write_text(SLIDER, encoding="utf-8")
    answer = sk.manipulability(sk.load(path))
    x, r, theta = 3, 1, 1.0
    value = (x * r * sin(theta) / (x - r * cos(theta))) ** 2
    assert answer.kinematic.finite == pytest.approx([value])
    formula, unknown = answer.symbolic.kinematic, answer.symbolic.unknown
    assert unknown == "lambda"
    given = {"value": value, "x": x, "r": r, "theta": theta, "cos": cos, "sin": sin}
    python = formula.replace("lambda", "value").replace("^", "**")
    assert eval(python, given) == pytest.approx(0, abs=1e-12)
    assert "with the value λ" in " ".join(str(answer).split())
    # What does not turn is not said to, by rounding, nor weighed against what slides.
    assert answer.rotation.semi_axes == ()
    assert not answer.units
