"""Claims about a node in general: its dimensions are tied, the platform keeps still.

They hold on a whole sheet where they hold at a random posture of it.  So every sheet of
the node has to be met; where several unsolved conditions meet, that is not sure, and
is said.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import islice

from screwkit.algebra.all_roots import NoResidueError
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.postures import POINTS, Postures, Way
from screwkit.certificates.records import Node
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError


class GeneralClaims:
    """Claims of one part that are examined at random postures of a node.

    Args:
        postures: Of the mechanism and the part.
        matrix: Of the part.
        sheets: Of conditions.
        dimensions: Symbols that tell one mechanism from another.
        nonzero: Symbols that are not 0.
    """

    def __init__(
        self,
        postures: Postures,
        matrix: ScrewMatrix | GraphMatrix,
        sheets: Sheets,
        dimensions: Collection[str],
        nonzero: Collection[str],
    ) -> None:
        self._postures, self._matrix, self._sheets = postures, matrix, sheets
        self._part = postures.part
        self._nonzero = sorted({*nonzero} & {*postures.symbols})
        self._names = sorted({*dimensions} & {*postures.symbols})
        self.fixed = {*self._names, *self._nonzero}
        """Symbols that are dimensions, or not 0."""
        self._ranks: dict[tuple[Way, str | None], list[tuple[int, ...]]] = {}
        self.sampled: dict[tuple[str, ...], None] = {}
        """Conditions that meet where only some postures were seen."""

    @property
    def _otherwise(self) -> str:
        if self._part.question == "limb":
            return "the limb may allow less on it"
        return "the platform moves on it"

    # -- the platform ----------------------------------------------------------------

    def bounded(self, node: Node, way: Way, freedom: int) -> None:
        """Where the minor of a node does not vanish no posture of the locus is.

        With joints locked, where the platform keeps still: some ranks less that of the
        matrix are its freedom.  Of a limb by its loop equations, where it allows what
        it does in general: the rank of the matrix less another one.  The rank of the
        matrix is no less than the minor's size, and the others are no larger than on
        any larger set of postures: those of one of the conditions alone.

        Args:
            node: With a minor.
            way: To the node.
            freedom: 0, or what the limb allows in general.

        Raises:
            RefusedError: If the platform may move, or the limb allow less.
        """
        if node.rank == self._part.rank:
            return
        active = self._sheets.active(way)
        sizes: tuple[int, ...] | None = None
        for text in active or (None,):
            try:
                found = self._ranks_on(Way(way.steps), text)
            except NoResidueError:
                continue
            if all(sum(own) + freedom <= node.rank for own in found):
                return
            largest = tuple(map(max, zip(*found, strict=True)))
            sizes = largest if sizes is None else tuple(map(min, largest, sizes))
            if sum(sizes) + freedom <= node.rank:
                return
        if len(active) < 2 and sizes is not None:
            raise RefusedError(self._otherwise)
        self._seen_bounded(node, way, freedom)
        self.sampled[active] = None

    def _ranks_on(self, way: Way, text: str | None) -> list[tuple[int, ...]]:
        """The bounding ranks on every sheet of a condition."""
        key = way, text
        if key not in self._ranks:
            self._ranks[key] = self._sheets.on(
                way, text, lambda _, there: self._matrix.bounding_ranks(there)
            )
        return self._ranks[key]

    def _seen_bounded(self, node: Node, way: Way, freedom: int) -> None:
        for _, point in islice(self._postures.meeting(way, node.roots), 2 * POINTS):
            rank = self._matrix.rank(point)
            if not freedom and rank > node.rank:
                raise RefusedError(f"the rank on it is {rank}")
            others = sum(self._matrix.bounding_ranks(point))
            if rank >= node.rank and others + freedom > node.rank:
                raise RefusedError(self._otherwise)

    # -- the dimensions --------------------------------------------------------------

    def special(self, node: Node, way: Way) -> None:
        """Moving on the node changes the dimensions in fewer ways than there are.

        So they satisfy an equation there, and dimensions in general do not.

        Raises:
            RefusedError: If they may be anything.
        """
        if not self._names:
            raise RefusedError("there are no dimensions that could be special")
        active = self._sheets.active(way)
        # What is tied where one condition holds is tied where more do.
        free = self._seen_free(node, way, active) if len(active) > 1 else set()
        for text in active or (None,):
            if text in free:
                continue
            wider = replace(way, conditions=() if text is None else (text,))
            if self._are_tied(wider, text, alone=len(active) < 2):
                return
        for point, there in islice(self._postures.meeting(way, node.roots), POINTS):
            if any(there.symbol(name) == 0 for name in self._nonzero):
                raise RefusedError("a length that is not 0 vanishes on it")
            self._tied(point, way)
        self.sampled[active] = None

    def is_tied(self, point: PointRing, way: Way) -> bool:
        """Whether the dimensions satisfy an equation on the sheet of a posture.

        Args:
            point: Before the steps of the way; it meets its conditions.
            way: To the sheet.
        """
        try:
            self._tied(point, way)
        except RefusedError:
            return False
        return bool(self._names)

    def _seen_free(self, node: Node, way: Way, active: Sequence[str]) -> set[str]:
        """Conditions that leave the dimensions free near a posture of the node.

        Each alone, where it changes in some direction there.
        """
        try:
            point, _ = next(self._postures.meeting(way, node.roots))
            rows = self._postures.changes(point, way, [*self._names, *active])
        except (RefusedError, ResampleError):
            return set()
        count = len(self._names)
        return {
            text
            for place, text in enumerate(active, count)
            if any(row[place] != 0 for row in rows)
            and self._matrix.rank_of([[*row[:count], row[place]] for row in rows])
            > count
        }

    def _are_tied(self, way: Way, text: str | None, *, alone: bool) -> bool:
        """Whether the dimensions are tied on all sheets of a condition."""
        try:
            self._sheets.on(way, text, lambda point, _: self._tied(point, way))
        except NoResidueError:
            return False
        except RefusedError:
            if alone:
                raise
            return False
        return True

    def _tied(self, point: PointRing, way: Way) -> None:
        count = len(self._names)
        texts = [*self._names, *way.conditions]
        try:
            rows = self._postures.changes(point, way, texts)
        except ResampleError:
            raise RefusedError("no derivative was found on it") from None
        bound = self._matrix.rank_of([row[count:] for row in rows])
        if self._matrix.rank_of(rows) - bound >= count:
            raise RefusedError("the dimensions are free on it")
