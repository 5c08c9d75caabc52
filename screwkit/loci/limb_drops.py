"""Where the twists of a serial limb lose rank, searched once for all who ask."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any
from weakref import WeakKeyDictionary

from screwkit.algebra.branches import Branch
from screwkit.algebra.search import Search
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.loci.exact_rank_drop import DropPieces, exact_rank_drop
from screwkit.loci.rank_drop import RankDrop, rank_drop
from screwkit.loci.searching_again import SearchedLocus

# Branches are kept with what was found on them, so that no other gets their number.
_Found = dict[tuple[str, tuple[int, ...]], tuple[Sequence[Branch], Any]]
_DROPS: WeakKeyDictionary[Assembly, _Found] = WeakKeyDictionary()
_PIECES: WeakKeyDictionary[Assembly, _Found] = WeakKeyDictionary()


def limb_drop(assembly: Assembly, limb: LimbChain, branch: Branch) -> RankDrop:
    """Where on a branch a limb of joints in series loses rank.

    Args:
        assembly: The mechanism.
        limb: A serial limb.
        branch: In the limb's own ring; the same object where the same is meant.
    """
    known = _DROPS.setdefault(assembly, {})
    key = limb.name, (id(branch),)
    if key not in known:
        framed = assembly.limb_twists[limb.name]
        columns = [framed.column(joint) for joint in limb.joints]
        search = Search(assembly.library(framed.ring))
        known[key] = (branch,), rank_drop(branch, columns, search)
    drop: RankDrop = known[key][1]
    return drop


def limb_pieces(
    assembly: Assembly, limb: LimbChain, branches: Sequence[Branch]
) -> SearchedLocus[DropPieces]:
    """The pieces of these branches on which a serial limb loses rank.

    Args:
        assembly: The mechanism.
        limb: A serial limb.
        branches: In the limb's own ring; the same objects where the same are meant.
    """
    known = _PIECES.setdefault(assembly, {})
    key = limb.name, tuple(map(id, branches))
    if key not in known:
        framed = assembly.limb_twists[limb.name]
        columns = [framed.column(joint) for joint in limb.joints]
        found = exact_rank_drop(
            assembly.root(framed.ring),
            branches,
            columns,
            assembly.library(framed.ring),
            partial(limb_drop, assembly, limb),
        )
        known[key] = tuple(branches), found
    pieces: SearchedLocus[DropPieces] = known[key][1]
    return pieces
