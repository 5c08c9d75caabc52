"""Bars pinned at their ends, written as mechanism files: every bar is a body."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import screwkit as sk
from screwkit.case import load_text

Bar = tuple[str, str]


def framework(
    points: Mapping[str, Sequence[object]],
    bars: Sequence[Bar],
    *,
    ends: tuple[int, int],
    joint: str = "revolute",
    symbols: Mapping[str, object],
) -> sk.Case:
    """A framework in the plane z = 0 (revolute) or in space (spherical).

    Args:
        points: Coordinates by name, numbers or symbols.
        bars: Each between two points; at a point, each is pinned to the next.
        ends: Which bars are base and platform.
        joint: Of all pins.
        symbols: With their values.
    """
    meeting: dict[str, list[str]] = {}
    for bar in bars:
        for end in bar:
            meeting.setdefault(end, []).append("".join(bar))
    axis = ", axis: [0, 0, 1]" if joint == "revolute" else ""
    lines = ["screwkit: 1", "name: framework", "space: spatial", "geometry: posture"]
    names = ["".join(bar) for bar in bars]
    lines += [f"base: {names[ends[0]]}", f"platform: {names[ends[1]]}"]
    lines += [f"links: [{', '.join(names)}]", "variables:"]
    lines += [f"  {name}: {number}" for name, number in symbols.items()]
    lines.append("points:")
    lines += [f"  {p}: [{', '.join(map(str, at))}]" for p, at in points.items()]
    lines.append("joints:")
    for point, there in meeting.items():
        for number, (parent, child) in enumerate(pairwise(there)):
            lines.append(
                f"  - {{name: {point}{number}, type: {joint}, parent: {parent}, "
                f"child: {child}, point: {point}{axis}}}"
            )
    return load_text("\n".join(lines) + "\n")
