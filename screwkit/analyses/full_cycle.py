"""Whether the instantaneous freedoms integrate to finite motion.

First come exact arguments; where none applies, the branches through the posture are
sampled, and where samples disagree with each other the question stays open.  Samples
also say how each branch moves.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from screwkit.finite.finite_motion import FiniteMotion
from screwkit.finite.finite_proofs import proved_mobility
from screwkit.finite.near_miss import near_miss
from screwkit.finite.sampling import sampled_motion
from screwkit.kinematics.network import Motion, Network
from screwkit.results.mobility import FullCycle, MotionBranch, Platform

OUT_OF_PLANE = 2
"""Couples about axes in the plane, of which planar files do not speak."""


def full_cycle(
    network: Network, at: Motion, known: FullCycle | None = None
) -> FullCycle:
    """The finite mobilities around a posture.

    Args:
        network: The mechanism.
        at: Its motion at the posture.
        known: The answer at the values of the file, where the rank is the same.
    """
    mechanism = network.mechanism
    held = any(joint.held for joint in mechanism.joints)
    if mechanism.geometry == "mdh" and not network.tied and not held:
        return _all_closed(network, at)
    proof = proved_mobility(network, at)
    if known is not None:
        sample = None
    else:
        sample = sampled_motion(mechanism, generic=bool(mechanism.parameters))
    if proof is not None:
        branches = known.branches if known is not None else _branches(network, sample)
        if {branch.mobility for branch in branches} - set(proof.mobility):
            branches = ()  # a sample that went elsewhere proves nothing
        reason = proof.reason
        missed = "" if network.has_symbols else near_miss(mechanism, at.rank)
        if missed:
            reason = f"{reason}; {missed}"
        return FullCycle("proved", proof.mobility, reason, branches)
    if known is not None:
        if known.status == "undecided":
            return known
        reason = (
            f"at the values of the file, where the rank is the same: {known.reason}"
        )
        return FullCycle("sampled", known.mobility, reason, known.branches)
    assert sample is not None
    return cycle_of(network, sample)


@dataclass(frozen=True)
class OnTheMotion:
    """Ranks on the motion through a posture that is itself special."""

    loop_rank: int
    platform: Platform


def on_the_motion(
    network: Network, cycle: FullCycle, about: Platform
) -> OnTheMotion | None:
    """The generic numbers where loops tie joint variables together.

    None where the posture is as good as any, or its branches differ in rank.  Of
    branches that move differently the one on which most samples fell is taken.
    """
    if not network.tied or not cycle.branches:
        return None
    ranks = {branch.loop_rank for branch in cycle.branches}
    if len(ranks) > 1 or ranks == {network.motion.rank}:
        return None
    branch = max(cycle.branches, key=lambda b: b.starts)
    kind = branch.motion_type
    translations, rotations = (int(n) for n in kind.removesuffix("R").split("T"))
    size = len(network.rows)
    freedom = translations + rotations
    return OnTheMotion(
        ranks.pop(),
        replace(
            about,
            twist_dimension=freedom,
            translations=translations,
            rotations=rotations,
            motion_type=kind,
            wrench_dimension=size - freedom,
            couples=branch.couples,
            motion_class=None,
        ),
    )


def _all_closed(network: Network, at: Motion) -> FullCycle:
    """Where the object is grasped wherever the limbs are."""
    if at.rank == len(network.rows) * len(network.loops):
        reason = (
            "all joint variables are free and every posture is closed; the closure "
            "equations are independent, so the motion is finite"
        )
    else:
        reason = (
            "all joint variables are free and every posture is closed; the rank of the "
            "closure equations is the same at all postures around a generic one, so "
            "the motion is finite"
        )
    return FullCycle("proved", (at.mobility,), reason)


def cycle_of(network: Network, sample: FiniteMotion) -> FullCycle:
    """Samples as they are reported."""
    branches = _branches(network, sample)
    return FullCycle(sample.status, sample.mobility, sample.reason, branches)


def _in_plane(kind: str) -> str:
    """A motion type without what a plane leaves out: bodies on nothing had it all."""
    return "2T1R" if kind == "3T3R" else kind


def _branches(
    network: Network, sample: FiniteMotion | None
) -> tuple[MotionBranch, ...]:
    if sample is None:
        return ()
    planar = len(network.rows) == 3
    return tuple(
        MotionBranch(
            branch.mobility,
            branch.instantaneous_mobility,
            branch.loop_rank,
            len(network.rows) * len(network.loops) - branch.loop_rank,
            _in_plane(branch.motion_type) if planar else branch.motion_type,
            max(branch.couples - OUT_OF_PLANE, 0) if planar else branch.couples,
            branch.motion,
            branch.starts,
            branch.modes,
            _in_plane(branch.finite_type) if planar else branch.finite_type,
        )
        for branch in sample.branches
    )
