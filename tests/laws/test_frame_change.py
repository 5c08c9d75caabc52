"""What a change of frame must leave alone."""

from __future__ import annotations

from hypothesis import given, settings
from laws.systems import RING, displacements, twist_systems

import screwkit as sk
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.placement import joint_twists, placed_links
from screwkit.screw.displacement import Displacement
from screwkit.screw.nullspace import moved
from screwkit.screw.system import TwistSystem, reciprocal_product


@settings(max_examples=40)
@given(twist_systems, displacements)
def test_frame_change_commutes_with_reciprocity(
    system: TwistSystem, move: Displacement[Polynomial]
) -> None:
    there = system.expressed_in("elsewhere", move)
    assert there.dimension == system.dimension
    assert there.reciprocal() == system.reciprocal().expressed_in("elsewhere", move)
    back = there.expressed_in("base", move.inverse(RING))
    assert back.columns == tuple(
        tuple(RING.normal(v) for v in column) for column in system.columns
    )


@settings(max_examples=30)
@given(twist_systems, twist_systems, displacements)
def test_frame_change_keeps_powers_sums_and_intersections(
    a: TwistSystem, b: TwistSystem, move: Displacement[Polynomial]
) -> None:
    here, there = a, a.expressed_in("elsewhere", move)
    forces = b.reciprocal()
    moved_forces = forces.expressed_in("elsewhere", move)
    for one, other in zip(here, there, strict=True):
        for force, carried in zip(forces, moved_forces, strict=True):
            assert reciprocal_product(one, force) == reciprocal_product(other, carried)
    assert (a & b).expressed_in("elsewhere", move) == there & b.expressed_in(
        "elsewhere", move
    )


def test_twists_of_a_limb_move_with_its_links() -> None:
    """The kinematics in another frame, and the exact displacement, agree."""
    case = sk.load("nao_t14")
    limb, mechanism = case.limbs[0], case.mechanism
    ring = limb.twists.ring
    chain = case.assembly.limbs[0].chain
    for origin in ("r1", "r3"):
        place = placed_links(mechanism, ring, mechanism.base, chain)[origin]
        twists = joint_twists(mechanism, ring, origin, chain)
        for joint, column in zip(limb.joints, limb.twists.columns, strict=True):
            assert moved(ring, place, twists[joint].coordinates) == column
