"""What a search knows so far is told seldom enough to cost little."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.pieces import Piece
from screwkit.loci.unhurried import Unhurried

GENERIC = LoopState((6, 6), 6, 12)


def test_telling_takes_a_small_share_of_the_time() -> None:
    """Two seconds of telling are followed by forty of silence."""
    now = [0.0]
    told: list[float] = []

    def tell(_pieces: Sequence[Piece], generic: LoopState) -> None:
        assert generic is GENERIC
        told.append(now[0])
        now[0] += 2.0

    early = Unhurried(tell, clock=lambda: now[0])
    for second in range(100):
        now[0] = max(now[0], float(second))
        early((), GENERIC)
    assert told == [0.0, 42.0, 84.0]
