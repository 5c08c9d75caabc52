"""The grasp model of any mechanism over any ring: J q̇ = Gᵀ u, row by row.

A row is a wrench that a contact transmits: its power on the motion of the object is the
same as on the motion of the link that holds it.  Rows of closures inside limbs have
nothing to do with the object.  Joints are parted into actuated and passive ones.

References: [BicchiMelchiorri] eqs. (1)-(7), [BicchiPrattichizzo] eq. (1), Appendix A.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, NamedTuple, TypeAlias

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.ring import Ring, S
from screwkit.grasping.holds import Hold, Holds, holds_of
from screwkit.kinematics.contacts import (
    ContactWrench,
    contact_wrenches,
    rigid_wrenches,
)
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.placement import joint_twists
from screwkit.kinematics.product_of_exponentials import placed_by_variables
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Joint, Mechanism
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement
from screwkit.screw.vector import Vector

Twists: TypeAlias = Mapping[str, JointTwist[S]]


class GraspRow(NamedTuple, Generic[S]):
    """One component of the contact forces, and of the velocities that it couples.

    Attributes:
        hold: Where.
        wrench: The component, in base axes about the base origin.
        couples: Whether it is a row of an angular velocity.
    """

    hold: Hold
    wrench: ContactWrench[S]

    @property
    def label(self) -> str:
        """``contact: f normal``."""
        return f"{self.hold.joint}: {self.wrench.label}"


@dataclass(frozen=True)
class GraspMatrices(Generic[S]):
    """J and Gᵀ over a ring; u is (ω; v) with v of the reference point.

    Attributes:
        holds: Where the object is held, and how limbs close in themselves.
        rows: Contacts first, forces before couples: [f_1 … f_n, m_1 … m_n]; then those
            of closures, likewise.
        actuated: Freedoms in the order of the scheme.
        passive: All others, in the order of the file.
        j: One tuple for each row, the columns `actuated` then `passive`.
        gt: One tuple for each row, the coordinates of u: six, or (ωz; vx, vy).
        squares: Of the length of the direction of each row.
        strokes: Of the length of the axis of each freedom.
        reference_point: Whose velocity v is, in base coordinates.
        twist_size: Coordinates of u.
        turning: Freedoms that turn what follows them.
        joint_of: The joint of each freedom.
        twists: Of all freedoms, about the base origin.
        slipping: Passive freedoms of contacts that carry a body.
        carried: Where each body has been carried from where the file describes it;
            empty where all stand as described.
    """

    holds: Holds
    rows: tuple[GraspRow[S], ...]
    actuated: tuple[str, ...]
    passive: tuple[str, ...]
    j: tuple[tuple[S, ...], ...]
    gt: tuple[tuple[S, ...], ...]
    squares: tuple[S, ...]
    strokes: tuple[S, ...]
    reference_point: Vector[S]
    twist_size: int
    turning: frozenset[str]
    slipping: tuple[str, ...]
    joint_of: Mapping[str, str]
    twists: Mapping[str, JointTwist[S]]
    carried: Mapping[str, Displacement[S]]

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Labels of the columns of `j`."""
        return (*self.actuated, *self.passive)

    @property
    def held(self) -> int:
        """How many rows are of contacts with the object."""
        return sum(row.hold.on_object for row in self.rows)


def twist_coordinates(mechanism: Mechanism) -> range:
    """The coordinates of a twist that count: all six, or (ωz; vx, vy)."""
    return range(2, 5) if mechanism.space == "planar" else range(6)


def grasp_matrices(
    mechanism: Mechanism,
    ring: Ring[S],
    twists: Twists[S] | None = None,
    carried: Mapping[str, Displacement[S]] | None = None,
    holds: Holds | None = None,
) -> GraspMatrices[S]:
    """J and Gᵀ of a mechanism whose platform is the object.

    Args:
        mechanism: Any; symbols have values in the ring.
        ring: Where the entries live.
        twists: Of all freedoms, where the mechanism has been moved from where the file
            describes it; in base axes about the base origin.
        carried: With them, where each body has been carried.
        holds: From `holds_of`, where several rings are asked for.

    Raises:
        UndecidedError: If a joint or contact is placed nowhere.
        ExpressionError: If a coordinate has no value in the ring.
    """
    placed = grasp_rows(mechanism, ring, twists, carried, holds)
    holds, twists, rows = placed.holds, placed.twists, placed.rows
    labels = {
        joint.name: freedom_labels(joint, mechanism.space) for joint in mechanism.joints
    }
    actuated = mechanism.scheme_order or mechanism.actuated
    passive = tuple(
        label
        for joint in mechanism.joints
        for label in labels[joint.name]
        if label not in actuated and _has_rate(joint, holds)
    )
    order = (*actuated, *passive)
    place = {label: number for number, label in enumerate(order)}
    coordinates = {label: twists[label].coordinates for label in order}
    felt = {
        hold.joint: [
            (place[label], coordinates[label], sign)
            for name, sign in hold.steps
            for label in labels[name]
            if label in place
        ]
        for hold in holds.all
    }
    turning = frozenset(
        label for label in order if not _is_zero(ring, twists[label].direction)
    )
    shifted = None if _is_zero(ring, placed.centre) else placed.centre
    return GraspMatrices(
        holds,
        rows,
        tuple(actuated),
        passive,
        tuple(
            _j_row(row.wrench, felt[row.hold.joint], len(order), ring) for row in rows
        ),
        tuple(_gt_row(row, mechanism, ring, shifted) for row in rows),
        tuple(_square(ring, row.wrench.direction) for row in rows),
        tuple(
            _square(
                ring,
                twists[label].direction if label in turning else twists[label].moment,
            )
            for label in order
        ),
        placed.centre,
        len(twist_coordinates(mechanism)),
        turning,
        tuple(label for name in holds.passing for label in labels[name]),
        {label: twists[label].joint for label in order},
        twists,
        placed.carried,
    )


