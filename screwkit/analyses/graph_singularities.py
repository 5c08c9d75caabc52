"""Singularities of any joint graph: loops outside limbs, limbs that are no chains.

The loop constraint matrix of the whole mechanism stands for its limbs; every find is
confirmed by ranks at exact points.

References: [LongCaroKhalil2012] §5, [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from screwkit.analyses.one_component import limb_component
from screwkit.analyses.whole_singularities import (
    graph_component,
    meanings_of,
    never_still,
    put_together,
)
from screwkit.kinematics.whole_graph import GraphState, WholeGraph
from screwkit.loci.graph_loci import (
    GraphLocus,
    actuation_locus,
    constraint_locus,
    limb_locus,
    state_on,
)
from screwkit.loci.graph_witness import GraphWitnesses
from screwkit.loci.meanings import Meanings
from screwkit.loci.pieces import Piece
from screwkit.progress import Progress, silent
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    LimbSingularities,
    Singularities,
)


def graph_singularities(
    graph: WholeGraph,
    actuated: Sequence[str] | None = None,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
) -> Singularities:
    """Answer ``singularities`` for any joint graph whose loops close by construction.

    Args:
        graph: The mechanism.
        actuated: Freedoms; the declared ones by default.
        progress: Told about each stage.
        finished: Given each part as soon as it is there, by name.

    Raises:
        UndecidedError: See `WholeGraph.framed`.
    """
    mechanism = graph.mechanism
    limbs = []
    for number, limb in enumerate(graph.network.limbs):
        progress(f"limb {limb.name}", f"{len(limb.joints)} joints")
        limbs.append(_limb(graph.limbs[number], limb.name))
        finished(f"limb {limb.name}", limbs[-1])
    scheme = tuple(mechanism.actuated if actuated is None else actuated)
    actuation = None
    if scheme:
        free = len(graph.network.labels) - len(scheme)
        progress("actuation", f"{free} passive freedoms")
        actuation, _ = actuation_places(graph, scheme)
        finished("actuation", actuation)
    progress("constraint", f"{len(graph.network.labels)} columns")
    constraint = _constraint(graph)
    finished("constraint", constraint)
    return put_together(
        mechanism,
        (limbs, constraint, actuation),
        graph.root.assumptions,
        graph.libraries,
    )


def _size(graph: WholeGraph) -> int:
    return len(graph.network.rows)


def _in_order(pieces: Sequence[Piece]) -> list[Piece]:
    return sorted(
        pieces, key=lambda piece: (piece.codimension, sum(map(len, piece.equations)))
    )


def _limb(limb: WholeGraph, name: str) -> LimbSingularities:
    """Where one limb allows the platform less than in general."""
    locus = limb_locus(limb)
    meanings = meanings_of(limb) if locus.pieces else None
    components = tuple(
        limb_component(
            piece,
            limb.root,
            limb.library,
            meanings,
            locus.pieces,
            rank=state_on(limb, piece.branches).platform_freedom,
            dimension=_size(limb),
        )
        for piece in _in_order(locus.pieces)
    )
    return LimbSingularities(
        limb=name,
        joints=limb.network.labels,
        generic_rank=limb.generic_state().platform_freedom,
        complete=not locus.reason,
        components=components,
        proof=_proof(locus, "its twists, loops inside closed,"),
        reason=locus.reason,
    )


def _constraint(graph: WholeGraph) -> ConstraintSingularities:
    """Where the loop constraint matrix loses rank."""
    generic = graph.generic_state()
    if not graph.network.loops:
        return ConstraintSingularities(
            0, True, (), proof="there is no loop to constrain"
        )
    locus = constraint_locus(graph)
    meanings = meanings_of(graph) if locus.pieces else None
    return ConstraintSingularities(
        generic_rank=generic.loop,
        complete=not locus.reason,
        components=tuple(
            _component(graph, piece, meanings, state, state.loop)
            for piece in _in_order(locus.pieces)
            for state in [state_on(graph, piece.branches)]
        ),
        proof=_proof(locus, "the loop equations"),
        reason=locus.reason,
    )


def actuation_places(
    graph: WholeGraph, actuated: Sequence[str]
) -> tuple[ActuationSingularities, tuple[Piece, ...]]:
    """Where, with these freedoms locked, the platform can move, and the pieces.

    Args:
        graph: The mechanism.
        actuated: The freedoms that are locked.

    Returns:
        The answer, and the pieces of its components in their order.
    """
    size = _size(graph)
    generic = graph.generic_state(actuated)
    if generic.platform_freedom:
        witness = GraphWitnesses(graph).of(actuated)
        return never_still(actuated, size, generic.platform_freedom, witness), ()
    locus = actuation_locus(graph, actuated)
    meanings = meanings_of(graph, actuated) if locus.pieces or locus.others else None

    def component(piece: Piece) -> Component:
        state = state_on(graph, piece.branches, actuated)
        return _component(graph, piece, meanings, state, size - state.platform_freedom)

    pieces = tuple(_in_order(locus.pieces))
    answer = ActuationSingularities(
        actuated=tuple(actuated),
        admissible=True,
        generic_rank=size,
        complete=not locus.reason,
        components=tuple(map(component, pieces)),
        idle=tuple(map(component, _in_order(locus.others))),
        reason=locus.reason,
    )
    return answer, pieces


def _component(
    graph: WholeGraph,
    piece: Piece,
    meanings: Meanings | None,
    state: GraphState,
    rank: int,
) -> Component:
    words = meanings.each_of if meanings else None
    return graph_component(graph, piece, state, rank, words)


def _proof(locus: GraphLocus, subject: str) -> str:
    """Why a list is complete, in words; empty where it is not."""
    if locus.reason:
        return ""
    if not locus.pieces:
        return f"{subject} keep their rank everywhere"
    return (
        f"{subject} form a block triangle; the zeros of the minors of its blocks were "
        f"searched by exhaustive case distinction over their factors"
    )
