"""The rest of a piece: where what its sheets were solved with is zero.

Sheets are charts: a condition a·x + b was solved for x where a is not zero.  A search
on them does not come to where it is, and parts of the piece there lie on its equations,
so that they are no pieces of their own beside it.

References: [CoxLittleOShea] §3.1.
"""

from __future__ import annotations

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Decomposition, Search
from screwkit.loci.pieces import Piece


def beyond_sheets(root: Branch, piece: Piece, library: FactorLibrary) -> Decomposition:
    """Where a piece's equations hold and a divisor of its sheets vanishes.

    That may be more than the rest of the piece: equations of a sheet hold on other
    sets where its divisors vanish.

    Args:
        root: The whole configuration space.
        piece: Found on it.
        library: Factors met before.
    """
    steps = [step for sheet in piece.branches for step in sheet.steps]
    divisors = {str(s.divisor): s.divisor for s in steps if not s.divisor.is_constant()}
    found: list[Branch] = []
    left: list[Branch] = []
    for divisor in divisors.values():
        zeros = common_zeros(root, [*piece.equations, divisor], Search(library))
        found += [branch for branch in zeros.branches if branch.points]
        left += [branch for branch in zeros.branches if not branch.points]
        left += zeros.open
    return Decomposition(tuple(found), tuple(left))
