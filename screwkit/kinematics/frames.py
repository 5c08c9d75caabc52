"""The frame and the angles that keep a mechanism's twists short.

Two choices decide the size of every later polynomial: the link whose frame is used,
and the basis angles.  Consecutive parallel axes turn their angles into sums, so the
sums are taken as basis angles; every link is tried as origin, and the shortest wins.

The frame alone is worth a factor of 4 to 24 (docs/decisions/0003-frames.md).
"""

from __future__ import annotations

from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    plain_basis,
)
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.errors import ExpressionError
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.parallel_axes import parallel_basis
from screwkit.kinematics.placement import joint_twists
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import JointType, Mechanism
from screwkit.screw.vector import Vector


@dataclass(frozen=True)
class FramedTwists:
    """The twists of some joints, exact, in the frame of one link.

    Attributes:
        origin: The link whose frame is used.
        joints: The freedoms by their labels, in the order of ``columns``.
        columns: Six polynomials each, (ω; v), cleared of divisors.
        points: A point of each axis.
        limbs: Labels limb by limb, where several limbs are placed together.
        balls: Joints that turn about a point in every way, and their rotations, which
            are no axes of their own.
        places: Points that the file names, where they are known in this frame.
    """

    ring: TrigonometricRing
    origin: str
    joints: tuple[str, ...]
    columns: tuple[tuple[Polynomial, ...], ...]
    points: tuple[Vector[Polynomial], ...]
    limbs: tuple[tuple[str, ...], ...] = ()
    balls: tuple[tuple[str, tuple[str, ...]], ...] = ()
    places: tuple[tuple[str, Vector[Polynomial]], ...] = ()

    def limb_of(self, joint: str) -> int:
        """Number of the limb of a joint; 0 where there is only one."""
        for number, joints in enumerate(self.limbs):
            if joint in joints:
                return number
        return 0

    @property
    def terms(self) -> int:
        """Number of terms of all coordinates together."""
        return sum(len(entry) for column in self.columns for entry in column)

    def column(self, joint: str) -> tuple[Polynomial, ...]:
        """The twist of a joint."""
        return self.columns[self.joints.index(joint)]

    def axis_direction(self, joint: str) -> tuple[Polynomial, ...]:
        """A joint's direction as its column has it, coordinates that are 0 left out."""
        column = self.column(joint)
        omega = tuple(x for x in column[DIRECTION] if x != 0)
        return omega or tuple(x for x in column[MOMENT] if x != 0)

    def axis_square(self, joint: str) -> Polynomial:
        """The squared length of `axis_direction`."""
        parts = self.axis_direction(joint)
        return self.ring.normal(sum((x * x for x in parts), self.ring.zero))


def survey(mechanism: Mechanism, joints: Collection[str], origin: str) -> SurveyRing:
    """What the exact ring must hold for these joints."""
    ring = SurveyRing()
    joint_twists(mechanism, ring, origin, joints)
    return ring


def framed_twists(
    mechanism: Mechanism,
    joints: Collection[str],
    origin: str,
    *,
    merged: bool = True,
) -> FramedTwists:
    """The twists of ``joints`` in the frame of ``origin``.

    Args:
        mechanism: Any mechanism.
        joints: Names of the joints, fixed ones included where they carry a row.
        origin: A link that the rows of these joints connect with them.
        merged: Take sums of angles of parallel axes as basis angles.
    """
    seen = survey(mechanism, joints, origin)
    plain = TrigonometricRing(seen)
    basis = plain_basis(tuple(seen.angles))
    if merged and mechanism.geometry != "posture":
        basis = parallel_basis(mechanism, joints, origin, plain)
    same = basis == plain_basis(tuple(seen.angles))
    ring = plain if same else TrigonometricRing(seen, basis)
    twists = joint_twists(mechanism, ring, origin, joints)
    own = {j.name: freedom_labels(j, mechanism.space) for j in mechanism.joints}
    ordered = [x for name in joints for x in own[name] if x in twists]
    return FramedTwists(
        ring,
        origin,
        tuple(ordered),
        tuple(_column(twists[name], ring) for name in ordered),
        tuple(twists[name].point for name in ordered),
        balls=balls_among(mechanism, joints),
        places=_places(mechanism, ring) if origin == mechanism.base else (),
    )


def _places(
    mechanism: Mechanism, ring: TrigonometricRing
) -> tuple[tuple[str, Vector[Polynomial]], ...]:
    """The points of the file that the ring can express."""
    found = []
    for name, written in mechanism.points.items():
        with suppress(ExpressionError, KeyError):
            x, y, z = (ring.normal(evaluate(part, ring)) for part in written)
            found.append((name, (x, y, z)))
    return tuple(found)


def balls_among(
    mechanism: Mechanism, joints: Collection[str]
) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Those of the joints that turn about a point, with their rotations."""
    if mechanism.space == "planar":
        return ()
    return tuple(
        (joint.name, freedom_labels(joint, mechanism.space)[:3])
        for joint in mechanism.joints
        if joint.type in BALLS and joint.name in joints
    )


BALLS = (JointType.SPHERICAL, JointType.HARD_FINGER, JointType.POINT)
"""Joints with a rotation about every axis through a point."""


def _column(
    twist: JointTwist[Polynomial], ring: TrigonometricRing
) -> tuple[Polynomial, ...]:
    return tuple(ring.without_divisors(twist.coordinates))


def shortest_twists(
    mechanism: Mechanism, joints: Collection[str], origins: Collection[str]
) -> FramedTwists:
    """The same twists in whichever of the frames ``origins`` gives the fewest terms."""
    return min(
        (framed_twists(mechanism, joints, origin) for origin in origins),
        key=lambda framed: framed.terms,
    )
