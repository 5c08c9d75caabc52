"""Equations of a set where places meet that hold nowhere else than on all of them.

What was found in a chart was solved one condition after the other, each where the
coefficient of a symbol is not zero.  Where it is, the conditions may hold beside the
places that meet: two points of the plane are one where a distance and a direction
agree, and these agree elsewhere too.  The equations of a place exclude what is not on
it, so that some of them are added.

References: [CoxLittleOShea] §4.4 (quotients of ideals: what division by a coefficient
leaves beside).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros, other_parts
from screwkit.algebra.points import residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.pieces import Piece

BUDGET = 40
"""Case distinctions for the zeros of the equations of one set."""


def on_all_places(
    piece: Piece, root: Branch, places: Sequence[Piece], search: Search
) -> Piece:
    """The same set, with as many equations of places as its own leave parts beside.

    Args:
        piece: Where the places meet, or a part of that.
        root: The whole configuration space.
        places: On all of which the piece lies.
        search: With known factors.

    Returns:
        The piece with equations that hold on all places; with all of theirs where the
        zeros of its own could not be told.
    """
    if piece.is_exact:
        return piece
    own = list(piece.equations)
    present = piece.texts
    known = {str(e): e for place in places for e in place.equations}
    offered = [e for text, e in known.items() if text not in present]
    offered.sort(key=len)
    while offered:
        beside = _beside(own, root, places, search)
        if beside is None:
            own += offered
            break
        if not beside:
            break
        # One that excludes most of the parts; of these the shortest.
        chosen = max(offered, key=lambda e: sum(_excludes(e, part) for part in beside))
        own.append(chosen)
        offered.remove(chosen)
    return Piece(tuple(own), piece.branches)


def _beside(
    equations: Sequence[Polynomial],
    root: Branch,
    places: Sequence[Piece],
    search: Search,
) -> list[Branch] | None:
    """Parts of the zeros of equations that do not lie on all places; None if unknown.

    Parts that are there for special dimensions alone are left out.
    """
    fresh = replace(search, found=[], unfinished=[], special=[], budget=BUDGET)
    zeros = common_zeros(root, equations, fresh)
    if zeros.open:
        return None
    parts = list(zeros.branches)
    for part in zeros.branches:
        more = other_parts(part, fresh)
        if more is None:
            return None
        parts += [b for b in more if not b.is_special]
    if not all(part.points for part in parts):
        return None
    return [
        part
        for part in parts
        if any(_excludes(e, part) for place in places for e in place.equations)
    ]


def _excludes(equation: Polynomial, part: Branch) -> bool:
    """Whether an equation does not hold all over a part."""
    return any(residue(equation, point, prime) for point, prime in part.points)
