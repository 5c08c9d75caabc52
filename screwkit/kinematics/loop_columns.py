"""The loop equations of limbs between two bodies, loops inside limbs included.

Each column belongs to one freedom.  Chains side by side must agree on the twist between
their ends: each after the first closes a loop with the first, and the first one's twist
is what the loops around see.

References: [LongCaroKhalil2012] §5.2.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from screwkit.kinematics.limb_parts import Column, Parts, SideBySide


def loop_columns(limbs: Sequence[Parts], height: int) -> list[list[Any]]:
    """Columns of the loop constraint matrix, ``height`` rows for each loop.

    A single limb beside an empty one, ``[limb, ()]``, gives its twists below the
    equations of the loops inside: the platform's twist must then be zero.

    Args:
        limbs: Parts of each, in one frame.
        height: Coordinates of a twist.
    """
    matrix = _LoopMatrix()
    matrix.add_block(SideBySide(tuple(tuple(limb) for limb in limbs)), ())
    width = height * matrix.loops
    found = []
    for column, places in matrix.placed:
        entries = [column[0] - column[0]] * width
        for loop, sign in places:
            own = column if sign > 0 else [-entry for entry in column]
            entries[loop * height : (loop + 1) * height] = own
        found.append(entries)
    return found


class _LoopMatrix:
    """Columns and the loops they run through, with their sense."""

    def __init__(self) -> None:
        self.loops = 0
        self.placed: list[tuple[Column, tuple[tuple[int, int], ...]]] = []

    def add_block(self, block: SideBySide, around: tuple[tuple[int, int], ...]) -> None:
        """Chains side by side, and the loops that what they allow runs through."""
        first, *others = block.chains
        own = []
        for chain in others:
            loop = self.loops
            self.loops += 1
            own.append((loop, 1))
            self._add_chain(chain, ((loop, -1),))
        self._add_chain(first, (*around, *own))

    def _add_chain(self, chain: Parts, around: tuple[tuple[int, int], ...]) -> None:
        for part in chain:
            if isinstance(part, SideBySide):
                self.add_block(part, around)
            else:
                self.placed.append((part, around))
