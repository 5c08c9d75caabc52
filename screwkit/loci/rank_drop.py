"""Where a list of twists loses rank: the zeros of its maximal minors.

The size of the minors is the generic rank on the branch, so that systems which are
dependent everywhere (planar arms in space) are treated like any other.

References: [CoxLittleOShea] §9.1 (determinantal varieties), [LongCaroKhalil2012] §5.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.minors import minor_table, minors_of, minors_of_size
from screwkit.algebra.nowhere_zero import without_nowhere_zero
from screwkit.algebra.points import rank_at
from screwkit.algebra.search import Decomposition, Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, content

Column = Sequence[Polynomial]


@dataclass(frozen=True)
class RankDrop:
    """The locus, on a branch, where a matrix falls below its generic rank there.

    Attributes:
        rank: Generic on the branch.
        minors: The maximal minors that are not zero on the branch.
    """

    rank: int
    minors: tuple[Polynomial, ...]
    decomposition: Decomposition


def generic_rank(branch: Branch, columns: Sequence[Column]) -> int:
    """Rank of a matrix on a branch, at random exact points of it."""
    return max(
        (rank_at(columns, point, prime) for point, prime in branch.points),
        default=0,
    )


def rank_drop(branch: Branch, columns: Sequence[Column], search: Search) -> RankDrop:
    """Where on ``branch`` the columns have less than their generic rank there.

    Args:
        branch: The piece of the configuration space.
        columns: In the generators of the whole ring; they are restricted here.
        search: Budget, known factors, and pieces to leave out.
    """
    rank = generic_rank(branch, columns)
    minors = maximal_minors(branch, columns, rank)
    fresh = replace(search, found=[], unfinished=[])
    return RankDrop(rank, tuple(minors), common_zeros(branch, minors, fresh))


def maximal_minors(
    branch: Branch, columns: Sequence[Column], rank: int
) -> list[Polynomial]:
    """All non-zero minors of size ``rank``, each once up to a factor."""
    on_branch = [branch.column(column) for column in columns]
    return minors_of_size(branch.ring, on_branch, rank)


def extensors(
    branch: Branch,
    columns: Sequence[Column],
    rank: int,
    library: FactorLibrary | None = None,
) -> list[dict[int, Polynomial]]:
    """Plücker coordinates of the span on a branch, one chart per choice of columns.

    Where the rank is ``rank`` at least one chart is not zero, and the charts are
    proportional.  A choice of columns that are dependent on all of the branch has no
    chart: conditions that are not solved do not show that its coordinates vanish, and
    without their common factor they would speak of other screws.

    Args:
        branch: Where the columns are taken.
        columns: As in `rank_drop`.
        rank: Of them on the branch.
        library: Divide each chart by the common factor of its coordinates, found with
            these factors; where that vanishes the rank is less.
    """
    on_branch = [branch.column(column) for column in columns]
    charts = [
        minors
        for minors in _charts(branch.ring, on_branch, rank)
        if minors and not branch.vanishes([*minors.values()])
    ]
    nonzero = branch.divisors
    different: dict[str, dict[int, Polynomial]] = {}
    for minors in charts:
        values = without_nowhere_zero(branch.ring, [*minors.values()], nonzero)
        if library is not None:
            values = [*without_common_factors(branch.ring, values, library)]
        scale = content(values[0])
        chart = {
            rows: value / scale for rows, value in zip(minors, values, strict=True)
        }
        different.setdefault(str(sorted(chart.items(), key=_by_rows)), chart)
    return sorted(different.values(), key=lambda c: sum(len(v) for v in c.values()))


def _charts(
    ring: TrigonometricRing, columns: Sequence[Column], rank: int
) -> list[dict[int, Polynomial]]:
    """The minors of every choice of that many columns."""
    if rank == len(columns):
        return [minors_of(ring, columns)]
    table = minor_table(ring, columns, len(columns[0]), rank)
    return [minors for chosen, minors in table.items() if chosen.bit_count() == rank]


def _by_rows(entry: tuple[int, Polynomial]) -> int:
    return entry[0]
