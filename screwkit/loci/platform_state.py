"""What a mechanism's platform can do on a branch: ranks at its exact points.

The platform's twists are the meet of the limbs' twist systems, whatever overlaps; with
joints locked, the meet of those of the passive twists.

References: [Zlatanov2002]; [LongCaroKhalil2012] §5.2.
"""

from __future__ import annotations

from collections.abc import Collection

from screwkit.algebra.branches import Branch
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.kinematics.assembly import Assembly, loop_rows
from screwkit.kinematics.subspaces import PlatformSystem
from screwkit.results.strata import PlatformState


class PlatformStates:
    """States of one mechanism with one scheme.

    Args:
        assembly: The mechanism, its limbs serial chains.
        actuated: The joints that are locked; None where none is.
    """

    def __init__(self, assembly: Assembly, actuated: Collection[str] | None) -> None:
        self._assembly = assembly
        self._actuated = actuated

    def on(self, branch: Branch) -> PlatformState | None:
        """Generic on a branch; None where it has no exact point.

        Of two random points the one with the higher ranks is generic.
        """
        states = [self.at(*point) for point in branch.points]
        if not states:
            return None
        return max(states, key=lambda s: (s.limb_ranks, -s.mobility))

    def at(self, point: Point, prime: int) -> PlatformState:
        """At one exact point of the ring of all limbs."""
        assembly = self._assembly
        framed = assembly.common_twists
        limbs = [
            {
                joint: [residue(x, point, prime) for x in framed.column(joint)]
                for joint in limb.joints
            }
            for limb in assembly.limbs
        ]
        twists = [list(limb.values()) for limb in limbs]
        rows = loop_rows(twists)
        platform = PlatformSystem.held_by(twists, prime)
        locked = None
        if self._actuated is not None:
            passive = [
                [twist for joint, twist in limb.items() if joint not in self._actuated]
                for limb in limbs
            ]
            locked = PlatformSystem.held_by(passive, prime).freedom
        return PlatformState(
            limb_ranks=tuple(rank(limb, prime) for limb in twists),
            wrench_dimension=assembly.dimension - platform.freedom,
            platform_freedom=platform.freedom,
            motion_type=platform.motion_type,
            mobility=len(assembly.joints) - (rank(rows, prime) if rows else 0),
            locked_freedom=locked,
        )
