"""Who carries what in a state of self-stress: joints in series, taken together.

Where only two joints of the state meet at a body they transmit the same wrench.  Such
joints of one limb are one carrier, whose wrench is written as it acts away from the
base, or around the loop where there is no such end.

References: [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from screwkit.kinematics.network import Network
from screwkit.reasons.readable_screws import Row
from screwkit.reasons.self_stress import SelfStress
from screwkit.reasons.short_loops import by_name


@dataclass(frozen=True)
class Carrier:
    """Joints in series that transmit one wrench.

    Attributes:
        joints: In the order in which they are passed.
        limb: The limb they belong to; empty where they belong to none.
        wrench: (f; m) that the side of the first joint exerts on that of the last.
        closed: Whether they are a whole loop.
    """

    joints: tuple[str, ...]
    limb: str
    wrench: Row
    closed: bool


def carriers(network: Network, stress: SelfStress, prime: int) -> tuple[Carrier, ...]:
    """The carriers of a state of self-stress, limb by limb."""
    limb_of = {joint: limb.name for limb in network.limbs for joint in limb.joints}
    depth = {network.mechanism.base: 0}
    for link, (before, _) in network.steps.items():
        depth[link] = depth.get(before, 0) + 1
    ends: dict[str, tuple[str, str]] = {}
    meeting: dict[str, list[str]] = {}
    for joint in network.mechanism.joints:
        if joint.name in stress.wrenches:
            ends[joint.name] = joint.parent, joint.child
            for body in ends[joint.name]:
                meeting.setdefault(body, []).append(joint.name)
    found = []
    seen: set[str] = set()
    for first in sorted(stress.wrenches, key=by_name):
        if first in seen:
            continue
        chain, start, end = _chain(first, ends, meeting, limb_of)
        closed = start == end and len(meeting[start]) == 2
        if depth.get(end, 0) < depth.get(start, 0):
            chain, start = chain[::-1], end
        seen.update(chain)
        sign = 1 if ends[chain[0]][0] == start else -1
        wrench = tuple(sign * x % prime for x in stress.wrenches[chain[0]])
        found.append(Carrier(tuple(chain), limb_of.get(first, ""), wrench, closed))
    return tuple(sorted(found, key=lambda c: (c.limb == "", by_name(c.limb))))


def limb_wrenches(
    network: Network, stress: SelfStress, prime: int
) -> Mapping[str, Row]:
    """What each limb that takes part exerts on the platform; together nothing."""
    platform = network.mechanism.platform
    at_platform = {
        joint.name: 1 if joint.child == platform else -1
        for joint in network.mechanism.joints
        if platform in (joint.parent, joint.child)
    }
    totals: dict[str, Row] = {}
    for limb in sorted(network.limbs, key=lambda limb: by_name(limb.name)):
        total: Row = (0,) * 6
        for name in limb.joints:
            if name in stress.wrenches and name in at_platform:
                sign, wrench = at_platform[name], stress.wrenches[name]
                pairs = zip(total, wrench, strict=True)
                total = tuple((a + sign * b) % prime for a, b in pairs)
        if any(total):
            totals[limb.name] = total
    return totals


def _chain(
    first: str,
    ends: Mapping[str, tuple[str, str]],
    meeting: Mapping[str, list[str]],
    limb_of: Mapping[str, str],
) -> tuple[list[str], str, str]:
    """The series that a joint is part of, with the bodies where it begins and ends."""
    chain = [first]
    start, end = ends[first]
    for forwards in (True, False):
        body = end if forwards else start
        while True:
            here = chain[-1] if forwards else chain[0]
            other = [joint for joint in meeting[body] if joint != here]
            if (
                len(meeting[body]) != 2
                or other[0] in chain
                or limb_of.get(other[0], "") != limb_of.get(here, "")
            ):
                break
            (joint,) = other
            chain.insert(len(chain) if forwards else 0, joint)
            one, two = ends[joint]
            body = two if one == body else one
        if forwards:
            end = body
        else:
            start = body
    return chain, start, end
