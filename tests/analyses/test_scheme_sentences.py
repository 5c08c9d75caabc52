"""What conditions of schemes mean: the lines that limbs resist along, by hand."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np
from loci.numeric import Array, value

import screwkit as sk

SOURCE = np.random.default_rng(9)
Posture = Mapping[str, float]


def _drawn(names: str) -> dict[str, float]:
    names_of = names.split()
    return dict(zip(names_of, SOURCE.uniform(0.5, 2.5, len(names_of)), strict=True))


def _legs(at: Posture) -> tuple[Array, Array]:
    """Points A1, A2, A3 and B1, B2, B3 of the planar 3-RPR."""
    c, s = np.cos(at["phi"]), np.sin(at["phi"])
    base = np.array([[0, 0], [at["a2"], 0], [at["a3x"], at["a3y"]]])
    own = np.array([[0, 0], [at["b2"], 0], [at["b3x"], at["b3y"]]])
    moved = own @ np.array([[c, s], [-s, c]]) + [at["x"], at["y"]]
    return base, np.asarray(moved)


def test_lines_of_each_scheme_meet_in_one_point() -> None:
    """An actuated slide resists along its leg, a hinge across it through the other."""
    answer = sk.schemes(sk.load("3rpr_planar"))
    found = 0
    for factor in answer.factors:
        if "meet in one point" not in (factor.meaning or ""):
            continue
        ratios = []
        for _ in range(4):
            at = _drawn("a2 a3x a3y b2 b3x b3y x y phi")
            base, moved = _legs(at)
            rows = []
            for n, (a, b) in enumerate(zip(base, moved, strict=True), 1):
                across = re.search(
                    rf"through ([AB]){n} normal to axes R1 and P{n}",
                    factor.meaning or "",
                )
                along = b - a
                place = a if across is None or across[1] == "A" else b
                if across is not None:
                    along = np.array([-along[1], along[0]])
                rows.append([*along, place[0] * along[1] - place[1] * along[0]])
            ratios.append(np.linalg.det(np.array(rows)) / value(factor.equation, at))
        assert np.ptp(ratios) < 1e-6 * abs(ratios[0])
        found += 1
    assert found > 20


def _links(at: Posture) -> dict[str, Array]:
    """A, E and B of the limbs of the 3-CRR robot."""
    x, y, z, a, b, length = (at[n] for n in ("x", "y", "z", "a", "b", "l"))
    centre = np.array([x, y, z])
    i, j, k = np.eye(3)
    found = {
        "A1": np.array([x, a, 0]),
        "A2": np.array([0, y, a]),
        "A3": np.array([a, 0, z]),
    }
    ways = ((j, k), (k, i), (i, j))
    for n, (one, other) in enumerate(ways, 1):
        angle = at[f"theta{n}"]
        found[f"E{n}"] = found[f"A{n}"] + length * (
            np.cos(angle) * one + np.sin(angle) * other
        )
    for n, way in enumerate((j, k, i), 1):
        found[f"B{n}"] = centre + b * way
    return found


def test_forces_of_a_translating_robot_are_parallel_to_one_plane() -> None:
    """Couples keep it from turning; normal to such forces it translates.

    A length that is a factor is no condition, so that of the links stays the same here.
    """
    answer = sk.schemes(sk.load("3crr"))
    assert all(factor.meaning for factor in answer.factors)
    found = 0
    for factor in answer.factors:
        named = re.fullmatch(
            r"lines (\w+) (\w+), (\w+) (\w+) and (\w+) (\w+) are parallel to one plane",
            factor.meaning or "",
        )
        if named is None:
            continue
        ratios = []
        for _ in range(4):
            at = {**_drawn("x y z a b theta1 theta2 theta3"), "l": 1.3}
            points = _links(at)
            one, two, three, four, five, six = (points[name] for name in named.groups())
            rows = np.array([two - one, four - three, six - five])
            ratios.append(np.linalg.det(rows) / value(factor.equation, at))
        assert np.ptp(ratios) < 1e-6 * abs(ratios[0])
        found += 1
    assert found > 20
