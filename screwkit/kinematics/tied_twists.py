"""Twists where loops tie joint variables, and all that closed loops demand of these.

Written in all joint variables as if they were free.  Rods between two spherical joints
and triangles of three stay outside: their own turns are in no equation.

References: [MurrayLiSastry1994] §3.2, [Hunt1978] §13.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from screwkit.algebra.ring import Ring, S
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.link_invariants import link_invariants
from screwkit.kinematics.loop_closing import closing_equations, with_ball_bodies_outside
from screwkit.kinematics.placement import joint_twists
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import JointType, Mechanism
from screwkit.screw import vector


def tied_twists(
    mechanism: Mechanism,
    ring: Ring[S],
    origin: str,
    joints: Collection[str] | None = None,
) -> Mapping[str, JointTwist[S]]:
    """The twist of every freedom, spherical joints by rotations about x, y and z.

    Their own angles do not matter then.

    Args:
        mechanism: A ``reference`` or ``mdh`` file.
        ring: Where the coordinates live.
        origin: The link whose frame is used.
        joints: Only these joints; all of them by default.

    Raises:
        UndecidedError: See `freedoms.freedom_twists`.
    """
    placed = with_ball_bodies_outside(mechanism)
    twists = dict(joint_twists(placed, ring, origin, joints))
    zero, one = ring.zero, ring.one
    axes = (one, zero, zero), (zero, one, zero), (zero, zero, one)
    for joint in placed.joints:
        labels = freedom_labels(joint, placed.space)
        if (
            joint.type is not JointType.SPHERICAL
            or placed.space == "planar"
            or not {*labels} <= twists.keys()
        ):
            continue
        centre = twists[labels[0]].point
        for label, axis in zip(labels, axes, strict=True):
            moment = vector.normal(ring, vector.cross(centre, axis))
            twists[label] = twists[label]._replace(
                direction=axis, moment=moment, point=centre
            )
    return twists


def closing_demands(mechanism: Mechanism, ring: Ring[S]) -> list[S]:
    """Polynomials of the joint variables that vanish exactly where all loops close.

    Args:
        mechanism: A ``reference`` or ``mdh`` file.
        ring: Where the coordinates live.

    Raises:
        UndecidedError: See `loop_closing.closing_equations`.
    """
    return closing_equations(with_ball_bodies_outside(mechanism), ring)


def tied_demands(mechanism: Mechanism, ring: Ring[S]) -> list[S]:
    """The same, and short consequences of them after these.

    Args:
        mechanism: A ``reference`` or ``mdh`` file.
        ring: Where the coordinates live.

    Raises:
        UndecidedError: See `loop_closing.closing_equations`.
    """
    return [*closing_demands(mechanism, ring), *link_invariants(mechanism, ring)]
