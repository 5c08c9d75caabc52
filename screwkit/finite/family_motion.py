"""How the platform moves along closed postures that are proved to be all there are.

Where every part of a mechanism has a family whose loops close identically, random
parameters give a posture, and several of them displacements of the platform.  Ranks
there are those of the whole family, and whether all displacements keep an axis, a
point or all directions is linear algebra: no samples are needed, and the answer is the
same in every frame.

References: [Herve1999], [Schwartz1980].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.modular import rank
from screwkit.finite.chain_graph import ChainGraph, Cycle, Edge, with_parameters
from screwkit.finite.family_posture import (
    Values,
    displacements,
    moved_graph,
    random_values,
)
from screwkit.finite.lie_closure import (
    UNMOVED,
    Displacement,
    carried,
    composed,
    random_step,
)
from screwkit.finite.motion_words import words_of

WITNESSES = 6
"""Displacements that tell a motion: 3 + 3 values, more than any of the kinds has."""


@dataclass(frozen=True)
class FamilyMotion:
    """The platform's motion along a family of postures.

    Attributes:
        mobility: Dimension of the joint rates at a posture of the family.
        twists: Dimension of the platform's twist system there and of its rotations.
        along: The same of the twists along the family itself.
        words: The motion in words; None where residues do not tell it.
    """

    mobility: int
    twists: tuple[int, int]
    along: tuple[int, int]
    words: str | None


def family_motion(
    graph: ChainGraph, families: Sequence[ChainGraph], base: str, platform: str
) -> FamilyMotion | None:
    """The motion of one body relative to another; None where nothing connects them.

    Args:
        graph: Of the mechanism.
        families: Families of all of its blocks whose loops close identically.
        base: The one body.
        platform: The other.
    """
    family = _assembled(graph, families)
    way = _way(family, base, platform)
    if way is None:
        return None
    values = random_values(family)
    prime = graph.prime
    along = _along(family, way, values)
    there = moved_graph(graph, displacements(family, values))
    twists = there.body_twists()
    relative = [
        [(y - x) % prime for x, y in zip(one, other, strict=True)]
        for one, other in zip(twists[base], twists[platform], strict=True)
    ]
    seen = [_shift(family, way, random_values(family, k)) for k in range(WITNESSES)]
    own = _system(along, prime)
    words = words_of(seen, prime, coupled=own[0] == 1)
    return FamilyMotion(there.mobility, _system(relative, prime), own, words)


def _assembled(graph: ChainGraph, families: Sequence[ChainGraph]) -> ChainGraph:
    """One family of the whole mechanism; edges on no loop stay free."""
    chosen: dict[str, Edge] = {}
    first = graph.width
    for family in families:
        for edge in family.edges:
            parameter = edge.parameter + first if edge.screw else -1
            chosen[edge.name] = replace(edge, parameter=parameter)
        first += family.width
    edges = [chosen.get(edge.name, edge) for edge in graph.edges]
    return with_parameters(edges, graph.prime, graph.loops)


def _way(graph: ChainGraph, base: str, platform: str) -> Cycle | None:
    """From one body to another along the paths from their root."""
    out, back = graph.paths.get(base), graph.paths.get(platform)
    if out is None or back is None:
        return None
    shared = 0
    while out[shared : shared + 1] == back[shared : shared + 1] != ():
        shared += 1
    home = tuple((number, -sign) for number, sign in reversed(out[shared:]))
    way = (*home, *back[shared:])
    return way if _ends(graph, way, base) == platform else None


def _ends(graph: ChainGraph, way: Cycle, start: str) -> str:
    """Where a walk leads; empty if it is none."""
    here = start
    for number, sign in way:
        edge = graph.edges[number]
        tail, head = (edge.tail, edge.head) if sign > 0 else (edge.head, edge.tail)
        if tail != here:
            return ""
        here = head
    return here


def _along(family: ChainGraph, way: Cycle, values: Values) -> list[Sequence[int]]:
    """The twist that each parameter alone gives the end of a way."""
    prime, here = family.prime, UNMOVED
    columns: Mapping[int, list[int]] = {
        parameter: [0] * 6 for parameter in range(family.width)
    }
    for parameter, screw in family.word(way):
        own = carried(here, screw, prime)
        for row, value in enumerate(own):
            columns[parameter][row] = (columns[parameter][row] + value) % prime
        step = random_step(screw, *values[parameter], prime)
        here = composed(here, step, prime)
    return list(columns.values())


def _shift(family: ChainGraph, way: Cycle, values: Values) -> Displacement:
    """The displacement of the end of a way."""
    here = UNMOVED
    for parameter, screw in family.word(way):
        step = random_step(screw, *values[parameter], family.prime)
        here = composed(here, step, family.prime)
    return here


def _system(twists: Sequence[Sequence[int]], prime: int) -> tuple[int, int]:
    """Dimension of a span of twists, and of its rotations."""
    moving = [list(twist) for twist in twists if any(twist)]
    if not moving:
        return 0, 0
    return rank(moving, prime), rank([twist[:3] for twist in moving], prime)
