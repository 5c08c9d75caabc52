"""Mechanism files of the recomputed cases of the two Bicchi papers.

The reference orders twists (v; ω) and wrenches (f; m), both of its object frame.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

REFERENCE = Path(__file__).parents[1] / "reference"
CONTACTS = {"hard": "hard_finger", "soft": "soft_finger", "complete": "complete"}
DIRECTION_FIRST = {3: (2, 0, 1), 6: (3, 4, 5, 0, 1, 2)}  # into the file's order


def published() -> dict[str, dict[str, Any]]:
    """All cases that have a geometry, by name."""
    text = (REFERENCE / "cooperating.json").read_text(encoding="utf-8")
    return {
        f"{paper}:{name}": case
        for paper, cases in json.loads(text)["cases"].items()
        for name, case in cases.items()
        if isinstance(case, dict) and "geometry" in case
    }


def mechanism_file(geometry: dict[str, Any]) -> str:
    """The text of a mechanism file with this geometry."""
    planar = geometry["dim"] == 2
    links, joints, before = ["ground", "object"], [], set[int]()
    for contact in geometry["contacts"]:
        parent = "ground"
        for number in contact["joints"]:
            if number not in before:
                before.add(number)
                links.append(f"l{number}")
                joints.append(_joint(geometry["joints"][number - 1], number, parent))
            parent = f"l{number}"
    for number, contact in enumerate(geometry["contacts"], start=1):
        moved = contact["joints"]
        normal = "" if planar else f", normal: {_vector(contact['normal'])}"
        joints.append(
            f"name: c{number}, type: {CONTACTS[contact['type']]}, "
            f"parent: {f'l{moved[-1]}' if moved else 'ground'}, child: object, "
            f"point: {_vector(contact['point'])}{normal}"
        )
    driven = ", ".join(f'"{number}"' for number in geometry["actuated"])
    lines = [
        "screwkit: 1",
        "name: cooperating",
        f"space: {'planar' if planar else 'spatial'}",
        "geometry: posture",
        "base: ground",
        "platform: object",
        f"links: [{', '.join(links)}]",
        f"reference_point: {_vector(geometry['object_frame'])}",
        f"actuated: [{driven}]",
    ]
    if "Wu" in geometry:
        order = DIRECTION_FIRST[len(geometry["Wu"])]
        twist = [[geometry["Wu"][i][j] for j in order] for i in order]
        lines.append(
            f"weights: {{twist: {_matrix(twist)}, wrench: {_matrix(geometry['Ww'])}}}"
        )
    return "\n".join([*lines, "joints:", *(f"  - {{{entry}}}" for entry in joints), ""])


def _joint(joint: dict[str, Any], number: int, parent: str) -> str:
    turning = joint["type"] == "R"
    entry = (
        f'name: "{number}", type: {"revolute" if turning else "prismatic"}, '
        f"parent: {parent}, child: l{number}"
    )
    if not turning or len(joint.get("axis", ())) == 3:
        entry += f", axis: {_vector(joint['axis'])}"
    return entry + (f", point: {_vector(joint['origin'])}" if turning else "")


def _vector(values: Sequence[float]) -> str:
    return f"[{', '.join(map(_number, values))}]"


def _matrix(rows: Sequence[Sequence[float]]) -> str:
    return f"[{', '.join(map(_vector, rows))}]"


def _number(value: float) -> str:
    """Exact; what is below the last digit of the others is a rounded zero."""
    if isinstance(value, int):
        return str(value)
    return format(value, ".17g") if abs(value) > 1e-12 else "0"
