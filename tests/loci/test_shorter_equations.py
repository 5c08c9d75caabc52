"""Equations shortened by each other: same piece, fewer regular postures beside it."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from loci.numeric import Array, value
from one_ring import in_one_ring
from scipy.optimize import least_squares

import screwkit as sk
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Search
from screwkit.loci.pieces import Piece
from screwkit.loci.shorter_equations import with_shorter_equations

SYMBOLS = ("a", "b", "h", "z", "u", "v", "s1", "s2", "s3")


@pytest.mark.parametrize(
    ("written", "where", "wanted"),
    [
        (  # v = 0, u = ±1 satisfies both and not what is wanted
            ["u**2 - v**2 - 1", "h*u**2 + h*v**2 - h + 4*v"],
            ["u**2 - v**2 - 1", "h*v + 2"],
            {"u**2 - v**2 - 1", "h*v + 2"},
        ),
        (
            ["c*cos(q)*u - 3*c*sin(q) + 2*r", "cos(q)*u - 3*sin(q)"],
            ["cos(q)*u - 3*sin(q)", "r"],
            {"cos(q)*u - 3*sin(q)", "r"},
        ),
        (["x*y - 1", "x**2 + y**2 - 5"], ["x*y - 1", "x**2 + y**2 - 5"], None),
    ],
)
def test_a_multiple_of_one_equation_shortens_another(
    written: list[str], where: list[str], wanted: set[str] | None
) -> None:
    ring, polynomials = in_one_ring(*written, *where, *(wanted or ()))
    count = len(written)
    library = FactorLibrary(ring)
    root = Branch(ring, Assumptions())
    zeros = common_zeros(root, polynomials[count : 2 * count], Search(library))
    piece = Piece(tuple(polynomials[:count]), zeros.branches)
    shorter = with_shorter_equations(piece, root, library)
    expected = polynomials[2 * count :] if wanted else polynomials[:count]
    assert {*map(str, shorter.equations)} == {*map(str, expected)}


def leaning_guides() -> dict[str, object]:
    """A 3-PRS robot whose guides lean outwards, tan of the angle h."""
    vectors: dict[str, object] = {"k": [0, 0, 1], "e1": [1, 0, 0]}
    vectors |= {
        "e2": ["-1/2", "sqrt(3)/2", 0],
        "e3": ["-1/2", "-sqrt(3)/2", 0],
    }
    points: dict[str, object] = {}
    links, joints = ["base", "platform"], []
    for k in "123":
        vectors |= {f"t{k}": f"cross(k, e{k})", f"d{k}": f"k - h*e{k}"}
        points |= {
            f"A{k}": f"a*e{k} + s{k}*d{k}",
            f"B{k}": {"link": "platform", "at": f"b*e{k}"},
        }
        links += [f"slider{k}", f"rod{k}"]
        ends = ["base", f"slider{k}", f"rod{k}", "platform"]
        bodies = [{"parent": one, "child": two} for one, two in pairwise(ends)]
        joints += [
            {"name": f"P{k}", "type": "prismatic", "axis": f"d{k}", **bodies[0]},
            {
                "name": f"R{k}",
                "type": "revolute",
                "axis": f"t{k}",
                "point": f"A{k}",
                **bodies[1],
            },
            {"name": f"S{k}", "type": "spherical", "point": f"B{k}", **bodies[2]},
        ]
    squared = "(1 + u^2 + v^2)"
    return {
        "screwkit": 1,
        "name": "leaning_guides",
        "geometry": "posture",
        "base": "base",
        "platform": "platform",
        "links": links,
        "parameters": {n: {"value": 1, "positive": True} for n in "abh"},
        "variables": dict.fromkeys(SYMBOLS[3:], "1/3"),
        "vectors": vectors,
        "points": points,
        # Without rotation about the vertical first, its centres stay in their planes.
        "pose": {
            "translation": [f"b*(u^2 - v^2)/{squared}", f"-2*b*u*v/{squared}", "z"],
            "rotation": {"quaternion": [1, "u", "v", 0]},
        },
        "joints": joints,
    }


def forces_are_dependent(at: dict[str, float]) -> bool:
    """Forces through each ball joint that neither guide nor hinge gives way to."""
    a, b, h, z, u, v = (at[name] for name in SYMBOLS[:6])
    length = 1 + u * u + v * v
    turn: Array = np.array([[0, 0, v], [0, 0, -u], [-v, u, 0]])
    rotation = np.eye(3) + 2 * (turn + turn @ turn) / length
    centre = [b * (u * u - v * v) / length, -2 * b * u * v / length, z]
    wrenches = []
    for k in range(3):
        c, s = np.cos(2 * np.pi * k / 3), np.sin(2 * np.pi * k / 3)
        out, across = np.array([c, s, 0]), np.array([-s, c, 0])
        guide = np.array([0, 0, 1]) - h * out
        hinge = a * out + at[f"s{k + 1}"] * guide
        ball = rotation @ (b * out) + centre
        gives_way = np.array([guide, np.cross(across, ball - hinge)])
        gives_way /= np.linalg.norm(gives_way, axis=1)[:, None]
        _, sizes, forces = np.linalg.svd(gives_way)
        kept = forces[int((sizes > 1e-6).sum()) :]
        wrenches += [[*force, *np.cross(ball, force)] for force in kept]
    sizes = np.linalg.svd(np.array(wrenches), compute_uv=False)
    return len(wrenches) > 6 or bool(sizes[-1] < 1e-6)


def test_the_robot_with_leaning_guides_is_singular_on_its_components(
    tmp_path: Path,
) -> None:
    file = tmp_path / "leaning_guides.json"
    file.write_text(json.dumps(leaning_guides()), encoding="utf-8")
    found = sk.singularities(sk.load(file)).constraint
    assert found.complete, found.reason
    source = np.random.default_rng(5)
    for component in found.components:

        def residuals(
            x: Array, equations: tuple[str, ...] = component.equations
        ) -> list[float]:
            at = dict(zip(SYMBOLS, map(float, x), strict=True))
            return [value(text, at) for text in equations]

        met = 0
        for _ in range(25):
            start = source.uniform(-2, 2, len(SYMBOLS))
            best = least_squares(residuals, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
            at = dict(zip(SYMBOLS, map(float, best.x), strict=True))
            if np.abs(best.fun).max() < 1e-11 and abs(at["b"]) > 1e-2:
                met += 1
                assert forces_are_dependent(at), component.equations
        assert met > 3
