"""Whether what a certificate lists is there: ranks, components, none in another."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from screwkit.algebra.all_roots import NoResidueError
from screwkit.algebra.exact_point import PointRing
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.postures import POINTS, Postures, Way
from screwkit.certificates.records import Locus
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError, read


class ClaimedLoci:
    """The components of one part under examination.

    Args:
        postures: Of the mechanism and the part.
        matrix: Of the part.
        sheets: Of conditions.
    """

    def __init__(
        self, postures: Postures, matrix: ScrewMatrix | GraphMatrix, sheets: Sheets
    ) -> None:
        self._postures, self._matrix, self._sheets = postures, matrix, sheets
        self._part = postures.part
        self.freedom = -1
        """Of a limb by its loop equations: what it allows the platform in general."""
        self.sampled: dict[tuple[str, ...], None] = {}
        """Equations of components of which only some postures were seen."""

    def generic(self) -> None:
        """Check the rank in general, and that a scheme stops the platform.

        Raises:
            RefusedError: If either is otherwise.
        """
        points = self._postures.several(Way())
        rank = max(map(self._matrix.rank, points))
        if rank != self._part.rank:
            raise RefusedError(f"its generic rank is {rank}, not {self._part.rank}")
        if self._part.question == "actuation" and any(
            map(self._matrix.freedom, points)
        ):
            raise RefusedError("the platform moves at every posture")
        if isinstance(self._matrix, GraphMatrix) and self._matrix.is_held:
            self.freedom = rank - max(map(self._matrix.loop_rank, points))

    def component(self, locus: Locus, *, moves: bool) -> None:
        """Check that postures are on a component, and what the rank is there.

        Args:
            locus: The component.
            moves: Whether the platform is said to move there.

        Raises:
            RefusedError: If it is otherwise.
        """
        if not locus.equations or not locus.reach:
            raise RefusedError("it has no equation or no posture")
        seen = [*self._on_sheets(locus)]
        for point in self._points_of(locus):
            for text in locus.equations:
                if point.value(read(text)) != 0:
                    raise RefusedError("its postures do not satisfy its equations")
            seen.append(self._numbers(point))
        ranks = [rank for rank, _ in seen]
        freedoms = [own for _, own in seen if own is not None]
        if 0 <= self.freedom <= max(freedoms, default=0):
            raise RefusedError(f"the platform has {max(freedoms)} freedoms on it")
        if max(ranks) >= self._part.rank:
            raise RefusedError(f"the rank on it is {max(ranks)}, as in general")
        if max(ranks) != locus.rank:
            raise RefusedError(f"the rank on it is {max(ranks)}, not {locus.rank}")
        if freedoms and min(freedoms) != locus.freedom:
            raise RefusedError(f"the platform has {min(freedoms)} freedoms there")
        if self._part.question == "actuation" and (locus.freedom > 0) != moves:
            raise RefusedError("the platform is said to move where it does not")

    def _on_sheets(self, locus: Locus) -> list[tuple[int, int | None]]:
        """The numbers on all sheets, as far as they are met."""
        if len(locus.equations) == 1:
            try:
                return self._sheets.on(
                    Way(), locus.equations[0], lambda _, there: self._numbers(there)
                )
            except NoResidueError:
                pass
        self.sampled[locus.equations] = None
        return []

    def _numbers(self, point: PointRing) -> tuple[int, int | None]:
        """The rank at a posture and the freedom of the platform."""
        asked = self._part.question != "limb" or self.freedom >= 0
        return self._matrix.rank(point), self._matrix.freedom(point) if asked else None

    def _points_of(self, locus: Locus) -> Iterator[PointRing]:
        for reach in locus.reach:
            yield from islice(self._postures.on(Way(reach.steps), reach.roots), POINTS)

    def none_inside_another(self) -> None:
        """Check that each component has postures that lie on no other.

        Raises:
            RefusedError: If one has not.
        """
        loci = (*self._part.components, *self._part.idle)
        for number, locus in enumerate(loci):
            point = next(self._points_of(locus))
            for place, other in enumerate(loci):
                if place != number and not any(
                    point.value(read(text)) != 0 for text in other.equations
                ):
                    raise RefusedError(
                        f"component {' = 0, '.join(locus.equations)} = 0 lies in "
                        f"another one"
                    )
