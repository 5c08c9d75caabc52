"""What no branch of a finite motion exceeds, where proofs leave the rest open."""

from __future__ import annotations

import numpy as np
from finite.linkages import ball, network
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from screwkit.algebra.batch import Array
from screwkit.analyses.mobility import mobility
from screwkit.finite.finite_proofs import proved_mobility, upper_bound
from screwkit.kinematics.network import Network


def legs_on_a_circle(feet: int) -> Network:
    places = [(1, 0), (0, 1), (-1, 0), (0, -1), ("3/5", "4/5")][:feet]
    joints = [
        joint
        for k, (x, y) in enumerate(places)
        for joint in (
            ball(f"S{k}", "base", f"rod{k}", (x, y, 0)),
            ball(f"T{k}", f"rod{k}", "plate", (x, y, 3)),
        )
    ]
    return network(*joints, platform="plate")


def test_equal_legs_on_a_circle_are_bounded_by_the_fourth_order() -> None:
    """Vertical rods of one length, their feet on a circle: Wren's platform.

    A shift (x, y) with a turn t tilts the rod at p by d = (x, y) + t·ẑ × p, and its top
    sinks by |d|²/2 to second order, an affine function of p on a circle: all is well.
    The plate tilts by t·(x, y), which at fourth order puts t²(x² − y²) and t²xy out of
    balance, so that not every rate goes on.
    """
    plate = legs_on_a_circle(5)
    assert plate.motion.mobility == 5 + 3
    found = upper_bound(plate, plate.motion)
    assert found is not None
    assert found.mobility == 5 + 2
    assert "through order 4" in found.reason
    cycle = mobility(plate).full_cycle
    assert cycle.status == "undecided"
    assert "proved is that it is 7 at most" in cycle.reason


def test_four_equal_legs_on_a_circle_leave_two_dimensions_to_every_branch() -> None:
    """One equation is left for (x, y, t): t² times x² − y², to fourth order.

    The plate translates in two dimensions (t = 0).  Turned by t it may shift along a
    diagonal too: there four legs have the rank 4, which leaves 6 − 4 dimensions.
    """
    turn, shift, length = 0.4, 0.3, 3.0
    feet = np.array([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)], dtype=float)

    def heads(pose: Array) -> Array:
        turned = Rotation.from_rotvec([pose[0], pose[1], turn]).apply(feet)
        return np.asarray(turned + np.array([shift, pose[2], length + pose[3]]))

    def missed(pose: Array) -> Array:
        return np.asarray(((heads(pose) - feet) ** 2).sum(axis=1) - length**2)

    found = least_squares(missed, [0, 0, shift, -0.1], xtol=1e-15, ftol=1e-15)
    assert np.abs(found.fun).max() < 1e-12
    top = heads(found.x)
    legs = np.hstack([top - feet, np.cross(top, top - feet)])
    assert np.linalg.svd(legs, compute_uv=False)[-1] > 1e-3

    plate = legs_on_a_circle(4)
    assert plate.motion.mobility == 4 + 3
    proof = proved_mobility(plate, plate.motion)
    assert proof is not None
    assert proof.mobility == (4 + 2,)
    assert "vanishes twice on a smooth family of dimension 2" in proof.reason
    assert not proof.whole
    answer = mobility(plate)
    assert "2T0R" in answer.platform.finite_motion_types
    assert "on other branches is open" in answer.full_cycle.reason
