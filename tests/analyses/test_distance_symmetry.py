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


def test_equal_legs_of_a_stewart_platform_are_equally_far() -> None:
    """The twist system of a leg S P with a soft finger falls at length 0 alone.

    Legs 1, 3, 5 and legs 2, 4, 6 are turned by 120 degrees. With the actuators locked
    the platform turns freely where it is turned by 90 degrees about the vertical from
    one with upright legs, [Hunt1978]: 30 degrees from here.
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
    assert found["actuation"] == pytest.approx(pi / 6, abs=1e-7)
    assert all(one.met >= 3 for one in answer.singularities if one.nearest)
