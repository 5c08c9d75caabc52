"""Coordinates of balls and the like that suit a motion instead of the file's axes.

A joint of several freedoms whose screws span an algebra moves in a whole group, which
products of exponentials of any basis cover around the posture.  With a basis of the
twists that a motion has there, and others beside it, freedoms come to rest that all
turn where axes are those of the base frame: a ball in planar motion turns about the
normal alone, however the plane lies.

References: [Herve1999].
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from screwkit.algebra.modular import echelon
from screwkit.finite.chain_graph import INNER, ChainGraph
from screwkit.finite.lie_closure import Span, is_subalgebra

Rates = Sequence[Mapping[int, int]]


def adapted(graph: ChainGraph, rates: Rates) -> tuple[ChainGraph, Rates] | None:
    """The graph with other screws for the same joints, and the rates by these.

    Args:
        graph: A block.
        rates: Of the motions that matter.

    Returns:
        None where the screws suit the rates as they are.
    """
    prime = graph.prime
    edges, still = list(graph.edges), set[int]()
    for joint in _groups(graph):
        screws = [graph.edges[number].screw for number in joint]
        parameters = [graph.edges[number].parameter for number in joint]
        # In an order of their own, so that balls passed backwards are treated alike.
        order = sorted(range(len(joint)), key=lambda k: screws[k], reverse=True)
        rows = [[r.get(parameters[k], 0) for k in order] for r in rates]
        basis = echelon([row for row in rows if any(row)], prime)
        for row in basis:
            first = next(k for k, x in enumerate(row) if x)
            if not any(row[first + 1 :]):
                continue
            number = joint[order[first]]
            screw = tuple(
                sum(x * screws[k][i] for x, k in zip(row, order, strict=True)) % prime
                for i in range(6)
            )
            edges[number] = replace(edges[number], screw=screw)
        leading = {next(k for k, x in enumerate(row) if x) for row in basis}
        still |= {parameters[k] for n, k in enumerate(order) if n not in leading}
    if tuple(edges) == graph.edges:
        return None
    turned = ChainGraph(tuple(edges), graph.width, prime, graph.loops)
    return turned, [{p: x for p, x in r.items() if p not in still} for r in rates]


def _groups(graph: ChainGraph) -> Iterator[list[int]]:
    """The edges of every joint of several freedoms that moves in a whole group."""
    uses: dict[int, int] = {}
    for edge in graph.edges:
        uses[edge.parameter] = uses.get(edge.parameter, 0) + 1
    joint: list[int] = []
    for number, edge in enumerate(graph.edges):
        if not edge.tail.startswith(INNER):
            joint = []
        joint.append(number)
        if edge.head.startswith(INNER) or len(joint) < 2:
            continue
        own = [graph.edges[k] for k in joint]
        alone = all(e.screw and uses[e.parameter] == 1 for e in own)
        screws = [e.screw for e in own]
        independent = alone and len(Span(graph.prime, screws)) == len(screws)
        if independent and is_subalgebra(screws, graph.prime):
            yield joint
