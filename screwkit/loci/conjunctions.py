"""Several statements that hold together on a piece and nowhere else.

A component of several equations is seldom one statement.  Of those that hold at its
exact points, simplest first, each is kept that cuts off something beside the piece;
what is left of the whole space after each is known exactly, as branches.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.points import differential, residue
from screwkit.algebra.search import Search
from screwkit.loci.pieces import Piece, surely_in
from screwkit.loci.said_together import (
    Conjunction,
    Said,
    all_of,
    is_met,
    stated,
)

_TRIED = 160  # statements
_SAID = 6  # statements together
_BESIDE = 12  # branches that are followed at once
_AGAIN = 4  # statements that are looked at once more
_SEARCHES = 40  # of branches for a statement, in all
_BUDGET = 40  # case distinctions for one statement on one branch


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
        others: Components that may share them, as mirror images do, in their order.

    Returns:
        None where none were found that are proved to hold nowhere else.
    """
    said = _strongest_first(piece, list(islice(statements, _TRIED)), root)
    alone = _Cutting(piece, (), library).chosen(said, root)
    if alone is not None:
        return stated(alone, piece, root, library, others)
    for numbers in _groups(piece, said, others):
        known = [others[number] for number in numbers]
        shared = [one for one in said if all(is_met(one, p) for p in known)]
        both = _Cutting(piece, tuple(known), library).chosen(shared, root)
        found = both and stated(both, piece, root, library, others)
        if found:
            return found
    return None


def _groups(
    piece: Piece, said: Sequence[Said], others: Sequence[Piece]
) -> list[tuple[int, ...]]:
    """Other components that may share statements: mirror images, then the most."""
    beside = [
        (number, other)
        for number, other in enumerate(others)
        if other is not piece and all(branch.points for branch in other.branches)
    ]
    pairs = [(number,) for number, other in beside if _alike(piece, other)]
    sharing = [tuple(n for n, other in beside if is_met(one, other)) for one in said]
    found = [*pairs, max(sharing, key=len, default=())]
    return [g for g in found if g and any(set(g) <= set(s) for s in sharing)]


def _alike(one: Piece, other: Piece) -> bool:
    """Whether two may be mirror images: equations of the same lengths."""
    lengths = (sorted(map(len, piece.equations)) for piece in (one, other))
    return next(lengths) == next(lengths) and one.codimension == other.codimension


def _strongest_first(piece: Piece, said: list[Said], root: Branch) -> list[Said]:
    """Those that are as many independent conditions as the piece before the others."""
    point, prime = piece.branches[0].points[0]

    def is_weaker(one: Said) -> bool:
        rows = [differential(root.ring, s, [*point], prime) for s in one[1]]
        return rank(rows, prime) < piece.codimension

    return sorted(said, key=is_weaker)


@dataclass
class _Cutting:
    """What statements leave of the space beside a piece, and beside known others.

    Attributes:
        left: Searches that may still be made.
    """

    piece: Piece
    others: tuple[Piece, ...]
    library: FactorLibrary
    left: int = _SEARCHES

    def chosen(self, said: Sequence[Said], root: Branch) -> list[Said] | None:
        """Those that leave nothing; None where something is left."""
        chosen: list[Said] = []
        beside = [root]
        waiting: list[Said] = []  # unknown at first, decided where others have cut
        for again, one in self._in_turn(said, waiting):
            cut = self._cut(one, beside)
            if cut is None and again and chosen:
                cut = self._cut(all_of([*chosen, one]), [root])
            if cut is None and not again:
                waiting.append(one)
            if cut is None or _same(cut, beside):
                continue
            chosen.append(one)
            beside = cut
            if not beside or len(chosen) == 2 * _SAID:
                break
        if beside:
            return None
        needed = self._needed(chosen, root)
        short = len(needed) <= max(_SAID, self.piece.codimension)
        return needed if short else None

    def _in_turn(
        self, said: Sequence[Said], waiting: Sequence[Said]
    ) -> Iterator[tuple[bool, Said]]:
        for one in said:
            yield False, one
        for one in waiting[:_AGAIN]:
            yield True, one

    def _needed(self, chosen: list[Said], root: Branch) -> list[Said]:
        """The statements without those that the others are seen to imply."""
        for one in chosen[::-1]:
            rest = [other for other in chosen if other is not one]
            if rest and self._suffice(rest, root):
                chosen = rest
        return chosen

    def _suffice(self, said: Sequence[Said], root: Branch) -> bool:
        """Whether statements are proved to hold nowhere besides."""
        beside: list[Branch] | None = [root]
        for one in said:
            if beside:
                beside = self._cut(one, beside)
        if beside is None:
            beside = self._cut(all_of(said), [root])
        return beside == []

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
            if not self.left:
                return None
            self.left -= 1
            values = [value for value in map(branch.value, scalars) if value != 0]
            search = Search(self.library, budget=_BUDGET)
            zeros = common_zeros(branch, values, search)
            if not zeros.complete or any(not b.points for b in zeros.branches):
                return None
            found += [
                b for b in zeros.branches if not any(surely_in(b, p) for p in known)
            ]
        return found if len(found) <= _BESIDE else None


def _same(cut: Sequence[Branch], beside: Sequence[Branch]) -> bool:
    return len(cut) == len(beside) and all(
        a is b for a, b in zip(cut, beside, strict=True)
    )
