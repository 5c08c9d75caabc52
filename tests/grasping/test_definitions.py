"""G, D and H of a grasp with symbols, written out from the definitions.

[BicchiMelchiorri] eqs. (1)-(7), [BicchiPrattichizzo] Appendix A: in space with turning
and sliding joints and four kinds of contacts, and in the plane.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from grasping.test_matrices import Array, numbers

import screwkit as sk
from screwkit.analyses.grasp_view import GraspView

SPATIAL = """screwkit: 1
name: hand
geometry: posture
base: palm
platform: ball
links: [palm, a1, a2, b1, ball]
parameters: {a: {value: 1}, b: {value: 2}, h: {value: 3}}
reference_point: [a, 1, h]
joints:
  - {name: "1", type: revolute, parent: palm, child: a1, axis: [0, 0, 1],
      point: [a, 0, 0]}
  - {name: "2", type: prismatic, parent: a1, child: a2, axis: [1, 0, 0]}
  - {name: "3", type: revolute, parent: b1, child: palm, axis: [0, 1, 0],
      point: [0, b, h]}
  - {name: soft, type: soft_finger, parent: a2, child: ball,
      point: [a, b, 1], normal: [0, 1, 0]}
  - {name: flat, type: line, parent: ball, child: b1,
      point: [b, 0, h], normal: [0, 0, 1], line: [1, 0, 0]}
  - {name: tip, type: point, parent: palm, child: ball,
      point: [0, 0, b], normal: [1, 0, 0]}
actuated: ["3", "1"]
"""
PLANAR = """screwkit: 1
name: pair
space: planar
geometry: posture
base: palm
platform: ball
links: [palm, a1, b1, ball]
parameters: {a: {value: 1}, b: {value: 2}}
reference_point: [a, b]
joints:
  - {name: "1", type: revolute, parent: palm, child: a1, point: [a, 0]}
  - {name: "2", type: prismatic, parent: palm, child: b1, axis: [0, 1]}
  - {name: hard, type: hard_finger, parent: a1, child: ball, point: [b, a]}
  - {name: edge, type: line, parent: b1, child: ball, point: [0, b], normal: [1, 0]}
actuated: ["1"]
"""
VALUES = {"a": 0.7, "b": -1.3, "h": 2.1}


def grasp_of(folder: Path, text: str) -> GraspView:
    path = folder / "hand.yaml"
    path.write_text(text, encoding="utf-8")
    return sk.load(path).grasp


def cross_matrix(r: Array) -> Array:
    x, y, z = r
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def test_the_matrices_of_a_hand(tmp_path: Path) -> None:
    grasp = grasp_of(tmp_path, SPATIAL)
    a, b, h = VALUES["a"], VALUES["b"], VALUES["h"]
    x, y, z = np.eye(3)
    places = [np.array(p) for p in ([a, b, 1], [b, 0, h], [0, 0, b])]
    centre = np.array([a, 1, h])
    full = np.zeros((6, 18))
    for k, place in enumerate(places):
        full[:3, 3 * k : 3 * k + 3] = np.eye(3)
        full[3:, 3 * k : 3 * k + 3] = cross_matrix(place - centre)
        full[3:, 9 + 3 * k : 12 + 3 * k] = np.eye(3)
    d = np.zeros((18, 3))
    # Columns 3, 1, 2: the scheme in its order, then what is passive.  Joint 3 is
    # passed from child to parent, so that its axis turns round.
    d[3:6, 0] = -np.cross(y, places[1] - np.array([0, b, h]))
    d[12:15, 0] = -y
    d[0:3, 1] = np.cross(z, places[0] - np.array([a, 0, 0]))
    d[9:12, 1] = z
    d[0:3, 2] = x
    select = np.zeros((7, 18))
    select[0:3, 0:3] = np.eye(3)  # soft finger: all forces
    select[3, 3:6] = z  # line without friction: the normal force
    select[4, 6:9] = x  # point without friction
    select[5, 9:12] = y  # soft finger: the moment about its normal
    select[6, 12:15] = np.cross(z, x)  # line: rotation about y = z × x is held
    assert grasp.D.columns == ("3", "1", "2")
    assert np.allclose(numbers(grasp.G_full, **VALUES), full)
    assert np.allclose(numbers(grasp.D, **VALUES), d)
    found, wanted = numbers(grasp.H, **VALUES), select
    assert np.allclose(np.abs(found), np.abs(wanted))
    assert np.allclose(found @ found.T, np.eye(7))
    assert np.allclose(numbers(grasp.J, **VALUES), found @ d)
    assert np.allclose(numbers(grasp.G, **VALUES), full @ found.T)
    assert np.allclose(numbers(grasp.J_a, **VALUES), (found @ d)[:, :2])
    assert np.allclose(numbers(grasp.J_p, **VALUES), (found @ d)[:, 2:])


def test_the_matrices_in_the_plane(tmp_path: Path) -> None:
    """Lower left [−r_y, r_x]; a turn moves by (−e_y, e_x; 1)."""
    grasp = grasp_of(tmp_path, PLANAR)
    a, b = VALUES["a"], VALUES["b"]
    values = {"a": a, "b": b}
    full = np.zeros((3, 6))
    for k, place in enumerate(([b, a], [0, b])):
        rx, ry = place[0] - a, place[1] - b
        full[:2, 2 * k : 2 * k + 2] = np.eye(2)
        full[2, 2 * k : 2 * k + 2] = [-ry, rx]
        full[2, 4 + k] = 1
    d = np.zeros((6, 2))
    d[0:2, 0] = [-a, b - a]
    d[4, 0] = 1
    d[2:4, 1] = [0, 1]
    select = np.zeros((4, 6))
    select[0, 0] = select[1, 1] = select[2, 2] = select[3, 5] = 1
    assert np.allclose(numbers(grasp.G_full, **values), full)
    assert np.allclose(numbers(grasp.D, **values), d)
    assert np.allclose(numbers(grasp.H, **values), select)
    assert np.allclose(numbers(grasp.J, **values), select @ d)


@pytest.mark.parametrize("text", [SPATIAL, PLANAR], ids=["space", "plane"])
def test_symbols_and_numbers_agree(tmp_path: Path, text: str) -> None:
    """Exact entries through sympy, at rational values of the file's symbols."""
    grasp = grasp_of(tmp_path, text)
    names = {name: value for name, value in VALUES.items() if f"{name}: {{" in text}
    for matrix in (grasp.G, grasp.J, grasp.G_full, grasp.D, grasp.H):
        exact = matrix.to_sympy()
        by_name = {symbol.name: symbol for symbol in exact.free_symbols}
        at = {by_name[n]: v for n, v in names.items() if n in by_name}
        assert np.allclose(
            np.array(exact.subs(at).tolist(), float), numbers(matrix, **names)
        )
