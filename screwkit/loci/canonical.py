"""Equations of a piece in the words of the limbs' own conditions, where possible.

A later condition is found on a branch, after earlier ones were substituted, and may
read strangely: on r3 cos q2 + d3 sin q2 = 0 the mirrored condition shows up as
sin(q2 + q7) = 0.  Where a known condition does the same, it is preferred; that both
describe the same set is decided, not assumed.
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.modular import rank
from screwkit.algebra.points import differential, residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.pieces import Piece, lies_in

_BUDGET = 30


def in_known_conditions(
    piece: Piece, root: Branch, known: Sequence[Polynomial], search: Search
) -> Piece:
    """The same piece, with known conditions for equations where that is exact."""
    equations = list(piece.equations)
    present = {str(e) for e in equations}
    wanted = [
        f
        for f in known
        if str(f) not in present and all(_vanishes(f, b) for b in piece.branches)
    ]
    if not wanted or not piece.branches[0].points:
        return piece
    for position, equation in enumerate(equations):
        if str(equation) in {str(f) for f in known}:
            continue
        for f in wanted:
            trial = [*equations]
            trial[position] = f
            if not _independent(piece.branches[0], trial):
                continue
            if _same(trial, piece, root, search):
                equations = trial
                wanted.remove(f)
                break
    return Piece(tuple(equations), piece.branches)


def _vanishes(polynomial: Polynomial, branch: Branch) -> bool:
    return bool(branch.points) and not any(
        residue(polynomial, point, prime) for point, prime in branch.points
    )


def _independent(branch: Branch, equations: Sequence[Polynomial]) -> bool:
    point, prime = branch.points[0]
    rows = [differential(branch.ring, e, point, prime) for e in equations]
    return rank(rows, prime) == len(equations)


def _same(
    equations: Sequence[Polynomial], piece: Piece, root: Branch, search: Search
) -> bool:
    """Whether the equations have exactly this piece as their zeros."""
    fresh = Search(search.library, budget=_BUDGET)

    def is_refuted(_: Branch) -> bool:
        beside = (b for b in fresh.found if not lies_in(b, piece))
        return bool(fresh.unfinished) or any(beside)

    fresh.skip = is_refuted  # then nothing more need be known
    zeros = common_zeros(root, equations, fresh)
    if not zeros.complete or not zeros.branches:
        return False
    return all(lies_in(branch, piece) for branch in zeros.branches) and all(
        lies_in(branch, other)
        for other in [Piece(tuple(equations), zeros.branches)]
        for branch in piece.branches
    )
