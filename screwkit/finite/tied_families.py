"""Subfamilies of postures in which joints are tied together or held.

Joints whose rates are equal or opposite in every motion at a posture may stay so for
good, as in parallelograms; joints without any rate may stay at rest.  A subfamily keeps
them so, which makes loops close in smaller groups and gives up no rate.  Balls have no
axes of their own: they are tried with those of the base frame and with adapted ones.

References: [Herve1999] (parallelograms as generators of translation).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from screwkit.finite.adapted_joints import adapted
from screwkit.finite.chain_graph import ChainGraph, with_parameters
from screwkit.finite.lie_closure import ResidueScrew, loop_algebra

MOST_CYCLES = 120


def subfamilies(
    graph: ChainGraph, rates: Sequence[Mapping[int, int]] | None = None
) -> Iterator[tuple[ChainGraph, bool, bool]]:
    """The graph and subfamilies with the same rates at the posture, without repeats.

    With each whether joints are tied in it, and whether joints are held.

    Args:
        graph: A block.
        rates: The rates that a subfamily shall keep; all that close the loops if none
            are given.
    """
    yield from _with_ties(graph, graph.rates if rates is None else rates)
    other = adapted(graph, graph.rates if rates is None else rates)
    if other is not None:
        yield from _with_ties(*other, plain=False)


def _with_ties(
    graph: ChainGraph, kept: Sequence[Mapping[int, int]], *, plain: bool = True
) -> Iterator[tuple[ChainGraph, bool, bool]]:
    """The subfamilies for the joints' screws as they are, with the graph if plain."""
    groups = _tied_groups(graph, kept)
    still = frozenset(range(graph.width)) - {p for r in kept for p in r}
    closing = _ties_that_close(graph, groups)
    seen: set[tuple[object, ...]] = set() if plain else {((), frozenset())}
    for ties in (groups[:0], closing, groups):
        for held in (frozenset[int](), still):
            key = (tuple(sorted(map(tuple, ties))), held)
            if key not in seen:
                seen.add(key)
                family = subfamily(graph, ties, held) if ties or held else graph
                yield family, bool(ties), bool(held)


def _tied_groups(
    graph: ChainGraph, kept: Sequence[Mapping[int, int]]
) -> list[dict[int, int]]:
    """Parameters of parallel joints with equal or opposite rates.

    Each group gives the factor from its first parameter to the others; a parameter in
    one group at most.  Compared are the rates of all motions that are kept.
    """
    prime, groups, taken = graph.prime, [], set[int]()
    moving = {e.parameter: _axis(e.screw) for e in graph.edges if any(e.screw)}
    columns = {p: [rates.get(p, 0) for rates in kept] for p in moving}
    for first, (turns, axis) in moving.items():
        if first in taken or not any(columns[first]):
            continue
        group = {first: 1}
        for other, (other_turns, other_axis) in moving.items():
            if other <= first or other in taken or other_turns != turns:
                continue
            ratio = _ratio(axis, other_axis, prime)
            for factor in (ratio, -ratio) if ratio else ():
                # other = ±ratio⁻¹ · first: angles about axes of different length.
                scaled = pow(factor, -1, prime)
                if columns[other] == [scaled * x % prime for x in columns[first]]:
                    group[other] = scaled
        if len(group) > 1:
            taken |= set(group)
            groups.append(group)
    return groups


def _axis(screw: ResidueScrew) -> tuple[bool, ResidueScrew]:
    """Whether it turns, and the axis; else the direction of the translation."""
    turns = any(screw[:3])
    return turns, screw[:3] if turns else screw[3:]


def _ratio(first: Sequence[int], second: Sequence[int], prime: int) -> int:
    """The factor from the first to the second; 0 where there is none."""
    pivot = next(i for i, x in enumerate(first) if x)
    ratio = second[pivot] * pow(first[pivot], -1, prime) % prime
    parallel = all(
        (ratio * x - y) % prime == 0 for x, y in zip(first, second, strict=True)
    )
    return ratio if parallel else 0


def _ties_that_close(
    graph: ChainGraph, groups: list[dict[int, int]]
) -> list[dict[int, int]]:
    """Of the ties those in loops that they close identically, as in parallelograms."""
    tied = subfamily(graph, groups, frozenset())
    kept: list[set[int]] = []
    for cycle in graph.simple_cycles(MOST_CYCLES):
        if len(cycle) <= 8 and not loop_algebra(tied.word(cycle), graph.prime):
            own = {graph.edges[n].parameter for n, _ in cycle} - {-1}
            kept += [own & set(g) for g in groups if len(own & set(g)) > 1]
    merged: list[set[int]] = []
    for members in kept:
        apart = [other for other in merged if not other & members]
        joined = members.union(*(other for other in merged if other & members))
        merged = [*apart, joined]
    found = []
    for members in merged:
        group = next(g for g in groups if members <= set(g))
        unit = pow(group[min(members)], -1, graph.prime)
        found.append({p: group[p] * unit % graph.prime for p in sorted(members)})
    return found


def subfamily(
    graph: ChainGraph, ties: Sequence[Mapping[int, int]], held: frozenset[int]
) -> ChainGraph:
    """The subfamily in which tied parameters are one and held ones are zero."""
    prime = graph.prime
    leader = {p: (min(ties_), k) for ties_ in ties for p, k in ties_.items()}
    edges = []
    for edge in graph.edges:
        if edge.parameter in held:
            edges.append(replace(edge, screw=(), parameter=-1))
        elif edge.parameter in leader:
            parameter, factor = leader[edge.parameter]
            screw = tuple(factor * x % prime for x in edge.screw)
            edges.append(replace(edge, screw=screw, parameter=parameter))
        else:
            edges.append(edge)
    return with_parameters(edges, prime, graph.loops)
