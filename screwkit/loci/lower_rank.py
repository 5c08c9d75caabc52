"""Where closed postures have less than the rank that they have in general.

Overconstrained loops have a lower rank when closed than joint variables without ties
would have, and the free matrix loses that rank on sets of high codimension.  So minors
of the size of the closed rank are taken together with the closing equations at once:
what they imply for one joint variable has no real solution, or a few, at which the
closed postures are looked at.

References: [CoxLittleOShea] §3.1, §9.1.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.points_on import Unknown
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.whole_graph import Row
from screwkit.loci.closed_pieces import TiedLocus, TiedPiece, is_impossible
from screwkit.loci.matrix_drop import RankAt, minors_at
from screwkit.loci.pieces import pieces_of

_MINORS = 8  # asked together; more make the elimination long
_LONGEST = 400  # terms of them together
_CASES = 60  # case distinctions on what they imply


def lower_rank(
    graph: TiedGraph, rows: Sequence[Row], at: RankAt, kept: Collection[Unknown]
) -> TiedLocus:
    """Closed postures at which a matrix has not its rank at closed postures.

    Args:
        graph: With exact closed postures.
        rows: Of the matrix, in the ring of the graph.
        at: Its rank at exact points.
        kept: The unknowns to which conditions are brought first.
    """
    regular = max(graph.closed.points, key=lambda point: at(*point))
    rank = at(*regular)
    minors = minors_at(graph.root, rows, *regular, _MINORS)
    if not minors or sum(map(len, minors)) > _LONGEST:
        return TiedLocus(
            (), f"the minors of size {rank} of the loop equations are too long"
        )
    undecided: str = f"whether closed postures have rank below {rank} was not decided"
    tried = False
    for chosen in _choices(graph, kept):
        implied = graph.implied(minors, chosen)
        if implied is None:
            continue
        tried = True
        if is_impossible(graph, implied):
            return TiedLocus(())
        found = _looked_at(graph, implied.left, minors, at, rank)
        if found is not None:
            return TiedLocus(found)
    if not tried:
        undecided += ": its joint variables could not be taken out one by one"
    return TiedLocus((), undecided)


def _choices(
    graph: TiedGraph, kept: Collection[Unknown]
) -> Iterator[Collection[Unknown]]:
    """Unknowns to keep: those asked for, then each angle alone."""
    if kept:
        yield kept
    for number in range(len(graph.framed.ring.basis)):
        alone = [("angle", number)]
        if list(kept) != alone:
            yield alone


def _looked_at(
    graph: TiedGraph,
    implied: Sequence[Polynomial],
    minors: Sequence[Polynomial],
    at: RankAt,
    rank: int,
) -> tuple[TiedPiece, ...] | None:
    """The conditions on which closed postures have lower rank; None if undecided."""
    search = Search(graph.library, budget=_CASES)
    zeros = common_zeros(graph.root, implied, search)
    if zeros.open:
        return None
    found = []
    for piece in pieces_of(zeros.branches):
        if never_met(graph.framed.ring, piece.equations):
            continue
        if _is_regular(graph, [*piece.equations, *minors]):
            continue
        closed = graph.closed_where(piece.equations)
        if not closed.is_complete or not closed.points:
            return None
        if max(at(*point) for point in closed.points) >= rank:
            return None  # the condition does not tell them from other postures
        found.append(TiedPiece(piece, closed.points))
    return tuple(found)


def _is_regular(graph: TiedGraph, equations: Sequence[Polynomial]) -> bool:
    """Whether it is proved that equations hold at no closed posture."""
    for chosen in _choices(graph, ()):
        implied = graph.implied(equations, chosen)
        if implied is not None and is_impossible(graph, implied):
            return True
    return graph.closed_where(equations).is_empty
