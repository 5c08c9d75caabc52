"""What can move when some joints can, with loops inside limbs, at one exact point.

The motions of a limb are kept for every choice of its joints, so that many schemes cost
one small rank each.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from screwkit.conventions import SCREW_DIMENSION
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.limb_parts import PartsMotion, motion_of, parts_of
from screwkit.kinematics.loop_state import LoopState, state_of


class HybridRanks:
    """States for any passive joints at one exact point."""

    def __init__(
        self, assembly: Assembly, twists: Mapping[str, Sequence[int]], prime: int
    ) -> None:
        self._assembly = assembly
        self._twists = twists
        self._prime = prime
        self._known: dict[tuple[int, frozenset[str]], PartsMotion] = {}

    def state(self, joints: Collection[str]) -> LoopState:
        """What can move when only these joints can."""
        return state_of(self.motions(joints), self._prime)

    def loop_rank(self, joints: Collection[str]) -> int:
        """Rank of these columns of the loop constraint matrix."""
        return self.state(joints).loop

    def motions(self, joints: Collection[str]) -> list[PartsMotion]:
        """Of each limb."""
        return [
            self._motion(number, frozenset(j for j in limb.joints if j in joints))
            for number, limb in enumerate(self._assembly.limbs)
        ]

    def _motion(self, number: int, chosen: frozenset[str]) -> PartsMotion:
        key = number, chosen
        if key not in self._known:
            assembly = self._assembly
            limb = assembly.limbs[number]
            columns: dict[str, list[Sequence[int]]] = {}
            for label in limb.joints:
                if label in chosen:
                    twist = [int(x) for x in self._twists[label]]
                    columns.setdefault(assembly.joint_of(label).name, []).append(twist)
            parts = parts_of(limb.elements or limb.chain, columns)
            self._known[key] = motion_of(parts, SCREW_DIMENSION, self._prime)
        return self._known[key]
