"""Whether exact closed postures are of the kind that the file's own posture is.

The closing equations may have several components, some without real postures.  Ranks
at exact closed postures speak for the mechanism only if they are those of a posture
that it has.
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.analyses.moved import closed_table
from screwkit.errors import UndecidedError
from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.finite.posture_numbers import numbers_at
from screwkit.kinematics.network import Network, motion
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.values import declared_values, with_values


def tied_graph(network: Network) -> TiedGraph:
    """The graph with its closed postures, which are like that of the file.

    Args:
        network: A mechanism whose loops tie joint variables together.

    Raises:
        UndecidedError: If no exact closed postures were found, they have another rank
            than the posture of the file and those around it, or the closing equations
            of a joint are not known.
    """
    graph = TiedGraph(network.mechanism)
    exact = graph.generic_state().loop
    here = rank_in_the_file(network)
    if here != exact and exact not in _ranks_around(network):
        raise UndecidedError(
            f"{network.tied}; at the posture of the file the loop equations have rank "
            f"{here}, at exact closed postures elsewhere {exact}, so that these may "
            f"belong to another branch"
        )
    return graph


def rank_in_the_file(network: Network, locked: Sequence[str] = ()) -> int:
    """Rank of the loop equations at the posture of the file, some freedoms locked.

    Exact where joint variables 0 are closed, by singular values elsewhere.
    """
    if closed_table(network) is None:
        return max(motion(network, at, locked).rank for at in network.postures)
    return numbers_at(model_in_the_file(network), locked).loop_rank


def _ranks_around(network: Network) -> set[int]:
    """Ranks in general on the motions that start from the posture, by sampling."""
    return {
        branch.loop_rank
        for branch in finite_motion(model_in_the_file(network)).branches
    }


def model_in_the_file(network: Network) -> PostureModel:
    """The posture of the file in numbers."""
    mechanism = with_values(network.mechanism, declared_values(network.mechanism))
    table = closed_table(network)
    if table is not None:
        return posture_model(mechanism, table.values)
    zeros = dict.fromkeys(mechanism.joint_variables, 0.0)
    return posture_model(mechanism, zeros)
