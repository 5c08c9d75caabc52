"""What a search knows so far, told as often as it costs little beside the search."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.pieces import Piece

_SHARE = 20  # the search goes on so many times as long as it took to tell


class Unhurried:
    """Tells the pieces that a search has found, and waits before it tells more."""

    def __init__(
        self,
        tell: Callable[[Sequence[Piece], LoopState], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Prepare.

        Args:
            tell: Given the pieces and the ranks that are generic; what it costs is
                measured.
            clock: Seconds.
        """
        self._tell = tell
        self._clock = clock
        self._next = clock()

    def __call__(self, pieces: Sequence[Piece], generic: LoopState) -> None:
        """Tell, if it is time."""
        before = self._clock()
        if before < self._next:
            return
        self._tell(pieces, generic)
        after = self._clock()
        self._next = after + _SHARE * (after - before)
