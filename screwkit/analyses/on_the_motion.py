"""What holds on the motion through a posture that is itself special.

Where loops tie joint variables together the file gives one closed posture, and ranks
there may be lower than on the motion that leads through it.  Then the numbers are taken
at sampled postures of the branch, by singular values with a gap.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from screwkit.finite.exponentials import at_stance
from screwkit.finite.finite_branches import FiniteBranch
from screwkit.finite.finite_motion import FiniteMotion
from screwkit.finite.posture_model import PostureModel
from screwkit.finite.posture_numbers import connectivity_at, numbers_at
from screwkit.kinematics.network import Network
from screwkit.results.mobility import (
    Actuation,
    Connectivity,
    FullCycle,
    Platform,
)
from screwkit.results.partition import Partition


@dataclass(frozen=True)
class OnTheMotion:
    """The numbers on the motion; all of one posture."""

    loop_rank: int
    platform: Platform
    actuation: Actuation | None
    partition: Partition
    connectivity: Connectivity | None


def on_the_motion(
    network: Network,
    cycle: FullCycle,
    about: Platform,
    sample: FiniteMotion | None,
    table: int,
) -> OnTheMotion | None:
    """The generic numbers where loops tie joint variables together.

    Args:
        network: The mechanism.
        cycle: Its branches.
        about: The platform at the posture of the file.
        sample: Where the branches come from.
        table: Bodies up to which the table of connectivity is made.

    Returns:
        None where the posture is as good as any, or its branches differ in rank.  Of
        branches that move differently the first is taken.
    """
    if not network.tied or not cycle.branches or sample is None:
        return None
    ranks = {branch.loop_rank for branch in cycle.branches}
    branch = cycle.branches[0]
    here = network.motion.rank, about.motion_type, about.couples
    if len(ranks) > 1 or here == (branch.loop_rank, branch.motion_type, branch.couples):
        return None
    model = _clearest(sample, sample.branches[0])
    if model is None:
        return None
    kind = branch.motion_type
    translations, rotations = (int(n) for n in kind.removesuffix("R").split("T"))
    freedom, mobility = translations + rotations, branch.instantaneous_mobility
    driven = [x for x in network.labels if x not in network.contact_labels]
    links = network.mechanism.links
    rows = connectivity_at(model) if len(links) <= table else None
    return OnTheMotion(
        branch.loop_rank,
        replace(
            about,
            twist_dimension=freedom,
            translations=translations,
            rotations=rotations,
            motion_type=kind,
            wrench_dimension=len(network.rows) - freedom,
            couples=branch.couples,
            motion_class=None,
        ),
        _actuation(network, model),
        Partition(
            mobility,
            freedom,
            mobility - freedom,
            numbers_at(model, driven).twist_dimension,
        ),
        None if rows is None else Connectivity(links, rows),
    )


def _actuation(network: Network, model: PostureModel) -> Actuation | None:
    actuated = network.mechanism.actuated
    if not actuated:
        return None
    held = numbers_at(model, actuated)
    return Actuation(actuated, held.mobility, held.twist_dimension)


def _clearest(sample: FiniteMotion, branch: FiniteBranch) -> PostureModel | None:
    """The kept posture of a branch whose ranks have the largest margin."""
    best, widest = None, 0.0
    if sample.model is None or branch.places is None:
        return None
    for entry in range(len(branch.places)):
        model = at_stance(sample.model, branch.places, entry)
        found = numbers_at(model)
        expected = branch.loop_rank, branch.motion_type
        if (found.loop_rank, found.motion_type) == expected and found.gap > widest:
            best, widest = model, found.gap
    return best
