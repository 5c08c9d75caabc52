"""Determinants too long to expand as they stand, searched limb by limb."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from loci.numeric import Array, value

import screwkit as sk
from screwkit.algebra.branches import Branch
from screwkit.loci.actuation import actuation_locus
from screwkit.loci.dependence import Dependence
from screwkit.results.singularities import ActuationSingularities

BASE = [[2, 0, 0], [1, 2, 0], [-1, 2, 0], [-2, 0, 0], [-1, -2, 0], [1, -2, 1]]
CORNERS = [["b", "0", "0"], ["0", "b", "0"], ["-b", "-b", "0"]]
IN_LINE = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [4, 0, 0], [0, 3, 0], [2, 3, 1]]
ALSO_IN_LINE = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [0, 1, 0], [1, 2, 0]]
NAMES = ("x", "y", "z", "u", "v", "w")
HEIGHTS = tuple(f"s{n}" for n in range(1, 7))
RAILS = [[5, 1, 0], [3, 4, 0], [-3, 4, 0], [-5, 1, 0], [-1, -5, 0], [2, -5, 0]]
CARRIED = [[2, -1, 0], [2, 2, 0], [-2, 2, 0], [-2, -1, 0], [0, -2, 0], [1, -2, 0]]


def spherical_legs(
    base: Sequence[Sequence[int]], platform: Sequence[Sequence[object]]
) -> dict[str, object]:
    """Six S-P-S legs between points of the base and the platform; each spins idly."""
    links = ["base", "platform"]
    points: dict[str, object] = {}
    joints: list[dict[str, object]] = []
    for k in range(6):
        n, a, b = k + 1, f"A{k + 1}", f"B{k + 1}"
        links += [f"lower{n}", f"upper{n}"]
        points[a] = list(base[k])
        points[b] = {"link": "platform", "at": list(platform[k])}
        ends = ["base", f"lower{n}", f"upper{n}", "platform"]
        bodies = [{"parent": one, "child": two} for one, two in pairwise(ends)]
        joints += [
            {"name": f"S{n}", "type": "spherical", "point": a, **bodies[0]},
            {"name": f"P{n}", "type": "prismatic", "axis": f"{b} - {a}", **bodies[1]},
            {"name": f"T{n}", "type": "spherical", "point": b, **bodies[2]},
        ]
    return {
        "screwkit": 1,
        "name": "six_legs",
        "geometry": "posture",
        "base": "base",
        "platform": "platform",
        "links": links,
        "parameters": {"b": {"value": 1, "positive": True}},
        "variables": {"x": "1/3", "y": "1/5", "z": 3, "u": "1/9", "v": "1/7", "w": 1},
        "pose": {
            "translation": ["x", "y", "z"],
            "rotation": {"quaternion": [1, "u", "v", "w"]},
        },
        "points": points,
        "joints": joints,
        "actuated": [f"P{n}" for n in range(1, 7)],
    }


def legs_on_slides(
    base: Sequence[Sequence[int]], platform: Sequence[Sequence[object]]
) -> dict[str, object]:
    """Six P-U-S legs whose lower ends are lifted by vertical slides."""
    file = spherical_legs(base, platform)
    joints: list[dict[str, object]] = []
    points: dict[str, object] = {}
    for n in range(1, 7):
        points[f"A{n}"] = list(base[n - 1])
        points[f"S{n}"] = f"A{n} + s{n}*k"
        points[f"B{n}"] = {"link": "platform", "at": list(platform[n - 1])}
        ends = ["base", f"lower{n}", f"upper{n}", "platform"]
        bodies = [{"parent": one, "child": two} for one, two in pairwise(ends)]
        leg = f"B{n} - S{n}"
        axes = ["i", f"cross({leg}, i)"]
        joints += [
            {"name": f"P{n}", "type": "prismatic", "axis": "k", **bodies[0]},
            {"name": f"U{n}", "type": "universal", "axes": axes, **bodies[1]},
            {"name": f"T{n}", "type": "spherical", "point": f"B{n}", **bodies[2]},
        ]
        joints[-2]["point"] = f"S{n}"
    variables = {name: f"{n}/7" for n, name in enumerate((*NAMES, *HEIGHTS), 1)}
    vectors = {"i": [1, 0, 0], "k": [0, 0, 1]}
    return file | {
        "parameters": {},
        "variables": variables,
        "vectors": vectors,
        "points": points,
        "joints": joints,
    }


def actuation(folder: Path, file: dict[str, object]) -> ActuationSingularities:
    """What is answered of a file."""
    path = folder / "six_legs.json"
    path.write_text(json.dumps(file), encoding="utf-8")
    found = sk.singularities(sk.load(path)).actuation
    assert found is not None
    return found


def placed(points: Array, posture: Mapping[str, float]) -> tuple[Array, float]:
    """Points of the platform in the base frame, and the square of the quaternion."""
    x, y, z, u, v, w = (posture[name] for name in NAMES)
    turn: Array = np.array([[0, -w, v], [w, 0, -u], [-v, u, 0]])
    length = 1 + u * u + v * v + w * w
    rotation = np.eye(3) + 2 * (turn + turn @ turn) / length
    return points @ rotation.T + [x, y, z], length


def four_planes(posture: Mapping[str, float]) -> float:
    """Zero where the planes of two legs each and the platform's meet in one point.

    Every leg goes through a corner, so that the wrenches of a pair are the pencil of
    forces in their plane about it.  Denominators and the size b are multiplied out.
    """
    base, b = np.array(BASE, float), posture["b"]
    own: Array = np.array([[b, 0, 0], [0, b, 0], [-b, -b, 0]])
    corners, length = placed(own, posture)

    def plane(one: Array, two: Array, three: Array) -> Array:
        normal: Array = np.cross(two - one, three - one)
        return np.append(normal, -normal @ one)

    planes = [plane(base[2 * k], base[2 * k + 1], corners[k]) for k in range(3)]
    determinant = float(np.linalg.det(np.array([*planes, plane(*corners)])))
    return determinant * float(length / b) ** 3


def test_three_corners_fail_where_four_planes_meet(tmp_path: Path) -> None:
    file = spherical_legs(BASE, [CORNERS[k // 2] for k in range(6)])
    found = actuation(tmp_path, file)
    assert found.complete, found.reason
    ((equation,),) = [component.equations for component in found.components]
    source = np.random.default_rng(3)
    ratios = []
    for _ in range(5):
        posture = dict(zip((*NAMES, "b"), source.uniform(0.2, 2, 7), strict=True))
        ratios.append(value(equation, posture) / four_planes(posture))
    assert np.ptp(ratios) < 1e-6 * abs(ratios[0])


def test_four_legs_between_two_lines(tmp_path: Path) -> None:
    """The whole determinant is too long to factor; the parts are all its factors.

    That of the six forces is their product, a number, and a power of the denominator.
    """
    found = actuation(tmp_path, spherical_legs(IN_LINE, ALSO_IN_LINE))
    assert found.complete, found.reason
    assert [len(c.equations) for c in found.components] == [1, 1]
    base, own = np.array(IN_LINE, float), np.array(ALSO_IN_LINE, float)
    source = np.random.default_rng(4)
    rows, logarithms = [], []
    for _ in range(8):
        posture = dict(zip(NAMES, source.uniform(0.2, 2, 6), strict=True))
        ends, length = placed(own, posture)
        forces = np.hstack([ends - base, np.cross(base, ends)])
        factors = [value(c.equations[0], posture) for c in found.components]
        rows.append([1.0, math.log(length), *np.log(np.abs(factors))])
        logarithms.append(math.log(abs(np.linalg.det(forces))))
    powers, residuals, rank, _ = np.linalg.lstsq(np.array(rows), np.array(logarithms))
    assert rank == 4
    assert residuals < 1e-12
    assert powers[1:] == pytest.approx(np.round(powers[1:]))
    assert min(powers[2:]) > 0.5


def test_six_legs_on_slides_for_every_pose(tmp_path: Path) -> None:
    """The determinant of the six forces, of 94 433 terms, is a power times one factor.

    It is expanded and factored, and limbs are searched whatever that has cost.
    """
    path = tmp_path / "six_legs.json"
    path.write_text(json.dumps(legs_on_slides(RAILS, CARRIED)), encoding="utf-8")
    assembly = sk.load(path).assembly
    found = actuation_locus(assembly, assembly.mechanism.actuated)
    assert found.complete, found.reason
    (piece,) = found.pieces
    assert found.meanings is not None
    assert "of one linear complex" in (found.meanings.of_six_lines(piece) or "")
    (equation,) = piece.equations
    ring = piece.branches[0].ring
    place = {
        name: ring.names.index(str(ring.symbol(name))) for name in (*NAMES, *HEIGHTS)
    }
    base, own = np.array(RAILS, float), np.array(CARRIED, float)
    source = np.random.default_rng(6)
    ratios = []
    for _ in range(3):
        numbers = source.integers(1, 9, 12)
        posture = dict(zip((*NAMES, *HEIGHTS), map(int, numbers), strict=True))
        feet = base + np.outer([posture[name] for name in HEIGHTS], [0, 0, 1])
        ends, length = placed(own, posture)
        forces = np.hstack([ends - feet, np.cross(feet, ends)])
        point = [0] * len(ring.names)
        for name, number in posture.items():
            point[place[name]] = number
        exact = equation(*point)
        whole = int(exact.p) / int(exact.q)
        ratios.append(whole / (float(np.linalg.det(forces)) * length**3))
    assert np.ptp(ratios) < 1e-6 * abs(ratios[0])


def test_what_was_not_expanded_is_told_beside_idle_pieces(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The determinant hides whole components; an idle piece small ones."""

    def never(branch: Branch, *_: object, **__: object) -> Dependence:
        return Dependence((), (branch,), "a determinant was not expanded")

    monkeypatch.setattr("screwkit.loci.actuation.dependent_zeros", never)
    assembly = sk.load("nao_t14").assembly
    found = actuation_locus(assembly, assembly.mechanism.actuated)
    assert not found.complete
    assert found.reason == (
        "a determinant was not expanded; an idle piece was not searched to the end"
    )
