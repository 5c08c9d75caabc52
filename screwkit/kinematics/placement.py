"""Where the joints are, over any ring, whichever way a file gives its geometry.

In an ``mdh`` file each joint with a row places its child; bodies are placed outwards
from any link, so that the same text gives twists in the base frame, in the frame of a
middle link, or in whichever frame keeps them short.  In ``posture`` files the axes
stand as written, in ``reference`` files they are carried; both are in the base frame.

References: [KhalilKleinfinger1986], [LongCaroKhalil2012] eq. (2) for the transform.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Mapping

from screwkit.algebra.evaluation import add_angles, cosine_sine, evaluate
from screwkit.algebra.ring import Ring, S
from screwkit.errors import UndecidedError
from screwkit.kinematics.freedoms import JointTwist, freedom_twists
from screwkit.kinematics.product_of_exponentials import placed_by_variables
from screwkit.mechanism.graph import independent_loops
from screwkit.mechanism.joints import RIGID, freedom_labels
from screwkit.mechanism.model import (
    Joint,
    JointType,
    MdhRow,
    Mechanism,
    variable_value,
)
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement


def parent_from_joint(joint: Joint, row: MdhRow, ring: Ring[S]) -> Displacement[S]:
    """The frame of a joint seen from its antecedent's frame."""
    theta = cosine_sine(row.theta, ring)
    r = evaluate(row.r, ring)
    if joint.type in TURNING:
        moved = add_angles(
            cosine_sine(joint.offsets[0], ring),
            cosine_sine(variable_value(joint, 0), ring),
            ring,
        )
        theta = add_angles(theta, moved, ring)
    if joint.type is JointType.HELICAL and joint.pitch is not None:
        turned = evaluate(joint.offsets[0], ring) + evaluate(
            variable_value(joint, 0), ring
        )
        r = r + evaluate(joint.pitch, ring) * turned
    elif joint.type is JointType.PRISMATIC:
        r = (
            r
            + evaluate(joint.offsets[0], ring)
            + evaluate(variable_value(joint, 0), ring)
        )
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


def table_agrees(mechanism: Mechanism, ring: Ring[S]) -> bool:
    """Whether every row of a table puts its link where other rows have put it.

    Args:
        mechanism: An ``mdh`` mechanism.
        ring: An exact one.
    """
    placed = placed_links(mechanism, ring, mechanism.base)
    misses: list[S] = []
    for joint in table_joints(mechanism):
        if joint.mdh is None or not {joint.parent, joint.child} <= placed.keys():
            continue
        step = parent_from_joint(joint, joint.mdh, ring)
        one, other = placed[joint.parent].then(step, ring), placed[joint.child]
        pairs = zip(
            (*one.rotation, one.translation),
            (*other.rotation, other.translation),
            strict=True,
        )
        misses += [x for a, b in pairs for x in vector.subtract(a, b)]
    return all(ring.is_zero(ring.normal(miss)) for miss in misses)


def table_joints(mechanism: Mechanism) -> tuple[Joint, ...]:
    """The joints that carry a row and place their child."""
    return tuple(joint for joint in mechanism.joints if joint.mdh is not None)


def why_tied(mechanism: Mechanism) -> str:
    """What ties joint variables together, or an empty text.

    In ``posture`` files loops are closed by construction, in an ``mdh`` file whose
    table places every link once the object is grasped wherever the limbs are.  The
    base needs no row: one that leads back to it closes a loop.
    """
    if mechanism.geometry == "posture":
        return ""
    if mechanism.geometry == "reference":
        loops = independent_loops(mechanism)
        return "closed loops tie the joint variables together" if loops else ""
    placed_by: dict[str, str] = {}
    for joint in table_joints(mechanism):
        if joint.child == mechanism.base:
            return (
                f"the row of joint {joint.name!r} leads back to the base, which ties "
                f"the joint variables together"
            )
        if joint.child in placed_by:
            return (
                f"joints {placed_by[joint.child]!r} and {joint.name!r} both place "
                f"{joint.child!r}, which ties the joint variables together"
            )
        placed_by[joint.child] = joint.name
    return ""


def joint_twists(
    mechanism: Mechanism,
    ring: Ring[S],
    origin: str,
    joints: Collection[str] | None = None,
) -> Mapping[str, JointTwist[S]]:
    """The twist of every freedom in the frame of ``origin``, by its label.

    Args:
        mechanism: Any mechanism.
        ring: Where the coordinates live.
        origin: The link whose frame is used; the base in ``posture`` and
            ``reference`` files, which give no frames of links.
        joints: Only these joints; all of them by default.

    Raises:
        UndecidedError: See `freedoms.freedom_twists`.
    """
    if mechanism.geometry == "mdh":
        return _table_twists(mechanism, ring, origin, joints)
    chosen = [j for j in mechanism.joints if joints is None or j.name in joints]
    if mechanism.geometry == "reference":
        _, twists = placed_by_variables(mechanism, ring)
        labels = [label for j in chosen for label in freedom_labels(j, mechanism.space)]
        return {label: twists[label] for label in labels}
    return {
        twist.label: twist
        for joint in chosen
        for twist in freedom_twists(joint, ring, mechanism.space)
    }


def _table_twists(
    mechanism: Mechanism,
    ring: Ring[S],
    origin: str,
    joints: Collection[str] | None,
) -> Mapping[str, JointTwist[S]]:
    placed = placed_links(mechanism, ring, origin, joints)
    twists: dict[str, JointTwist[S]] = {}
    zero = (ring.zero, ring.zero, ring.zero)
    for joint in mechanism.joints:
        if joints is not None and joint.name not in joints:
            continue
        if joint.mdh is None:
            if joint.type not in RIGID:
                twists |= _contact_twists(mechanism, joint, ring, origin)
            continue
        if joint.type in RIGID or joint.child not in placed:
            continue
        frame = placed[joint.child]
        axis = vector.column(frame.rotation, 2)
        point = frame.translation
        name = joint.name
        if joint.type is JointType.PRISMATIC:
            twists[name] = JointTwist(name, 0, zero, axis, point, name)
            continue
        moment = vector.cross(point, axis)
        if joint.type is JointType.HELICAL and joint.pitch is not None:
            advance = vector.scaled(evaluate(joint.pitch, ring), axis)
            moment = vector.add(moment, advance)
        moment = vector.normal(ring, moment)
        twists[name] = JointTwist(name, 0, axis, moment, point, name)
    return twists


def _contact_twists(
    mechanism: Mechanism, joint: Joint, ring: Ring[S], origin: str
) -> Mapping[str, JointTwist[S]]:
    """A contact of an ``mdh`` file stands in the base frame."""
    moved = None
    if origin != mechanism.base:
        placed = placed_links(mechanism, ring, origin)
        if mechanism.base not in placed:
            raise UndecidedError(f"nothing connects {origin!r} with the base")
        moved = placed[mechanism.base]
    twists = freedom_twists(joint, ring, mechanism.space, moved)
    return {twist.label: twist for twist in twists}


TURNING = (JointType.REVOLUTE, JointType.HELICAL)
"""Joints of a table whose variable is an angle."""

MOVING = (JointType.REVOLUTE, JointType.PRISMATIC, JointType.HELICAL)
"""Joints of one freedom."""

GRASPS = (JointType.FIXED, JointType.COMPLETE)
"""Joints that leave no freedom."""
