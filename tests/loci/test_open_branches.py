"""Branches that would be left open are gone on with: a Delta's arms outstretched.

Its parallelograms of four revolute joints carry all couples at every posture, so that
constraints are lost where the forces along the rods of outstretched arms become
dependent: two rods parallel, three parallel to one plane.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from loci.numeric import Array, Posture, value
from scipy.optimize import brentq

import screwkit as sk
from screwkit.algebra.branches import Branch
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search, imposed
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.told_parts import told_parts
from screwkit.loci.dependence import Dependence, dependent_zeros

WIDE, LENGTH = 0.4, 1.6
SIZES = {"a": 1.0 + WIDE, "b": 1.0, "c": 0.7, "l": LENGTH}
UP = np.array([0.0, 0.0, 1.0])
# r·sin θ = z·cos θ for r = a − b less the platform's place along the arm.
OUTSTRETCHED = (
    "(a - b - x)*sin(theta1) - z*cos(theta1)",
    "(2*a - 2*b + x - sqrt(3)*y)*sin(theta2) - 2*z*cos(theta2)",
    "(2*a - 2*b + x + sqrt(3)*y)*sin(theta3) - 2*z*cos(theta3)",
)


@cache
def delta() -> Assembly:
    return sk.load("delta_4r").assembly


@cache
def zeros(arms: tuple[int, ...]) -> Dependence:
    """Where forces become dependent while these arms are outstretched."""
    assembly = delta()
    ring = assembly.common_twists.ring
    limbs = [told_parts(assembly, limb) for limb in assembly.limbs]
    search = Search(assembly.library(ring), budget=150, further=True)
    branches: list[Branch] = [assembly.root(ring)]
    for number in arms:
        own = ring.normal(evaluate(parse(OUTSTRETCHED[number]), ring))
        branches = [b for a in branches for b in imposed(a, own, search)]
    (branch,) = branches
    return dependent_zeros(branch, limbs, search, within=True, in_blocks=True)


def rods(posture: Posture) -> Array:
    """Rows: the three rods, written down from the geometry."""
    rows = []
    for number in range(3):
        turn = 2 * math.pi * number / 3
        out = np.array([math.cos(turn), math.sin(turn), 0.0])
        angle = posture[f"theta{number + 1}"]
        end = posture["a"] * out
        end = end + posture["l"] * (math.cos(angle) * out - math.sin(angle) * UP)
        place = np.array([posture[name] for name in "xyz"]) + posture["b"] * out
        rows.append(place - end)
    return np.array(rows)


def outstretched(first: float, second: float, third: float) -> Posture:
    """All arms, in these directions: z = r·tan θ, and the r have the sum 3·w."""
    angles = (first, second, third)
    z = 3 * WIDE / sum(1 / math.tan(angle) for angle in angles)
    out = [WIDE - z / math.tan(angle) for angle in angles]
    place = {"x": out[0], "y": (out[1] - out[2]) / math.sqrt(3), "z": z}
    named = {f"theta{k + 1}": angle for k, angle in enumerate(angles)}
    return {**SIZES, **place, **named}


def farthest(found: Dependence, posture: Posture) -> float:
    """How far a posture is from the nearest find."""
    ring = delta().common_twists.ring
    return min(
        max(abs(value(text(ring, e), posture)) for e in branch.conditions)
        for branch in found.branches
    )


def in_a_plane(first: float, second: float) -> Posture:
    """All arms outstretched and their rods parallel to one plane."""

    def volume(third: float) -> float:
        posture = outstretched(first, second, third)
        return float(np.linalg.det(rods(posture))) / posture["z"] ** 3  # has no pole

    angles = np.linspace(0.1, 3.0, 60)
    signs = [volume(angle) for angle in angles]
    place = next(k for k in range(59) if signs[k] * signs[k + 1] < 0)
    third = brentq(volume, angles[place], angles[place + 1], xtol=1e-15)
    return outstretched(first, second, float(third))


@pytest.mark.parametrize("arms", [(1, 2), (0, 1, 2)])
def test_nothing_is_left_open(arms: tuple[int, ...]) -> None:
    assert not zeros(arms).open


def test_parallel_rods_of_two_arms_are_found() -> None:
    """Equal arms with l·cos θ = −w, crossed ones with l·cos θ = 3·w."""
    equal, crossed = math.acos(-WIDE / LENGTH), math.acos(3 * WIDE / LENGTH)
    tangent, z, y = math.tan(equal), 0.4, 0.5
    for place in (
        {"theta2": equal, "theta3": equal, "x": 2 * z / tangent - 2 * WIDE, "y": 0.0},
        {"theta2": crossed, "theta3": -crossed, "x": -2 * WIDE, "y": y},
    ):
        posture = {**SIZES, "theta1": 0.3, "z": z, **place}
        if place["y"]:
            posture["z"] = -math.sqrt(3) / 2 * y * math.tan(crossed)
        _, second, third = rods(posture)
        assert np.linalg.norm(np.cross(second, third)) < 1e-12
        assert farthest(zeros((1, 2)), posture) < 1e-12


def test_rods_parallel_to_a_plane_are_found_others_not() -> None:
    for first, second in ((0.7, 1.1), (2.2, 0.5), (1.9, 1.4)):
        assert farthest(zeros((0, 1, 2)), in_a_plane(first, second)) < 1e-9
        regular = outstretched(first, second, 0.9)
        assert abs(np.linalg.det(rods(regular))) > 1e-3
        assert farthest(zeros((0, 1, 2)), regular) > 1e-3
