"""Whether the equations of a piece hold on the piece alone.

Conditions that were solved one after the other, each where the coefficient of a symbol
is not zero, may have common zeros where that coefficient vanishes and nothing is
singular.  Then the equations do not say where the piece is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.pieces import Piece

_BUDGET = 120  # case distinctions on the equations of one piece


def loose(
    root: Branch,
    pieces: Sequence[Piece],
    is_singular: Callable[[Branch], bool],
    library: FactorLibrary,
) -> list[Piece]:
    """The pieces whose equations were not shown to hold at singular postures alone.

    Args:
        root: The whole configuration space.
        pieces: With several equations each; those with one are irreducible.
        is_singular: Of a branch with exact points: what is generic on it.
        library: Factors met before.
    """
    found = []
    for piece in pieces:
        if len(piece.equations) < 2:
            continue
        if not all(
            _is_singular_on(root, equations, is_singular, library)
            for equations in _where_to_look(piece)
        ):
            found.append(piece)
    return found


def _where_to_look(piece: Piece) -> Iterator[tuple[Polynomial, ...]]:
    """The equations, and again with each divisor that solving them took as non-zero."""
    yield piece.equations
    seen: set[str] = set()
    for branch in piece.branches:
        for step in branch.steps:
            if not step.divisor.is_constant() and str(step.divisor) not in seen:
                seen.add(str(step.divisor))
                yield (*piece.equations, step.divisor)


def _is_singular_on(
    root: Branch,
    equations: Sequence[Polynomial],
    is_singular: Callable[[Branch], bool],
    library: FactorLibrary,
) -> bool:
    zeros = common_zeros(root, equations, Search(library, budget=_BUDGET))
    decided = zeros.complete and all(branch.points for branch in zeros.branches)
    return decided and all(map(is_singular, zeros.branches))


def about_loose(count: int) -> str:
    """That some equations say too much, in words; empty for none."""
    if not count:
        return ""
    noun = "one component" if count == 1 else f"{count} components"
    return f"the equations of {noun} may hold at regular postures too"
