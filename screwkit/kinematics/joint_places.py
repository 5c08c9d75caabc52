"""Where a joint or contact stands, in any ring: its axes, its point, its normal.

What it lets pass (`freedoms`) and what it holds (`contacts`) are both read from here.
Axes need no length; directions at right angles to a given one are products of it, so
that everything stays polynomial.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Generic

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.ring import Ring, S
from screwkit.errors import UndecidedError
from screwkit.mechanism.joints import CATALOGUE
from screwkit.mechanism.model import Joint, JointType, VectorExpression
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement
from screwkit.screw.vector import Vector


@dataclass(frozen=True)
class JointPlace(Generic[S]):
    """A joint's directions and point in a ring; absent ones are zero.

    Attributes:
        known_sides: At right angles to the normal and to each other, zero nowhere; None
            where products of the normal with axes of the base serve.
    """

    ring: Ring[S]
    axes: tuple[Vector[S], ...]
    point: Vector[S]
    normal: Vector[S]
    line: Vector[S]
    pitch: S
    known_sides: tuple[Vector[S], Vector[S]] | None = None

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

    def tangents(self) -> tuple[Vector[S], Vector[S]]:
        """Two directions that span the plane at right angles to the normal."""
        return self.known_sides or tangents_of(self.ring, self.normal)

    def square_tangents(self) -> tuple[Vector[S], Vector[S]]:
        """The same, at right angles to each other."""
        return self.known_sides or self.sides(self.normal)

    def sides(self, axis: Vector[S]) -> tuple[Vector[S], Vector[S]]:
        """Two directions at right angles to an axis and to each other."""
        first, _ = tangents_of(self.ring, axis)
        return first, vector.normal(self.ring, vector.cross(axis, first))


def tangents_of(ring: Ring[S], n: Vector[S]) -> tuple[Vector[S], Vector[S]]:
    """Two directions that span the plane at right angles to ``n``.

    Products of it with two unit vectors; they are independent where its third
    coordinate does not vanish, so one is taken that is constant if possible.
    """
    units = unit_vectors(ring)
    usable = [k for k in (2, 1, 0) if not ring.is_zero(ring.normal(n[k]))]
    k = min(usable, key=lambda k: _size(n[k]), default=2)
    first = vector.cross(units[(k + 2) % 3], n)
    second = vector.cross(n, units[(k + 1) % 3])
    return vector.normal(ring, first), vector.normal(ring, second)


def unit_vectors(ring: Ring[S]) -> tuple[Vector[S], Vector[S], Vector[S]]:
    """The axes of the base."""
    o, i = ring.zero, ring.one
    return (i, o, o), (o, i, o), (o, o, i)


def joint_place(
    joint: Joint, ring: Ring[S], moved: Displacement[S] | None
) -> JointPlace[S]:
    """Where a joint of a ``posture`` or ``reference`` file stands.

    Args:
        joint: With its axes and points in base coordinates.
        ring: Where the coordinates live.
        moved: Carries the joint from where the file describes it to where it is.

    Raises:
        UndecidedError: If it is placed nowhere.
        ExpressionError: If a coordinate has no value in the ring.
    """
    if joint.point is None and joint.type in PLACED_BY_POINT:
        words = CATALOGUE[joint.type].words
        raise UndecidedError(f"joint {joint.name!r}, a {words}, has no point")

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
    return JointPlace(
        ring,
        tuple(direction(axis) for axis in joint.axes),
        point,
        direction(joint.normal),
        direction(joint.line),
        ring.zero if joint.pitch is None else evaluate(joint.pitch, ring),
        joint.sides and (direction(joint.sides[0]), direction(joint.sides[1])),
    )


def _size(value: object) -> int:
    """Degree of a polynomial; scalars of other rings are all of one size."""
    degrees = getattr(value, "total_degree", None)
    return int(degrees()) if callable(degrees) else 0


PLACED_BY_POINT: Final = frozenset(
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
