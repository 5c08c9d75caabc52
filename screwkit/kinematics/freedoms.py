"""The twists of one joint or contact where it stands, freedom by freedom, in any ring.

Axes need no length: a twist counts up to a factor, and a pitch is given per radian
about the unit axis, so that it multiplies whatever axis is written.  Freedoms come in
the order of the file format, those of contacts as rotations before translations.

References: [BicchiPrattichizzo] Tables I and II (as reciprocal pairs), [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.ring import Ring, S
from screwkit.errors import UndecidedError
from screwkit.mechanism.joints import CATALOGUE, freedom_labels
from screwkit.mechanism.model import Joint, JointType, Space, VectorExpression
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement
from screwkit.screw.vector import Vector


@dataclass(frozen=True)
class JointTwist(Generic[S]):
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


@dataclass(frozen=True)
class _Place(Generic[S]):
    """A joint's directions and point in a ring; absent ones are zero."""

    ring: Ring[S]
    axes: tuple[Vector[S], ...]
    point: Vector[S]
    normal: Vector[S]
    line: Vector[S]
    pitch: S

    def rotation(self, axis: Vector[S]) -> tuple[Vector[S], Vector[S]]:
        """About a line through the point."""
        return axis, vector.normal(self.ring, vector.cross(self.point, axis))

    def translation(self, along: Vector[S]) -> tuple[Vector[S], Vector[S]]:
        """Along a direction."""
        return (self.ring.zero,) * 3, along

    def helix(self) -> tuple[Vector[S], Vector[S]]:
        """Rotation with an advance of the pitch per radian."""
        axis, moment = self.rotation(self.axes[0])
        advance = vector.scaled(self.pitch, axis)
        return axis, vector.normal(self.ring, vector.add(moment, advance))

    @property
    def units(self) -> tuple[Vector[S], Vector[S], Vector[S]]:
        """The axes of the base."""
        o, i = self.ring.zero, self.ring.one
        return (i, o, o), (o, i, o), (o, o, i)

    def tangents(self) -> tuple[Vector[S], Vector[S]]:
        """Two directions that span the plane at right angles to the normal.

        Products of the normal with two unit vectors; they are independent where its
        third coordinate does not vanish, so one is taken that is constant if possible.
        """
        ring, n = self.ring, self.normal
        usable = [k for k in (2, 1, 0) if not ring.is_zero(ring.normal(n[k]))]
        k = min(usable, key=lambda k: _size(n[k]), default=2)
        first = vector.cross(self.units[(k + 2) % 3], n)
        second = vector.cross(n, self.units[(k + 1) % 3])
        return vector.normal(ring, first), vector.normal(ring, second)


def _size(value: object) -> int:
    """Degree of a polynomial; scalars of other rings are all of one size."""
    degrees = getattr(value, "total_degree", None)
    return int(degrees()) if callable(degrees) else 0


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
    if joint.point is None and joint.type in _NEED_POINT:
        words = CATALOGUE[joint.type].words
        raise UndecidedError(f"joint {joint.name!r}, a {words}, has no point")
    place = _place(joint, ring, moved)
    pairs = _planar(joint, place) if space == "planar" else _spatial(joint, place)
    return tuple(
        JointTwist(joint.name, number, direction, moment, place.point, label)
        for number, (label, (direction, moment)) in enumerate(
            zip(labels, pairs, strict=True)
        )
    )


def _place(joint: Joint, ring: Ring[S], moved: Displacement[S] | None) -> _Place[S]:
    def direction(written: VectorExpression | None) -> Vector[S]:
        if written is None:
            return (ring.zero,) * 3
        x, y, z = (evaluate(part, ring) for part in written)
        if moved is None:
            return x, y, z
        return vector.normal(ring, vector.rotate(moved.rotation, (x, y, z)))

    point = direction(joint.point)
    if moved is not None and joint.point is not None:
        point = vector.normal(ring, vector.add(point, moved.translation))
    elif moved is not None:
        point = moved.translation
    return _Place(
        ring,
        tuple(direction(axis) for axis in joint.axes),
        point,
        direction(joint.normal),
        direction(joint.line),
        ring.zero if joint.pitch is None else evaluate(joint.pitch, ring),
    )


def _spatial(joint: Joint, place: _Place[S]) -> Sequence[tuple[Vector[S], Vector[S]]]:
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
            return [turn(axis) for axis in place.units]
        case JointType.PLANAR | JointType.PLANE:
            return [turn(place.normal), *map(slide, place.tangents())]
        case JointType.POINT:
            return [*map(turn, place.units), *map(slide, place.tangents())]
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


def _planar(joint: Joint, place: _Place[S]) -> Sequence[tuple[Vector[S], Vector[S]]]:
    x, y, z = place.units
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


_NEED_POINT = frozenset(
    {
        JointType.REVOLUTE,
        JointType.HELICAL,
        JointType.CYLINDRICAL,
        JointType.UNIVERSAL,
        JointType.SPHERICAL,
        JointType.POINT,
        JointType.HARD_FINGER,
        JointType.SOFT_FINGER,
        JointType.LINE,
        JointType.LINE_FRICTION,
    }
)
"""Those with a rotation about an axis that must be somewhere."""
