"""What schemes hold on the motions that start from the posture of the file.

The closing equations may have several components.  Exact closed postures may all lie
on one that the mechanism does not reach without being taken apart; with freedoms locked
the platform may be still there and move all along the mechanism's own motions, at the
same rank of the loop equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Final

from screwkit.analyses.tied_branch import model_in_the_file
from screwkit.finite.exponentials import at_stance
from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.posture_model import PostureModel
from screwkit.finite.posture_numbers import numbers_at
from screwkit.kinematics.network import Network

MOVES_ALL_ALONG: Final = (
    "on the motions from the posture of the file, as sampled, the platform moves all "
    "along; the exact closed postures where it is still belong to another branch"
)

STILL_ALL_ALONG: Final = (
    "on the motions from the posture of the file, as sampled, the platform is still; "
    "the exact closed postures where it moves belong to another branch"
)


class OwnBranch:
    """The motions from the posture of a file, sampled where that is asked about."""

    def __init__(self, network: Network) -> None:
        self._network = network

    @cached_property
    def _around(self) -> tuple[tuple[PostureModel, ...], ...]:
        """Postures on each branch."""
        sample = finite_motion(model_in_the_file(self._network))
        if sample.model is None:
            return ()
        return tuple(
            tuple(
                at_stance(sample.model, branch.places, entry)
                for entry in range(len(branch.places))
            )
            for branch in sample.branches
            if branch.places is not None
        )

    def freedom_left(self, locked: Sequence[str]) -> int:
        """The platform's freedoms all along every motion, some freedoms locked.

        Returns:
            0 where it is still somewhere on a motion, and where that is not clear.
        """
        return min(map(min, self._freedoms(locked)), default=0)

    def is_still(self, locked: Sequence[str]) -> bool:
        """Whether the platform is still all along every motion."""
        found = [*self._freedoms(locked)]
        return bool(found) and not any(map(max, found))

    def comes_to(self, rank: int, locked: Sequence[str]) -> bool:
        """Whether the loop equations come to a rank on every motion.

        Args:
            rank: Of the loop equations without the locked freedoms.
            locked: The freedoms.
        """
        return bool(self._around) and all(
            any(
                found.clear and found.loop_rank == rank
                for found in (numbers_at(model, locked) for model in models)
            )
            for models in self._around
        )

    def _freedoms(self, locked: Sequence[str]) -> Iterator[tuple[int, ...]]:
        """On each branch at its places; from 0 to 6 where one is not clear."""
        for models in self._around:
            found = [numbers_at(model, locked) for model in models]
            clear = all(x.clear for x in found)
            yield tuple(x.twist_dimension for x in found) if clear else (0, 6)
