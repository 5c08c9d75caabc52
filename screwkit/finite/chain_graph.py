"""The freedoms of a posture as a graph with one screw an edge, modulo a prime.

A joint of several freedoms is a chain of edges with bodies in between, in the order of
its freedoms.  Freedoms may share a parameter and edges may stand for motions that no
joint has; what is proved of such a graph, `closing_groups` brings back to the
mechanism.

References: [Hunt1978].
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from screwkit.algebra.elimination_modulo import Eliminated, eliminated
from screwkit.finite.lie_closure import ResidueScrew, Span, Word
from screwkit.kinematics.network import Motion
from screwkit.mechanism.model import JointType

Cycle: TypeAlias = tuple[tuple[int, int], ...]
"""Numbers of edges with +1 or −1 for the direction, in the order of the walk."""

_STEPS = 4000

INNER = "after "
"""Begins the name of a body between two freedoms of a joint."""


@dataclass(frozen=True)
class Edge:
    """One freedom between two bodies, or a rigid connection.

    Attributes:
        name: Label of the freedom.
        screw: Empty for rigid connections.
        parameter: The column of its rate; −1 for rigid connections.
    """

    name: str
    tail: str
    head: str
    screw: ResidueScrew = ()
    parameter: int = -1


@dataclass(frozen=True)
class ChainGraph:
    """Edges with screws at one posture.

    Attributes:
        edges: Parallel edges are allowed.
        width: Number of parameters.
        prime: The modulus.
        loops: A basis of short loops by the names of edges, where it is known.
    """

    edges: tuple[Edge, ...]
    width: int
    prime: int
    loops: tuple[tuple[tuple[str, int], ...], ...] = ()

    @cached_property
    def neighbours(self) -> Mapping[str, Sequence[tuple[int, int, str]]]:
        """For every body the edges that leave it: number, sign, the other body."""
        found: dict[str, list[tuple[int, int, str]]] = {}
        for number, edge in enumerate(self.edges):
            found.setdefault(edge.tail, []).append((number, 1, edge.head))
            found.setdefault(edge.head, []).append((number, -1, edge.tail))
        return found

    @cached_property
    def paths(self) -> Mapping[str, Cycle]:
        """The way to every body from the first of its component, shortest first."""
        paths: dict[str, Cycle] = {}
        for root in self.neighbours:
            if root not in paths:
                paths[root] = ()
                waiting = deque([root])
                while waiting:
                    here = waiting.popleft()
                    for number, sign, there in self.neighbours[here]:
                        if there not in paths:
                            paths[there] = (*paths[here], (number, sign))
                            waiting.append(there)
        return paths

    @cached_property
    def fundamental_cycles(self) -> tuple[Cycle, ...]:
        """A basis: the known loops, or one for every edge outside a tree."""
        if self.loops:
            number_of = {edge.name: number for number, edge in enumerate(self.edges)}
            return tuple(
                tuple((number_of[name], sign) for name, sign in loop)
                for loop in self.loops
            )
        paths = self.paths
        tree = {path[-1][0] for path in paths.values() if path}
        cycles = []
        for number, edge in enumerate(self.edges):
            if number not in tree:
                out, back = paths[edge.tail], paths[edge.head]
                shared = 0
                while out[shared : shared + 1] == back[shared : shared + 1] != ():
                    shared += 1
                home = tuple((k, -s) for k, s in reversed(back[shared:]))
                cycles.append((*out[shared:], (number, 1), *home))
        return tuple(cycles)

    def word(self, cycle: Cycle) -> Word:
        """The factors of the displacement along a walk."""
        prime, found = self.prime, []
        for number, sign in cycle:
            edge = self.edges[number]
            if edge.screw:
                signed = tuple(sign * x % prime for x in edge.screw)
                found.append((edge.parameter, signed))
        return tuple(found)

    def closure_rows(self, cycles: Iterable[Cycle]) -> list[dict[int, int]]:
        """Six rows a cycle of the matrix that maps rates to the twists to vanish.

        Rows are residues by parameter, zeros absent; a row may be empty.
        """
        rows: list[dict[int, int]] = []
        for cycle in cycles:
            own: list[dict[int, int]] = [{} for _ in range(6)]
            for parameter, screw in self.word(cycle):
                for row, value in zip(own, screw, strict=True):
                    row[parameter] = (row.get(parameter, 0) + value) % self.prime
            rows.extend({c: x for c, x in row.items() if x} for row in own)
        return rows

    @cached_property
    def closed(self) -> Eliminated:
        """The loop equations in echelon form."""
        rows = self.closure_rows(self.fundamental_cycles)
        return eliminated(rows, self.width, self.prime)

    @property
    def rank(self) -> int:
        """Rank of the loop equations."""
        return self.closed.rank

    @cached_property
    def rates(self) -> tuple[Mapping[int, int], ...]:
        """Basis of the rates that close the loops."""
        return tuple(self.closed.null_vectors())

    @property
    def mobility(self) -> int:
        """Dimension of the rates."""
        return self.width - self.rank

    def body_twists(self) -> Mapping[str, Sequence[ResidueScrew]]:
        """For every body its twist under each basis vector of `rates`."""
        prime = self.prime
        still = (0,) * 6
        twists: dict[str, list[ResidueScrew]] = {}
        for body, path in self.paths.items():
            if not path:
                twists[body] = [still] * len(self.rates)
                continue
            number, sign = path[-1]
            edge = self.edges[number]
            before = twists[edge.tail if sign > 0 else edge.head]
            twists[body] = [
                tuple(
                    (x + sign * rates.get(edge.parameter, 0) * y) % prime
                    for x, y in zip(twist, edge.screw or still, strict=True)
                )
                for twist, rates in zip(before, self.rates, strict=True)
            ]
        return twists

    def simple_cycles(self, most: int) -> tuple[Cycle, ...]:
        """Cycles that meet no body twice, at most so many, fundamental ones first."""
        found = {frozenset(n for n, _ in c): c for c in self.fundamental_cycles}
        for cycle in self._cycles_by_search():
            found.setdefault(frozenset(n for n, _ in cycle), cycle)
            if len(found) >= most:
                break
        return tuple(found.values())

    def _cycles_by_search(self) -> Iterator[Cycle]:
        """Each cycle once, from its edge of the least number; gives up when long."""
        left = _STEPS
        for least, edge in enumerate(self.edges):
            first: Cycle = ((least, 1),)
            stack = [(edge.head, first, frozenset({edge.tail, edge.head}))]
            while stack and left:
                left -= 1
                here, way, met = stack.pop()
                for number, sign, there in self.neighbours[here]:
                    if number > least and there == edge.tail:
                        yield (*way, (number, sign))
                    elif number > least and there not in met:
                        stack.append((there, (*way, (number, sign)), met | {there}))

    def blocks(self) -> tuple[ChainGraph, ...]:
        """The parts whose loops share no edge; edges on no loop are left out."""
        leader = list(range(len(self.edges)))

        def find(number: int) -> int:
            while leader[number] != number:
                leader[number] = leader[leader[number]]
                number = leader[number]
            return number

        looped: set[int] = set()
        for cycle in self.fundamental_cycles:
            looped.update(n for n, _ in cycle)
            for number, _ in cycle[1:]:
                leader[find(number)] = find(cycle[0][0])
        groups: dict[int, list[Edge]] = {}
        for number in sorted(looped):
            groups.setdefault(find(number), []).append(self.edges[number])
        return tuple(
            with_parameters(edges, self.prime, self.loops) for edges in groups.values()
        )


def with_parameters(
    edges: Iterable[Edge],
    prime: int,
    loops: Iterable[tuple[tuple[str, int], ...]] = (),
) -> ChainGraph:
    """The edges alone, their parameters numbered anew; ties stay ties.

    Of the loops those on these edges are kept.
    """
    numbers: dict[int, int] = {}
    kept = []
    for edge in edges:
        number = -1
        if edge.screw:
            number = numbers.setdefault(edge.parameter, len(numbers))
        same = edge.parameter == number
        kept.append(edge if same else replace(edge, parameter=number))
    names = {edge.name for edge in kept}
    own = tuple(loop for loop in loops if loop[0][0] in names)
    return ChainGraph(tuple(kept), len(numbers), prime, own)


def chain_graph(motion: Motion, held: Collection[str] = ()) -> ChainGraph:
    """The graph of a mechanism at a posture; locked and held freedoms are rigid.

    The factors of a ball joint come in the order of its freedoms where it leads away
    from a body an even number of joints from the base, and backwards elsewhere: then
    two balls of a rod undo each other by opposite angles, factor by factor.
    """
    network, posture = motion.network, motion.posture
    far = joints_away(
        ((j.parent, j.child) for j in network.mechanism.joints), network.mechanism.base
    )
    orders: dict[str, tuple[str, ...]] = {}
    edges: list[Edge] = []
    for joint in sorted(network.mechanism.joints, key=lambda joint: joint.name):
        labels = network.labels_of[joint.name]
        if joint.type is JointType.SPHERICAL and far.get(joint.parent, 0) % 2:
            labels = tuple(reversed(labels))
        orders[joint.name] = tuple(labels)
        here = joint.parent
        for number, label in enumerate(labels, start=1):
            last = number == len(labels)
            there = joint.child if last else f"{INNER}{label}"
            still = label in motion.locked or label in held
            screw = () if still else posture.twists.get(label, ())
            edges.append(Edge(label, here, there, tuple(screw), len(edges)))
            here = there
        if not labels:
            edges.append(Edge(joint.name, joint.parent, joint.child))
    parts = {joint: labels or (joint,) for joint, labels in orders.items()}
    loops = (
        tuple(
            (name, sign)
            for joint, sign in loop
            for name in (parts[joint] if sign > 0 else reversed(parts[joint]))
        )
        for loop in network.loops
    )
    return with_parameters(edges, posture.prime, loops)


def joints_away(ends: Iterable[tuple[str, str]], base: str) -> dict[str, int]:
    """How many joints lie between the base and each body connected with it."""
    beside: dict[str, list[str]] = {}
    for parent, child in ends:
        beside.setdefault(parent, []).append(child)
        beside.setdefault(child, []).append(parent)
    found = {base: 0}
    waiting = deque(found)
    while waiting:
        here = waiting.popleft()
        for there in beside.get(here, ()):
            if there not in found:
                found[there] = found[here] + 1
                waiting.append(there)
    return found


def independent_cycles(
    graph: ChainGraph, cycles: Iterable[Cycle], count: int
) -> list[Cycle]:
    """The first ``count`` cycles that are independent as chains of edges."""
    span, chosen = Span(graph.prime), list[Cycle]()
    for cycle in cycles:
        vector = [0] * len(graph.edges)
        for number, sign in cycle:
            vector[number] += sign
        if span.add(vector):
            chosen.append(cycle)
        if len(chosen) == count:
            break
    return chosen
