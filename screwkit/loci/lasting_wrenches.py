"""Wrenches that limbs have at every posture, and where these let go of the platform.

The wrenches of a limb found by Cramer's rule are polynomials reciprocal to its twists,
divided by what they share.  They stay reciprocal where the limb loses rank, though it
has others there.  So wherever the platform can move they have lost rank: what lies
elsewhere on a piece on which a limb idles need not be searched.

References: [CoxLittleOShea] §9.1 (determinantal varieties), [LongCaroKhalil2012] (26).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import comb

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.minors import minors_of_size
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.limb_parts import Parts, has_loops, motion_at
from screwkit.loci.pieces import Piece, lies_in, surely_in
from screwkit.loci.wrench_blocks import block_minors, wrenches_on
from screwkit.loci.wrench_sums import height_of
from screwkit.loci.wrench_vectors import ALL, Vector, overlap_minors

_DEAREST = 3_000_000  # products of terms in a minor of all wrenches
_LONGEST = 4_000  # terms of all their minors
_SHORT = 200  # terms of a limb's wrenches
_BUDGET = 150  # case distinctions on one list of minors


def all_are_held(
    root: Branch,
    limbs: Sequence[Parts],
    moving: Sequence[Piece],
    idle: Sequence[Piece],
    search: Search,
    *,
    all_known: bool,
) -> bool:
    """Whether the platform is shown to be held wherever no piece says that it moves.

    Args:
        root: The whole configuration space.
        limbs: Passive twists of each, that hold the platform in general.
        moving: Pieces on which the platform moves in general.
        idle: Pieces on which only limbs move, in general.
        search: Known factors.
        all_known: Whether whatever moves more than in general lies on these pieces.
    """
    if not all(limbs):
        return True  # the platform is locked to the base by a limb
    height = height_of(limbs)
    if not root.points or any(map(has_loops, limbs)):
        return False
    at = root.points[0]
    each = [_lasting(root, limb, height, at, search) for limb in limbs]
    systems = [own for own in each if own is not None]
    if len(systems) < len(limbs):
        return False
    wrenches = [wrench for own in systems for wrench in own.wrenches]
    if all_known and sum(own.dimension for own in systems) == height:
        # Where those of each limb are independent, one determinant tells all; its zeros
        # are of codimension 1, but for real ones of sums of squares.
        if not all(_span_all(wrenches, piece) for piece in idle):
            return False
        if all(own.is_independent(root, moving, search) for own in systems):
            return True
    lists = block_minors(root, limbs, height, search)
    if lists is None:
        minors = overlap_minors(root, wrenches, at, _DEAREST, _LONGEST)
        lists = [minors] if minors else []
    return bool(lists) and all(
        _lie_in(root, minors, moving, search) for minors in lists
    )


def lasting_minors(
    root: Branch, limbs: Sequence[Parts], search: Search
) -> tuple[list[Polynomial], int]:
    """Polynomials that vanish wherever more wrenches than needed let the platform go.

    Args:
        root: The whole configuration space.
        limbs: Passive twists of each, that hold the platform in general.
        search: Known factors.

    Returns:
        The minors of the wrenches that the limbs have at every posture, and the largest
        codimension of a part of their common zeros; no minors where the limbs hold the
        platform by no more wrenches than a twist has coordinates, or these are too
        many.
    """
    if not all(limbs) or not root.points or any(map(has_loops, limbs)):
        return [], 0
    height, at = height_of(limbs), root.points[0]
    each = [_lasting(root, limb, height, at, search) for limb in limbs]
    systems = [own for own in each if own is not None]
    wrenches = [wrench for own in systems for wrench in own.wrenches]
    count = len(wrenches)
    if len(systems) < len(each) or comb(count, height) > ALL:
        return [], 0
    if sum(own.dimension for own in systems) <= height:
        return [], 0
    minors = overlap_minors(root, wrenches, at, _DEAREST, _LONGEST)
    return minors, count - height + 1


@dataclass(frozen=True)
class _Lasting:
    """Reciprocal to a limb's twists everywhere; in general they span its system."""

    wrenches: Sequence[Vector]
    dimension: int

    def is_independent(
        self, root: Branch, known: Sequence[Piece], search: Search
    ) -> bool:
        """Whether they span less in known pieces alone, or where one determinant says.

        Not shown of many or long ones.
        """
        count, size = len(self.wrenches), self.dimension
        if count == size:
            return True
        height = len(self.wrenches[0])
        long = sum(len(x) for wrench in self.wrenches for x in wrench) > _SHORT
        if long or comb(count, size) * comb(height, size) > ALL:
            return False
        minors = minors_of_size(root.ring, self.wrenches, size)
        return _lie_in(root, minors, known, search)


def _lasting(
    root: Branch, limb: Parts, height: int, at: tuple[Point, int], search: Search
) -> _Lasting | None:
    found = wrenches_on(root, limb, height, at, search)
    if found is None:
        return None
    return _Lasting(found, height - motion_at(limb, height, *at).dimension)


def _span_all(wrenches: Sequence[Vector], piece: Piece) -> bool:
    """Whether wrenches span all coordinates, in general on each sheet of a piece."""
    return all(
        any(
            rank([[residue(x, point, prime) for x in w] for w in wrenches], prime)
            == len(wrenches[0])
            for point, prime in branch.points
        )
        for branch in piece.branches
    )


def _lie_in(
    root: Branch, minors: Sequence[Polynomial], known: Sequence[Piece], search: Search
) -> bool:
    """Whether all common zeros lie in known pieces."""
    own = replace(
        search,
        found=[],
        unfinished=[],
        special=[],
        budget=_BUDGET,
        skip=lambda branch: any(lies_in(branch, piece) for piece in known),
    )
    zeros = common_zeros(root, minors, own)
    return not zeros.branches and all(
        any(surely_in(branch, piece) for piece in known) for branch in zeros.open
    )
