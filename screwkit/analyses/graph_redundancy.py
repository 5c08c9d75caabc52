"""Redundant actuation of any joint graph: what added actuators remove.

References: [Merlet1989] (singularities of an actuated platform).
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.points import Point
from screwkit.analyses.added_actuators import FreedomAt, Place, everywhere, with_added
from screwkit.analyses.graph_singularities import actuation_places
from screwkit.analyses.tied_singularities import tied_actuation
from screwkit.kinematics.network import Motion
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.whole_graph import LockedRanks, WholeGraph
from screwkit.results.schemes import Redundancy
from screwkit.results.singularities import ActuationSingularities


def graph_redundancy(
    graph: WholeGraph, actuated: Sequence[str], candidates: Sequence[str]
) -> Redundancy:
    """What one added actuator does, and two where none alone suffices.

    Args:
        graph: The mechanism.
        actuated: The scheme.
        candidates: Freedoms that may be actuated too.
    """
    answer, places = _places(graph, actuated)
    if not answer.admissible:
        generic = [_freedom(found) for found in graph.generic_motions]
        places = [everywhere(answer, len(graph.network.rows), [generic])]
    return with_added(answer, places, candidates)


def _places(
    graph: WholeGraph, actuated: Sequence[str]
) -> tuple[ActuationSingularities, list[Place]]:
    """Components with their points; of tied loops each point may be a sheet."""

    def at(points: Sequence[tuple[Point, int]]) -> list[FreedomAt]:
        return [_freedom(graph.motion_at(*point)) for point in points]

    if isinstance(graph, TiedGraph):
        answer, tied = tied_actuation(graph, actuated)
        found = zip(answer.components, tied, strict=True)
        return answer, [Place(c, [[x] for x in at(one.points)]) for c, one in found]
    answer, pieces = actuation_places(graph, actuated)
    return answer, [
        Place(component, [at(b.points) for b in piece.branches if b.points])
        for component, piece in zip(answer.components, pieces, strict=True)
    ]


def _freedom(found: Motion) -> FreedomAt:
    ranks = LockedRanks(found)
    return lambda locked: ranks.state(locked).platform_freedom
