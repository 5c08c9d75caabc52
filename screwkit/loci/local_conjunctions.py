"""Statements that are a component near almost all of its points.

Several statements that are as many independent conditions at a component's exact points
are equal to it there.  What else satisfies them is searched once, on the whole space;
where that lies inside other components of the same list, it is said of which.

References: [CoxLittleOShea] §9.6 (smooth points, tangent spaces).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from screwkit.algebra.branches import Branch
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.points import differential
from screwkit.loci.pieces import Piece
from screwkit.loci.said_together import Conjunction, Said, stated


def up_to_others(
    piece: Piece,
    said: Sequence[Said],
    root: Branch,
    library: FactorLibrary,
    others: Sequence[Piece] = (),
    singular: Callable[[Branch], bool] | None = None,
) -> Conjunction | None:
    """Statements that hold on a piece and, but for it, inside few other components.

    Args:
        piece: A component.
        said: Statements that hold at its exact points, those first that are preferred.
        root: The space in which it lies.
        library: Factors met before, of the same ring.
        others: The components of its list, in their order.
        singular: See `stated`.

    Returns:
        None where none were found that are proved to hold nowhere else.
    """
    chosen = _independent(piece, said)
    if not chosen:
        return None
    return stated(chosen, piece, root, library, others, said, singular)


def _independent(piece: Piece, said: Sequence[Said]) -> list[Said]:
    """As many conditions at the exact points as the piece; empty if there are fewer."""
    places = [branch.points[0] for branch in piece.branches if branch.points]
    if not places:
        return []
    tangents = [_rows(one, piece, places) for one in said]

    def independent(numbers: Sequence[int], number: int) -> int:
        _, prime = places[number]
        return rank([row for n in numbers for row in tangents[n][number]], prime)

    def codimension(numbers: Sequence[int]) -> int:
        return min(independent(numbers, k) for k in range(len(places)))

    chosen: list[int] = []
    reached = 0
    for number in range(len(said)):
        more = codimension([*chosen, number])
        if more > reached:
            chosen.append(number)
            reached = more
        if reached == piece.codimension:
            break
    if reached < piece.codimension:
        return []
    for number in chosen[::-1]:
        rest = [other for other in chosen if other != number]
        if rest and codimension(rest) == piece.codimension:
            chosen = rest
    return [said[number] for number in chosen]


def _rows(
    one: Said, piece: Piece, places: Sequence[tuple[Sequence[int], int]]
) -> list[list[list[int]]]:
    """The differentials of what vanishes, at each of some exact points."""
    ring = piece.branches[0].ring
    return [
        [differential(ring, scalar, [*point], prime) for scalar in one[1]]
        for point, prime in places
    ]
