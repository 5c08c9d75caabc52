"""Every singular posture of a Delta's rods, against six rods written down anew.

The platform's twist t and the arms' rates ω_i close the loops where, for both rods k
of each arm i, L_k · t = (L_k · R_i) ω_i, L_k being the force along the rod.  These are
six equations in nine unknowns, dependent exactly where a constraint is lost.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from loci.numeric import Array, Posture, closed_at
from loci.searching import singular_postures

import screwkit as sk
from screwkit.analyses.singularities import constraint_singularities
from screwkit.results.singularities import ConstraintSingularities

LENGTHS = {"a": 1.3, "b": 0.9, "c": 0.7, "l": 1.5}
UP = np.array([0.0, 0.0, 1.0])


@cache
def answer() -> ConstraintSingularities:
    return constraint_singularities(sk.load("delta_ss").assembly)


def arm(posture: Posture, number: int) -> tuple[Array, Array, Array, Array]:
    """Motor, end of the arm, platform's point, and the axis of the motor."""
    turn = 2 * math.pi * number / 3
    out = np.array([math.cos(turn), math.sin(turn), 0.0])
    angle = posture[f"theta{number + 1}"]
    motor = posture["a"] * out
    end = motor + posture["l"] * (math.cos(angle) * out - math.sin(angle) * UP)
    place = np.array([posture[name] for name in "xyz"]) + posture["b"] * out
    return motor, end, place, np.cross(UP, out)


def equations(posture: Posture) -> Array:
    """6×9: of each rod the force along it on (ω, v), and on the arm's rate."""
    rows = []
    for number in range(3):
        motor, end, place, axis = arm(posture, number)
        for side in (1, -1):
            at = end + side * posture["c"] * axis
            force = place - end
            own = np.zeros(3)
            own[number] = -force @ np.cross(axis, at - motor)
            rows.append([*np.cross(at, force), *force, *own])
    return np.array(rows)


def least(posture: Posture) -> float:
    sizes = np.linalg.svd(equations(posture), compute_uv=False)
    return float(sizes[-1] / sizes[0])


def distances(posture: Posture) -> Array:
    return closed_at([c.equations for c in answer().components], posture)


def test_the_list_is_complete() -> None:
    found = answer()
    assert found.complete
    sizes = sorted(component.codimension for component in found.components)
    # Couples in a plane; of each pair of arms the rods equal, or crossed and parallel;
    # all arms outstretched with their rods in a plane.
    assert sizes == [1, *[4] * (2 * 3 + 1)]


def test_singular_postures_lie_on_the_components() -> None:
    large = [c.equations for c in answer().components if c.codimension == 1]
    found = singular_postures(
        equations, ["x", "y", "z", "theta1", "theta2", "theta3"], LENGTHS, large, 24
    )
    postures = list(found)
    assert len(postures) >= 4
    assert all(np.min(distances(posture)) < 1e-5 for posture in postures)


def test_parallel_rods_of_two_outstretched_arms_are_on_components() -> None:
    """Written down from the geometry, for the arms on both sides of the first.

    Equal arms: l cos θ = b − a makes rods equal, y = 0.  Crossed arms: θ₃ = −θ₂,
    l cos θ₂ = 3(a − b), x = −2(a − b), z = −(√3/2) y tan θ₂.
    """
    wide = LENGTHS["a"] - LENGTHS["b"]
    equal = math.acos(-wide / LENGTHS["l"])
    crossed = math.acos(3 * wide / LENGTHS["l"])
    z = 0.4
    postures = [
        {
            "theta2": equal,
            "theta3": equal,
            "x": 2 * z / math.tan(equal) + 2 * LENGTHS["l"] * math.cos(equal),
            "y": 0.0,
            "z": z,
        },
        {
            "theta2": crossed,
            "theta3": -crossed,
            "x": -2 * wide,
            "y": 0.5,
            "z": -math.sqrt(3) / 2 * 0.5 * math.tan(crossed),
        },
    ]
    for posture in postures:
        whole = {**LENGTHS, "theta1": 0.3, **posture}
        assert least(whole) < 1e-12
        assert np.min(distances(whole)) < 1e-12


def test_regular_postures_lie_on_none() -> None:
    source = np.random.default_rng(4)
    for _ in range(6):
        names = ["x", "y", "z", "theta1", "theta2", "theta3"]
        posture = {**LENGTHS, **{n: float(source.uniform(-2, 2)) for n in names}}
        assert least(posture) > 1e-4
        assert np.min(distances(posture)) > 1e-4
