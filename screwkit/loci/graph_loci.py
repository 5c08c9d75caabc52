"""The singular loci of any joint graph, from the loop equations alone.

Constraint: where the loop constraint matrix C loses rank.  Actuation: where, with the
actuated freedoms locked, the platform moves; only where the columns of the others lose
rank can it do so.  Limb: where rank [C; P] − rank C of the limb falls, P being the
platform's twist; only where [C; P] loses rank can it.  Pieces of such a matrix's locus
that are no finds themselves are searched in turn, for what lies inside.

References: [Zlatanov2002], [LongCaroKhalil2012] §5.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from functools import partial

from screwkit.algebra.branches import Branch
from screwkit.algebra.names import counted
from screwkit.algebra.points import Point
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.kinematics.whole_graph import (
    GraphState,
    Row,
    WholeGraph,
    ranks_of,
    state_of,
)
from screwkit.loci.exact_equations import Singularity, with_exact_equations
from screwkit.loci.matrix_drop import MatrixZeros, RankAt, matrix_zeros
from screwkit.loci.pieces import (
    Piece,
    lies_in,
    pieces_of,
    surely_in,
    without_contained,
)
from screwkit.loci.searching_again import searched_again

_LONGEST = 60_000  # terms of a polynomial that is factored
_BUDGET = 600  # case distinctions on one locus

Judge = Callable[[Branch], bool]
"""Whether a branch with exact points is a find."""


@dataclass(frozen=True)
class GraphLocus:
    """What was found of a locus.

    Attributes:
        pieces: The finds.
        others: Largest pieces on which the matrix loses rank, and which are no finds.
        reason: Why the list may have gaps; empty where it is proved to have none.
        hypersurfaces_known: Whether all pieces of one condition were found.
    """

    pieces: tuple[Piece, ...]
    others: tuple[Piece, ...] = ()
    reason: str = ""
    hypersurfaces_known: bool = True


def constraint_locus(graph: WholeGraph) -> GraphLocus:
    """Where the loop constraint matrix loses rank."""
    _, rows = graph.equations()

    def rank_at(point: Point, prime: int) -> int:
        return graph.motion_at(point, prime).rank

    return _searched(graph, rows, rank_at, lambda branch: True)


def actuation_locus(graph: WholeGraph, actuated: Collection[str]) -> GraphLocus:
    """Where the platform moves with these freedoms locked, though not in general."""
    _, rows = graph.equations(actuated)

    def rank_at(point: Point, prime: int) -> int:
        return graph.motion_at(point, prime, actuated).rank

    def moves(branch: Branch) -> bool:
        return state_on(graph, [branch], actuated).platform_freedom > 0

    return _searched(graph, rows, rank_at, moves)


def limb_locus(limb: WholeGraph) -> GraphLocus:
    """Where a limb, taken as a mechanism of its own, allows the platform less."""
    _, rows = limb.equations(held=True)
    generic = limb.generic_state().platform_freedom

    def rank_at(point: Point, prime: int) -> int:
        return state_of(limb.motion_at(point, prime)).held

    def holds(branch: Branch) -> bool:
        return state_on(limb, [branch]).platform_freedom < generic

    return _searched(limb, rows, rank_at, holds)


def state_on(
    graph: WholeGraph, branches: Sequence[Branch], locked: Collection[str] = ()
) -> GraphState:
    """What moves in general on the first branches of a piece."""
    states = [
        state_of(graph.motion_at(*point, locked))
        for branch in branches[:2]
        for point in branch.points
    ]
    return max(states, key=ranks_of)


@dataclass(frozen=True)
class _Searched:
    """What one search came back with.

    Attributes:
        pieces: The finds.
        others: Pieces on which the matrix loses rank, and which are no finds.
        zeros: Of the matrix, everywhere and on the others.
        depths: Least codimensions of what was left open.
    """

    pieces: Sequence[Piece]
    others: Sequence[Piece]
    zeros: Sequence[MatrixZeros]
    depths: Sequence[int]

    @property
    def reason(self) -> str:
        """Why the list of finds may have gaps; empty where it has none."""
        return _why_open(self.zeros, self.depths)


def _searched(
    graph: WholeGraph, rows: Sequence[Row], rank_at: RankAt, is_find: Judge
) -> GraphLocus:
    """Finds on the locus of a matrix, those inside of other pieces too."""
    singular = Singularity(
        graph.root, partial(_columns, rows, graph.root.ring), is_find, graph.library
    )
    found = searched_again(
        lambda given: _search(graph, rows, rank_at, is_find, given),
        partial(with_exact_equations, singular=singular),
    )
    finds = found.exact.pieces
    others = without_contained(found.last.others)
    return GraphLocus(
        finds,
        tuple(piece for piece in others if not _lies_in_any(piece, finds)),
        found.reason,
        min(found.last.depths, default=2) > 1,
    )


def _search(
    graph: WholeGraph,
    rows: Sequence[Row],
    rank_at: RankAt,
    is_find: Judge,
    given: Sequence[Piece],
) -> _Searched:
    """One search, which passes over what lies on a given piece."""
    search = Search(graph.library, budget=_BUDGET, largest=_LONGEST)
    finds = list(given)
    search.skip = lambda branch: any(lies_in(branch, piece) for piece in finds)
    zeros = matrix_zeros(graph.root, rows, rank_at, search)
    others: list[Piece] = []
    everything = [zeros]
    waiting = pieces_of(zeros.branches)
    while waiting:
        piece = waiting.pop(0)
        branch = piece.branches[0]
        if any(lies_in(branch, find) for find in finds):
            continue
        if is_find(branch):
            finds.append(piece)
            continue
        if any(_same(piece, other) for other in others):
            continue
        others.append(piece)
        inside = [matrix_zeros(b, rows, rank_at, search) for b in piece.branches]
        everything += inside
        waiting += pieces_of([b for found in inside for b in found.branches])
    finds = without_contained(finds)
    return _Searched(finds, others, everything, _open_depths(everything, finds))


def _columns(rows: Sequence[Row], ring: TrigonometricRing) -> list[list[Polynomial]]:
    width = 1 + max((place for row in rows for place in row), default=-1)
    return [[row.get(place, ring.zero) for row in rows] for place in range(width)]


def _same(one: Piece, other: Piece) -> bool:
    return {str(e) for e in one.equations} == {str(e) for e in other.equations}


def _lies_in_any(piece: Piece, others: Sequence[Piece]) -> bool:
    return any(lies_in(piece.branches[0], other) for other in others)


def _open_depths(found: Sequence[MatrixZeros], finds: Sequence[Piece]) -> list[int]:
    """Least codimensions of what was left open outside the finds."""
    return [
        max(depth, branch.codimension)
        for zeros in found
        for branch, depth in zeros.open
        if not branch.points or not any(surely_in(branch, find) for find in finds)
    ]


def _why_open(found: Sequence[MatrixZeros], depths: Sequence[int]) -> str:
    """Why a list of finds may have gaps, in words; empty where it has none."""
    if not depths:
        return ""
    sizes = sorted({size for zeros in found for size in zeros.too_large})
    if sizes:
        most = sizes[-1]
        return (
            f"the determinants of {counted(len(sizes), 'block')} of the loop "
            f"equations, up to {most[0]} by {most[1]}, are too long to expand"
        )
    noun = counted(len(depths), "piece")
    least = min(depths)
    if least > 1:
        return (
            f"all pieces of codimension {least - 1} were found; {noun} of codimension "
            f"{least} or more could not be decided within the budget"
        )
    return f"{noun} of the locus could not be decided within the budget"
