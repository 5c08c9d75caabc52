"""Joints that run along a straight line though their body turns."""

from __future__ import annotations

import numpy as np
from finite.linkages import hinge, network, slider
from scipy.spatial.transform import Rotation

import screwkit as sk
from screwkit.algebra.batch import Array
from screwkit.analyses.mobility import mobility
from screwkit.finite.motion_invariants import runs_straight
from screwkit.kinematics.network import Network


def straight(of: Network) -> list[tuple[str, ...]]:
    return [branch.straight for branch in mobility(of).full_cycle.branches]


def test_peaucellier_draws_a_straight_line() -> None:
    """The first linkage to do so, by inversion in a circle [Peaucellier 1864]."""
    found = sk.mobility(sk.load("peaucellier"))
    assert [branch.straight for branch in found.full_cycle.branches] == [("T",)]
    told = " ".join(str(found).split())
    assert "on a walk along it T of the platform keeps to a straight line" in told


def test_a_crank_to_the_middle_of_a_rod_keeps_both_its_ends_straight() -> None:
    """Scott Russell: crank and half rod are equally long, one end is on a rail.

    The other end runs through the crank's pivot at right angles to the rail, so that a
    second rail there changes nothing.
    """
    crank = [
        hinge("O", "base", "crank", (0, 0, 0)),
        hinge("M", "crank", "rod", (3, 4, 0)),
        hinge("B", "rod", "block", (6, 0, 0)),
        slider("rail", "block", "base", (1, 0, 0)),
    ]
    assert straight(network(*crank, platform="rod")) == [("B",)]
    second = [
        hinge("E", "rod", "tip", (0, 8, 0)),
        slider("upright", "tip", "base", (0, 1, 0)),
    ]
    both = network(*crank, *second, platform="rod")
    assert both.motion.mobility == 1
    assert straight(both) == [("B", "E")]


def moved(angles: Array, shifts: Array) -> Array:
    found = np.tile(np.eye(4), (len(angles), 1, 1))
    found[:, :3, :3] = Rotation.from_rotvec(np.outer(angles, [0, 0, 1])).as_matrix()
    found[:, :3, 3] = shifts
    return found


def test_a_cardan_circle_draws_diameters() -> None:
    """A circle that rolls inside one twice as large: its points run on diameters."""
    angles = np.linspace(-1.0, 1.0, 40)
    centre = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    # The body turns backwards about its centre, at (1, 0, 0) in the beginning.
    turned = moved(-angles, np.zeros((40, 3)))
    shifts = centre - turned[:, :3, :3] @ np.array([1.0, 0, 0])
    rolled = moved(-angles, shifts)
    on_rim = np.array([[1.0 + np.cos(0.7), np.sin(0.7), 0.0]])
    assert runs_straight(rolled, on_rim, 1e-9)
    assert not runs_straight(rolled, 0.9 * on_rim, 1e-9)
    assert not runs_straight(moved(angles, np.zeros((40, 3))), np.zeros((1, 3)), 1e-9)
