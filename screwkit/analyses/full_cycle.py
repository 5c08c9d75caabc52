"""Whether the instantaneous freedoms integrate to finite motion.

First come exact arguments; where none applies, the branches through the posture are
sampled, and where samples disagree with each other the question stays open.  Samples
also say how each branch moves.
"""

from __future__ import annotations

from dataclasses import replace

from screwkit.finite.finite_branches import TURNING, FiniteBranch, kind_of
from screwkit.finite.finite_motion import FiniteMotion
from screwkit.finite.finite_proofs import (
    Proof,
    UpperBound,
    proved_mobility,
    rests_on_contacts,
    upper_bound,
)
from screwkit.finite.idle_freedoms import idle_freedoms
from screwkit.finite.near_miss import near_miss
from screwkit.finite.near_motion import near_motion
from screwkit.finite.sampling import sampled_motion
from screwkit.kinematics.network import Motion, Network
from screwkit.results.mobility import FullCycle, MotionBranch

_NO_ROLLING = (
    "contacts are taken to keep their points and normals: what rolling would change is "
    "not known"
)

OUT_OF_PLANE = 2
"""Couples about axes in the plane, of which planar files do not speak."""


def full_cycle(
    network: Network, at: Motion, kind: str, known: FullCycle | None = None
) -> tuple[FullCycle, FiniteMotion | None]:
    """The finite mobilities around a posture, and the samples where some were taken.

    Args:
        network: The mechanism.
        at: Its motion at the posture.
        kind: The platform's motion type there.
        known: The answer at the values of the file, where the rank is the same.
    """
    mechanism = network.mechanism
    held = any(joint.held for joint in mechanism.joints)
    if mechanism.geometry == "mdh" and not network.tied and not held:
        return _all_closed(network, at), None
    proof = proved_mobility(network, at)
    if proof is not None and known is not None and _as_proved(known, at, kind):
        return FullCycle("proved", proof.mobility, proof.reason, known.branches), None
    if proof is not None and proof.mobility == (0,):
        return FullCycle("proved", proof.mobility, _proved(network, at, proof)), None
    exact = _exact_branch(network, at, proof) if proof else None
    if proof and exact and not _wants_samples(network, proof):
        told = _proved(network, at, proof)
        return FullCycle("proved", proof.mobility, told, (exact,)), None
    sample = sampled_motion(at, generic=bool(mechanism.parameters))
    if proof is None:
        cycle = bounded(cycle_of(network, sample), upper_bound(network, at))
        if rests_on_contacts(network, at):
            cycle = replace(cycle, reason=f"{cycle.reason}; {_NO_ROLLING}")
        return cycle, sample
    branches = _branches(network, sample)
    if {branch.mobility for branch in branches} - set(proof.mobility):
        branches = ()  # a sample that went elsewhere proves nothing
    notes = [_proved(network, at, proof)]
    if not branches and proof.mobility != (at.mobility,):
        where = "meanwhile" if exact is None else "on other branches"
        seen = exact is None or not proof.whole
        open_ = f"how the platform moves {where} is open: {sample.reason}"
        notes += [open_] if seen else []
    if exact is not None:
        branches = _those_like(exact, branches, whole=proof.whole)
    return FullCycle("proved", proof.mobility, "; ".join(notes), branches), sample


def _proved(network: Network, at: Motion, proof: Proof) -> str:
    """The argument, and what rounding may hide from it."""
    hidden = _what_rounding_hides(network, at, proof)
    return "; ".join(filter(None, (proof.reason, hidden)))


def _exact_branch(network: Network, at: Motion, proof: Proof) -> MotionBranch | None:
    """The branch of a proof that says how the platform moves; None if it does not.

    Words stay empty where residues do not tell them.
    """
    found = proof.motion
    if found is None:
        return None
    loop_rank = len(network.labels) - len(at.locked) - found.mobility
    branch = FiniteBranch(
        mobility=proof.mobility[-1],
        instantaneous_mobility=found.mobility,
        loop_rank=loop_rank,
        redundant_constraints=len(network.rows) * len(network.loops) - loop_rank,
        twist_dimension=found.twists[0],
        motion_type=kind_of(found.twists),
        finite_type=kind_of(found.along),
        couples=3 - found.twists[1],
        motion=found.words or "",
        starts=0,
    )
    return _reported(network, branch)


def _wants_samples(network: Network, proof: Proof) -> bool:
    """Whether more is asked for: postures, points on straight lines, a pitch."""
    found = proof.motion
    if network.tied or not proof.whole or found is None or found.words is None:
        return True
    return proof.mobility == (1,) and found.words in TURNING


def _those_like(
    exact: MotionBranch, sampled: tuple[MotionBranch, ...], *, whole: bool
) -> tuple[MotionBranch, ...]:
    """Of the samples those on the one branch there is, without what they err in.

    Where there may be others, all of them, and the known branch if none fell on it.
    """
    keys = [
        (branch.loop_rank, branch.motion_type, branch.finite_type)
        for branch in (exact, *sampled)
    ]
    alike = [b for b, key in zip(sampled, keys[1:], strict=True) if key == keys[0]]
    if not whole:
        return sampled if alike else (exact, *sampled)
    most = max(alike, key=lambda branch: branch.starts, default=exact)
    return (most,)


def _what_rounding_hides(network: Network, at: Motion, proof: Proof) -> str:
    """What the loops would be up to the rounding of decimals; mostly empty."""
    if network.has_symbols:
        return ""
    missed = near_miss(network.mechanism, at.rank)
    if not missed and at.mobility and proof.mobility == (len(idle_freedoms(at)),):
        missed = near_motion(at)
    return missed


def _as_proved(known: FullCycle, at: Motion, kind: str) -> bool:
    """Whether the values show one branch of full mobility that moves as in general.

    Then that branch, proved for generic values, need not be looked at again.
    """
    looks = {(branch.mobility, branch.motion_type) for branch in known.branches}
    return looks == {(at.mobility, kind)}


def _all_closed(network: Network, at: Motion) -> FullCycle:
    """Where the object is grasped wherever the limbs are."""
    if not at.mobility:
        reason = (
            "every posture of the joints is closed, and from a generic one no joint "
            "rates keep it so"
        )
        return FullCycle("proved", (0,), reason)
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


def bounded(cycle: FullCycle, bound: UpperBound | None) -> FullCycle:
    """Samples beside what is proved: the bound is told where they leave all open."""
    if bound is None:
        return cycle
    told = f"proved is that it is {bound.mobility} at most: {bound.reason}"
    if not cycle.mobility:
        return replace(cycle, reason=f"{cycle.reason}; {told}")
    if max(cycle.mobility) <= bound.mobility:
        return cycle
    found = " or ".join(map(str, cycle.mobility))
    return FullCycle("undecided", (), f"samples show {found}, yet {told}")


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
    return tuple(_reported(network, b) for b in sample.branches) if sample else ()


def _reported(network: Network, branch: FiniteBranch) -> MotionBranch:
    planar = len(network.rows) == 3
    return MotionBranch(
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
        branch.straight,
    )
