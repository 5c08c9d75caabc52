"""How many joint motions the loops leave, and how many of them the platform feels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.kinematics.limb_parts import PartsMotion, shared_dimension


@dataclass(frozen=True)
class LoopState:
    """Ranks at a posture, of all joints or of those that are not locked.

    Attributes:
        limbs: Dimension of each limb's twist system.
        loop: Rank of the loop constraint matrix, loops inside limbs included.
        freedoms: Number of its columns.
        inner: Rank of the loops inside limbs alone.
    """

    limbs: tuple[int, ...]
    loop: int
    freedoms: int
    inner: int = 0

    @property
    def mobility(self) -> int:
        """Dimension of the joint motions that the loops allow."""
        return self.freedoms - self.loop

    @property
    def platform_freedom(self) -> int:
        """Dimension of the twists the platform can have."""
        return self.mobility - (self.freedoms - self.inner - sum(self.limbs))


def state_of(limbs: Sequence[PartsMotion], prime: int) -> LoopState:
    """The state of limbs that hold one platform.

    The joint motions that close all loops are those with the platform held, limb by
    limb, and one for every dimension of the twists that all limbs allow.
    """
    freedoms = sum(limb.freedoms for limb in limbs)
    mobility = shared_dimension(limbs, prime) + sum(limb.idle for limb in limbs)
    return LoopState(
        tuple(limb.dimension for limb in limbs),
        freedoms - mobility,
        freedoms,
        sum(limb.inner_rank for limb in limbs),
    )
