"""An answer of ``singularities`` put together from its parts."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.analyses.assumed import assumptions_in_words, unsplit
from screwkit.analyses.one_component import component_of
from screwkit.kinematics.whole_graph import GraphState, WholeGraph
from screwkit.loci.meanings import Meanings
from screwkit.loci.mechanism_figures import graph_figures
from screwkit.loci.pieces import Piece
from screwkit.mechanism.model import Mechanism
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    LimbSingularities,
    Singularities,
)

NAMED = 30
"""Freedoms up to which statements about axes are tried."""


def meanings_of(graph: WholeGraph, locked: Collection[str] = ()) -> Meanings | None:
    """What loci of a graph mean; None where it has many freedoms.

    Args:
        graph: Of the mechanism.
        locked: Freedoms that are held; bodies between them are one member.
    """
    if len(graph.framed.joints) > NAMED:
        return None
    given = graph.framed, graph.root, graph.library
    return Meanings(*given, graph_figures(graph.mechanism, *given, locked))


def put_together(
    mechanism: Mechanism,
    parts: tuple[
        Sequence[LimbSingularities],
        ConstraintSingularities,
        ActuationSingularities | None,
    ],
    assumptions: Assumptions,
    libraries: Mapping[TrigonometricRing, FactorLibrary],
) -> Singularities:
    """The whole answer, with what it took for granted.

    Args:
        mechanism: That was asked about.
        parts: Limbs, constraint, and actuation if some joints are actuated.
        assumptions: Signs that the file declares.
        libraries: The factors met, by ring.
    """
    limbs, constraint, actuation = parts
    components = [c for limb in limbs for c in limb.components]
    components += constraint.components
    components += actuation.components if actuation is not None else ()
    listed = [equation for c in components for equation in c.equations]
    return Singularities(
        case=mechanism.name,
        title=mechanism.title,
        limb=tuple(limbs),
        constraint=constraint,
        actuation=actuation,
        assumptions=(
            *assumptions_in_words(mechanism, assumptions.positive, assumptions.nonzero),
            *unsplit(libraries, listed),
        ),
        platform_name=mechanism.platform,
    )


def graph_component(
    graph: WholeGraph,
    piece: Piece,
    state: GraphState,
    rank: int,
    words: Callable[[Piece], str | None] | None,
) -> Component:
    """A component of a locus of the loop equations.

    Args:
        graph: Of the mechanism.
        piece: Where it is.
        state: What moves there.
        rank: That is lower there.
        words: What a piece means, if that is asked.
    """
    return component_of(
        piece,
        graph.root,
        graph.library,
        words,
        rank=rank,
        wrench_dimension=len(graph.network.rows) - state.platform_freedom,
        platform_freedom=state.platform_freedom,
        mobility=state.mobility,
    )


def never_still(
    actuated: Sequence[str], size: int, freedom: int, witness: str
) -> ActuationSingularities:
    """A scheme that leaves the platform some freedoms everywhere, and why."""
    return ActuationSingularities(
        tuple(actuated), False, size - freedom, True, (), witness=witness
    )
