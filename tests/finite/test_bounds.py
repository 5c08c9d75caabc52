"""What no branch of a finite motion exceeds, where proofs leave the rest open."""

from __future__ import annotations

import pytest
from finite.linkages import ball, network

from screwkit.analyses.mobility import mobility
from screwkit.finite.finite_proofs import upper_bound


@pytest.mark.parametrize(("feet", "bound"), [(4, 2), (5, 2)])
def test_equal_legs_on_a_circle_are_bounded_by_the_fourth_order(
    feet: int, bound: int
) -> None:
    """Vertical rods of one length, their feet on a circle: Wren's platform.

    A shift (x, y) with a turn t tilts the rod at p by d = (x, y) + t·ẑ × p, and its top
    sinks by |d|²/2 to second order, an affine function of p on a circle: all is well.
    The plate tilts by t·(x, y), which at fourth order puts t²(x² − y²) and t²xy out of
    balance, so that not every rate goes on.
    """
    places = [(1, 0), (0, 1), (-1, 0), (0, -1), ("3/5", "4/5")][:feet]
    joints = [
        joint
        for k, (x, y) in enumerate(places)
        for joint in (
            ball(f"S{k}", "base", f"rod{k}", (x, y, 0)),
            ball(f"T{k}", f"rod{k}", "plate", (x, y, 3)),
        )
    ]
    plate = network(*joints, platform="plate")
    assert plate.motion.mobility == feet + 3
    found = upper_bound(plate, plate.motion)
    assert found is not None
    assert found.mobility == feet + bound
    assert "through order 4" in found.reason
    cycle = mobility(plate).full_cycle
    assert cycle.status == "undecided"
    assert f"proved is that it is {feet + bound} at most" in cycle.reason
