"""Where the bodies of a ``reference`` file are, over any ring.

Axes and points hold at joint variables 0; every freedom then moves what follows it by
the exponential of its twist.  Bodies are placed along a spanning forest.  Of a joint
that closes a loop the first freedom is where its parent is and those after it where its
child is, which is right on closed postures and needs none of its own variables: these
need not be known where loops are closed by their axes alone.

References: [MurrayLiSastry1994] §3.2.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.expression import Call, Expression, Power, Sum
from screwkit.algebra.expression_building import multiply
from screwkit.algebra.ring import Ring, S
from screwkit.kinematics.freedoms import JointTwist, freedom_twists
from screwkit.mechanism.graph import closing_tree
from screwkit.mechanism.joints import is_actuable
from screwkit.mechanism.model import Joint, JointType, Mechanism, variable_value
from screwkit.mechanism.vanishing import is_zero
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement
from screwkit.screw.vector import Vector

_FIXED_AT_BOTH_ENDS = (
    JointType.UNIVERSAL,
    JointType.CYLINDRICAL,
    JointType.PLANAR,
)
"""Joints whose first freedom keeps to the parent, and whose others to the child."""


def exponential(twist: JointTwist[S], joint: Joint, ring: Ring[S]) -> Displacement[S]:
    """The displacement that a freedom makes when its variable goes from 0 to its value.

    Args:
        twist: At joint variables 0, in base axes about the base origin.
        joint: Whose freedom it is.
        ring: Where the coordinates live.
    """
    value = variable_value(joint, twist.freedom)
    along = twist.moment if _slides(joint, twist.freedom) else twist.direction
    unit = _unit(along, _possible_squares(joint, twist.freedom), ring)
    if _slides(joint, twist.freedom):
        shift = vector.scaled(evaluate(value, ring), unit)
        still = Displacement.identity(ring)
        return Displacement(still.rotation, vector.normal(ring, shift))
    cosine, sine = cosine_sine(value, ring)
    rest = ring.normal(ring.one - cosine)
    rows = []
    for i in range(3):
        row = [ring.normal(rest * unit[i] * unit[j]) for j in range(3)]
        row[i] = row[i] + cosine
        row[(i + 1) % 3] = row[(i + 1) % 3] - sine * unit[(i + 2) % 3]
        row[(i + 2) % 3] = row[(i + 2) % 3] + sine * unit[(i + 1) % 3]
        rows.append(vector.normal(ring, row))
    rotation = (rows[0], rows[1], rows[2])
    shift = vector.subtract(twist.point, vector.rotate(rotation, twist.point))
    if joint.type is JointType.HELICAL and joint.pitch is not None:
        advance = evaluate(joint.pitch, ring) * evaluate(value, ring)
        shift = vector.add(shift, vector.scaled(advance, unit))
    return Displacement(rotation, vector.normal(ring, shift))


def placed_by_variables(
    mechanism: Mechanism, ring: Ring[S]
) -> tuple[Mapping[str, Displacement[S]], Mapping[str, JointTwist[S]]]:
    """Where every body is, and the twist of every freedom, by link and by label.

    Args:
        mechanism: A ``reference`` file.
        ring: Where the coordinates live.

    Returns:
        base_from_link for every link (the identity at joint variables 0), and the
        twists in base axes about the base origin.
    """
    tree = set(closing_tree(mechanism))
    placed: dict[str, Displacement[S]] = {}
    twists: dict[str, JointTwist[S]] = {}
    neighbours: dict[str, list[tuple[Joint, bool]]] = {}
    for joint in mechanism.joints:
        if joint.name in tree:
            neighbours.setdefault(joint.parent, []).append((joint, True))
            neighbours.setdefault(joint.child, []).append((joint, False))
    for root in (mechanism.base, *mechanism.links):
        if root in placed:
            continue
        placed[root] = Displacement.identity(ring)
        stack = [root]
        while stack:
            link = stack.pop()
            for joint, outwards in neighbours.get(link, ()):
                other = joint.child if outwards else joint.parent
                if other in placed:
                    continue
                step, _ = _moved(joint, mechanism, ring, Displacement.identity(ring))
                if not outwards:
                    step = step.inverse(ring)
                placed[other] = placed[link].then(step, ring)
                stack.append(other)
    for joint in mechanism.joints:
        _, own = _moved(joint, mechanism, ring, placed[joint.parent])
        if joint.name not in tree and joint.type in _FIXED_AT_BOTH_ENDS:
            still = freedom_twists(joint, ring, mechanism.space)[1:]
            behind = (carried(twist, placed[joint.child], ring) for twist in still)
            own = (own[0], *behind)
        twists |= {twist.label: twist for twist in own}
    return placed, twists


def _moved(
    joint: Joint, mechanism: Mechanism, ring: Ring[S], parent: Displacement[S]
) -> tuple[Displacement[S], tuple[JointTwist[S], ...]]:
    """Where the child is, and the joint's twists there, from where the parent is."""
    here, twists = parent, []
    for twist in freedom_twists(joint, ring, mechanism.space):
        twists.append(carried(twist, here, ring))
        if is_actuable(joint.type):
            here = here.then(exponential(twist, joint, ring), ring)
    return here, tuple(twists)


