"""The matrix of a part at a posture, from the mechanism: twists, ranks, minors.

Here of limbs that are chains; `graph_matrix` has that of any joint graph.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import Any

from screwkit.algebra.all_roots import rank_at_roots
from screwkit.algebra.exact_point import PointRing, determinant_modulo
from screwkit.certificates.postures import Postures
from screwkit.conventions import SCREW_DIMENSION
from screwkit.mechanism.graph import limbs


class ScrewMatrix:
    """The columns that a part of a certificate speaks of.

    Args:
        postures: Of the mechanism and the part.
        locked: Freedoms that are held; by default those of the part.
    """

    def __init__(
        self, postures: Postures, locked: Collection[str] | None = None
    ) -> None:
        self._postures = postures
        self._part = postures.part
        self.limbs = postures.spoken_of.limbs
        self.prime = postures.prime
        self._locked = frozenset(self._part.locked if locked is None else locked)

    def twists(self, point: PointRing) -> Mapping[str, tuple[Any, ...]]:
        """The twists at a posture, by freedom, times their scales."""
        return self._postures.twists(point)

    @cached_property
    def freedoms_of(self) -> dict[str, tuple[str, ...]]:
        """By limb, its freedoms, locked or not."""
        names = [limb.name for limb in limbs(self._postures.spoken_of.mechanism)]
        return dict(zip(names, self.limbs, strict=False))

    @property
    def is_of_limbs(self) -> bool:
        """Whether limbs hold every joint of a loop: all are chains."""
        return True

    def height(self, limb: str) -> int:
        """Coordinates of a twist."""
        return SCREW_DIMENSION

    def of_limb(self, limb: str, point: PointRing) -> dict[str, list[Any]]:
        """The twists of a limb at a posture, by freedom."""
        twists = self.twists(point)
        free = (x for x in self.freedoms_of[limb] if x not in self._locked)
        return {label: list(twists[label]) for label in free}

    @property
    def columns(self) -> tuple[str, ...]:
        """The freedoms that are columns of the matrix, limb by limb."""
        return tuple(x for own in self.limbs for x in own if x not in self._locked)

    def matrix(self, point: PointRing) -> dict[str, list[Any]]:
        """The columns of the part's matrix, by freedom.

        Of a limb: its twists.  Else of the loop constraint matrix
        [T1 T2 0 …; T1 0 T3 …], without the locked freedoms.
        """
        twists = self.twists(point)
        if self._part.question == "limb":
            return {label: list(twists[label]) for label in self.columns}
        loops = len(self.limbs) - 1
        zero = [point.zero] * 6
        columns = {}
        for number, labels in enumerate(self.limbs):
            for label in labels:
                if label in self._locked:
                    continue
                own = list(twists[label])
                columns[label] = [
                    entry
                    for loop in range(loops)
                    for entry in (own if number in (0, loop + 1) else zero)
                ]
        return columns

    def rank_of(self, rows: Sequence[Sequence[Any]]) -> int:
        """Of a matrix of residues, or of values at roots."""
        return rank_at_roots(rows, self.prime)

    def rank(self, point: PointRing) -> int:
        """Of the matrix at a posture."""
        columns = list(self.matrix(point).values())
        # One limb alone closes no loop.
        return self.rank_of(columns) if columns and columns[0] else 0

    def bounding_ranks(self, point: PointRing) -> tuple[int, ...]:
        """Ranks whose sum exceeds that of the matrix by the platform's freedom.

        Those of the limbs' twists at a posture, locked freedoms left out.
        """
        twists = self.twists(point)
        return tuple(
            self.rank_of([twists[x] for x in labels if x not in self._locked])
            for labels in self.limbs
        )

    def freedom(self, point: PointRing) -> int:
        """Dimension of the platform's twists at a posture, locked freedoms held.

        The kernel of the matrix without the motions in which the limbs alone move.
        """
        return sum(self.bounding_ranks(point)) - self.rank(point)

    def minor(
        self, point: PointRing, rows: Sequence[int], columns: Sequence[str]
    ) -> Any:
        """A minor of the matrix at a posture."""
        matrix = self.matrix(point)
        chosen = [[matrix[name][row] for row in rows] for name in columns]
        return determinant_modulo(chosen, self.prime)
