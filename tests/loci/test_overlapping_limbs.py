"""Limbs that carry the same couples: where the forces they gain become dependent.

The limbs of the 3-CRR robot carry two couples each, three of the six independent.  A
limb whose three parallel axes lie in one plane gains the force along that plane, across
its axes.  All couples being there already, the forces' directions alone count: two are
dependent where they are parallel, three where they are coplanar.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from loci.numeric import Array, value

import screwkit as sk

A, B, LENGTH = 4.0, 1.0, 1.3


def line(axis: Array, point: Array) -> Array:
    return np.concatenate([axis, np.cross(point, axis)])


def loop_rank(posture: dict[str, float]) -> int:
    """Of the two loops of the 3-CRR robot, from its drawing, by singular values."""
    place = np.array([posture[name] for name in "xyz"])
    limbs = []
    for k in range(3):
        axis, out, up = (np.eye(3)[(k + i) % 3] for i in range(3))
        start = A * out + place[k] * axis
        angle = posture[f"theta{k + 1}"]
        middle = start + LENGTH * (np.cos(angle) * out + np.sin(angle) * up)
        end = place + B * out
        slide = np.concatenate([np.zeros(3), axis])
        limbs.append([slide, *(line(axis, p) for p in (start, middle, end))])
    zero = [np.zeros(6)] * 4
    rows = [[*limbs[0], *limbs[1], *zero], [*limbs[0], *zero, *limbs[2]]]
    singular = np.linalg.svd(np.vstack([np.array(r).T for r in rows]), compute_uv=False)
    kept = int(np.sum(singular > 1e-6))
    assert singular[kept:].max(initial=0) < 1e-9
    return kept


def in_planes(angles: Array) -> dict[str, float]:
    """The posture at which each limb's axes lie in one plane, at these angles.

    (a − b − y) sin θ1 + z cos θ1 = 0, and so on around.
    """
    s, c = np.sin(angles), np.cos(angles)
    rows = np.array([[0, -s[0], c[0]], [c[1], 0, -s[1]], [-s[2], c[2], 0]])
    place = np.linalg.solve(rows, -(A - B) * s)
    return named(place, angles)


def named(place: Array, angles: Array) -> dict[str, float]:
    names = ["x", "y", "z", "theta1", "theta2", "theta3"]
    known = {"a": A, "b": B, "l": LENGTH}
    return known | {n: float(v) for n, v in zip(names, [*place, *angles], strict=True)}


@cache
def listed() -> tuple[tuple[str, ...], ...]:
    found = sk.singularities(sk.load("3crr")).constraint
    assert found.complete
    return tuple(component.equations for component in found.components)


def on_a_component(posture: dict[str, float]) -> bool:
    return any(
        all(abs(value(text, posture)) < 1e-7 for text in equations)
        for equations in listed()
    )


@pytest.mark.parametrize("seed", range(4))
def test_coplanar_forces_of_three_limbs_are_listed(seed: int) -> None:
    angles = np.random.default_rng(seed).uniform(0.2, 1.4, 3)
    assert loop_rank(in_planes(angles)) == 9
    assert not on_a_component(in_planes(angles))
    # Directions (0, cos θ1, sin θ1), (sin θ2, 0, cos θ2), (cos θ3, sin θ3, 0).
    one, two, _ = angles
    angles[2] = np.arctan2(-np.cos(one) * np.cos(two), np.sin(one) * np.sin(two))
    assert loop_rank(in_planes(angles)) == 8
    assert on_a_component(in_planes(angles))


@pytest.mark.parametrize("first", range(3))
@pytest.mark.parametrize("seed", range(2))
def test_parallel_forces_of_two_limbs_are_listed(first: int, seed: int) -> None:
    source = np.random.default_rng(seed)
    place, angles = source.uniform(0.3, 2, 3), source.uniform(0.2, 1.4, 3)
    second = (first + 1) % 3
    # Both along the axis of the third limb.
    angles[first], place[second] = np.pi / 2, A - B
    angles[second], place[first] = 0.0, 0.0
    posture = named(place, angles)
    assert loop_rank(posture) == 8
    assert on_a_component(posture)
    angles[second] = 0.4  # then this limb's plane is left, and its force is gone
    assert loop_rank(named(place, angles)) == 9
    assert not on_a_component(named(place, angles))