def carried(twist: JointTwist[S], by: Displacement[S], ring: Ring[S]) -> JointTwist[S]:
    """The twist after a displacement of the body on which its axis is fixed."""
    direction = vector.normal(ring, vector.rotate(by.rotation, twist.direction))
    turned = vector.rotate(by.rotation, twist.moment)
    shifted = vector.cross(by.translation, direction)
    point = vector.add(vector.rotate(by.rotation, twist.point), by.translation)
    return twist._replace(
        direction=direction,
        moment=vector.normal(ring, vector.add(turned, shifted)),
        point=vector.normal(ring, point),
    )


def _slides(joint: Joint, freedom: int) -> bool:
    return joint.type is JointType.PRISMATIC or (
        joint.type in {JointType.CYLINDRICAL, JointType.PLANAR} and freedom > 0
    )


def _possible_squares(joint: Joint, freedom: int) -> tuple[Expression, ...]:
    """Squares of lengths, as the file writes them, one of which is the axis's.

    A planar joint slides along a product of its normal with a unit vector, whose square
    is that of two of the normal's coordinates, and along a product of the normal with
    that; empty where the axis is a unit vector.
    """
    if joint.type is JointType.PLANAR and joint.normal is not None and freedom:
        x, y, z = (Power(part, 2) for part in joint.normal)
        pairs = Sum((x, y)), Sum((y, z)), Sum((z, x))
        # A side has a length, and what is zero would be no divisor.
        first = tuple(square for square in pairs if not is_zero(square))
        if freedom == 1:
            return first
        return tuple(multiply(Sum((x, y, z)), square) for square in first)
    if joint.type is JointType.UNIVERSAL:
        written: tuple[Expression, ...] | None = joint.axes[freedom]
    elif joint.type is JointType.PLANAR:
        written = joint.normal
    else:
        written = joint.axes[0] if joint.axes else None
    return () if written is None else (Sum(tuple(Power(p, 2) for p in written)),)


def _unit(along: Vector[S], squares: Sequence[Expression], ring: Ring[S]) -> Vector[S]:
    """The direction divided by its length, whose square is one of those given."""
    if not squares:
        return along
    square = ring.normal(vector.dot(along, along))
    equal = [
        written
        for written in squares
        if ring.is_zero(ring.normal(evaluate(written, ring) - square))
    ]
    shrink = ring.one
    # Where nothing can be compared, as in a survey, all of them may be needed.
    for written in equal[:1] or squares:
        length = ring.square_root(written, square)
        shrink = ring.inverse(Call("sqrt", (written,)), length)
    return vector.normal(ring, vector.scaled(shrink, along))
