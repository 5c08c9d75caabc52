"""Systems of screws at one exact posture: dimensions, reciprocals, intersections.

Everything is linear algebra over a prime field, so that a dimension is exact and, at a
random posture, generic.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import nmod_mat

from screwkit.conventions import DIRECTION, MOMENT

Row = Sequence[int]


def dimension(rows: Sequence[Row], prime: int) -> int:
    """Dimension of the span."""
    if not rows:
        return 0
    return int(_matrix(rows, prime).rank())


def annihilator(rows: Sequence[Row], width: int, prime: int) -> list[list[int]]:
    """Basis of the vectors x with row·x = 0 for every row."""
    if not rows:
        return [[int(i == j) for j in range(width)] for i in range(width)]
    kernel, nullity = _matrix(rows, prime).nullspace()
    return [[int(kernel[i, j]) for i in range(width)] for j in range(int(nullity))]


def reciprocal(screws: Sequence[Row], prime: int) -> list[list[int]]:
    """Basis of the screws reciprocal to all of these, again (direction, moment)."""
    return [[*form[MOMENT], *form[DIRECTION]] for form in annihilator(screws, 6, prime)]


def _matrix(rows: Sequence[Row], prime: int) -> nmod_mat:
    entries = [int(value) % prime for row in rows for value in row]
    return nmod_mat(len(rows), len(rows[0]), entries, prime)


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
