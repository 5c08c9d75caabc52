"""The strata of a limb with loops inside: where its twist system is another.

On each stratum the twist system is an extensor (`limb_systems`) outside the strata
inside it.  Besides those on which the limb loses rank there are strata on which its
loops do, and the platform gains; all of them are followed down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Search
from screwkit.kinematics.limb_parts import Parts, PartsMotion, motion_at
from screwkit.loci.beyond_sheets import beyond_sheets
from screwkit.loci.limb_systems import UnclearError, limb_system
from screwkit.loci.open_branches import undecided
from screwkit.loci.pieces import Piece, lies_in, pieces_of, without_contained
from screwkit.loci.strata import LimbStrata, Stratum

_MOST = 80  # strata of one limb


@dataclass(frozen=True)
class HybridStratum:
    """An irreducible closed set of postures of one limb.

    Attributes:
        piece: None for the whole space.
        dimension: Of the twist system, generic on the stratum.
        inner_rank: Of the loops inside, generic on the stratum.
        inside: The strata in which the twist system may be another one.
    """

    piece: Piece | None
    dimension: int
    inner_rank: int
    inside: tuple[Piece, ...]

    @property
    def codimension(self) -> int:
        """Of the stratum."""
        return self.piece.codimension if self.piece else 0

    @property
    def equations(self) -> Stratum:
        """The same by equations alone, and of the strata inside those that are exact.

        What lies on the equations of others alone may be no such stratum.
        """
        return Stratum(
            self.piece.equations if self.piece else (),
            self.dimension,
            self.codimension,
            tuple(piece.equations for piece in self.inside if piece.is_exact),
        )


@dataclass(frozen=True)
class HybridStrata:
    """All strata of a limb, the whole space first, by increasing codimension.

    Attributes:
        open: Branches that were not decided.
    """

    strata: tuple[HybridStratum, ...]
    open: tuple[Branch, ...]

    @property
    def by_equations(self) -> LimbStrata:
        """The same by equations alone."""
        return LimbStrata(tuple(s.equations for s in self.strata), not self.open)

    def narrow(self, given: Sequence[Piece] = ()) -> NarrowStrata:
        """The largest strata with less than the generic dimension.

        Args:
            given: Some of them, with more equations than they had.
        """
        generic = self.strata[0].dimension
        own = [s.piece for s in self.strata if s.piece and s.dimension < generic]
        pieces = without_contained([*given, *own])
        return NarrowStrata(tuple(pieces), undecided(self.open) if self.open else "")


@dataclass(frozen=True)
class NarrowStrata:
    """The largest strata on which a limb has less than its generic freedom.

    Attributes:
        pieces: These strata.
        reason: Why there may be others; empty where there are none.
    """

    pieces: tuple[Piece, ...]
    reason: str


def hybrid_strata(
    root: Branch, parts: Parts, height: int, library: FactorLibrary
) -> HybridStrata:
    """Every stratum of a limb.

    Args:
        root: The whole configuration space.
        parts: Of the limb, in the ring of ``root``.
        height: Coordinates of a twist.
        library: Factors met before.
    """
    found: list[HybridStratum] = []
    left: list[Branch] = []
    waiting: list[tuple[Piece | None, tuple[Branch, ...]]] = [(None, (root,))]
    seen: list[Piece] = []
    while waiting:
        piece, sheets = waiting.pop(0)
        motion = generic_motion(sheets, parts, height)
        if motion is None or len(found) >= _MOST:
            left.extend(sheets)
            continue
        inside: list[Branch] = []
        for sheet in sheets:
            below = _below(sheet, parts, height, library)
            inside += below.branches
            left += below.open
        pieces = tuple(pieces_of(inside, surely=True))
        if piece is not None:
            rest = beyond_sheets(root, piece, library)
            left += rest.open
            pieces = (*pieces, *pieces_of(rest.branches, surely=True))
        found.append(HybridStratum(piece, motion.dimension, motion.inner_rank, pieces))
        for below_it in pieces:
            if not any(_same(below_it, known) for known in seen):
                seen.append(below_it)
                waiting.append((below_it, below_it.branches))
    found.sort(key=lambda stratum: stratum.codimension)
    return HybridStrata(tuple(found), tuple(left))


def generic_motion(
    branches: Sequence[Branch], parts: Parts, height: int
) -> PartsMotion | None:
    """The joint motions of a limb, generic on a piece; None if no point is known."""
    motions = [
        motion_at(parts, height, point, prime)
        for branch in branches
        for point, prime in branch.points
    ]
    # The fewer motions the inner loops allow, the more generic is the point.
    return min(motions, key=lambda m: (-m.inner_rank, -m.dimension), default=None)


def _same(one: Piece, other: Piece) -> bool:
    """Whether two irreducible pieces are one: of one size, and each in the other."""
    return (
        one.codimension == other.codimension
        and lies_in(one.branches[0], other)
        and lies_in(other.branches[0], one)
    )


@dataclass(frozen=True)
class _Below:
    branches: tuple[Branch, ...]
    open: tuple[Branch, ...]


def _below(branch: Branch, parts: Parts, height: int, library: FactorLibrary) -> _Below:
    """Where on a branch the extensor that holds in general may fail."""
    try:
        system = limb_system(branch, parts, height, library)
    except UnclearError:
        return _Below((), (branch,))
    found: list[Branch] = []
    left: list[Branch] = []
    for ideal in system.limits:
        zeros = common_zeros(branch, ideal, Search(library))
        found += zeros.branches
        left += zeros.open
    return _Below(tuple(found), tuple(left))
