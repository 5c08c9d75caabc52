"""Systems of screws at one exact posture: dimensions, reciprocals, intersections.

Everything is linear algebra over a prime field, so that a dimension is exact and, at a
random posture, generic.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from screwkit.algebra.modular import annihilator
from screwkit.algebra.modular import rank as dimension
from screwkit.conventions import DIRECTION, MOMENT

Row: TypeAlias = Sequence[int]

__all__ = ["PlatformSystem", "Row", "dimension", "reciprocal"]


def reciprocal(screws: Sequence[Row], prime: int) -> list[list[int]]:
    """Basis of the screws reciprocal to all of these, again (direction, moment)."""
    return [[*form[MOMENT], *form[DIRECTION]] for form in annihilator(screws, 6, prime)]


@dataclass(frozen=True)
class PlatformSystem:
    """What holds a platform at one posture.

    Attributes:
        wrenches: Basis of the constraint wrenches.
        twists: Basis of the twists left.
    """

    wrenches: tuple[Row, ...]
    twists: tuple[Row, ...]
    prime: int

    @classmethod
    def held_by(cls, limbs: Sequence[Sequence[Row]], prime: int) -> PlatformSystem:
        """The platform at the end of limbs given by their twists."""
        wrenches = [w for limb in limbs for w in reciprocal(limb, prime)]
        twists = reciprocal(wrenches, prime)
        return cls(tuple(reciprocal(twists, prime)), tuple(twists), prime)

    @property
    def freedom(self) -> int:
        """Dimension of the twists."""
        return len(self.twists)

    @property
    def couples(self) -> int:
        """Dimension of the pure couples among the wrenches."""
        return self._without_direction(self.wrenches)

    @property
    def translations(self) -> int:
        """Dimension of the pure translations among the twists."""
        return self._without_direction(self.twists)

    @property
    def motion_type(self) -> str:
        """nTmR: translations, and the rest of the freedom."""
        return f"{self.translations}T{self.freedom - self.translations}R"

    def _without_direction(self, screws: Sequence[Row]) -> int:
        directions = [screw[DIRECTION] for screw in screws]
        return len(screws) - dimension(directions, self.prime)
