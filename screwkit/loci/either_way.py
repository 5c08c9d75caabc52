"""Where limbs become dependent, with angles solved or kept that conditions fix.

Links of several limbs that point along lines each fix an angle of their own
(`algebra.fixed_directions`).  Solved for coordinates of the platform such conditions
lose that form; where this leaves something undecided they are kept as they are.  Where
that leaves something too, branches that would stay open are taken further, also
thoroughly: with points on conditions that share their unknowns; and in the end wrenches
in a few coordinates are looked at on their own, even if none of them is redundant.

References: [CoxLittleOShea] §5.4 (the coordinate ring of a variety).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.fixed_directions import SEVERAL, has_directions_alone
from screwkit.algebra.search import Search
from screwkit.kinematics.limb_parts import Parts
from screwkit.loci.dependence import (
    Dependence,
    dependent_zeros,
    has_separate_blocks,
)

_KEPT = 900
"""Case distinctions on a branch where angles are kept."""

_FURTHER = 150
"""The same where branches that would be left open are taken further."""


def zeros_either_way(
    branch: Branch, limbs: Sequence[Parts], search: Search, *, kept_first: bool
) -> tuple[Dependence, bool]:
    """Where on a branch the limbs lose a dimension together, of what keeps their ranks.

    Args:
        branch: Irreducible.
        limbs: Parts of each limb, in coordinates that tell their twists apart.
        search: Budget, known factors, and what to leave out.  Where angles are kept, or
            branches taken further, a budget of its own is used.
        kept_first: Keep angles before they are solved; for where this went to the end
            on other branches.

    Returns:
        What was found, by the way that left nothing undecided if there is one, and
        whether it is the one that keeps angles.
    """
    if not has_directions_alone(branch):
        solved = _zeros(branch, limbs, search)
        return _further(branch, limbs, search, solved), False
    if kept_first and len(branch.pending) >= SEVERAL:
        found = _with_angles_kept(branch, limbs, search)
        return (_zeros(branch, limbs, search), False) if found.open else (found, True)
    solved = _zeros(branch, limbs, search)
    if not solved.open:
        return solved, False
    found = _with_angles_kept(branch, limbs, search)
    if found.open and has_separate_blocks(branch, limbs, search):
        found = _with_angles_kept(branch, limbs, search, overlapping=False)
    if not found.open:
        return found, True
    return _further(branch, limbs, search, solved), False


def _further(
    branch: Branch, limbs: Sequence[Parts], search: Search, solved: Dependence
) -> Dependence:
    """What was solved, or what was found where open branches were taken further."""
    if not solved.open:
        return solved
    thorough = replace(branch, thorough=True)
    ways = [(branch, True), (thorough, True)] if search.budget > 0 else []
    if has_separate_blocks(branch, limbs, search):
        ways.append((branch, False))
    for whole, overlapping in ways:
        own = replace(search, further=True, budget=_FURTHER)
        found = _zeros(whole, limbs, own, overlapping=overlapping)
        if not found.open:
            return found
    return solved


def _with_angles_kept(
    branch: Branch,
    limbs: Sequence[Parts],
    search: Search,
    *,
    overlapping: bool = True,
) -> Dependence:
    """The finds are branches like others, whose angles may be solved."""
    kept = replace(branch, directed=True)
    own = replace(search, budget=_KEPT)
    found = _zeros(kept, limbs, own, overlapping=overlapping)
    plain = tuple(replace(part, directed=False) for part in found.branches)
    return replace(found, branches=plain)


def _zeros(
    branch: Branch,
    limbs: Sequence[Parts],
    search: Search,
    *,
    overlapping: bool = True,
) -> Dependence:
    return dependent_zeros(
        branch, limbs, search, within=True, in_blocks=True, overlapping=overlapping
    )
