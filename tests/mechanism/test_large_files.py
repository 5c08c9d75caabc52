"""Files of thousands of joints: read in linear time, right or wrong.

A planar scissor chain written spatially has three joints and two loops a cell.  Bounds
are several times what a slow machine needs, and far below what quadratic work takes.
"""

from __future__ import annotations

import json
import time
from functools import cache
from typing import Any

import pytest

from screwkit.errors import MechanismFileError
from screwkit.mechanism.files import mechanism_from_text
from screwkit.mechanism.graph import (
    components,
    fundamental_loops,
    independent_loops,
    limbs,
    other_parts,
    spanning_tree,
)
from screwkit.mechanism.model import Mechanism

CELLS = 2_000


def hinge(name: str, parent: str, child: str, x: str, y: str) -> dict[str, Any]:
    ends = {"name": name, "type": "revolute", "parent": parent, "child": child}
    return {**ends, "axis": ["0", "0", "1"], "point": [x, y, "0"]}


@cache
def scissors(cells: int) -> str:
    """The chain as JSON; its bars cross at the middle of each cell."""
    joints = [hinge("g", "base", "a0", "-1/2", "-1/2")]
    for k in range(cells):
        joints.append(hinge(f"c{k}", f"a{k}", f"b{k}", str(k), "0"))
        if k + 1 < cells:
            x = f"{2 * k + 1}/2"
            joints.append(hinge(f"u{k}", f"a{k}", f"b{k + 1}", x, "1/2"))
            joints.append(hinge(f"d{k}", f"b{k}", f"a{k + 1}", x, "-1/2"))
    bars = [f"{side}{k}" for k in range(cells) for side in "ab"]
    head = {"screwkit": 1, "name": "scissors", "geometry": "posture", "base": "base"}
    rest = {"platform": bars[-1], "links": ["base", *bars], "joints": joints}
    return json.dumps({**head, **rest}, indent=1)


def timed(text: str, limit: float, json: bool = False) -> Mechanism:
    start = time.perf_counter()
    mechanism = mechanism_from_text(text, "scissors", json=json)
    assert time.perf_counter() - start < limit
    return mechanism


def test_a_chain_of_six_thousand_joints() -> None:
    text = scissors(CELLS)
    found = timed(text, 8, json=True)
    # Flow style with every text in quotes is YAML as well.
    assert timed(text, 12) == found
    assert len(found.joints) == 3 * CELLS - 1
    assert found.joint(f"c{CELLS - 1}").child == f"b{CELLS - 1}"
    start = time.perf_counter()
    assert independent_loops(found) == CELLS - 1
    assert len(components(found)) == 1
    assert len(spanning_tree(found)) == 2 * CELLS
    (limb,) = limbs(found)
    assert len(limb.joints) == len(found.joints)
    assert other_parts(found) == ()
    assert time.perf_counter() - start < 2


def test_its_loops_close() -> None:
    found = timed(scissors(200), 2, json=True)
    loops = fundamental_loops(found)
    assert len(loops) == 199
    for loop in loops:
        bodies = []
        for name, sign in loop:
            joint = found.joint(name)
            bodies.append((joint.parent, joint.child)[::sign])
        assert all(
            here == there
            for (_, here), (there, _) in zip(
                bodies, [*bodies[1:], bodies[0]], strict=True
            )
        )


@pytest.mark.parametrize(
    ("old", "new", "faults"),
    [
        ('"axis"', '"axsi"', 2 * (3 * 1_000 - 1)),
        ('"child": "b', '"child": "bar', 2 * 1_000 - 1),
        ('"revolute"', '"revolt"', 3 * 1_000 - 1),
        ('"type": "revolute",', "", 3 * 1_000 - 1),
    ],
)
def test_thousands_of_faults(old: str, new: str, faults: int) -> None:
    text = scissors(1_000).replace(old, new)
    start = time.perf_counter()
    with pytest.raises(MechanismFileError) as caught:
        mechanism_from_text(text, "scissors", json=True)
    assert time.perf_counter() - start < 8
    assert len(caught.value.faults) == faults


def test_a_long_chain_of_points_and_values_written_backwards() -> None:
    count = 3_000
    values = {f"a{k}": f"a{k + 1} + 1" for k in range(count)} | {f"a{count}": "0"}
    points: dict[str, Any] = {f"P{k}": f"P{k + 1}" for k in range(count)}
    points[f"P{count}"] = ["1", "0", "0"]
    file = {
        **{"screwkit": 1, "name": "n", "geometry": "posture", "base": "b"},
        **{"platform": "b", "links": ["b"], "joints": []},
        **{"parameters": values, "points": points},
    }
    found = timed(json.dumps(file), 6, json=True)
    assert found.points["P0"] == found.points[f"P{count}"]
    assert [*found.points][:2] == ["P0", "P1"]
