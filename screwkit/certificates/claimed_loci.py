"""Whether what a certificate lists is there: ranks, components, none in another."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import combinations

from screwkit.algebra.all_roots import NoResidueError, vanishes
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.closed_postures import ClosedPostures
from screwkit.certificates.general_claims import GeneralClaims
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.irreducible_equations import Shape, shape_of
from screwkit.certificates.postures import Way
from screwkit.certificates.records import Locus, Node
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError, read
from screwkit.certificates.towers import Towers


class ClaimedLoci:
    """The components of one part under examination.

    Args:
        matrix: Of the part.
        sheets: Of conditions.
        towers: Of several conditions at once.
        closed: Its closed postures.
        general: Whether dimensions are tied.
    """

    def __init__(
        self,
        matrix: ScrewMatrix | GraphMatrix,
        sheets: Sheets,
        towers: Towers,
        closed: ClosedPostures,
        general: GeneralClaims,
    ) -> None:
        self._postures, self._matrix, self._sheets = sheets.postures, matrix, sheets
        self._towers, self._closed, self._general = towers, closed, general
        self._part = self._postures.part
        self.freedom = -1
        """Of a limb by its loop equations: what it allows the platform in general."""
        self._seen: dict[tuple[str, ...], list[tuple[int, int | None]]] = {}
        self._products: set[tuple[str, ...]] = set()
        self.sampled: dict[tuple[str, ...], None] = {}
        """Equations of components that may hold at other postures too."""
        self._cased: set[tuple[str, ...]] = set()
        """Those whose trees have sheets that need be none of the component's own."""
        self.irreducible: dict[tuple[str, ...], None] = {}
        """Equations of components that were shown to be no product."""

    def generic(self) -> None:
        """Check the rank in general, and that a scheme stops the platform.

        Raises:
            RefusedError: If either is otherwise.
        """
        points = self._closed.in_general()
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
        for point in self._points_of(locus):
            if any(point.value(read(text)) != 0 for text in locus.equations):
                raise RefusedError("its postures do not satisfy its equations")
        seen = self._seen.pop(locus.equations, [])
        if not seen or locus.equations in self.sampled:
            seen += [self._numbers(point) for point in self._points_of(locus)]
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

    def equation(self, locus: Locus) -> None:
        """Look at all sheets of a component of one equation.

        Raises:
            RefusedError: If it is a product.
        """
        (text,) = locus.equations
        shape = shape_of(self._sheets, text)
        if shape is Shape.PRODUCT:
            raise RefusedError("its equation is a product")
        if self._postures.tied:  # closed postures on it may still fall apart
            self.sampled[locus.equations] = None
            return
        if shape is Shape.IRREDUCIBLE:
            self.irreducible[locus.equations] = None
        self._look(locus, Way(), text)

    def sheet(self, locus: Locus, way: Way, node: Node) -> None:
        """Look at all sheets of a way on which the equations of a component hold.

        Where that is not possible it is said that they may hold elsewhere.

        Raises:
            RefusedError: If they hold at regular postures.
        """
        if node.roots:
            self._towers.check(node, way)
            self._cased.add(locus.equations)
        try:
            self._all_sheets(locus, way, node)
        except (NoResidueError, ResampleError):
            self.sampled[locus.equations] = None

    def _all_sheets(self, locus: Locus, way: Way, node: Node) -> None:
        texts = tuple(own.equation for own in node.roots)

        def judged(at: PointRing, there: PointRing) -> tuple[int, int | None] | bool:
            return self._judged(locus, way, replace(way, conditions=texts), at, there)

        if node.roots:
            self._note(locus, self._towers.on(way, node.roots, judged))
            return
        active = self._sheets.active(way)
        texts = active
        if len(active) > 1:
            self._cased.add(locus.equations)
            texts = tuple(own for own in active if self._is_all(own, way))[:1]
            if not texts:
                self.sampled[locus.equations] = None
                return
        text = next(iter(texts), None)
        if text and shape_of(self._sheets, text, way) is not Shape.IRREDUCIBLE:
            self._products.add(locus.equations)
        if locus.equations in self._cased:
            self._note(locus, self._sheets.on(way, text, judged))
        else:
            self._look(locus, way, text)

    def small(self, locus: Locus | None, way: Way) -> None:
        """Check that a way has fewer dimensions than n − k, for k equations.

        Whatever k equations cut out has n − k at least (Krull), so that the way lies in
        the closure of what is met elsewhere.

        Raises:
            RefusedError: If it may have more.
        """
        if locus is None:
            raise RefusedError("it says nothing about a proof")
        points = [self._postures.moved(b, way) for b in self._sheets.choices(way)]
        solved, conditions = len(way.steps), [read(text) for text in way.conditions]
        if all(any(x.value(own) != 0 for own in conditions) for x in points):
            solved += 1
        if solved <= len(locus.equations):
            raise RefusedError("it may be a sheet of the component")

    def _is_all(self, text: str, way: Way) -> bool:
        """Whether all conditions of a way hold wherever one of them does."""
        others = [read(own) for own in way.conditions]

        def hold(_: PointRing, there: PointRing) -> bool:
            return all(there.value(own) == 0 for own in others)

        return all(self._sheets.on(way, text, hold))

    def _judged(
        self, locus: Locus, way: Way, wider: Way, at: PointRing, there: PointRing
    ) -> tuple[int, int | None] | bool:
        """What is seen at a posture, if it is as on the component; if the sheet counts.

        Where dimensions are tied nothing is said; where equations of the component do
        not hold, or it is not clear whether the posture is near singular ones, False.

        Args:
            locus: The component.
            way: To the sheet.
            wider: With the conditions that were met.
            at: The posture before the steps.
            there: The posture.

        Raises:
            RefusedError: If it is a regular posture.
        """
        if self._general.is_tied(at, wider):
            return True
        if not all(vanishes(there.value(read(text))) for text in way.conditions):
            return False
        rank, freedom = self._numbers(there)
        if rank >= self._part.rank:
            raise RefusedError(f"the rank on it is {rank}, as in general")
        if rank == locus.rank and freedom in (None, locus.freedom):
            return rank, freedom
        if freedom is not None and self._part.question == "actuation":
            return freedom > 0 or locus.freedom == 0
        return freedom is None or self.freedom < 0 or freedom < self.freedom

    def _note(
        self, locus: Locus, seen: Iterable[tuple[int, int | None] | bool]
    ) -> None:
        for own in seen:
            if own is False:
                self.sampled[locus.equations] = None
            elif own is not True:
                self._seen.setdefault(locus.equations, []).append(own)

    def unseen(self, locus: Locus) -> None:
        """Look where two coordinates are 0 for regular postures on a component.

        Raises:
            RefusedError: If one is found there.
        """
        free = {*self._postures.symbols} - self._general.fixed - {"pi"}
        texts = [read(text) for text in locus.equations]
        for names in combinations(sorted(free), 2):
            for point in self._postures.several(Way()):
                there = point.changed(numbers=dict.fromkeys(names, point.zero))
                if any(there.value(own) != 0 for own in texts):
                    break
                with suppress(ResampleError, ZeroDivisionError):
                    rank, _ = self._numbers(there)
                    if rank >= self._part.rank:
                        raise RefusedError(f"the rank on it is {rank}, as in general")

    def covered(self, locus: Locus, cover: Node) -> None:
        """Note what is known of a component when all of its tree was looked at."""
        if locus.equations in self.sampled:
            self.unseen(locus)
        left = self._products | self._cased | {*self.sampled}
        if locus.equations not in left and _has_one_case(cover):
            self.irreducible[locus.equations] = None

    def _look(self, locus: Locus, way: Way, text: str | None) -> None:
        try:
            seen = self._sheets.on(way, text, lambda _, there: self._numbers(there))
        except NoResidueError:
            self.sampled[locus.equations] = None
        else:
            self._seen.setdefault(locus.equations, []).extend(seen)

    def _numbers(self, point: PointRing) -> tuple[int, int | None]:
        """The rank at a posture and the freedom of the platform."""
        asked = self._part.question != "limb" or self.freedom >= 0
        return self._matrix.rank(point), self._matrix.freedom(point) if asked else None

    def _points_of(self, locus: Locus) -> Iterator[PointRing]:
        for reach in locus.reach:
            yield from self._closed.on(Way(reach.steps), reach.roots)

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


def _has_one_case(node: Node) -> bool:
    """Whether one equation after the other is solved, none of them in two ways.

    Opposite values of an angle count as one way, as in sin q = 0.
    """
    going = [case for case in node.cases if not case.end]
    below = [sheet.node for case in going for sheet in case.sheets]
    below += [case.kept for case in going if case.kept is not None]
    return len(going) < 2 and all(map(_has_one_case, below))
