"""Joint motions of limbs with loops inside, by parts and by all loop equations."""

from __future__ import annotations

import pytest

import screwkit as sk
from screwkit.algebra.modular import rank
from screwkit.kinematics.limb_parts import has_loops, motion_of, parts_of
from screwkit.kinematics.loop_state import state_of
from screwkit.kinematics.network import motion

NESTED = (
    "delta_ss",
    "delta_4r",
    "orthoglide",
    "h4",
    "stephenson_six_bar",
    "gough_6ups",
)


@pytest.mark.parametrize("name", NESTED)
def test_parts_move_as_their_network(name: str) -> None:
    case = sk.load(name)
    assembly, network = case.assembly, case.network
    posture = network.postures[0]
    found = []
    for limb in assembly.limbs:
        columns = {
            joint: [[int(x) for x in posture.twists[label]] for label in labels]
            for joint, labels in network.labels_of.items()
        }
        parts = parts_of(limb.elements or limb.chain, columns)
        assert has_loops(parts) == (limb.elements is not None)
        found.append(motion_of(parts, 6, posture.prime))
        own = network.part(
            limb.chain, (network.mechanism.base, case.mechanism.platform)
        )
        alone = motion(own, posture)
        expected = alone.platform_twists
        mine = [list(row) for row in found[-1].twists]
        assert len(mine) == len(expected)
        assert rank([*mine, *expected], posture.prime) == len(expected)
        assert found[-1].dimension + found[-1].idle == alone.mobility
        assert found[-1].inner_rank == alone.rank
    whole = motion(network, posture)
    state = state_of(found, posture.prime)
    assert (state.mobility, state.loop) == (whole.mobility, whole.rank)
    assert state.platform_freedom == len(whole.platform_twists)
