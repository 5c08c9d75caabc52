"""A set reached by two combinations of limb strata is searched for each of them.

Three legs universal, prismatic, universal.  Where the platform's centre is above that
of the base, x = y = 0, all limbs are singular.  As two of the three limb conditions say
so already, the combination in which the third limb is regular leads there too, and
leaves everything on it to the one in which it is not.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from screwkit.analyses.singularities import constraint_singularities
from screwkit.case import load_text

ALONG = [(1.0, 0.0), (-0.5, 0.75**0.5), (-0.5, -(0.75**0.5))]


def three_legs() -> dict[str, Any]:
    points: dict[str, Any] = {}
    vectors: dict[str, Any] = {"k": ["0", "0", "1"]}
    links, joints = ["base", "top"], []
    for n, (c, s) in enumerate(
        (("1", "0"), ("-1/2", "sqrt(3)/2"), ("-1/2", "-sqrt(3)/2")), start=1
    ):
        vectors |= {f"e{n}": [c, s, "0"], f"d{n}": f"B{n} - A{n}"}
        vectors[f"w{n}"] = f"cross(d{n}, cross(k, e{n}))"
        points[f"A{n}"] = f"2*e{n}"
        points[f"B{n}"] = {"link": "top", "at": [c, s, "0"]}
        ways = ["base", f"u{n}", f"p{n}", "top"]
        links += ways[1:-1]
        kinds: list[dict[str, Any]] = [
            {"type": "universal", "axes": [f"e{n} + k", f"w{n}"], "point": f"A{n}"},
            {"type": "prismatic", "axis": f"d{n}"},
            {"type": "universal", "axes": [f"w{n}", f"e{n}"], "point": f"B{n}"},
        ]
        joints += [
            {"name": f"J{n}{k}", "parent": ways[k], "child": ways[k + 1], **kind}
            for k, kind in enumerate(kinds)
        ]
    return {
        "screwkit": 1,
        "name": "three_legs",
        "geometry": "posture",
        "base": "base",
        "platform": "top",
        "links": links,
        "variables": {"x": "1/3", "y": "1/4", "z": "2"},
        "pose": {"translation": ["x", "y", "z"]},
        "points": points,
        "vectors": vectors,
        "joints": joints,
    }


def loop_rank(x: float, y: float, z: float) -> int:
    """Of the twists of all joints around two loops, by singular values."""
    rows = np.zeros((12, 15))
    up = np.array([0.0, 0.0, 1.0])
    for n, (c, s) in enumerate(ALONG):
        e = np.array([c, s, 0.0])
        start, end = 2 * e, e + np.array([x, y, z])
        d = end - start
        w = np.cross(d, np.cross(up, e))
        lines = [(e + up, start), (w, start), (None, d), (w, end), (e, end)]
        for k, (axis, at) in enumerate(lines):
            twist = (
                np.concatenate([np.zeros(3), at])
                if axis is None
                else np.concatenate([axis, np.cross(at, axis)])
            )
            column = 5 * n + k
            if n in {0, 1}:
                rows[:6, column] = twist
            if n in {0, 2}:
                rows[6:, column] = twist
    return int(np.linalg.matrix_rank(rows, tol=1e-9))


def test_what_one_combination_leaves_to_another_is_found_by_that() -> None:
    found = constraint_singularities(load_text(json.dumps(three_legs())).assembly)
    assert loop_rank(0.3, 0.2, 1.1) == loop_rank(0, 0, 1.1) == found.generic_rank == 11
    assert loop_rank(0, 0, 0) == 9
    assert found.complete
    (only,) = found.components
    assert set(only.equations) == {"x", "y", "z"}
    assert only.rank == 9
