"""Random postures of a family whose loops all close whatever its parameters are.

Such a family is parametrised by the joint values that are left in it, so that any of
these give a posture: where every body stands there, and the screws that go with it,
are exact modulo the prime.

References: [Schwartz1980] (what holds at random values).
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import replace

from screwkit.finite.chain_graph import ChainGraph
from screwkit.finite.lie_closure import (
    UNMOVED,
    Displacement,
    carried,
    composed,
    random_step,
)

Values = Sequence[tuple[int, int]]
"""For every parameter Cayley's, and what helices advance by."""


def random_values(family: ChainGraph, number: int = 0) -> Values:
    """Values for all parameters of a family; the same number gives the same ones."""
    source = random.Random(family.width + 1000 * number)
    prime = family.prime
    return [
        (source.randrange(1, prime), source.randrange(prime))
        for _ in range(family.width)
    ]


def displacements(family: ChainGraph, values: Values) -> Mapping[str, Displacement]:
    """Where every body goes from the first of its component."""
    found: dict[str, Displacement] = {}
    for body, path in family.paths.items():
        if not path:
            found[body] = UNMOVED
            continue
        number, sign = path[-1]
        edge = family.edges[number]
        here = found[edge.tail if sign > 0 else edge.head]
        if edge.screw:
            screw = tuple(sign * x for x in edge.screw)
            step = random_step(screw, *values[edge.parameter], family.prime)
            here = composed(here, step, family.prime)
        found[body] = here
    return found


def moved_graph(graph: ChainGraph, places: Mapping[str, Displacement]) -> ChainGraph:
    """A graph with the same bodies as a family, every screw carried along."""
    edges = tuple(
        replace(edge, screw=carried(places[edge.tail], edge.screw, graph.prime))
        if edge.screw
        else edge
        for edge in graph.edges
    )
    return ChainGraph(edges, graph.width, graph.prime, graph.loops)
