"""Why a choice of actuators never stops the platform.

The simplest witness is given: passive axes, one in every limb, that are one line; or
the line about which the platform can turn, named by the points it passes through; or
what kind of motion is left.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import product

from screwkit.algebra.points import Point as ExactPoint
from screwkit.algebra.points import residue
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.subspaces import PlatformSystem
from screwkit.loci.features import listed
from screwkit.loci.meanings import Residue, features_at, features_of
from screwkit.loci.passive import PassiveSystem
from screwkit.screw.vector import cross, dot, subtract


def witness(assembly: Assembly, system: PassiveSystem, passive: Collection[str]) -> str:
    """A sentence that explains why the platform stays movable."""
    shared = _shared_axis(assembly, passive)
    if shared is not None:
        return shared
    root = assembly.root(assembly.common_twists.ring)
    motions = [_motion(assembly, passive, *point) for point in root.points]
    if motions and all(motion == motions[0] for motion in motions):
        return motions[0]
    freedom = system.generic_state(passive).platform_freedom
    return f"the platform keeps {freedom} freedom{'s' if freedom > 1 else ''}"


def _shared_axis(assembly: Assembly, passive: Collection[str]) -> str | None:
    """Passive joints, one in every limb, with one and the same twist up to a factor."""
    choices = [
        [joint for joint in limb.joints if joint in passive] for limb in assembly.limbs
    ]
    for joints in product(*choices):
        if len(joints) > 1 and _same_twist(assembly, joints):
            names = listed(joints)
            kind = str(assembly.joint_of(joints[0]).type)
            if kind == "revolute":
                return (
                    f"axes {names} are one line and passive: "
                    f"limbs and platform turn about it together"
                )
            return (
                f"joints {names} slide in one direction and are passive: "
                f"limbs and platform move along it together"
            )
    return None


def _same_twist(assembly: Assembly, joints: Sequence[str]) -> bool:
    for twists, prime in assembly.random_postures:
        first = [int(x) for x in twists[joints[0]]]
        for joint in joints[1:]:
            other = [int(x) for x in twists[joint]]
            if any(
                (first[i] * other[j] - first[j] * other[i]) % prime
                for i in range(6)
                for j in range(i)
            ):
                return False
    return True


def _motion(
    assembly: Assembly, passive: Collection[str], point: ExactPoint, prime: int
) -> str:
    """The platform's remaining motion in words."""
    framed = assembly.common_twists
    limbs = [
        [
            [residue(x, point, prime) for x in framed.column(j)]
            for j in limb.joints
            if j in passive
        ]
        for limb in assembly.limbs
    ]
    platform = PlatformSystem.held_by(limbs, prime)
    if platform.freedom != 1:
        count = platform.freedom
        return f"the platform keeps {count} freedoms: {platform.motion_type}"
    twist = platform.twists[0]
    omega = [Residue(x, prime) for x in twist[DIRECTION]]
    v = [Residue(x, prime) for x in twist[MOMENT]]
    if not any(x.value for x in omega):
        return "the platform can translate: every wrench is normal to that direction"
    if dot(omega, v).value:
        return "the platform keeps one screw motion, reciprocal to every wrench"
    features = features_at(features_of(framed), point, prime)
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
            f"the platform can turn about a line through {through[0]}: every wrench "
            f"meets it"
        )
    return "the platform can turn about a line that every wrench meets"