@dataclass(frozen=True)
class PlacedRows(Generic[S]):
    """Where the object is held and what moves, before velocities are compared.

    Attributes:
        holds: Where the object is held, and how limbs close in themselves.
        rows: In the order of `GraspMatrices`.
        twists: Of all freedoms, about the base origin.
        centre: The reference point, in base coordinates.
        carried: Where each body has been carried; empty where all stand as described.
    """

    holds: Holds
    rows: tuple[GraspRow[S], ...]
    twists: Twists[S]
    centre: Vector[S]
    carried: Mapping[str, Displacement[S]]


def grasp_rows(
    mechanism: Mechanism,
    ring: Ring[S],
    twists: Twists[S] | None = None,
    carried: Mapping[str, Displacement[S]] | None = None,
    holds: Holds | None = None,
) -> PlacedRows[S]:
    """All that `grasp_matrices` asks of a ring; enough to survey it.

    Args:
        mechanism: As for `grasp_matrices`, with all the other arguments.
        ring: Where the coordinates live.
        twists: Of all freedoms of a mechanism that has been moved.
        carried: With them, where each body has been carried.
        holds: From `holds_of`, where several rings are asked for.

    Raises:
        UndecidedError: If a joint or contact is placed nowhere.
        ExpressionError: If a coordinate has no value in the ring.
    """
    holds = holds or holds_of(mechanism)
    centre = reference_point(mechanism, ring)
    if twists is None:
        twists = joint_twists(mechanism, ring, mechanism.base)
        if mechanism.geometry == "reference":
            carried, _ = placed_by_variables(mechanism, ring)
    if carried and mechanism.platform in carried:
        there = carried[mechanism.platform]
        turned = vector.rotate(there.rotation, centre)
        centre = vector.normal(ring, vector.add(turned, there.translation))
    carried = carried or {}
    rows: list[GraspRow[S]] = []
    for group in (holds.contacts, holds.closures):
        own = []
        for hold in group:
            joint = mechanism.joint(hold.joint)
            moved = carried.get(joint.parent)
            own += [
                GraspRow(hold, wrench)
                for wrench in _wrenches(
                    mechanism, joint, hold, ring, twists, centre, moved
                )
            ]
        forces = [row for row in own if row.wrench.kind != "couple"]
        rows += [*forces, *(row for row in own if row.wrench.kind == "couple")]
    return PlacedRows(holds, tuple(rows), twists, centre, carried)


def _has_rate(joint: Joint, holds: Holds) -> bool:
    """Whether its freedoms are joint rates: not those of a selector."""
    return all(joint.name != h.joint for h in holds.all if h.selective)


def reference_point(mechanism: Mechanism, ring: Ring[S]) -> Vector[S]:
    """Of the platform, in base coordinates where the file describes it."""
    if mechanism.reference_point is None:
        return ring.zero, ring.zero, ring.zero
    x, y, z = (evaluate(part, ring) for part in mechanism.reference_point)
    return x, y, z


def _wrenches(
    mechanism: Mechanism,
    joint: Joint,
    hold: Hold,
    ring: Ring[S],
    twists: Twists[S],
    centre: Vector[S],
    moved: Displacement[S] | None,
) -> tuple[ContactWrench[S], ...]:
    """The rows of a hold: its selector, or all wrenches at the joint's point."""
    space = mechanism.space
    if hold.selective or not freedom_labels(joint, space):
        return contact_wrenches(joint, ring, space, moved, at=centre)
    label = freedom_labels(joint, space)[0]
    placed = joint.mdh is not None or joint.point is not None
    point = twists[label].point if placed else centre
    return rigid_wrenches(joint.name, ring, point, space)


def _j_row(
    wrench: ContactWrench[S],
    felt: Sequence[tuple[int, Sequence[S], int]],
    width: int,
    ring: Ring[S],
) -> tuple[S, ...]:
    """The power of a wrench on what it feels: columns, their twists and signs."""
    pressing = (*wrench.moment, *wrench.force)
    acting = [(i, x) for i, x in enumerate(pressing) if not ring.is_zero(x)]
    found = [ring.zero] * width
    if not acting:
        return tuple(found)
    (k, first), *others = acting
    for column, twist, sign in felt:
        power = first * twist[k]
        for i, x in others:
            power = power + x * twist[i]
        found[column] = ring.normal(power if sign > 0 else -power)
    return tuple(found)


def _gt_row(
    row: GraspRow[S], mechanism: Mechanism, ring: Ring[S], centre: Vector[S] | None
) -> tuple[S, ...]:
    """The wrench about the reference point, None where that is the origin."""
    coordinates = twist_coordinates(mechanism)
    if not row.hold.on_object:
        return (ring.zero,) * len(coordinates)
    force, moment = row.wrench.force, row.wrench.moment
    if centre is not None:
        about = vector.subtract(moment, vector.cross(centre, force))
        moment = vector.normal(ring, about)
    return (*moment, *force)[coordinates.start : coordinates.stop]


def _is_zero(ring: Ring[S], direction: Vector[S]) -> bool:
    return all(ring.is_zero(ring.normal(x)) for x in direction)


def _square(ring: Ring[S], direction: Vector[S]) -> S:
    return ring.normal(vector.dot(direction, direction))
