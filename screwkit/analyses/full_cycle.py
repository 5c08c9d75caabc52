"""Whether the instantaneous freedoms integrate to finite motion.

First come exact arguments; where none applies, the branches through the posture are
sampled, and where samples disagree with each other the question stays open.

References: /* see kinematics.finite_proofs and kinematics.finite_motion */
"""

from __future__ import annotations

from screwkit.kinematics.network import Motion, Network
from screwkit.results.mobility import FullCycle


def full_cycle(
    network: Network, at: Motion, known: FullCycle | None = None
) -> FullCycle:
    """The finite mobilities around a posture.

    Args:
        network: The mechanism.
        at: Its motion at the posture.
        known: The answer at the values of the file, where the rank is the same.
    """
    return known or FullCycle("undecided", (), "to be done")
