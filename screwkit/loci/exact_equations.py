"""Equations that hold on a piece alone, not at regular postures besides.

A piece of codimension two or more may need more equations than its codimension: three
points of the plane are in line with the origin where three determinants vanish, and two
of these vanish at regular postures too.  All zeros of a piece's equations are taken
apart; each part on which the loop constraint matrix keeps its rank is excluded by a
minor of the matrix that is not zero there.

References: [CoxLittleOShea] §9.1 (determinantal varieties).
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.cases import possible_factors
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent
from screwkit.algebra.points import Point, rank_at, residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.errors import TooLargeError
from screwkit.kinematics.assembly import loop_rows
from screwkit.loci.pieces import Piece
from screwkit.loci.rank_drop import Column

_BUDGET = 120  # case distinctions for the zeros of one piece's equations
_TRIED = 12  # choices of rows and columns, of which the shortest minor is taken
_PRODUCTS = 20_000  # of terms, in the expansion of a minor by one more column


def with_exact_equations(
    piece: Piece, root: Branch, limbs: Sequence[Sequence[Column]], search: Search
) -> Piece:
    """The piece with equations that exclude regular postures, where these are found.

    Args:
        piece: On which the loop constraint matrix has less than its generic rank.
        root: The whole configuration space.
        limbs: Twists of each limb.
        search: Known factors.
    """
    branch = piece.branches[0]
    solved = not any(step.partial for step in branch.steps)
    if not limbs or (solved and len(branch.pending) < 2):
        return piece
    own = Search(search.library, budget=_BUDGET, largest=search.largest)
    own = replace(
        own,
        every_part=True,
        skip=lambda part: part.codimension > piece.codimension,
    )
    zeros = common_zeros(root, piece.equations, own)
    if not zeros.complete:
        return piece
    rows = loop_rows(limbs)
    generic = max(rank_at(rows, *point) for point in root.points)
    extra: list[Polynomial] = []
    for part in zeros.branches:
        for point, prime in part.points:
            if rank_at(rows, point, prime) < generic:
                continue
            if any(residue(e, point, prime) for e in extra):
                continue
            minor = _minor_at(root, rows, point, prime)
            if minor is not None:
                extra.append(_on_piece(minor, piece, root, search))
    return replace(piece, equations=(*piece.equations, *extra))


def _on_piece(
    minor: Polynomial, piece: Piece, root: Branch, search: Search
) -> Polynomial:
    """The factor that vanishes on the piece; the others say nothing of it."""
    places = piece.branches[0].points
    for case in possible_factors(root, minor, search.library):
        first, *more = case.equations
        if places and not more and not any(residue(first, *at) for at in places):
            return first
    return minor


def _minor_at(
    root: Branch, columns: Sequence[Column], point: Point, prime: int
) -> Polynomial | None:
    """A short minor, as large as the rank at a point, that is not zero there."""
    source = random.Random(len(columns))
    best: Polynomial | None = None
    for _ in range(_TRIED):
        order = source.sample(range(len(columns)), len(columns))
        heights = source.sample(range(len(columns[0])), len(columns[0]))
        values = [
            [residue(columns[k][h], point, prime) for h in heights] for k in order
        ]
        chosen = [order[k] for k in independent(values, prime)]
        across = [
            [residue(columns[k][h], point, prime) for k in chosen] for h in heights
        ]
        kept = [heights[h] for h in independent(across, prime)]
        own = [[columns[k][h] for h in kept] for k in chosen]
        try:
            minors = minors_of(root.ring, own, _PRODUCTS)
        except TooLargeError:
            continue
        minor = minors[(1 << len(kept)) - 1]
        if best is None or len(minor) < len(best):
            best = primitive(minor)
    return best
