"""Neither the frame of a file nor the order in it changes what is found."""

from __future__ import annotations

import numpy as np
import pytest
from finite.linkages import hinge, network
from finite.random_platforms import Placed, copied, random_platform, written

from screwkit.analyses.full_cycle import full_cycle
from screwkit.analyses.platform import finite_types, platform
from screwkit.finite.exponentials import at_stance, stance_of
from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.own_frame import in_own_frame
from screwkit.finite.posture_model import posture_model, scaled
from screwkit.finite.posture_numbers import numbers_at
from screwkit.finite.sampling import sampled_motion
from screwkit.finite.spanning_forest import forest_of


def answer(joints: tuple[Placed, ...]) -> tuple[object, ...]:
    """All that no frame may change."""
    network = written(joints)
    at, about = network.motion, platform(network.motion)
    cycle, _ = full_cycle(network, at, about.motion_type)
    names = "mobility loop_rank motion_type finite_type couples modes motion straight"
    looks = names.split()
    branches = {tuple(getattr(b, x) for x in looks) for b in cycle.branches}
    types = finite_types(about, cycle, at.mobility).finite_motion_types
    return cycle.status, cycle.mobility, branches, types


@pytest.mark.parametrize("seed", [78, 118, 124, 222, 235])
def test_copies_of_a_platform_have_the_same_finite_motion(seed: int) -> None:
    """UPU + HRR, three SPR + RRC, three RSR, two RRC, two PS + PUU.

    Random ones of special geometry on which copies had differed: in the type or the
    words of a sampled branch, in the order of joints, or in that one was proved.
    """
    joints = random_platform(seed)
    first = answer(joints)
    assert first[0] in ("proved", "sampled")
    for number in range(2):
        assert answer(copied(joints, 1000 * seed + number)) == first


@pytest.mark.parametrize("seed", [14, 37, 78, 118, 159])
def test_copies_are_sampled_at_the_same_postures(seed: int) -> None:
    """With balls, universal joints, sliders, helices and cylindrical joints."""
    joints = random_platform(seed)
    one, other = (
        in_own_frame(scaled(posture_model(written(own).mechanism))).model
        for own in (joints, copied(joints, seed))
    )
    assert [j.name for j in one.joints] == [j.name for j in other.joints]
    assert [j.parent for j in one.joints] == [j.parent for j in other.joints]
    assert np.abs(one.screws - other.screws).max() < 1e-9


@pytest.mark.parametrize("seed", [14, 78, 118])
def test_postures_come_back_to_the_frame_of_the_file(seed: int) -> None:
    """The posture itself screw by screw; places on a branch by their ranks."""
    joints = copied(random_platform(seed), seed)
    model = scaled(posture_model(written(joints).mechanism))
    own = in_own_frame(model)
    back = own.as_given(stance_of(own.model, forest_of(own.model)))
    assert np.abs(back.screws[0] - model.screws).max() < 1e-12
    found = finite_motion(model)
    for branch in found.branches:
        assert found.model is not None
        assert branch.places is not None
        there = numbers_at(at_stance(found.model, branch.places))
        assert there.loop_rank == branch.loop_rank
        assert there.motion_type == branch.motion_type


def test_the_order_of_parameters_does_not_choose_where_samples_are_taken() -> None:
    places = [("0", "0"), ("0", "a"), ("b", "a + c"), ("b + c", "0")]
    joints = [
        hinge(f"j{k}", f"b{k}", f"b{(k + 1) % 4}", (*place, 0))
        for k, place in enumerate(places)
    ]
    found = [
        sampled_motion(network(*joints, extra=extra).motion, generic=True).model
        for extra in (
            "parameters: {a: 2, b: 3, c: 1}\n",
            "parameters: {c: 1, b: 3, a: 2}\n",
        )
    ]
    one, other = found
    assert one is not None
    assert other is not None
    assert np.array_equal(one.screws, other.screws)
