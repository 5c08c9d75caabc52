"""Branches that touch to a high order are told apart where their ranks are clear."""

from __future__ import annotations

import numpy as np
import pytest
from finite.sample_linkages import Z, model, turn

from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.posture_model import PosedJoint, PostureModel


def watt(name: str, at: float) -> list[PosedJoint]:
    """Watt's linkage; the middle of its coupler is at (``at``, 1)."""
    left, middle, right = f"{name}l", f"{name}c", f"{name}r"
    return [
        turn(f"{name}A", "ground", left, Z, (at - 4, 0, 0)),
        turn(f"{name}B", left, middle, Z, (at, 0, 0)),
        turn(f"{name}C", middle, right, Z, (at, 2, 0)),
        turn(f"{name}D", right, "ground", Z, (at + 4, 2, 0)),
    ]


def rod_between_watts(turned: bool, shift: tuple[int, ...]) -> PostureModel:
    """A rod between the coupler points of two Watt linkages, in one of many frames.

    The middle of a coupler moves on x = c y⁵ + …, and on the same curve again in the
    second linkage.  With δ the difference of heights, the length of the rod asks
    for δ (δ/20 + 5 c y⁴ + …) = 0: the rod translates, δ = 0, or turns as
    δ ≈ −100 c y⁴.  Both are simple roots, so that the rank is full away from y = 0.
    """
    joints = [
        *watt("p", 0),
        *watt("q", 10),
        turn("M", "pc", "rod", Z, (0, 1, 0)),
        turn("N", "rod", "qc", Z, (10, 1, 0)),
    ]
    order = np.random.default_rng(shift[0]).permutation(len(joints))
    rotation = np.eye(3)
    if turned:
        rotation = np.linalg.qr(np.arange(9.0).reshape(3, 3) + np.diag([1, 5, 2]))[0]
        rotation *= np.linalg.det(rotation)
    moved = []
    for number in order:
        joint = joints[number]
        axis, moment = joint.screws[0, :3], joint.screws[0, 3:]
        point = rotation @ np.cross(axis, moment) + shift
        moved.append(
            turn(joint.name, joint.parent, joint.child, rotation @ axis, point)
        )
    return model("ground", "rod", *moved)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("shift", [(0, 0, 0), (3, -2, 1), (7, 5, -4)])
def test_a_rod_between_two_watt_linkages_translates_or_turns(
    turned: bool, shift: tuple[int, ...]
) -> None:
    found = finite_motion(rod_between_watts(turned, shift))
    assert found.mobility == (1,)
    kinds = {branch.finite_type for branch in found.branches}
    assert kinds == {"0T1R", "1T0R"}
    assert {branch.loop_rank for branch in found.branches} == {9}
