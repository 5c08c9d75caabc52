"""Why a choice of actuators never stops the platform.

The simplest witness is given: passive axes, one in every limb, that are one line; an
actuator that holds nothing, or two that hold the same freedom; the line about which the
platform can turn, or the direction in which it can slide, named by the points and axes
of the mechanism; or how many freedoms a few actuators hold, and what motion is left.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import NamedTuple

from screwkit.algebra.names import counted
from screwkit.algebra.points import residue
from screwkit.conventions import DIRECTION
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.subspaces import PlatformSystem
from screwkit.loci.features import Features, listed
from screwkit.loci.hybrid_ranks import HybridRanks
from screwkit.loci.passive import PassiveSystem
from screwkit.loci.placed_features import Residue, features_at, features_of
from screwkit.loci.remaining_motion import Motion, motion_in_words
from screwkit.loci.wasted_actuators import (
    HeldFreedoms,
    doing_too_little,
    too_few,
)


class ExactTwists(NamedTuple):
    """Twists by joint, modulo a prime."""

    by_joint: Mapping[str, Sequence[int]]
    prime: int


class Witnesses:
    """Why choices of actuators never stop the platform of one mechanism."""

    def __init__(self, assembly: Assembly, system: PassiveSystem) -> None:
        self._assembly = assembly
        self._system = system

    def of(self, passive: Collection[str]) -> str:
        """A sentence that explains why the platform stays movable."""
        shared = self._shared_axis(passive)
        if shared is not None:
            return shared
        actuated = [joint for joint in self._system.joints if joint not in passive]
        if len(actuated) < self._held.platform:
            return too_few(len(actuated), self._held.platform)
        wasted = self._held.wasted_in(actuated)
        if wasted is not None and len(wasted.actuators) < 3:
            return doing_too_little(wasted, self._motion_type)
        motion = self._one_motion(passive)
        if wasted is None or motion.named or len(wasted.actuators) == len(actuated):
            return motion.text
        return f"{doing_too_little(wasted, self._motion_type)}; {motion.text}"

    @cached_property
    def _held(self) -> HeldFreedoms:
        return HeldFreedoms(self._freedom)

    def _freedom(self, locked: Collection[str]) -> int:
        """What the platform keeps in general with these joints locked."""
        passive = [joint for joint in self._system.joints if joint not in locked]
        return self._system.generic_state(passive).platform_freedom

    def _motion_type(self, locked: Collection[str]) -> str:
        """The type of the platform's motion with these joints locked."""
        passive = [joint for joint in self._system.joints if joint not in locked]
        types = {
            self._platform(passive, twists).motion_type for twists, _ in self._at_points
        }
        if len(types) == 1:
            return types.pop()
        return f"the same {counted(self._freedom(locked), 'freedom')}"

    def _platform(
        self, passive: Collection[str], at_point: ExactTwists
    ) -> PlatformSystem:
        """What holds the platform at an exact point."""
        twists, prime = at_point
        motions = HybridRanks(self._assembly, twists, prime).motions(passive)
        return PlatformSystem.held_by([motion.twists for motion in motions], prime)

    def _one_motion(self, passive: Collection[str]) -> Motion:
        """The remaining motion as all exact points show it."""
        motions = [
            self._motion(passive, twists, features)
            for twists, features in self._at_points
        ]
        if motions and all(motion == motions[0] for motion in motions):
            return motions[0]
        freedom = self._system.generic_state(passive).platform_freedom
        text = f"the platform keeps {counted(freedom, 'freedom')}"
        return Motion(text, named=False)

    @cached_property
    def _at_points(self) -> list[tuple[ExactTwists, Features[Residue]]]:
        """The twists and features at the exact points of the mechanism."""
        framed = self._assembly.common_twists
        exact = features_of(framed)
        return [
            (
                ExactTwists(
                    {
                        joint: [residue(x, point, prime) for x in framed.column(joint)]
                        for joint in self._assembly.joints
                    },
                    prime,
                ),
                features_at(exact, point, prime),
            )
            for point, prime in self._assembly.root(framed.ring).points
        ]

    def _shared_axis(self, passive: Collection[str]) -> str | None:
        """Passive joints, one in every limb, with one twist up to a factor."""
        choices = [
            [joint for joint in own if joint in passive] for own in self._in_series
        ]
        for joints in product(*choices):
            if len(joints) > 1 and self._same_twist(joints):
                return self._sharing(joints)
        return None

    @cached_property
    def _in_series(self) -> list[list[str]]:
        """By limb the freedoms that carry its whole end, not a chain of a block."""
        assembly = self._assembly
        return [
            [
                joint
                for joint in limb.joints
                if limb.elements is None
                or assembly.joint_of(joint).name in limb.elements
            ]
            for limb in assembly.limbs
        ]

    def _sharing(self, joints: Sequence[str]) -> str:
        """Joints with one twist, in words."""
        names = listed(joints)
        twists, _ = self._assembly.random_postures[0]
        if not any(int(x) for x in twists[joints[0]][DIRECTION]):
            return (
                f"joints {names} slide in one direction and are passive: "
                f"limbs and platform move along it together"
            )
        kinds = {str(self._assembly.joint_of(joint).type) for joint in joints}
        if "helical" in kinds:
            return (
                f"joints {names} have one axis and pitch and are passive: "
                f"limbs and platform screw about it together"
            )
        line = f"rotations {names} have one line and are passive"
        if kinds == {"revolute"}:
            line = f"axes {names} are one line and passive"
        return f"{line}: limbs and platform turn about it together"

    def _same_twist(self, joints: Sequence[str]) -> bool:
        return all(joint in self._lines[joints[0]] for joint in joints[1:])

    @cached_property
    def _lines(self) -> dict[str, frozenset[str]]:
        """By joint: the joints with the same twist up to a factor at every posture."""
        joints = self._assembly.joints
        return {
            first: frozenset(j for j in joints if _parallel(self._assembly, first, j))
            for first in joints
        }

    def _motion(
        self,
        passive: Collection[str],
        at_point: ExactTwists,
        features: Features[Residue],
    ) -> Motion:
        """The platform's remaining motion in words."""
        platform = self._platform(passive, at_point)
        if platform.freedom != 1:
            count = platform.freedom
            text = f"the platform keeps {count} freedoms: {platform.motion_type}"
            return Motion(text, named=False)
        return motion_in_words(platform.twists[0], platform.prime, features)


def _parallel(assembly: Assembly, first: str, second: str) -> bool:
    for twists, prime in assembly.random_postures:
        one, other = ([int(x) for x in twists[joint]] for joint in (first, second))
        if any(
            (one[i] * other[j] - one[j] * other[i]) % prime
            for i in range(6)
            for j in range(i)
        ):
            return False
    return True
