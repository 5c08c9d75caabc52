"""What closed loops demand of joint variables, as polynomials.

Bodies are placed along a tree; every joint outside it closes a loop where what it holds
together is in one place seen from both of its bodies: an axis, a centre, a plane.  Its
own variables do not occur then, but for joints whose angle and advance are tied.

References: [MurrayLiSastry1994] §3.2, [KhalilKleinfinger1986].
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from screwkit.algebra.ring import Ring, S
from screwkit.errors import UndecidedError
from screwkit.kinematics.freedoms import freedom_twists
from screwkit.kinematics.placement import (
    parent_from_joint,
    placed_links,
    table_joints,
)
from screwkit.kinematics.product_of_exponentials import carried, placed_by_variables
from screwkit.mechanism.graph import spanning_tree
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


def rods(mechanism: Mechanism) -> dict[str, tuple[Joint, Joint]]:
    """Bodies between two spherical joints, through which nothing else is placed.

    Only the distance of their ends matters; how they are turned about it does not.

    Returns:
        By body: the joint by which it is placed, and the one that closes a loop.
    """
    tree = set(spanning_tree(mechanism))
    found = {}
    for link in mechanism.links:
        own = [j for j in mechanism.joints if link in (j.parent, j.child)]
        kinds = {joint.type for joint in own}
        placing = [joint for joint in own if joint.name in tree]
        if len(own) == 2 and kinds == {JointType.SPHERICAL} and len(placing) == 1:
            (closing,) = (joint for joint in own if joint.name not in tree)
            if link not in (mechanism.base, mechanism.platform):
                found[link] = placing[0], closing
    return found


def with_rods_outside(mechanism: Mechanism) -> Mechanism:
    """The mechanism with both ends of every rod placed by the bodies beside it."""
    ends = {j.name: rod for rod, pair in rods(mechanism).items() for j in pair}
    joints = tuple(
        replace(joint, parent=joint.child, child=joint.parent)
        if ends.get(joint.name) == joint.parent
        else joint
        for joint in mechanism.joints
    )
    return replace(mechanism, joints=joints)


def _of_reference(mechanism: Mechanism, ring: Ring[S]) -> Iterator[S]:
    tree = set(spanning_tree(mechanism))
    placed, _ = placed_by_variables(mechanism, ring)
    by_rod = {pair[1].name: (rod, pair) for rod, pair in rods(mechanism).items()}
    for joint in mechanism.joints:
        if joint.name in by_rod:
            yield _length(*by_rod[joint.name], mechanism, ring, placed)
        elif joint.name not in tree:
            ends = placed[joint.parent], placed[joint.child]
            yield from _between(joint, mechanism, ring, *ends)


def _length(
    rod: str,
    ends: Sequence[Joint],
    mechanism: Mechanism,
    ring: Ring[S],
    placed: Mapping[str, Displacement[S]],
) -> S:
    """The squared distance of a rod's ends, less what it is at joint variables 0."""
    here, before = [], []
    for joint in ends:
        beside = joint.child if joint.parent == rod else joint.parent
        twist = freedom_twists(joint, ring, mechanism.space)[0]
        before.append(twist.point)
        here.append(carried(twist, placed[beside], ring).point)
    now, then = (vector.subtract(*pair) for pair in (here, before))
    return vector.dot(now, now) - vector.dot(then, then)


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


_CLOSING = (
    JointType.REVOLUTE,
    JointType.PRISMATIC,
    JointType.CYLINDRICAL,
    JointType.UNIVERSAL,
    JointType.SPHERICAL,
    JointType.PLANAR,
)
