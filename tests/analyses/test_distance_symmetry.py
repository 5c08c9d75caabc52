"""Distances of equal limbs are equal, and those of a second route."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

import screwkit as sk


def to_the_base(corner: float, foot: float, length: float) -> float:
    """How far the platform must go for a leg of length 0.

    The rotation φ alone decides: the shift is what then remains between the corner at
    radius 3/2, height 2 and the foot at radius 2.
    """
    own = 1.5 * np.array([cos(corner), sin(corner), 0])
    aim = 2 * np.array([cos(foot), sin(foot), -1])

    def square(turn: np.ndarray) -> float:
        left = aim - Rotation.from_rotvec(turn).apply(own)
        return float(turn @ turn + left @ left / length**2)

    starts = np.random.default_rng(7).normal(size=(10, 3))
    found = [minimize(square, start, options={"gtol": 1e-9}).fun for start in starts]
    return float(min(found) ** 0.5)


def determinants(turns: np.ndarray, shifts: np.ndarray) -> np.ndarray:
    """Of the lines of the six legs, the platform turned about its centre and shifted.

    Args:
        turns: Rotation vectors, shape (batch, 3).
        shifts: Shape (batch, 3).
    """
    third = 2 * pi / 3
    rows = []
    for leg in range(6):
        corner = third * (leg // 2)
        foot = corner + (third if leg % 2 else 0)
        start = 2 * np.array([cos(foot), sin(foot), 0])
        own = 1.5 * np.array([cos(corner), sin(corner), 0])
        end = np.array([0, 0, 2]) + shifts + Rotation.from_rotvec(turns).apply(own)
        rows.append(np.concatenate([end - start, np.cross(start, end)], axis=1))
    return np.asarray(np.linalg.det(np.stack(rows, axis=1)))


def test_equal_legs_of_a_stewart_platform_are_equally_far() -> None:
    """The twist system of a leg S P with a soft finger falls at length 0 alone.

    Legs 1, 3, 5 and legs 2, 4, 6 are turned by 120 degrees. With the actuators locked
    the platform moves where the six legs are dependent as lines.
    """
    answer = sk.distance(sk.load("stewart_alpha_beta"))
    measure = answer.by_freedoms
    assert measure is not None
    assert measure.length is not None
    assert measure.platform
    found = {
        one.limb or one.kind: one.nearest.distance
        for one in answer.singularities
        if one.nearest is not None
    }
    for leg in range(1, 7):
        third = 2 * pi / 3
        corner = third * ((leg - 1) // 2)
        foot = corner + (0 if leg % 2 else third)
        expected = to_the_base(corner, foot, measure.length)
        assert found[f"limb_{leg}"] == pytest.approx(expected, abs=1e-7)
    far = found["actuation"]
    assert far == pytest.approx(pi / 6, abs=1e-7)
    upright = np.array([[0, 0, 1.0], [0, 0, -1.0]]) * pi / 6
    ends = determinants(upright, np.zeros((2, 3)))
    random = np.random.default_rng(8)
    ways = random.normal(size=(20000, 6))
    ways *= (0.99 * far * random.uniform(size=20000) / np.linalg.norm(ways, axis=1))[
        :, None
    ]
    within = determinants(ways[:, :3], measure.length * ways[:, 3:])
    assert np.abs(ends).min() < 1e-12 * np.abs(within).max()
    assert (np.sign(within) == np.sign(within[0])).all()
    assert all(one.met >= 3 for one in answer.singularities if one.nearest)
