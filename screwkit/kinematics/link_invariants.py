"""What a rigid link says of the rest of its loop: short consequences of closure.

Two axes on one link keep their angle and their mutual moment, two pivots of a planar
link their distance.  Seen along the rest of the loop these are functions of all joint
variables but those of the two axes, so that a loop of four gives equations in two
variables each.

References: [Hunt1978] §13.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from screwkit.algebra.ring import Ring, S
from screwkit.kinematics.freedoms import JointTwist, freedom_twists
from screwkit.kinematics.loop_basis import short_loops
from screwkit.kinematics.product_of_exponentials import carried, placed_by_variables
from screwkit.mechanism.graph import Step
from screwkit.mechanism.model import JointType, Mechanism
from screwkit.screw import vector


def link_invariants(mechanism: Mechanism, ring: Ring[S]) -> list[S]:
    """Polynomials of the joint variables that vanish wherever all loops close.

    They need not be enough to close a loop.  Of loops of hinges alone, in files that
    say where their axes are at joint variables 0; of others there are none.

    Args:
        mechanism: A ``reference`` or ``mdh`` file.
        ring: Where the coordinates live.
    """
    if mechanism.geometry != "reference":
        return []
    hinges = {j.name for j in mechanism.joints if j.type is JointType.REVOLUTE}
    found: list[S] = []
    for loop in short_loops(mechanism):
        if len(loop) > 3 and all(name in hinges for name, _ in loop):
            for first in range(len(loop)):
                around = [*loop[first:], *loop[:first]]
                found += _of_link(mechanism, around, ring)
    values = [ring.normal(value) for value in found]
    return [value for value in values if not ring.is_zero(value)]


def _of_link(
    mechanism: Mechanism, around: Sequence[Step], ring: Ring[S]
) -> Iterator[S]:
    """Of the link between the last and the first joint of a loop."""
    (first, onwards), *between, (last, arriving) = around
    one, other = mechanism.joint(first), mechanism.joint(last)
    start = one.child if onwards > 0 else one.parent
    end = other.parent if arriving > 0 else other.child
    rest = replace(
        mechanism,
        base=start,
        platform=end,
        joints=tuple(mechanism.joint(name) for name, _ in between),
    )
    placed, _ = placed_by_variables(rest, ring)
    here, there = (
        freedom_twists(joint, ring, mechanism.space)[0] for joint in (one, other)
    )
    moved = carried(there, placed[end], ring)
    measures = [_angle, _mutual_moment]
    if mechanism.space == "planar":
        measures = [_distance]
    for measure in measures:
        yield measure(here, moved) - measure(here, there)


def _angle(one: JointTwist[S], other: JointTwist[S]) -> S:
    return vector.dot(one.direction, other.direction)


def _mutual_moment(one: JointTwist[S], other: JointTwist[S]) -> S:
    """The reciprocal product of the two lines."""
    return vector.dot(one.direction, other.moment) + vector.dot(
        one.moment, other.direction
    )


def _distance(one: JointTwist[S], other: JointTwist[S]) -> S:
    apart = vector.subtract(one.point, other.point)
    return vector.dot(apart, apart)
