"""The order in which the freedoms of a mechanism are passed on the way to its bodies.

Bodies hang on a spanning forest, and every joint outside it closes one loop: the
fundamental loop that runs to its far side and to its child along the forest.

References: [LongCaroKhalil2012] eqs. (4)-(9).
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.finite.posture_model import PostureModel

Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Level:
    """Freedoms that can be passed at once, with the nodes before and behind them."""

    freedoms: Indices
    before: Indices
    behind: Indices


@dataclass(frozen=True, eq=False)
class Forest:
    """The order in which freedoms are passed on the way to every body.

    Nodes are the bodies, the places between two freedoms of one joint, and the far
    side of every joint that closes a loop.

    Attributes:
        levels: The freedoms, outwards from the roots.
        before: The node before each freedom, shape (freedoms,).
        signs: −1 where a joint is passed from child to parent, shape (freedoms,).
        ways: The signed freedoms on the way to each node, shape (nodes, freedoms).
        closing: Node on the far side of each closing joint, and the child's node.
        closing_joints: Names of the joints that close the loops.
        nodes: The node of each link.
        platform: Whether base and platform hang together, and the platform's node.
        tracked: The nodes whose displacements are kept.
        balls: The first freedom of every ball joint.
    """

    levels: tuple[Level, ...]
    before: Indices
    signs: Array
    ways: Array
    closing: tuple[Indices, Indices]
    closing_joints: tuple[str, ...]
    nodes: dict[str, int]
    platform: tuple[bool, int]
    tracked: Indices
    balls: Indices

    @property
    def behind(self) -> Indices:
        """The node behind each freedom, shape (freedoms,)."""
        found = np.zeros_like(self.before)
        for level in self.levels:
            found[level.freedoms] = level.behind
        return found

    @property
    def loop_signs(self) -> Array:
        """How each freedom is passed in each loop, shape (loops, freedoms)."""
        far, near = self.closing
        return np.asarray(self.ways[far] - self.ways[near])


def forest_of(model: PostureModel) -> Forest:
    """A breadth-first spanning forest, the base's tree first."""
    offsets = np.cumsum([0, *(len(joint.screws) for joint in model.joints)])
    builder = _Builder(int(offsets[-1]))
    touching: dict[str, list[int]] = {link: [] for link in model.links}
    for number, joint in enumerate(model.joints):
        touching[joint.parent].append(number)
        touching[joint.child].append(number)
    nodes: dict[str, int] = {}
    roots: dict[str, str] = {}
    tree: set[int] = set()
    for root in (model.base, *model.links):
        if root in nodes:
            continue
        nodes[root], roots[root] = builder.root(), root
        queue = deque([root])
        while queue:
            here = queue.popleft()
            for number in touching[here]:
                joint = model.joints[number]
                there = joint.child if joint.parent == here else joint.parent
                if there in nodes:
                    continue
                outwards = joint.parent == here
                span = range(offsets[number], offsets[number + 1])
                nodes[there] = builder.passed(nodes[here], span, outwards)
                roots[there] = root
                tree.add(number)
                queue.append(there)
    closing = [n for n in range(len(model.joints)) if n not in tree]
    far = [
        builder.passed(
            nodes[model.joints[n].parent], range(offsets[n], offsets[n + 1]), True
        )
        for n in closing
    ]
    near = [nodes[model.joints[n].child] for n in closing]
    return Forest(
        levels=builder.levels(),
        before=np.array(builder.before, dtype=np.intp),
        signs=np.array(builder.signs),
        ways=np.array(builder.ways).reshape(len(builder.ways), -1),
        closing=(np.array(far, dtype=np.intp), np.array(near, dtype=np.intp)),
        closing_joints=tuple(model.joints[n].name for n in closing),
        nodes=nodes,
        platform=(roots[model.platform] == model.base, nodes[model.platform]),
        tracked=np.array([nodes[model.platform]], dtype=np.intp),
        balls=np.array(
            [offsets[n] for n, joint in enumerate(model.joints) if joint.ball],
            dtype=np.intp,
        ),
    )


class _Builder:
    """Grows the nodes of a forest."""

    def __init__(self, freedoms: int) -> None:
        self.before = [0] * freedoms
        self.behind = [0] * freedoms
        self.signs = [1.0] * freedoms
        self.ways: list[Array] = []
        self.depths: list[int] = []
        self.freedoms = freedoms

    def root(self) -> int:
        self.ways.append(np.zeros(self.freedoms))
        self.depths.append(0)
        return len(self.ways) - 1

    def passed(self, node: int, span: range, outwards: bool) -> int:
        """The node behind a joint; a joint passed backwards is passed last to first."""
        for freedom in span if outwards else reversed(span):
            sign = 1.0 if outwards else -1.0
            way = self.ways[node].copy()
            way[freedom] = sign
            self.ways.append(way)
            self.depths.append(self.depths[node] + 1)
            self.before[freedom], self.signs[freedom] = node, sign
            node = self.behind[freedom] = len(self.ways) - 1
        return node

    def levels(self) -> tuple[Level, ...]:
        depth_of = [self.depths[node] for node in self.behind]
        levels = []
        for depth in sorted(set(depth_of)):
            chosen = [f for f, d in enumerate(depth_of) if d == depth]
            before = [self.before[f] for f in chosen]
            behind = [self.behind[f] for f in chosen]
            levels.append(
                Level(*(np.array(x, dtype=np.intp) for x in (chosen, before, behind)))
            )
        return tuple(levels)
