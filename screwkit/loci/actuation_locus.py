"""What is found of a scheme's singular locus."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.meanings import Meanings
from screwkit.loci.pieces import Piece


@dataclass(frozen=True)
class ActuationLocus:
    """Pieces on which something moves with the actuated joints locked.

    Attributes:
        platform_freedom: With these joints locked, in general.
        pieces: With their ``states``; where the platform's freedom there is 0, only
            limbs move.
        witness: Why the scheme is not admissible.
        reason: Why ``complete`` is false.
    """

    admissible: bool
    platform_freedom: int
    complete: bool
    pieces: tuple[Piece, ...]
    states: tuple[LoopState, ...]
    meanings: Meanings | None
    witness: str = ""
    reason: str = ""
