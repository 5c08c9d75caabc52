"""Where a limb's twists lose rank, in equations that hold there alone.

Each piece is the set where the rank is at most what it is in general on the piece.

References: [CoxLittleOShea] §9.1 (determinantal varieties).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Search
from screwkit.loci.exact_equations import (
    ExactPieces,
    Singularity,
    with_exact_equations,
)
from screwkit.loci.open_branches import undecided
from screwkit.loci.pieces import (
    Piece,
    lies_in,
    pieces_of,
    surely_in,
    without_contained,
)
from screwkit.loci.rank_drop import Column, RankDrop, generic_rank, rank_drop
from screwkit.loci.searching_again import SearchedLocus, searched_again


@dataclass(frozen=True)
class DropPieces:
    """What one search for a loss of rank came back with.

    Attributes:
        pieces: On which rank is lost.
        drops: On each of the branches that were searched.
    """

    pieces: tuple[Piece, ...]
    drops: tuple[RankDrop, ...]

    @property
    def reason(self) -> str:
        """Why there may be further pieces; empty where there are none."""
        left = [b for drop in self.drops for b in drop.decomposition.open]
        left = [b for b in left if not any(surely_in(b, p) for p in self.pieces)]
        return undecided(left) if left else ""


def exact_rank_drop(
    root: Branch,
    branches: Sequence[Branch],
    columns: Sequence[Column],
    library: FactorLibrary,
    drop_on: Callable[[Branch], RankDrop],
) -> SearchedLocus[DropPieces]:
    """The pieces on which columns have less rank than in general on these branches.

    Args:
        root: The whole configuration space.
        branches: Of one rank or several.
        columns: In the generators of the whole ring.
        library: Factors met before.
        drop_on: Searches one branch, with no piece known.
    """

    def search(given: Sequence[Piece]) -> DropPieces:
        def is_given(branch: Branch) -> bool:
            return any(lies_in(branch, piece) for piece in given)

        if given:
            drops = tuple(
                rank_drop(branch, columns, Search(library, skip=is_given))
                for branch in branches
            )
        else:
            drops = tuple(map(drop_on, branches))
        found = pieces_of([b for drop in drops for b in drop.decomposition.branches])
        return DropPieces(tuple(without_contained([*given, *found])), drops)

    def exact(pieces: Sequence[Piece]) -> ExactPieces:
        each = [_exact(piece, root, columns, library) for piece in pieces]
        return ExactPieces(
            tuple(piece for one in each for piece in one.pieces),
            sum(one.uncertain for one in each),
            any(one.narrowed for one in each),
        )

    return searched_again(search, exact)


def rank_on(piece: Piece, columns: Sequence[Column]) -> int:
    """Rank of columns in general on a piece."""
    return max(generic_rank(branch, columns) for branch in piece.branches)


def _exact(
    piece: Piece, root: Branch, columns: Sequence[Column], library: FactorLibrary
) -> ExactPieces:
    rank = rank_on(piece, columns)
    singular = Singularity(
        root,
        lambda: [list(column) for column in columns],
        lambda branch: generic_rank(branch, columns) <= rank,
        library,
        rank + 1,
    )
    return with_exact_equations([piece], singular)
