"""What is found where limbs become dependent, and what was left open."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.algebra.branches import Branch
from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.features import listed
from screwkit.loci.open_branches import undecided
from screwkit.loci.pieces import Piece


@dataclass(frozen=True)
class LoopDrop:
    """Pieces on which the loop constraint matrix loses rank.

    Attributes:
        open: Branches that were not decided; every further piece lies in one of them.
        searched: All pieces up to this codimension are among ``pieces`` or ``open``;
            None where there is no such limit.
        unsearched: Number of combinations of strata beyond that.
        where: In what postures the open branches lie, in words.
        around: Codimensions of components that are not among ``pieces``, for a part of
            each was found: the locus is smooth there, and larger.
    """

    generic: LoopState
    pieces: tuple[Piece, ...]
    open: tuple[Branch, ...]
    searched: int | None = None
    unsearched: int = 0
    around: tuple[int, ...] = ()
    where: str = ""

    @property
    def complete(self) -> bool:
        """Whether ``pieces`` is the whole locus."""
        return not self.open and self.searched is None

    @property
    def reason(self) -> str:
        """Why it is not complete; empty where it is."""
        reasons = []
        if self.around:
            sizes = listed([*map(str, sorted(set(self.around)))])
            reasons.append(
                f"there are components of codimension {sizes} of which parts were found"
            )
        if self.open:
            reasons.append(undecided(self.open))
            reasons += [self.where] if self.where else []
        if self.searched is not None:
            reasons.append(
                f"all pieces up to codimension {self.searched} were searched; "
                f"{self.unsearched} combinations of limb strata beyond were not"
            )
        return "; ".join(reasons)
