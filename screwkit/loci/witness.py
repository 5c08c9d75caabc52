"""Why a choice of actuators never stops the platform.

The simplest witness is given: passive axes, one in every limb, that are one line; or
the line about which the platform can turn, named by the points it passes through; or
what kind of motion is left.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import NamedTuple

from screwkit.algebra.points import residue
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.subspaces import PlatformSystem
from screwkit.loci.features import Features, listed
from screwkit.loci.meanings import Residue, features_at, features_of
from screwkit.loci.passive import PassiveSystem
from screwkit.screw.vector import cross, dot, subtract


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
        motions = [
            self._motion(passive, twists, features)
            for twists, features in self._at_points
        ]
        if motions and all(motion == motions[0] for motion in motions):
            return motions[0]
        freedom = self._system.generic_state(passive).platform_freedom
        return f"the platform keeps {freedom} freedom{'s' if freedom > 1 else ''}"

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
            [joint for joint in limb.joints if joint in passive]
            for limb in self._assembly.limbs
        ]
        for joints in product(*choices):
            if len(joints) > 1 and self._same_twist(joints):
                return self._sharing(joints)
        return None

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
    ) -> str:
        """The platform's remaining motion in words."""
        twists, prime = at_point
        limbs = [
            [twists[j] for j in limb.joints if j in passive]
            for limb in self._assembly.limbs
        ]
        platform = PlatformSystem.held_by(limbs, prime)
        if platform.freedom != 1:
            count = platform.freedom
            return f"the platform keeps {count} freedoms: {platform.motion_type}"
        twist = platform.twists[0]
        omega = [Residue(x, prime) for x in twist[DIRECTION]]
        v = [Residue(x, prime) for x in twist[MOMENT]]
        if not any(x.value for x in omega):
            return (
                "the platform can translate: every wrench is normal to that direction"
            )
        if dot(omega, v).value:
            return "the platform keeps one screw motion, reciprocal to every wrench"
        through = [
            p.name
            for p in features.points
            if not any(x.value for x in subtract(v, cross(p.position, omega)))
        ]
        along = [
            axis.joint
            for axis in features.axes
            if axis.point is not None
            and not any(
                x.value
                for x in (
                    *cross(axis.direction, omega),
                    *subtract(v, cross(axis.point, omega)),
                )
            )
        ]
        if along:
            return f"the platform can turn about axis {along[0]}: every wrench meets it"
        if len(through) > 1:
            return (
                f"the platform can turn about the line through {through[0]} and "
                f"{through[1]}: every wrench meets it"
            )
        if through:
            return (
                f"the platform can turn about a line through {through[0]}: "
                f"every wrench meets it"
            )
        return "the platform can turn about a line that every wrench meets"


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
