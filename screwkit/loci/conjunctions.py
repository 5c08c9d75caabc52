"""Several statements that hold together on a piece and nowhere else.

A component of several equations is seldom one statement.  Of those that hold at its
exact points, simplest first, each is kept that cuts off something beside the piece;
what is left of the whole space after each is known exactly, as branches.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.points import differential, residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.pieces import Piece, lies_in

_TRIED = 160  # statements
_SAID = 6  # statements together
_BESIDE = 12  # branches that are followed at once
_AGAIN = 2  # searches of the whole space, where one step by step ends
_BUDGET = 40  # case distinctions for one statement on one branch

Said = tuple[str, Sequence[Polynomial]]
"""A statement in words, and what vanishes where it holds."""


@dataclass(frozen=True)
class Conjunction:
    """Statements that together hold on a piece, and where else.

    Attributes:
        words: None of them to spare.
        elsewhere: Numbers of other components on which they hold too.
    """

    words: tuple[str, ...]
    elsewhere: tuple[int, ...] = ()


def conjunction(
    piece: Piece,
    statements: Iterable[Said],
    root: Branch,
    library: FactorLibrary,
    others: Sequence[Piece] = (),
) -> Conjunction | None:
    """Statements that together hold exactly on a piece.

    Args:
        piece: A component.
        statements: That hold at its exact points, simplest first.
        root: The space in which it lies.
        library: Factors met before, of the same ring.
        others: Components that may share them, as mirror images do.

    Returns:
        None where none were found that are proved to hold nowhere else.
    """
    said = _strongest_first(piece, list(islice(statements, _TRIED)), root)
    alone = _Cutting(piece, (), library).chosen(said, root)
    if alone is not None:
        return Conjunction(alone)
    for number, other in enumerate(others):
        shared = [
            one
            for one in said
            if not any(residue(s, *at) for s in one[1] for at in _points(other))
        ]
        if other is piece or not _points(other) or not shared:
            continue
        both = _Cutting(piece, (other,), library).chosen(shared, root)
        if both is not None:
            return Conjunction(both, (number,))
    return None


def _points(piece: Piece) -> list[tuple[Sequence[int], int]]:
    return [at for branch in piece.branches for at in branch.points]


def _strongest_first(piece: Piece, said: list[Said], root: Branch) -> list[Said]:
    """Those that are as many independent conditions as the piece before the others."""
    point, prime = piece.branches[0].points[0]

    def is_weaker(one: Said) -> bool:
        rows = [differential(root.ring, s, [*point], prime) for s in one[1]]
        return rank(rows, prime) < piece.codimension

    return sorted(said, key=is_weaker)


@dataclass(frozen=True)
class _Cutting:
    """What statements leave of the space beside a piece, and beside known others."""

    piece: Piece
    others: tuple[Piece, ...]
    library: FactorLibrary

    def chosen(self, said: Sequence[Said], root: Branch) -> tuple[str, ...] | None:
        """Those that leave nothing; None where something is left."""
        chosen: list[Said] = []
        beside = [root]
        again = _AGAIN
        for one in said:
            cut = self._cut(one, beside)
            if cut is None and again and chosen:
                again -= 1
                scalars = [s for _, own in (*chosen, one) for s in own]
                cut = self._cut(("", scalars), [root])
            if cut is None or _same(cut, beside):
                continue
            chosen.append(one)
            beside = cut
            if not beside:
                needed = self._needed(chosen, root)
                short = len(needed) <= max(_SAID, self.piece.codimension)
                return tuple(words for words, _ in needed) if short else None
            if len(chosen) == 2 * _SAID:
                return None
        return None

    def _needed(self, chosen: list[Said], root: Branch) -> list[Said]:
        """The statements without those that the others imply."""
        for one in list(chosen):
            beside: list[Branch] | None = [root]
            rest = [other for other in chosen if other is not one]
            for other in rest:
                if beside:
                    beside = self._cut(other, beside)
            if beside == []:
                chosen = rest
        return chosen

    def _cut(self, said: Said, beside: Sequence[Branch]) -> list[Branch] | None:
        """Where on these branches a statement holds besides; None if unknown."""
        _, scalars = said
        known = (self.piece, *self.others)
        found: list[Branch] = []
        for branch in beside:
            if not branch.points:
                return None
            if not any(residue(s, *at) for s in scalars for at in branch.points):
                found.append(branch)
                continue
            values = [value for value in map(branch.value, scalars) if value != 0]
            search = Search(self.library, budget=_BUDGET)
            zeros = common_zeros(branch, values, search)
            if not zeros.complete or any(not b.points for b in zeros.branches):
                return None
            found += [
                b for b in zeros.branches if not any(lies_in(b, p) for p in known)
            ]
        return found if len(found) <= _BESIDE else None


def _same(cut: Sequence[Branch], beside: Sequence[Branch]) -> bool:
    return len(cut) == len(beside) and all(
        a is b for a, b in zip(cut, beside, strict=True)
    )
