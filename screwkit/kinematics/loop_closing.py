"""What closed loops demand of joint variables, as polynomials.

Bodies are placed along a tree; every joint outside it closes a loop where what it holds
together is in one place seen from both of its bodies: an axis, a centre, a plane.  Its
own variables do not occur then, but for joints whose angle and advance are tied.

References: [MurrayLiSastry1994] §3.2, [KhalilKleinfinger1986].
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

from screwkit.algebra.ring import Ring, S
from screwkit.errors import UndecidedError
from screwkit.kinematics.freedoms import freedom_twists
from screwkit.kinematics.placement import (
    parent_from_joint,
    placed_links,
    table_joints,
)
from screwkit.kinematics.product_of_exponentials import carried, placed_by_variables
from screwkit.mechanism.graph import closing_tree
from screwkit.mechanism.model import Joint, JointType, Mechanism
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement
from screwkit.screw.vector import Vector


def closing_equations(mechanism: Mechanism, ring: Ring[S]) -> list[S]:
    """Polynomials of the joint variables that vanish exactly where all loops close.

    Args:
        mechanism: A ``reference`` or ``mdh`` file.
        ring: Where the coordinates live.

    Raises:
        UndecidedError: If a joint that closes a loop is of a kind without such
            equations.
    """
    table = mechanism.geometry == "mdh"
    found = _of_table(mechanism, ring) if table else _of_reference(mechanism, ring)
    values = [ring.normal(value) for value in found]
    return [value for value in values if not ring.is_zero(value)]


def _of_table(mechanism: Mechanism, ring: Ring[S]) -> Iterator[S]:
    placed = placed_links(mechanism, ring, mechanism.base)
    for joint in table_joints(mechanism):
        if joint.mdh is None or not {joint.parent, joint.child} <= placed.keys():
            continue
        step = parent_from_joint(joint, joint.mdh, ring)
        one, other = placed[joint.parent].then(step, ring), placed[joint.child]
        axes = [vector.column(frame.rotation, 2) for frame in (one, other)]
        shift = vector.subtract(one.translation, other.translation)
        yield from vector.subtract(*axes)
        if joint.type is JointType.REVOLUTE:
            yield from shift
            continue
        for first, second in zip(one.rotation, other.rotation, strict=True):
            yield from vector.subtract(first, second)
        if joint.type is JointType.PRISMATIC:
            yield from vector.cross(shift, axes[0])
        else:
            yield from shift


def ball_bodies(mechanism: Mechanism) -> dict[str, tuple[Joint, ...]]:
    """Rods and triangles: bodies on two or three spherical joints and nothing else.

    Only the distances of their centres matter, so they need no place of their own.  The
    platform may be one, the base is not.

    Returns:
        By body: the joint by which it is placed, then those that close loops.
    """
    tree = set(closing_tree(mechanism))
    found: dict[str, tuple[Joint, ...]] = {}
    used: set[str] = set()
    for link in mechanism.links:
        own = [j for j in mechanism.joints if link in (j.parent, j.child)]
        names = {joint.name for joint in own}
        if (
            link == mechanism.base
            or not 2 <= len(own) <= _CENTRES
            or {joint.type for joint in own} != {JointType.SPHERICAL}
            or len(names & tree) != 1
            or names & used
        ):
            continue
        used |= names
        found[link] = tuple(sorted(own, key=lambda joint: joint.name not in tree))
    return found


def with_ball_bodies_outside(mechanism: Mechanism) -> Mechanism:
    """The mechanism with all ends of rods and triangles placed by the bodies beside."""
    bodies = ball_bodies(mechanism).items()
    ends = {joint.name: body for body, own in bodies for joint in own}
    joints = tuple(
        replace(joint, parent=joint.child, child=joint.parent)
        if ends.get(joint.name) == joint.parent
        else joint
        for joint in mechanism.joints
    )
    return replace(mechanism, joints=joints)


def _of_reference(mechanism: Mechanism, ring: Ring[S]) -> Iterator[S]:
    tree = set(closing_tree(mechanism))
    placed, _ = placed_by_variables(mechanism, ring)
    outside = ball_bodies(mechanism)
    balls = {joint.name for own in outside.values() for joint in own}
    for body, joints in outside.items():
        yield from _lengths(body, joints, mechanism, ring, placed)
    for joint in mechanism.joints:
        if joint.name not in balls and joint.name not in tree:
            ends = placed[joint.parent], placed[joint.child]
            yield from _between(joint, mechanism, ring, *ends)


def _lengths(
    body: str,
    joints: Sequence[Joint],
    mechanism: Mechanism,
    ring: Ring[S],
    placed: Mapping[str, Displacement[S]],
) -> Iterator[S]:
    """The squared distances of a body's centres, less those at joint variables 0."""
    here, before = [], []
    for joint in joints:
        beside = joint.child if joint.parent == body else joint.parent
        twist = freedom_twists(joint, ring, mechanism.space)[0]
        before.append(twist.point)
        here.append(carried(twist, placed[beside], ring).point)
    for one, other in combinations(range(len(joints)), 2):
        now, then = (vector.subtract(at[one], at[other]) for at in (here, before))
        yield vector.dot(now, now) - vector.dot(then, then)


def _between(
    joint: Joint,
    mechanism: Mechanism,
    ring: Ring[S],
    one: Displacement[S],
    other: Displacement[S],
) -> Iterator[S]:
    """What vanishes where both bodies hold the joint in one place."""
    twists = freedom_twists(joint, ring, mechanism.space)
    kind = joint.type
    if kind is JointType.FIXED:
        for first, second in zip(one.rotation, other.rotation, strict=True):
            yield from vector.subtract(first, second)
        yield from vector.subtract(one.translation, other.translation)
        return
    if kind not in _CLOSING:
        raise UndecidedError(
            f"joint {joint.name!r} ({kind.value}) closes a loop, and no equations of "
            f"its closure are known"
        )
    here, there = (carried(twists[0], place, ring) for place in (one, other))
    shift = vector.subtract(here.point, there.point)
    if kind is JointType.SPHERICAL:
        yield from shift
        return
    if kind is JointType.UNIVERSAL:
        yield from shift
        across = carried(twists[1], other, ring)
        before = vector.dot(twists[0].direction, twists[1].direction)
        yield vector.dot(here.direction, across.direction) - before
        return
    if kind is JointType.PRISMATIC:
        for first, second in zip(one.rotation, other.rotation, strict=True):
            yield from vector.subtract(first, second)
        yield from vector.cross(shift, here.moment)
        return
    axis: Vector[S] = here.direction
    yield from vector.subtract(axis, there.direction)
    if kind is JointType.PLANAR:
        yield vector.dot(shift, axis)
    elif kind is JointType.CYLINDRICAL:
        yield from vector.cross(shift, axis)
    else:
        yield from shift


_CENTRES = 3  # of four, distances alone leave a mirror image
_CLOSING = (
    JointType.REVOLUTE,
    JointType.PRISMATIC,
    JointType.CYLINDRICAL,
    JointType.UNIVERSAL,
    JointType.SPHERICAL,
    JointType.PLANAR,
)
