"""The twists of one joint or contact where it stands, freedom by freedom, in any ring.

Axes need no length: a twist counts up to a factor, and a pitch is given per radian
about the unit axis, so that it multiplies whatever axis is written.  Freedoms come in
the order of the file format, those of contacts as rotations before translations.

References: [BicchiPrattichizzo] Tables I and II (as reciprocal pairs), [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, NamedTuple

from screwkit.algebra.ring import Ring, S
from screwkit.kinematics.joint_places import JointPlace, joint_place, unit_vectors
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Joint, JointType, Space
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement
from screwkit.screw.vector import Vector


class JointTwist(NamedTuple, Generic[S]):
    """The twist of one freedom in some frame.

    Attributes:
        joint: Name of the joint.
        freedom: Which of its freedoms, from 0.
        direction, moment: The six coordinates.
        point: A point of the axis (for a translation, of the joint or the origin).
        label: ``joint``, or ``joint:freedom`` where the joint has several.
    """

    joint: str
    freedom: int
    direction: Vector[S]
    moment: Vector[S]
    point: Vector[S]
    label: str = ""

    @property
    def coordinates(self) -> tuple[S, ...]:
        """(ω; v)."""
        return (*self.direction, *self.moment)


def freedom_twists(
    joint: Joint,
    ring: Ring[S],
    space: Space = "spatial",
    moved: Displacement[S] | None = None,
) -> tuple[JointTwist[S], ...]:
    """The twists of a joint's freedoms where its axes and points put them.

    Args:
        joint: A joint of a ``posture`` or ``reference`` file.
        ring: Where the coordinates live.
        space: In planar files rotations are about z and translations along x and y.
        moved: Carries the joint from where the file describes it to where it is.

    Returns:
        One twist a freedom, in the order of the file format; none for rigid joints.

    Raises:
        UndecidedError: If a contact is placed nowhere.
        ExpressionError: If a coordinate has no value in the ring.
    """
    labels = freedom_labels(joint, space)
    if not labels:
        return ()
    place = joint_place(joint, ring, moved)
    pairs = _planar(joint, place) if space == "planar" else _spatial(joint, place)
    return tuple(
        JointTwist(joint.name, number, direction, moment, place.point, label)
        for number, (label, (direction, moment)) in enumerate(
            zip(labels, pairs, strict=True)
        )
    )


def _spatial(
    joint: Joint, place: JointPlace[S]
) -> Sequence[tuple[Vector[S], Vector[S]]]:
    turn, slide = place.rotation, place.translation
    match joint.type:
        case JointType.REVOLUTE:
            return [turn(place.axes[0])]
        case JointType.PRISMATIC:
            return [slide(place.axes[0])]
        case JointType.HELICAL:
            return [place.helix()]
        case JointType.CYLINDRICAL:
            return [turn(place.axes[0]), slide(place.axes[0])]
        case JointType.UNIVERSAL:
            return [turn(axis) for axis in place.axes]
        case JointType.SPHERICAL | JointType.HARD_FINGER:
            return _all_turns(place)
        case JointType.PLANAR:  # may be actuated: translations are measured
            return [turn(place.normal), *map(slide, place.square_tangents())]
        case JointType.PLANE:
            return [turn(place.normal), *map(slide, place.tangents())]
        case JointType.POINT:
            return [*_all_turns(place), *map(slide, place.tangents())]
        case JointType.SOFT_FINGER:
            return [turn(tangent) for tangent in place.tangents()]
        case JointType.LINE:
            across = vector.normal(place.ring, vector.cross(place.normal, place.line))
            return [
                *(turn(axis) for axis in (place.line, place.normal)),
                *(slide(axis) for axis in (place.line, across)),
            ]
        case JointType.LINE_FRICTION:
            return [turn(place.line)]
        case _:
            return []


def _all_turns(place: JointPlace[S]) -> Sequence[tuple[Vector[S], Vector[S]]]:
    """About the axes of the base through the point."""
    units = unit_vectors(place.ring)
    return list(zip(units, vector.unit_moments(place.ring, place.point), strict=True))


def _planar(
    joint: Joint, place: JointPlace[S]
) -> Sequence[tuple[Vector[S], Vector[S]]]:
    x, y, z = unit_vectors(place.ring)
    turn, slide = place.rotation, place.translation
    along = vector.normal(place.ring, vector.cross(z, place.normal))
    match joint.type:
        case JointType.REVOLUTE:
            return [turn(place.axes[0])]
        case JointType.HARD_FINGER:
            return [turn(z)]
        case JointType.PRISMATIC:
            return [slide(place.axes[0])]
        case JointType.PLANAR:
            return [turn(z), slide(x), slide(y)]
        case JointType.POINT:
            return [turn(z), slide(along)]
        case JointType.LINE | JointType.PLANE:
            return [slide(along)]
        case _:
            return []
