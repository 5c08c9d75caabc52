"""Where only a limb idles is decided at real postures, not at complex ones."""

from __future__ import annotations

import json

import numpy as np
import pytest

from screwkit.case import load_text
from screwkit.questions import schemes

DIRECTIONS = ((1, 0), (0, 1), (-1, 0), (0, -1))


def four_cpr() -> str:
    """Four limbs C P R with both axes tangential; the slide is along the limb."""
    links, joints = ["base", "top"], []
    points, vectors = {}, {}
    for n, (c, s) in enumerate(DIRECTIONS, 1):
        vectors[f"t{n}"] = [str(-s), str(c), "0"]
        points[f"A{n}"] = [f"a*({c})", f"a*({s})", "0"]
        points[f"B{n}"] = [f"x + b*({c})", f"y + b*({s})", "z"]
        links += [f"p{n}", f"q{n}"]
        axis = {"axis": f"t{n}"}
        joints += [
            {"name": f"C{n}", "type": "cylindrical", "parent": "base"}
            | {"child": f"p{n}", "point": f"A{n}", **axis},
            {"name": f"P{n}", "type": "prismatic", "parent": f"p{n}"}
            | {"child": f"q{n}", "axis": f"B{n} - A{n}"},
            {"name": f"R{n}", "type": "revolute", "parent": f"q{n}"}
            | {"child": "top", "point": f"B{n}", **axis},
        ]
    length = {"positive": True}
    return json.dumps(
        {
            "screwkit": 1,
            "name": "four_cpr",
            "title": "4-CPR",
            "geometry": "posture",
            "base": "base",
            "platform": "top",
            "links": links,
            "parameters": {
                "a": {"value": "2", **length},
                "b": {"value": "1", **length},
            },
            "variables": {"x": "0.3", "y": "0.2", "z": "3"},
            "points": points,
            "vectors": vectors,
            "joints": joints,
        }
    )


def freedom(locked: tuple[str, ...], x: float, y: float, z: float) -> int:
    """What the platform keeps where a = 2.3 and b = 1.1, by singular values."""
    a, b = 2.3, 1.1
    limbs = []
    for n, (c, s) in enumerate(DIRECTIONS, 1):
        t = np.array([-s, c, 0.0])
        near = np.array([a * c, a * s, 0.0])
        far = np.array([x + b * c, y + b * s, z])
        none = np.zeros(3)
        twists = {
            f"C{n}:0": np.r_[t, np.cross(near, t)],
            f"C{n}:1": np.r_[none, t],
            f"P{n}": np.r_[none, far - near],
            f"R{n}": np.r_[t, np.cross(far, t)],
        }
        limbs.append(np.array([v for k, v in twists.items() if k not in locked]).T)
    sizes = np.cumsum([0, *(limb.shape[1] for limb in limbs)])
    loops = np.zeros((18, sizes[-1]))
    for k, limb in enumerate(limbs):
        for loop in range(3):
            if k in (0, loop + 1):
                rows = slice(6 * loop, 6 * loop + 6)
                loops[rows, sizes[k] : sizes[k + 1]] = limb if k else -limb
    platform = np.zeros((6, sizes[-1]))
    platform[:, : sizes[1]] = limbs[0]

    def rank(matrix: np.ndarray) -> int:
        values = np.linalg.svd(matrix, compute_uv=False)
        assert not any(1e-12 < v / values[0] < 1e-4 for v in values)
        return int((values > 1e-8 * values[0]).sum())

    return rank(np.vstack([loops, platform])) - rank(loops)


@pytest.mark.parametrize(
    ("locked", "place"),
    [
        (("C1:0", "P2", "R3"), {"x": 0.37, "y": -1.2, "z": 0.0}),
        (("C1:0", "P2", "P4"), {"x": -1.2, "y": 0.37, "z": 0.0}),
    ],
)
def test_two_squares(locked: tuple[str, ...], place: dict[str, float]) -> None:
    """(a − b ± y)² + z² is 0 where a limb idles and z = 0, where more may move."""
    candidates = [*locked]
    found = schemes(load_text(four_cpr()), candidates=candidates, work=100_000)
    (scheme,) = found.schemes
    (squares,) = (e for e in scheme.locus if "z^2" in e)
    assert (squares in scheme.idle) is (freedom(locked, **place) == 0)
