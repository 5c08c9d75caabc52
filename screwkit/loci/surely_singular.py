"""Whether all of a branch is singular, as every exact point of it says.

A rank that is lower in general on an irreducible set is so at all its postures; the
postures at which the platform moves are dense in it where it does in general.  So the
branch lies inside the components of a complete list, whichever of them these are.

References: [CoxLittleOShea] §9.1 (determinantal varieties are closed).
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.branches import Branch
from screwkit.kinematics.limb_parts import Parts, motion_at
from screwkit.kinematics.loop_state import LoopState, state_of
from screwkit.loci.loop_drop import rank_is_lost
from screwkit.loci.wrench_sums import height_of


def all_lost(generic: LoopState, limbs: Sequence[Parts], branch: Branch) -> bool:
    """Whether the loop constraint matrix has lost rank there; False if not known."""
    states = _states(branch, limbs)
    return bool(states) and all(rank_is_lost(state, generic) for state in states)


def all_move(limbs: Sequence[Parts], branch: Branch) -> bool:
    """Whether the platform moves there; False if that is not known."""
    states = _states(branch, limbs)
    return bool(states) and all(state.platform_freedom for state in states)


def _states(branch: Branch, limbs: Sequence[Parts]) -> list[LoopState]:
    height = height_of(limbs)
    return [
        state_of([motion_at(limb, height, point, prime) for limb in limbs], prime)
        for point, prime in branch.points
    ]
