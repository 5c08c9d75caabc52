"""Poses that divide: the divisor is zero nowhere, and no sentence speaks of it."""

from __future__ import annotations

from pathlib import Path

import pytest

import screwkit as sk

LEGS = [
    joint
    for k in "123"
    for joint in (
        f"{{name: R{k}, type: revolute, parent: base, child: a{k}, point: A{k}}}",
        f"{{name: P{k}, type: prismatic, parent: a{k}, child: b{k}, axis: l{k}}}",
        f"{{name: Q{k}, type: revolute, parent: b{k}, child: platform, point: B{k}}}",
    )
]
"""Three struts between pivots A and B in the plane."""


def platform(folder: Path, translation: str, variables: str) -> Path:
    """A planar 3-RPR."""
    path = folder / "struts.yaml"
    lines = [
        "screwkit: 1",
        "name: struts",
        "space: planar",
        "geometry: posture",
        "base: base",
        "platform: platform",
        "links: [base, platform, a1, b1, a2, b2, a3, b3]",
        f"variables: {{{variables}}}",
        f"pose: {{translation: {translation}}}",
        "points:",
        "  A1: [0, 0, 0]",
        "  A2: [0, 3, 0]",
        "  A3: [3, 1, 0]",
        "  B1: {link: platform, at: [0, 0, 0]}",
        "  B2: {link: platform, at: [1, 3, 0]}",
        "  B3: {link: platform, at: [0, 2, 0]}",
        "vectors: {l1: B1 - A1, l2: B2 - A2, l3: B3 - A3}",
        "joints:",
        *(f"  - {leg}" for leg in LEGS),
        "actuated: [P1, P2, P3]",
    ]
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize("height", ["u", "1/u", "2/(u^2 + w^2)"])
def test_no_proviso_speaks_of_a_divisor(tmp_path: Path, height: str) -> None:
    names = [name for name in "xuw" if name in f"x{height}"]
    variables = ", ".join(f"{name}: 2" for name in names)
    path = platform(tmp_path, f"[x, {height}, 0]", variables)
    actuation = sk.singularities(sk.load(path)).actuation
    assert actuation is not None
    (component,) = actuation.components
    assert component.geometry == (
        "lines A1 B1, A2 B2 and A3 B3 meet in one point or are parallel"
    )


def test_struts_from_points_at_ten_degrees_are_never_singular(tmp_path: Path) -> None:
    """Squares of axes over Q(2 cos π/18) divide all minors: none is a condition."""
    path = tmp_path / "strut.yaml"
    path.write_text(
        "screwkit: 1\nname: strut\nspace: spatial\ngeometry: posture\n"
        "base: base\nplatform: top\nlinks: [base, top, a, b]\n"
        "variables: {x: 1, y: 2, z: 4}\npose: {translation: [x, y, z]}\n"
        "points:\n  A: [5*cos(11*pi/18), 5*sin(11*pi/18), 0]\n"
        "  B: {link: top, at: [3*cos(4*pi/9), 3*sin(4*pi/9), 0]}\n"
        "vectors: {i: [1, 0, 0], l: B - A}\n"
        "joints:\n"
        "  - {name: U, type: universal, parent: base, child: a, point: A, "
        'axes: [i, "cross(l, i)"]}\n'
        "  - {name: P, type: prismatic, parent: a, child: b, axis: l}\n"
        "  - {name: S, type: spherical, parent: b, child: top, point: B}\n"
    )
    (limb,) = sk.singularities(sk.load(path)).limb
    assert limb.complete
    assert limb.components == ()
