"""The strata of one limb: where its twists lose rank, and lose more.

Found in the limb's own frame and ring, where they are short; handed on as equations.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.conversion import Conversion
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.loci.beyond_sheets import beyond_sheets
from screwkit.loci.exact_rank_drop import rank_on
from screwkit.loci.limb_drops import limb_pieces
from screwkit.loci.pieces import Piece, pieces_of
from screwkit.loci.rank_drop import generic_rank

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


def limb_strata(assembly: Assembly, limb: LimbChain) -> LimbStrata:
    """Every stratum of a limb, in the limb's own ring."""
    framed = assembly.limb_twists[limb.name]
    columns = [framed.column(joint) for joint in limb.joints]
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    found = [Stratum((), generic_rank(root, columns), 0)]
    complete = True
    level: list[Branch] = [root]
    seen: set[frozenset[str]] = set()
    while level and len(found) < _MOST:
        drop = limb_pieces(assembly, limb, level)
        complete = complete and drop.complete
        level = []
        waiting: list[tuple[Piece, int | None]] = [
            (piece, None) for piece in drop.exact.pieces
        ]
        while waiting:
            piece, above = waiting.pop(0)
            key = frozenset(str(e) for e in piece.equations)
            if key in seen:
                continue
            seen.add(key)
            rank = rank_on(piece, columns)
            if above is None or rank < above:
                found.append(Stratum(piece.equations, rank, piece.codimension))
            level.extend(piece.branches)
            rest = beyond_sheets(root, piece, library)
            complete = complete and not rest.open
            waiting += [(part, rank) for part in pieces_of(rest.branches)]
    found.sort(key=lambda stratum: stratum.codimension)
    return LimbStrata(tuple(found), complete and not level)


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
