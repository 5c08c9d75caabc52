"""The strata of one limb: where its twists lose rank, and lose more.

Found in the limb's own frame and ring, where they are short; handed on as equations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

from screwkit.algebra.branches import Branch
from screwkit.algebra.conversion import Conversion
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.loci.pieces import Piece, pieces_of
from screwkit.loci.rank_drop import RankDrop, generic_rank, rank_drop

_MOST = 40  # strata of one limb


@dataclass(frozen=True)
class Stratum:
    """A closed set on which a limb has less than its generic rank.

    Attributes:
        equations: In the ring of the limb, or of all limbs; empty for the whole space.
        rank: Generic on the stratum.
        codimension: Of the stratum.
        inside: The equations of the strata inside it, of a limb with loops; None for a
            serial limb, where they are those of lower rank.
    """

    equations: tuple[Polynomial, ...]
    rank: int
    codimension: int
    inside: tuple[tuple[Polynomial, ...], ...] | None = None


@dataclass(frozen=True)
class LimbStrata:
    """All strata of a limb, the whole space first, by increasing codimension.

    Attributes:
        complete: Whether no stratum was left undecided.
    """

    strata: tuple[Stratum, ...]
    complete: bool

    def below(self, own: Stratum) -> list[tuple[Polynomial, ...]]:
        """The equations of strata on which the limb is another than on ``own``."""
        if own.inside is not None:
            return list(own.inside)
        return [s.equations for s in self.strata if s.rank < own.rank]


_DROPS: WeakKeyDictionary[Assembly, dict[tuple[str, int], tuple[Branch, RankDrop]]]
_DROPS = WeakKeyDictionary()


def limb_drop(assembly: Assembly, limb: LimbChain, branch: Branch) -> RankDrop:
    """Where on a branch a limb of joints in series loses rank, searched once.

    Args:
        assembly: The mechanism.
        limb: A serial limb.
        branch: In the limb's own ring; the same object where the same is meant.
    """
    known = _DROPS.setdefault(assembly, {})
    key = limb.name, id(branch)  # the branch is kept, so that no other gets its number
    if key not in known:
        framed = assembly.limb_twists[limb.name]
        columns = [framed.column(joint) for joint in limb.joints]
        search = Search(assembly.library(framed.ring))
        known[key] = branch, rank_drop(branch, columns, search)
    return known[key][1]


def limb_strata(assembly: Assembly, limb: LimbChain) -> LimbStrata:
    """Every stratum of a limb, in the limb's own ring."""
    framed = assembly.limb_twists[limb.name]
    columns = [framed.column(joint) for joint in limb.joints]
    root = assembly.root(framed.ring)
    found = [Stratum((), generic_rank(root, columns), 0)]
    complete = True
    level: list[Branch] = [root]
    seen: set[frozenset[str]] = set()
    while level and len(found) < _MOST:
        lower: list[Branch] = []
        for branch in level:
            drop = limb_drop(assembly, limb, branch)
            complete = complete and drop.decomposition.complete
            lower.extend(drop.decomposition.branches)
        level = []
        for piece in pieces_of(lower):
            key = frozenset(str(e) for e in piece.equations)
            if key not in seen:
                seen.add(key)
                found.append(_stratum(piece, columns))
                level.extend(piece.branches)
    found.sort(key=lambda stratum: stratum.codimension)
    return LimbStrata(tuple(found), complete and not level)


def _stratum(piece: Piece, columns: Sequence[Sequence[Polynomial]]) -> Stratum:
    rank = max(generic_rank(branch, columns) for branch in piece.branches)
    return Stratum(piece.equations, rank, piece.codimension)


def in_ring(
    strata: LimbStrata, source: TrigonometricRing, target: TrigonometricRing
) -> LimbStrata:
    """The same strata with their equations in another ring."""
    convert = Conversion(source, target)

    def moved(equations: tuple[Polynomial, ...]) -> tuple[Polynomial, ...]:
        return tuple(convert(equation) for equation in equations)

    return LimbStrata(
        tuple(
            replace(
                s,
                equations=moved(s.equations),
                inside=None if s.inside is None else tuple(map(moved, s.inside)),
            )
            for s in strata.strata
        ),
        strata.complete,
    )
