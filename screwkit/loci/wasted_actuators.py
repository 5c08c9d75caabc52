"""Actuators that hold fewer of the platform's freedoms than they are.

With some joints locked the platform loses so many freedoms; in a good scheme every
actuator takes one.  A smallest choice that takes fewer than it has members shows why a
scheme is not admissible, whatever its other actuators are.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

from screwkit.loci.passive import PassiveSystem


class Wasted(NamedTuple):
    """A smallest choice of actuators that hold fewer freedoms than they are."""

    actuators: tuple[str, ...]
    held: int


class HeldFreedoms:
    """How many freedoms of the platform any locked joints take, in general."""

    def __init__(self, system: PassiveSystem) -> None:
        self._system = system
        self._known: dict[tuple[str, ...], int] = {}
        self.platform = system.generic_state(system.joints).platform_freedom

    def by(self, locked: tuple[str, ...]) -> int:
        """The platform's freedoms less those that are left."""
        if locked not in self._known:
            passive = [joint for joint in self._system.joints if joint not in locked]
            left = self._system.generic_state(passive).platform_freedom
            self._known[locked] = self.platform - left
        return self._known[locked]

    def wasted_in(self, actuators: Sequence[str]) -> Wasted | None:
        """The first smallest wasteful choice; None where there are too many or few.

        Among more actuators than freedoms some are wasted in the best of schemes.
        """
        if len(actuators) != self.platform:
            return None
        for size in range(1, len(actuators) + 1):
            for chosen in combinations(actuators, size):
                if self.by(chosen) < size:
                    return Wasted(chosen, self.by(chosen))
        return None
