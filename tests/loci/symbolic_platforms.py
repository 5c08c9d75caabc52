"""Six-strut platforms whose points are symbols, numbers or both, as mechanism files."""

from __future__ import annotations

from itertools import count
from pathlib import Path

from screwkit.mechanism.files import read_mechanism
from screwkit.mechanism.model import Mechanism

BASE = [(5, 1, 0), (3, 4, 0), (-3, 4, 0), (-5, 1, 0), (-1, -5, 0), (2, -5, 1)]
PLATFORM = [(2, -1, 0), (2, 2, 0), (-2, 2, 0), (-2, -1, 1), (0, -2, 0), (1, -2, 0)]


def numeric_points() -> list[list[list[str]]]:
    """Points in general position: none of both sets lies in one plane."""
    return [[[str(x) for x in p] for p in points] for points in (BASE, PLATFORM)]


def symbolic_points(*, gauge: bool) -> list[list[list[str]]]:
    """Three coordinates for each point; with a gauge 24 symbols instead of 36.

    The gauge: the first point of each body is its origin, the second lies on its first
    axis, the third in its first plane.
    """
    places = []
    for letter in "ab":
        points = [[f"{letter}{k}{c}" for c in "xyz"] for k in range(6)]
        if gauge:
            points[0] = ["0", "0", "0"]
            points[1][1:] = ["0", "0"]
            points[2][2] = "0"
        places.append(points)
    return places


def six_ups(
    folder: Path, points: list[list[list[str]]], *, quaternion: bool
) -> Mechanism:
    """Six struts with universal joints at the base and spherical ones above.

    Args:
        folder: Where the file is written.
        points: Of the base, and of the platform in its own frame.
        quaternion: The platform's rotation; else its matrix has nine free entries.
    """
    names = [x for body in points for p in body for x in p if x[0] in "ab"]
    values = count(3)
    pose = [*(f"e{i}" for i in range(4))]
    if not quaternion:
        pose = [f"r{i}{j}" for i in range(3) for j in range(3)]
    lines = [
        "screwkit: 1",
        "name: six_ups",
        "title: Platform on six struts",
        "source: made for a test",
        "units: m",
        "geometry: posture",
        "base: base",
        "platform: platform",
        f"links: [base, platform, {', '.join(f'u{k}, w{k}' for k in range(6))}]",
        "variables:",
        *(f"  {name}: {next(values)}" for name in ("x", "y", "z", *pose)),
    ]
    if names:
        lines += ["parameters:", *(f"  {n}: {{value: {next(values)}}}" for n in names)]
    if quaternion:
        lines += ["pose:", "  translation: [x, y, z]"]
        lines += [f"  rotation: {{quaternion: [{', '.join(pose)}]}}"]
    lines += ["vectors:", "  i: [1, 0, 0]"]
    lines += [f"  l{k}: B{k} - A{k}" for k in range(6)]
    lines += ["points:"]
    lines += [f"  A{k}: [{', '.join(p)}]" for k, p in enumerate(points[0])]
    for k, p in enumerate(points[1]):
        place = f"{{link: platform, at: [{', '.join(p)}]}}"
        if not quaternion:
            rows = [" + ".join(f"r{i}{j}*({p[j]})" for j in range(3)) for i in range(3)]
            shifted = [f'"{x} + {row}"' for x, row in zip("xyz", rows, strict=True)]
            place = f"[{', '.join(shifted)}]"
        lines.append(f"  B{k}: {place}")
    lines.append("joints:")
    for k in range(6):
        strut = [
            f"U{k}, type: universal, parent: base, child: u{k}, point: A{k}, "
            f'axes: [i, "cross(l{k}, i)"]',
            f"P{k}, type: prismatic, parent: u{k}, child: w{k}, point: A{k}, "
            f"axis: l{k}",
            f"S{k}, type: spherical, parent: w{k}, child: platform, point: B{k}",
        ]
        lines += [f"  - {{name: {joint}}}" for joint in strut]
    lines.append("actuated: [P0, P1, P2, P3, P4, P5]")
    path = folder / "six_ups.yaml"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return read_mechanism(path)
