"""A basis of short loops: every new one closes with joints that are there already.

Joints are added in the order of a sweep from the base.  One whose two bodies are
connected already closes a loop, for which the shortest way back is taken; it holds one
joint that no earlier loop has, so the loops are independent.  In a long chain of cells
each loop stays within its cell, where loops through a spanning tree may grow with the
chain.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from screwkit.mechanism.graph import Step
from screwkit.mechanism.model import Joint, Mechanism

Neighbours: TypeAlias = dict[str, list[tuple[str, Step]]]


def short_loops(mechanism: Mechanism) -> tuple[tuple[Step, ...], ...]:
    """Independent loops, joints − links + components of them.

    Returns:
        For each loop its joints in order, with +1 where a joint is passed from parent
        to child; the loop begins with the joint that closes it.
    """
    neighbours: Neighbours = {link: [] for link in mechanism.links}
    leader = {link: link for link in mechanism.links}
    loops = []
    for joint in _swept(mechanism):
        start, end = joint.child, joint.parent
        one, other = _leader(leader, start), _leader(leader, end)
        if one == other:
            loops.append(((joint.name, 1), *_shortest(neighbours, start, end)))
        leader[one] = other
        _connect(neighbours, joint)
    return tuple(loops)


def held_loops(mechanism: Mechanism) -> tuple[tuple[Step, ...], ...]:
    """The same where the platform is rigidly connected with the base.

    The joint that connects them stands in a loop by a name that is none of the file's.
    Nothing changes where one body is both.
    """
    if mechanism.base == mechanism.platform:
        return short_loops(mechanism)
    first = mechanism.joints[0]
    name = "held" + max((joint.name for joint in mechanism.joints), key=len)
    weld = replace(first, name=name, parent=mechanism.base, child=mechanism.platform)
    return short_loops(replace(mechanism, joints=(*mechanism.joints, weld)))


def way_to_platform(mechanism: Mechanism) -> tuple[Step, ...]:
    """The shortest way from the base to the platform; none where they are one body."""
    if mechanism.base == mechanism.platform:
        return ()
    neighbours: Neighbours = {link: [] for link in mechanism.links}
    for joint in mechanism.joints:
        _connect(neighbours, joint)
    return _shortest(neighbours, mechanism.base, mechanism.platform)


def _connect(neighbours: Neighbours, joint: Joint) -> None:
    neighbours[joint.parent].append((joint.child, (joint.name, 1)))
    neighbours[joint.child].append((joint.parent, (joint.name, -1)))


def _swept(mechanism: Mechanism) -> Sequence[Joint]:
    """The joints by the later of their two bodies in a sweep from the base."""
    touching: dict[str, list[Joint]] = {link: [] for link in mechanism.links}
    for joint in mechanism.joints:
        touching[joint.parent].append(joint)
        touching[joint.child].append(joint)
    reached: dict[str, int] = {}
    for root in (mechanism.base, *mechanism.links):
        if root in reached:
            continue
        reached[root] = len(reached)
        waiting = deque([root])
        while waiting:
            here = waiting.popleft()
            for joint in touching[here]:
                there = joint.child if joint.parent == here else joint.parent
                if there not in reached:
                    reached[there] = len(reached)
                    waiting.append(there)
    return sorted(
        mechanism.joints,
        key=lambda joint: (
            max(reached[joint.parent], reached[joint.child]),
            min(reached[joint.parent], reached[joint.child]),
        ),
    )


def _leader(leader: dict[str, str], link: str) -> str:
    while leader[link] != link:
        leader[link] = leader[leader[link]]
        link = leader[link]
    return link


def _shortest(neighbours: Neighbours, start: str, end: str) -> tuple[Step, ...]:
    """The shortest way between two connected bodies, searched from both of them."""
    sides: tuple[dict[str, tuple[str, Step] | None], ...] = ({start: None}, {end: None})
    fronts = [[start], [end]]
    while True:
        side = 0 if len(fronts[0]) <= len(fronts[1]) else 1
        own, opposite = sides[side], sides[1 - side]
        following = []
        for here in fronts[side]:
            for there, step in neighbours[here]:
                if there in own:
                    continue
                own[there] = here, step
                if there in opposite:
                    return (*_back(sides[0], there), *_turned(_back(sides[1], there)))
                following.append(there)
        fronts[side] = following


def _back(before: Mapping[str, tuple[str, Step] | None], link: str) -> tuple[Step, ...]:
    """The steps from where a search began to a body that it reached."""
    steps = []
    while (found := before[link]) is not None:
        link, step = found
        steps.append(step)
    return tuple(reversed(steps))


def _turned(steps: Sequence[Step]) -> tuple[Step, ...]:
    return tuple((name, -sign) for name, sign in reversed(steps))
