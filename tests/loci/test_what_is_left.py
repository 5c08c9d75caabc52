"""What a search leaves open, told by linear algebra: legs about radial axes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.optimize import minimize

import screwkit as sk
from screwkit.analyses.singularities import constraint_singularities

DIRECTIONS = ((1, 0, 0), (0, 1, 0), (-1, 0, 0))


def legs(folder: Path, height: str = "h", second: str = "beta") -> Path:
    """Three R-P-S legs whose first axes point to the middle, a leaning platform."""
    lines = ["screwkit: 1", "name: legs", "space: spatial", "geometry: posture"]
    lines += ["base: base", "platform: platform", "parameters:"]
    lines += [f"  {name}: {{value: {v}, positive: true}}" for name, v in SIZES.items()]
    lines += ["variables:", "  alpha: {value: 0.2, angle: true}"]
    lines += ["  beta: {value: 0.3, angle: true}", "  z: 3"]
    lines += [f"pose: {{translation: [0, 0, {height}]"]
    lines[-1] += f", rotation: {{euler: xyz, angles: [alpha, {second}, 0]}}}}"
    points, joints = ["points:"], ["joints:"]
    for n, (x, y, z) in enumerate(DIRECTIONS, 1):
        points += [f"  A{n}: [{x}*a, {y}*a, {z}]"]
        points += [f"  B{n}: {{link: platform, at: [{x}*b, {y}*b, {z}]}}"]
        kinds = ("revolute", f"axis: [{x}, {y}, {z}], point: A{n}")
        parts = (
            ("R", "base", f"u{n}", *kinds),
            ("P", f"u{n}", f"l{n}", "prismatic", f"axis: B{n} - A{n}, point: A{n}"),
            ("S", f"l{n}", "platform", "spherical", f"point: B{n}"),
        )
        joints += [
            f"  - {{name: {k}{n}, type: {kind}, parent: {a}, child: {b}, {where}}}"
            for k, a, b, kind, where in parts
        ]
    links = "links: [base, platform, u1, l1, u2, l2, u3, l3]"
    path = folder / "legs.yaml"
    path.write_text("\n".join([*lines, links, *points, *joints]) + "\n")
    return path


SIZES = {"a": 3, "b": 1, "h": 3}


def smallest(angles: np.ndarray) -> float:
    """Of the singular values of the forces that the legs withstand, through B1, B2, B3.

    Each is normal to its strut d and coplanar with its axis t: t (d·d) − d (d·t).
    """
    (sa, sb), (ca, cb) = np.sin(angles), np.cos(angles)
    turn = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    turn = turn @ np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    forces = []
    for own in np.array(DIRECTIONS, float):
        at = turn @ own * SIZES["b"] + np.array([0, 0, SIZES["h"]])
        strut = at - own * SIZES["a"]
        force = own * (strut @ strut) - strut * (strut @ own)
        force = force / np.linalg.norm(force)
        forces.append([*force, *np.cross(at, force)])
    return float(np.linalg.svd(np.array(forces), compute_uv=False)[-1])


def test_forces_of_legs_about_radial_axes_are_never_dependent(tmp_path: Path) -> None:
    """Two branches had been left open, of which all is known; no forces depend."""
    assembly = sk.load(legs(tmp_path)).assembly
    found = constraint_singularities(assembly)
    assert found.complete
    source = np.random.default_rng(5)
    least = min(
        minimize(lambda x: smallest(x) ** 2, start, method="Nelder-Mead").fun
        for start in source.uniform(-np.pi, np.pi, (8, 2))
    )
    assert not found.components
    assert least > 1e-4


def test_what_two_idle_limbs_share_is_searched_where_both_idle(tmp_path: Path) -> None:
    """Where z = 0 the first and the third strut lie along their axes.

    The forces of these legs at B1 and B3 are all those normal to the line B1 B3.  The
    second one, normal to its strut B2 − A2 too, meets that line where the strut is
    normal to O B2: b² = a·b·cos α.
    """
    assembly = sk.load(legs(tmp_path, "z", "0")).assembly
    found = constraint_singularities(assembly).components
    assert any({"z", "a*cos(alpha) - b"} == set(own.equations) for own in found)
