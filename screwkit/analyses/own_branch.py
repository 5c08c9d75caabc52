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


class OwnBranch:
    """The motions from the posture of a file, sampled where that is asked about."""

    def __init__(self, network: Network) -> None:
        self._network = network

    @cached_property
    def _here(self) -> PostureModel:
        return model_in_the_file(self._network)

    @cached_property
    def _around(self) -> tuple[tuple[PostureModel, ...], ...]:
        """Postures on each branch."""
        sample = finite_motion(self._here)
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
            0 where it is still at the posture of the file or somewhere on a motion, and
            where that is not clear.
        """
        if not numbers_at(self._here, locked).twist_dimension:
            return 0
        return min(map(min, self._freedoms(locked)), default=0)

    def _freedoms(self, locked: Sequence[str]) -> Iterator[list[int]]:
        """On each branch those that are clear; 0 where none is."""
        for models in self._around:
            found = [numbers_at(model, locked) for model in models]
            yield [x.twist_dimension for x in found if x.clear] or [0]
