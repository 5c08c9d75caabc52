"""Actuators that hold fewer of the platform's freedoms than they are.

With some joints locked the platform loses so many freedoms; in a good scheme every
actuator takes one.  A smallest choice that takes fewer than it has members shows why a
scheme is not admissible, whatever its other actuators are.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations
from typing import NamedTuple

from screwkit.algebra.names import counted
from screwkit.loci.features import listed


class Wasted(NamedTuple):
    """A smallest choice of actuators that hold fewer freedoms than they are."""

    actuators: tuple[str, ...]
    held: int


class HeldFreedoms:
    """How many freedoms of the platform any locked joints take, in general.

    Args:
        left: Freedoms of the platform with some joints locked.
    """

    def __init__(self, left: Callable[[tuple[str, ...]], int]) -> None:
        self._left = left
        self._known: dict[tuple[str, ...], int] = {}
        self.platform = left(())

    def by(self, locked: tuple[str, ...]) -> int:
        """The platform's freedoms less those that are left."""
        if locked not in self._known:
            self._known[locked] = self.platform - self._left(locked)
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


def too_few(actuators: int, freedoms: int) -> str:
    """That there are fewer actuators than freedoms, in words."""
    held = f"the platform's {counted(freedoms, 'freedom')}"
    if not actuators:
        return f"without actuators nothing holds {held}"
    return f"{counted(actuators, 'actuator')} cannot hold {held}"


def doing_too_little(wasted: Wasted, left: Callable[[Sequence[str]], str]) -> str:
    """Actuators that hold fewer freedoms than they are, in words.

    Args:
        wasted: A smallest choice of them.
        left: The type of the platform's motion with joints locked, in words.
    """
    names = wasted.actuators
    if len(names) == 1:
        return (
            f"actuator {names[0]} holds nothing: with it locked the platform moves "
            f"as freely as before"
        )
    if len(names) == 2:
        return (
            f"actuators {listed(names)} hold the same freedom: with one or both "
            f"locked the platform keeps {left(names)}"
        )
    held = counted(wasted.held, "freedom")
    return f"actuators {listed(names)} together hold {held} only"
