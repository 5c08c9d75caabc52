"""What a joint or contact holds: a basis of the wrenches that it transmits.

Each row of a selector [BicchiPrattichizzo, Tables I and II] picks a component of the
relative velocity that is prevented; the same row is the wrench that is transmitted,
and reciprocal to every freedom that `freedoms` gives for the same joint.  Forces come
before couples, in the order of the tables; rows are at right angles to each other and
need no length.

References: [BicchiPrattichizzo] Tables I, II, Appendix A; [BicchiMelchiorri] eq. (5).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, Literal, NamedTuple, TypeAlias

from screwkit.algebra.ring import Ring, S
from screwkit.kinematics.joint_places import JointPlace, joint_place, unit_vectors
from screwkit.mechanism.model import Joint, JointType, Space
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement
from screwkit.screw.vector import Vector

RowKind: TypeAlias = Literal["force", "couple", "screw"]


class ContactWrench(NamedTuple, Generic[S]):
    """One row of a selector: a component that is held, and transmitted.

    Attributes:
        joint: Name of the joint or contact.
        kind: ``force``: a row of FS; ``couple``: a row of MS; ``screw``: of both.
        component: ``x`` ``y`` ``z`` in base axes; ``normal``, ``line``, ``across`` or
            ``tangent`` of the joint itself.
        direction: Of the force, or of the couple; need not have unit length.
        force, moment: (f; m) about the origin.
        point: Where it acts.
    """

    joint: str
    kind: RowKind
    component: str
    direction: Vector[S]
    force: Vector[S]
    moment: Vector[S]
    point: Vector[S]

    @property
    def coordinates(self) -> tuple[S, ...]:
        """(f; m)."""
        return (*self.force, *self.moment)

    @property
    def label(self) -> str:
        """As a row is labelled: ``f normal`` or ``m x``."""
        return f"{'m' if self.kind == 'couple' else 'f'} {self.component}"


def contact_wrenches(
    joint: Joint,
    ring: Ring[S],
    space: Space = "spatial",
    moved: Displacement[S] | None = None,
    at: Vector[S] | None = None,
) -> tuple[ContactWrench[S], ...]:
    """The wrenches that a joint or contact transmits where it stands.

    Args:
        joint: With its axes and points in base coordinates.
        ring: Where the coordinates live.
        space: In planar files forces lie in the plane and couples are about z.
        moved: Carries the joint from where the file describes it to where it is.
        at: Where a rigid joint without a point acts; the origin by default.

    Returns:
        Forces, then couples; six (three in the plane) less its freedoms.

    Raises:
        UndecidedError: If a contact is placed nowhere.
        ExpressionError: If a coordinate has no value in the ring.
    """
    place = joint_place(joint, ring, moved)
    point = at if joint.point is None and at is not None else place.point
    return held_at(joint, place, point, space)


def rigid_wrenches(
    name: str, ring: Ring[S], point: Vector[S], space: Space = "spatial"
) -> tuple[ContactWrench[S], ...]:
    """All wrenches: what a rigid attachment at a point transmits."""
    rows = _Rows(name, ring, point)
    if space == "planar":
        z = unit_vectors(ring)[2]
        return (*rows.unit_forces()[:2], *rows.couples(("z", z)))
    return (*rows.unit_forces(), *rows.unit_couples())


def held_at(
    joint: Joint, place: JointPlace[S], point: Vector[S], space: Space
) -> tuple[ContactWrench[S], ...]:
    """The rows of a joint whose directions are known, acting at a point."""
    if joint.type in (JointType.FIXED, JointType.COMPLETE):
        return rigid_wrenches(joint.name, place.ring, point, space)
    rows = _Rows(joint.name, place.ring, point)
    if space == "planar":
        return _planar(joint, place, rows)
    return _spatial(joint, place, rows)


Named: TypeAlias = tuple[str, Vector[S]]


@dataclass(frozen=True)
class _Rows(Generic[S]):
    """Makes rows at a point."""

    joint: str
    ring: Ring[S]
    point: Vector[S]

    def forces(self, *along: Named[S]) -> list[ContactWrench[S]]:
        return [self._row("force", name, axis, axis) for name, axis in along]

    def unit_forces(self) -> list[ContactWrench[S]]:
        """Along the axes of the base."""
        units = unit_vectors(self.ring)
        moments = vector.unit_moments(self.ring, self.point)
        return [
            ContactWrench(self.joint, "force", name, axis, axis, moment, self.point)
            for name, axis, moment in zip("xyz", units, moments, strict=True)
        ]

    def unit_couples(self) -> list[ContactWrench[S]]:
        """About the axes of the base."""
        return self.couples(*zip("xyz", unit_vectors(self.ring), strict=True))

    def couples(self, *about: Named[S]) -> list[ContactWrench[S]]:
        zero = (self.ring.zero,) * 3
        return [
            ContactWrench(self.joint, "couple", name, axis, zero, axis, self.point)
            for name, axis in about
        ]

    def helix(self, name: str, axis: Vector[S], pitch: S) -> ContactWrench[S]:
        """The row zᵀv − h zᵀω of a helical joint: a wrench of pitch −h."""
        row = self._row("screw", name, axis, axis)
        back = vector.scaled(pitch, axis)
        moment = vector.normal(self.ring, vector.subtract(row.moment, back))
        return ContactWrench(self.joint, "screw", name, axis, axis, moment, self.point)

    def _row(
        self, kind: RowKind, name: str, direction: Vector[S], force: Vector[S]
    ) -> ContactWrench[S]:
        moment = vector.normal(self.ring, vector.cross(self.point, force))
        return ContactWrench(
            self.joint, kind, name, direction, force, moment, self.point
        )


def _sides(place: JointPlace[S], axis: Vector[S]) -> tuple[Named[S], Named[S]]:
    return _named(place.sides(axis))


def _named(pair: tuple[Vector[S], Vector[S]]) -> tuple[Named[S], Named[S]]:
    first, second = pair
    return ("tangent", first), ("across", second)


def _spatial(
    joint: Joint, place: JointPlace[S], rows: _Rows[S]
) -> tuple[ContactWrench[S], ...]:
    normal = "normal", place.normal
    match joint.type:
        case JointType.REVOLUTE:
            found = [*rows.unit_forces(), *rows.couples(*_sides(place, place.axes[0]))]
        case JointType.PRISMATIC:
            sides = _sides(place, place.axes[0])
            found = [*rows.forces(*sides), *rows.unit_couples()]
        case JointType.HELICAL:
            sides = _sides(place, place.axes[0])
            mixed = rows.helix("axis", place.axes[0], place.pitch)
            found = [*rows.forces(*sides), mixed, *rows.couples(*sides)]
        case JointType.CYLINDRICAL:
            sides = _sides(place, place.axes[0])
            found = [*rows.forces(*sides), *rows.couples(*sides)]
        case JointType.UNIVERSAL:
            cross = vector.normal(place.ring, vector.cross(*place.axes))
            found = [*rows.unit_forces(), *rows.couples(("normal", cross))]
        case JointType.SPHERICAL | JointType.HARD_FINGER:
            found = rows.unit_forces()
        case JointType.PLANAR | JointType.PLANE:
            sides = _named(place.square_tangents())
            found = [*rows.forces(normal), *rows.couples(*sides)]
        case JointType.POINT:
            found = rows.forces(normal)
        case JointType.SOFT_FINGER:
            found = [*rows.unit_forces(), *rows.couples(normal)]
        case JointType.LINE:
            beside = "across", _beside(place)
            found = [*rows.forces(normal), *rows.couples(beside)]
        case JointType.LINE_FRICTION:
            beside = "across", _beside(place)
            found = [*rows.unit_forces(), *rows.couples(beside, normal)]
        case _:
            found = []
    return tuple(found)


def _beside(place: JointPlace[S]) -> Vector[S]:
    """Y = z × x: in the plane of contact, at right angles to the line."""
    return vector.normal(place.ring, vector.cross(place.normal, place.line))


def _planar(
    joint: Joint, place: JointPlace[S], rows: _Rows[S]
) -> tuple[ContactWrench[S], ...]:
    z = unit_vectors(place.ring)[2]
    about = "z", z
    normal = "normal", place.normal
    match joint.type:
        case JointType.REVOLUTE | JointType.HARD_FINGER:
            found = rows.unit_forces()[:2]
        case JointType.PRISMATIC:
            side = vector.normal(place.ring, vector.cross(z, place.axes[0]))
            found = [*rows.forces(("across", side)), *rows.couples(about)]
        case JointType.POINT:
            found = rows.forces(normal)
        case JointType.LINE | JointType.PLANE:
            found = [*rows.forces(normal), *rows.couples(about)]
        case _:
            found = []
    return tuple(found)
