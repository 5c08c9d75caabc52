"""Where the joints are: an ``mdh`` table placed over any ring.

Each joint with a row places its child; bodies are placed outwards from any link, so
that the same text gives twists in the base frame, in the frame of a middle link, or in
whichever frame keeps them short.

References: [KhalilKleinfinger1986], [LongCaroKhalil2012] eq. (2) for the transform.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Generic

from screwkit.algebra.evaluation import add_angles, cosine_sine, evaluate
from screwkit.algebra.ring import Ring, S
from screwkit.errors import UndecidedError
from screwkit.mechanism.model import Joint, JointType, MdhRow, Mechanism
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
        point: A point of the axis (for a prismatic joint the origin of its frame).
    """

    joint: str
    freedom: int
    direction: Vector[S]
    moment: Vector[S]
    point: Vector[S]

    @property
    def coordinates(self) -> tuple[S, ...]:
        """(ω; v)."""
        return (*self.direction, *self.moment)


def parent_from_joint(joint: Joint, row: MdhRow, ring: Ring[S]) -> Displacement[S]:
    """The frame of a joint seen from its antecedent's frame."""
    theta = cosine_sine(row.theta, ring)
    r = evaluate(row.r, ring)
    if joint.type is JointType.REVOLUTE:
        moved = add_angles(
            cosine_sine(joint.offsets[0], ring),
            ring.cosine_sine(joint.variables[0]),
            ring,
        )
        theta = add_angles(theta, moved, ring)
    elif joint.type is JointType.PRISMATIC:
        r = r + evaluate(joint.offsets[0], ring) + ring.symbol(joint.variables[0])
    return _table_displacement(row, theta, ring.normal(r), ring)


def _table_displacement(
    row: MdhRow, theta: tuple[S, S], r: S, ring: Ring[S]
) -> Displacement[S]:
    """rot_z(γ) trans_z(b) rot_x(α) trans_x(d) rot_z(θ) trans_z(r), multiplied out."""
    cg, sg = cosine_sine(row.gamma, ring)
    ca, sa = cosine_sine(row.alpha, ring)
    ct, st = theta
    b, d = evaluate(row.b, ring), evaluate(row.d, ring)
    sgca, cgca = sg * ca, cg * ca
    x = (sg * sa, -(cg * sa), ca)
    rotation = (
        (cg * ct - sgca * st, -(cg * st) - sgca * ct, x[0]),
        (sg * ct + cgca * st, cgca * ct - sg * st, x[1]),
        (sa * st, sa * ct, x[2]),
    )
    translation = (d * cg + r * x[0], d * sg + r * x[1], b + r * x[2])
    first, second, third = (vector.normal(ring, line) for line in rotation)
    return Displacement((first, second, third), vector.normal(ring, translation))


def placed_links(
    mechanism: Mechanism,
    ring: Ring[S],
    origin: str,
    joints: Collection[str] | None = None,
) -> Mapping[str, Displacement[S]]:
    """origin_from_link for every link that rows of the table connect with ``origin``.

    Args:
        mechanism: An ``mdh`` mechanism.
        ring: Where the coordinates live.
        origin: The link whose frame is used.
        joints: Follow only these joints; all of them by default.

    Raises:
        UndecidedError: If the mechanism is no ``mdh`` file, or its table places a link
            twice, which ties joint variables together.
    """
    rows = table_joints(mechanism)
    if joints is not None:
        rows = tuple(joint for joint in rows if joint.name in joints)
    neighbours: dict[str, list[tuple[str, Joint, bool]]] = {}
    for joint in rows:
        neighbours.setdefault(joint.parent, []).append((joint.child, joint, True))
        neighbours.setdefault(joint.child, []).append((joint.parent, joint, False))
    placed = {origin: Displacement.identity(ring)}
    queue = deque([origin])
    while queue:
        link = queue.popleft()
        for other, joint, outwards in neighbours.get(link, ()):
            if other in placed:
                continue
            row = joint.mdh or MdhRow()
            step = parent_from_joint(joint, row, ring)
            step = step if outwards else step.inverse(ring)
            placed[other] = placed[link].then(step, ring)
            queue.append(other)
    return placed


def table_joints(mechanism: Mechanism) -> tuple[Joint, ...]:
    """The joints that carry a row.

    Raises:
        UndecidedError: See `placed_links`.
    """
    if mechanism.geometry != "mdh":
        raise UndecidedError(
            f"geometry {mechanism.geometry!r} is read but not yet analysed; "
            f"write the mechanism with `geometry: mdh`"
        )
    rows = tuple(joint for joint in mechanism.joints if joint.mdh is not None)
    placed_by: dict[str, str] = {}
    for joint in rows:
        if joint.child in placed_by:
            raise UndecidedError(
                f"joints {placed_by[joint.child]!r} and {joint.name!r} both place "
                f"{joint.child!r}: the loop ties the joint variables together, which "
                f"is not analysed yet; attach it by a fixed joint without a row where "
                f"the object is grasped wherever the limbs are"
            )
        placed_by[joint.child] = joint.name
    for joint in mechanism.joints:
        if joint.mdh is None and joint.type not in GRASPS:
            raise UndecidedError(
                f"joint {joint.name!r} ({joint.type}) carries no row of the table; "
                f"such joints are not analysed yet"
            )
    return rows


GRASPS = (JointType.FIXED, JointType.COMPLETE)


def joint_twists(
    mechanism: Mechanism,
    ring: Ring[S],
    origin: str,
    joints: Collection[str] | None = None,
) -> Mapping[str, JointTwist[S]]:
    """The twist of every moving joint in the frame of ``origin``, by joint name.

    Args:
        mechanism: An ``mdh`` mechanism.
        ring: Where the coordinates live.
        origin: The link whose frame is used.
        joints: Only these joints; all of them by default.
    """
    placed = placed_links(mechanism, ring, origin, joints)
    twists: dict[str, JointTwist[S]] = {}
    zero = (ring.zero, ring.zero, ring.zero)
    for joint in table_joints(mechanism):
        if joint.type not in MOVING or joint.child not in placed:
            continue
        if joints is not None and joint.name not in joints:
            continue
        frame = placed[joint.child]
        axis = vector.column(frame.rotation, 2)
        point = frame.translation
        if joint.type is JointType.REVOLUTE:
            moment = vector.normal(ring, vector.cross(point, axis))
            twists[joint.name] = JointTwist(joint.name, 0, axis, moment, point)
        else:
            twists[joint.name] = JointTwist(joint.name, 0, zero, axis, point)
    return twists


MOVING = (JointType.REVOLUTE, JointType.PRISMATIC)
