"""Coordinates of balls and the like that suit a mechanism instead of the file's axes.

A joint of several freedoms whose screws span an algebra moves in a whole group, which
products of exponentials of any basis cover around the posture.  With a basis of the
twists that a motion has there, and others beside it, freedoms come to rest that all
turn where axes are those of the base frame: a ball in planar motion turns about the
normal alone, however the plane lies.  Axes of hinges on either side of the joint come
first: a factor beside a hinge of its axis makes up for the hinge.

References: [Herve1999].
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from screwkit.algebra.modular import annihilator, echelon
from screwkit.finite.chain_graph import INNER, ChainGraph
from screwkit.finite.lie_closure import Span, is_subalgebra

Rates = Sequence[Mapping[int, int]]
Row = Sequence[int]
"""A twist of a joint by its coordinates in the joint's screws."""


def adapted(graph: ChainGraph, rates: Rates) -> tuple[ChainGraph, Rates] | None:
    """The graph with other screws for the same joints, and the rates by these.

    Args:
        graph: A block.
        rates: Of the motions that matter.

    Returns:
        None where the screws suit the rates as they are.
    """
    prime = graph.prime
    edges, found = list(graph.edges), [dict(own) for own in rates]
    joints = tuple(_groups(graph))
    own_axes = {number for joint in joints for number in joint}
    for joint in joints:
        screws = [graph.edges[number].screw for number in joint]
        parameters = [graph.edges[number].parameter for number in joint]
        moving = [[own.get(p, 0) for p in parameters] for own in rates]
        basis = _basis(graph, joint, moving, own_axes)
        for number, row in zip(joint, basis, strict=True):
            screw = tuple(
                sum(x * s[i] for x, s in zip(row, screws, strict=True)) % prime
                for i in range(6)
            )
            edges[number] = replace(edges[number], screw=screw)
        for own, row in zip(found, moving, strict=True):
            own.update(zip(parameters, _coordinates(row, basis, prime), strict=True))
    if tuple(edges) == graph.edges:
        return None
    turned = ChainGraph(tuple(edges), graph.width, prime, graph.loops)
    return turned, [{p: x for p, x in own.items() if x} for own in found]


def _basis(
    graph: ChainGraph,
    joint: Sequence[int],
    moving: Sequence[Row],
    others: Collection[int],
) -> list[list[int]]:
    """A basis of the joint's group that holds one of the twists it moves by."""
    prime, size = graph.prime, len(joint)
    screws = [graph.edges[number].screw for number in joint]
    # In the order of its freedoms, so that balls passed backwards are treated alike.
    order = sorted(range(size), key=lambda k: graph.edges[joint[k]].name)
    rows = echelon([[row[k] for k in order] for row in moving if any(row)], prime)
    twists = Span(prime, rows)
    first, last = list[list[int]](), list[list[int]]()
    chosen = Span(prime)
    for end, side in enumerate((first, last)):
        for axis in _axes(graph, joint, end, others):
            own = _in_ball(axis, [screws[k] for k in order], prime)
            inside = own and Span(prime, [*rows, own])
            if inside and len(inside) == len(twists) and chosen.add(own):
                side.append(own)
    middle: dict[int, list[int]] = {}
    leading = [next(k for k, x in enumerate(row) if x) for row in rows]
    for place, row in zip(leading, rows, strict=True):
        if chosen.add(row):
            middle[place] = list(row)
    for place in set(range(size)) - set(leading):
        middle[place] = [int(place == k) for k in range(size)]
    if not first and not last:
        placed = {order[k]: row for k, row in middle.items()}
        between = [placed[k] for k in range(size)]
    else:
        between = [middle[k] for k in sorted(middle)]
    back = [order.index(k) for k in range(size)]
    return [[row[k] for k in back] for row in (*first, *between, *reversed(last))]


def _axes(
    graph: ChainGraph, joint: Sequence[int], end: int, others: Collection[int]
) -> list[Row]:
    """Directions of axes at the body before or behind a joint, balls' left out."""
    body = graph.edges[joint[-1]].head if end else graph.edges[joint[0]].tail
    beside = [number for number, _, _ in graph.neighbours[body] if number not in others]
    axes = (graph.edges[number].screw[:3] for number in beside)
    return [axis for axis in axes if any(axis)]


def _in_ball(axis: Row, screws: Sequence[Row], prime: int) -> list[int]:
    """The coordinates of a rotation about an axis; empty where there is no ball."""
    turns = [screw[:3] for screw in screws]
    if len(turns) != 3 or len(Span(prime, turns)) < 3:
        return []
    return _coordinates(axis, turns, prime)


def _coordinates(row: Row, basis: Sequence[Row], prime: int) -> list[int]:
    """Factors of the basis whose sum a row is."""
    equations = [
        [*(own[k] for own in basis), -value % prime] for k, value in enumerate(row)
    ]
    (found,) = annihilator(equations, len(basis) + 1, prime)
    unit = pow(found[-1], -1, prime)
    return [x * unit % prime for x in found[:-1]]


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
