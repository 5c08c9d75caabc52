"""The loops of a joint graph, short ones first.

Every shortest loop through a body closes two branches of a breadth-first tree grown
from it with one joint between them; such loops contain a basis of shortest loops.

References: [Horton1987] (the candidates).
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from screwkit.mechanism.graph import Step
from screwkit.mechanism.model import Joint

_DIGITS = re.compile(r"(\d+)")


def by_name(name: str) -> tuple[tuple[int, int, str], ...]:
    """Sorts names as people do: ``A2`` before ``A10``, whatever order a file has."""
    return tuple(
        (0, int(part), "") if part.isdigit() else (1, 0, part)
        for part in _DIGITS.split(name)
        if part
    )


@dataclass(frozen=True)
class _Tree:
    """A breadth-first tree: for every body the way back and the branch it is on."""

    depth: Mapping[str, int]
    before: Mapping[str, tuple[str, Step]]
    branch: Mapping[str, str]

    def path(self, body: str) -> tuple[Step, ...]:
        steps = []
        while body in self.before:
            body, step = self.before[body]
            steps.append(step)
        return tuple(reversed(steps))


def short_loops(joints: Sequence[Joint]) -> Iterator[tuple[Step, ...]]:
    """Loops without repetition, by the number of their joints, then by name.

    Args:
        joints: Those of the graph; trees that hang on loops do no harm.
    """
    ordered = sorted(joints, key=lambda joint: by_name(joint.name))
    core = _without_dead_ends(ordered)
    adjacent: dict[str, list[tuple[str, Step]]] = {}
    for joint in core:
        adjacent.setdefault(joint.parent, []).append((joint.child, (joint.name, 1)))
        adjacent.setdefault(joint.child, []).append((joint.parent, (joint.name, -1)))
    trees = [_grown(root, adjacent) for root in _roots(core, adjacent)]
    candidates = []
    for number, tree in enumerate(trees):
        used = {step[0] for _, step in tree.before.values()}
        for place, joint in enumerate(core):
            one, other = joint.parent, joint.child
            if joint.name in used or one not in tree.depth:
                continue
            if tree.branch.get(one, "") != tree.branch.get(other, " "):
                length = tree.depth[one] + tree.depth[other] + 1
                candidates.append((length, place, number))
    seen: set[frozenset[str]] = set()
    for _, place, number in sorted(candidates):
        joint, tree = core[place], trees[number]
        back = reversed(tree.path(joint.child))
        loop = (
            *tree.path(joint.parent),
            (joint.name, 1),
            *((name, -sign) for name, sign in back),
        )
        members = frozenset(name for name, _ in loop)
        if members not in seen:
            seen.add(members)
            yield from_first(loop)


def from_first(loop: tuple[Step, ...]) -> tuple[Step, ...]:
    """The loop from the joint whose name comes first, towards the lesser neighbour.

    >>> from_first((("C", 1), ("A", -1), ("D", 1), ("B", 1)))
    (('A', 1), ('C', -1), ('B', -1), ('D', -1))
    """
    start = min(range(len(loop)), key=lambda i: by_name(loop[i][0]))
    turned = (*loop[start:], *loop[:start])
    if len(loop) > 2 and by_name(turned[-1][0]) < by_name(turned[1][0]):
        backwards = (turned[0], *reversed(turned[1:]))
        return tuple((joint, -sign) for joint, sign in backwards)
    return turned


def _roots(
    core: Sequence[Joint], adjacent: Mapping[str, Sequence[object]]
) -> list[str]:
    """Bodies where loops part; one of every loop that stands alone."""
    roots = [body for body in adjacent if len(adjacent[body]) > 2]
    reached: set[str] = set()
    neighbours: dict[str, set[str]] = {}
    for joint in core:
        neighbours.setdefault(joint.parent, set()).add(joint.child)
        neighbours.setdefault(joint.child, set()).add(joint.parent)

    def reach(body: str) -> None:
        waiting = [body]
        while waiting:
            here = waiting.pop()
            if here not in reached:
                reached.add(here)
                waiting.extend(neighbours[here])

    for body in roots:
        reach(body)
    for body in adjacent:
        if body not in reached:
            roots.append(body)
            reach(body)
    return roots


def _without_dead_ends(joints: Sequence[Joint]) -> list[Joint]:
    """The joints less the trees that hang on the loops."""
    degree: dict[str, int] = {}
    at: dict[str, list[Joint]] = {}
    for joint in joints:
        for body in (joint.parent, joint.child):
            degree[body] = degree.get(body, 0) + 1
            at.setdefault(body, []).append(joint)
    gone: set[str] = set()
    waiting = [body for body, count in degree.items() if count == 1]
    while waiting:
        for joint in at[waiting.pop()]:
            if joint.name in gone:
                continue
            gone.add(joint.name)
            for body in (joint.parent, joint.child):
                degree[body] -= 1
                if degree[body] == 1:
                    waiting.append(body)
    return [joint for joint in joints if joint.name not in gone]


def _grown(root: str, adjacent: Mapping[str, Sequence[tuple[str, Step]]]) -> _Tree:
    depth = {root: 0}
    branch: dict[str, str] = {}
    before: dict[str, tuple[str, Step]] = {}
    waiting = deque([root])
    while waiting:
        here = waiting.popleft()
        for there, step in adjacent[here]:
            if there not in depth:
                depth[there] = depth[here] + 1
                before[there] = here, step
                branch[there] = branch.get(here, step[0])
                waiting.append(there)
    return _Tree(depth, before, branch)
