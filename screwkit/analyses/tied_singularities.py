"""Singularities of mechanisms whose loops tie joint variables together.

Conditions are stated in joint variables and hold at closed postures; where they can be
written in the driven variables alone, these are given beside them.

References: [LongCaroKhalil2012] §5, [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from screwkit.algebra.points import Point
from screwkit.algebra.points_on import Unknown
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.solve import solutions
from screwkit.analyses.closed_example import closed_example
from screwkit.analyses.one_component import limb_component
from screwkit.analyses.own_branch import MOVES_ALL_ALONG, STILL_ALL_ALONG, OwnBranch
from screwkit.analyses.tied_branch import rank_in_the_file
from screwkit.analyses.whole_singularities import (
    graph_component,
    meanings_of,
    never_still,
    put_together,
)
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.whole_graph import GraphState
from screwkit.loci.closed_pieces import TiedLocus, TiedPiece
from screwkit.loci.graph_witness import GraphWitnesses
from screwkit.loci.meanings import Meanings
from screwkit.loci.pieces import Piece
from screwkit.loci.tied_loci import (
    actuation_finds,
    columns_locus,
    limb_locus,
    loop_locus,
)
from screwkit.progress import Progress, silent
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    DrivenCondition,
    LimbSingularities,
    Singularities,
)
from screwkit.results.solution import Solution

_LONG = 160  # characters of a condition that is written though it is not solved


def tied_singularities(
    graph: TiedGraph,
    actuated: Sequence[str] | None = None,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
) -> Singularities:
    """Answer ``singularities`` at closed postures.

    Args:
        graph: The mechanism.
        actuated: Freedoms; the declared ones by default.
        progress: Told about each stage.
        finished: Given each part as soon as it is there, by name.

    Raises:
        UndecidedError: If no exact closed posture was found, or the closing equations
            of a joint are not known.
    """
    mechanism = graph.mechanism
    scheme = tuple(mechanism.actuated if actuated is None else actuated)
    progress("loops", f"{len(graph.closing)} closing equations")
    generic = graph.generic_state()
    kept = graph.unknowns_of(scheme)
    limbs = []
    for number, limb in enumerate(graph.network.limbs):
        progress(f"limb {limb.name}", f"{len(limb.joints)} joints")
        limbs.append(_limb(graph, number, kept))
        finished(f"limb {limb.name}", limbs[-1])
    progress("constraint", f"{len(graph.network.labels)} columns")
    locus = loop_locus(graph, (), kept)
    meanings = meanings_of(graph) if locus.pieces else None
    constraint = ConstraintSingularities(
        generic_rank=generic.loop,
        complete=not locus.reason,
        components=tuple(
            _component(graph, one, meanings, state, state.loop)
            for one in locus.pieces
            for state in [graph.state_at(one.points)]
        ),
        proof=_proof(locus),
        reason=locus.reason,
    )
    finished("constraint", constraint)
    actuation = None
    if scheme:
        free = len(graph.network.labels) - len(scheme)
        progress("actuation", f"{free} passive freedoms")
        actuation, _ = tied_actuation(graph, scheme)
    return put_together(
        mechanism,
        (limbs, constraint, actuation),
        graph.root.assumptions,
        {graph.framed.ring: graph.library},
    )


def _size(graph: TiedGraph) -> int:
    return len(graph.network.rows)


def _limb(graph: TiedGraph, number: int, kept: Sequence[Unknown]) -> LimbSingularities:
    """Where a limb allows the platform less at closed postures."""
    limb, labels = graph.network.limbs[number], graph.framed.limbs[number]
    if limb.path is None:
        within = limb_locus(graph, number, kept)
        locus = TiedLocus(within.finds, within.reason)
    else:
        locus = columns_locus(graph, labels, kept)

    def freedom(points: Sequence[tuple[Point, int]]) -> int:
        if limb.path is None:
            return graph.limb_freedom(number, points)
        return graph.rank_of(labels, points)

    meanings = meanings_of(graph) if locus.pieces else None
    listed = [one.piece for one in locus.pieces]
    return LimbSingularities(
        limb=limb.name,
        joints=labels,
        generic_rank=freedom(graph.closed.points),
        complete=not locus.reason,
        components=tuple(
            _limb_component(graph, one, meanings, listed, freedom(one.points))
            for one in locus.pieces
        ),
        proof=_proof(locus),
        reason=locus.reason,
    )


def tied_actuation(
    graph: TiedGraph, actuated: Sequence[str]
) -> tuple[ActuationSingularities, tuple[TiedPiece, ...]]:
    """Where, with these freedoms locked, the platform can move, and the pieces.

    Args:
        graph: The mechanism.
        actuated: The freedoms that are locked.

    Returns:
        The answer, and the pieces of its components in their order.
    """
    size = _size(graph)
    generic = graph.generic_state(actuated)
    own = OwnBranch(graph.network)
    if generic.platform_freedom and own.is_still(actuated):
        return ActuationSingularities(
            tuple(actuated), True, size, False, (), reason=STILL_ALL_ALONG
        ), ()
    if generic.platform_freedom:
        witness = GraphWitnesses(graph).of(actuated)
        return never_still(actuated, size, generic.platform_freedom, witness), ()
    left = own.freedom_left(actuated)
    if left:
        return never_still(actuated, size, left, MOVES_ALL_ALONG), ()
    found = actuation_finds(graph, actuated)
    meanings = meanings_of(graph, actuated) if found.finds or found.others else None
    moving, idle = (
        tuple(
            _component(graph, one, meanings, state, size - state.platform_freedom)
            for one in pieces
            for state in [graph.state_at(one.points, actuated)]
        )
        for pieces in (found.finds, found.others)
    )
    reason = found.reason
    below = generic.loop > rank_in_the_file(graph.network, actuated)
    if below and not own.comes_to(generic.loop, actuated):
        special = (
            "the posture of the file is singular itself, and whether those near it are "
            "was not decided"
        )
        reason = "; ".join(filter(None, [reason, special]))
    answer = ActuationSingularities(
        actuated=tuple(actuated),
        admissible=True,
        generic_rank=size,
        complete=not reason,
        components=moving,
        idle=idle,
        reason=reason,
    )
    return answer, found.finds


def _component(
    graph: TiedGraph,
    one: TiedPiece,
    meanings: Meanings | None,
    state: GraphState,
    rank: int,
) -> Component:
    words = meanings.each_of if meanings else None
    component = graph_component(graph, one.piece, state, rank, words)
    return _at_closed_postures(graph, one, component)


def _limb_component(
    graph: TiedGraph,
    one: TiedPiece,
    meanings: Meanings | None,
    listed: Sequence[Piece],
    rank: int,
) -> Component:
    component = limb_component(
        one.piece,
        graph.root,
        graph.library,
        meanings,
        listed,
        rank=rank,
        dimension=_size(graph),
    )
    return _at_closed_postures(graph, one, component)


def _at_closed_postures(
    graph: TiedGraph, one: TiedPiece, component: Component
) -> Component:
    example = closed_example(graph, one.piece.equations)
    return replace(component, example=example, closes=_where_closed(graph, one))


def _where_closed(graph: TiedGraph, one: TiedPiece) -> tuple[DrivenCondition, ...]:
    """What the driven variables are at closed postures on a piece, if that is short."""
    ring = graph.framed.ring
    found = []
    for part in one.inputs:
        equation = equation_text(ring, part.polynomial)
        solved = next(
            (
                Solution(s.variable, s.values, s.modulo)
                for s in solutions(ring, part, graph.root.assumptions)
                if s.variable in graph.mechanism.joint_variables
            ),
            None,
        )
        if solved is None and len(equation) > _LONG:
            return ()
        found.append(DrivenCondition(equation, solved))
    return tuple(found)


def _proof(locus: TiedLocus) -> str:
    """Why a list is complete, in words; empty where it is not."""
    if locus.reason:
        return ""
    if not locus.pieces:
        return "at no closed posture"
    return (
        "at closed postures; conditions of joint variables that no closed posture "
        "meets were left out"
    )
