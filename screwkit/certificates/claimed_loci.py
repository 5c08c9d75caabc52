"""Whether what a certificate lists is there: ranks, components, none in another."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import combinations, permutations

from screwkit.algebra.all_roots import NoResidueError, vanishes
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.closed_postures import ClosedPostures
from screwkit.certificates.containment import holds_on, is_whole_part
from screwkit.certificates.general_claims import GeneralClaims
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.irreducible_equations import Shape, shape_of
from screwkit.certificates.postures import Way
from screwkit.certificates.records import Locus, Node
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError, read
from screwkit.certificates.towers import Towers, members


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
        self.wider: dict[tuple[str, ...], None] = {}
        """Equations of components that hold on all of another one, too."""
        self._looked_at: set[tuple[str, ...]] = set()
        """Those that were shown to hold at singular postures alone."""
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

    def is_known(self, number: int) -> bool:
        """Whether the component of a number was met on all sheets; of none, too."""
        if number < 0:
            return True
        found = self._part.components[number : number + 1]
        return any(own.equations in self._looked_at for own in found)

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
        if locus.equations not in self.sampled:
            self._looked_at.add(locus.equations)
        if not seen or locus.equations in self.sampled or self._postures.tied:
            seen += [self._numbers(point) for point in self._points_of(locus)]
        ranks = [rank for rank, _ in seen]
        freedoms = [own for _, own in seen if own is not None]
        if 0 <= self.freedom <= max(freedoms, default=0):
            raise RefusedError(f"the platform has {max(freedoms)} freedoms on it")
        if max(ranks) >= self._part.rank:
            raise RefusedError(f"the rank on it is {max(ranks)}, as in general")
        if max(ranks) != locus.rank:
            raise RefusedError(f"the rank on it is {max(ranks)}, not {locus.rank}")
        if not freedoms and locus.freedom >= 0:
            raise RefusedError("it speaks of the platform, and a limb does not")
        if freedoms and min(freedoms) != locus.freedom:
            raise RefusedError(f"the platform has {min(freedoms)} freedoms there")
        if self._part.question == "actuation" and (locus.freedom > 0) != moves:
            raise RefusedError("the platform is said to move where it does not")

    def equation(self, locus: Locus) -> None:
        """Look at all sheets of a component of one equation.

        Where loops tie joint variables it is not the only one: see `sheet`.

        Raises:
            RefusedError: If it is a product.
        """
        (text,) = locus.equations
        shape = shape_of(self._sheets, text)
        if shape is Shape.PRODUCT:
            raise RefusedError("its equation is a product")
        if self._postures.tied:  # closed postures on it may still fall apart
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
        texts = tuple(e.equation for own in node.roots for e in members(own))

        def judged(at: PointRing, there: PointRing) -> tuple[int, int | None] | bool:
            return self._judged(locus, way, texts, at, there)

        if node.roots:
            if not self._is_small(locus, way, len(texts)):
                self._note(locus, self._towers.on(way, node.roots, judged))
            return
        active = self._sheets.active(way)
        texts = active
        if len(active) > 1 or self._postures.tied:
            self._cased.add(locus.equations)
            texts = tuple(own for own in active if self._is_all(own, way))[:1]
        text = next(iter(texts), None)
        if text and shape_of(self._sheets, text, way) is not Shape.IRREDUCIBLE:
            self._products.add(locus.equations)
        if locus.equations in self._cased:
            self._note(locus, self._sheets.on(way, text, judged))
        else:
            self._look(locus, way, text)

    def _is_small(self, locus: Locus, way: Way, conditions: int) -> bool:
        """Whether so many conditions leave fewer dimensions than a component has.

        They are independent of each other and of the steps.  A component of what k
        equations cut out has n − k at least (Krull).
        """
        started_with = len(locus.equations) + len(self._closed.conditions)
        return len(way.steps) + conditions > started_with

    def on_components(self, node: Node, way: Way) -> None:
        """Check that each sheet of a way in a proof lies on a component.

        Raises:
            RefusedError: If one may not.
        """
        if not node.roots:
            raise RefusedError("nothing is said of it")
        self._towers.check(node, way)
        met = tuple(e.equation for own in node.roots for e in members(own))

        def placed(at: PointRing, there: PointRing) -> bool:
            return any(
                all(vanishes(there.value(read(text))) for text in own.equations)
                for own in self._part.components
            ) or self._general.is_tied(at, replace(way, conditions=met))

        if not all(self._towers.on(way, node.roots, placed)):
            raise RefusedError("some of it lies on no component")

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
        conditions = [read(text) for text in way.conditions]
        more = all(any(x.value(own) != 0 for own in conditions) for x in points)
        if not self._is_small(locus, way, int(more)):
            raise RefusedError("it may be a sheet of the component")

    def _is_all(self, text: str, way: Way) -> bool:
        """Whether all conditions of a way hold wherever one of them does."""
        others = [read(own) for own in way.conditions]

        def hold(_: PointRing, there: PointRing) -> bool:
            return all(there.value(own) == 0 for own in others)

        return all(self._sheets.on(way, text, hold))

    def _judged(
        self,
        locus: Locus,
        way: Way,
        met: tuple[str, ...],
        at: PointRing,
        there: PointRing,
    ) -> tuple[int, int | None] | bool:
        """What is seen at a posture, if it is as on the component; if the sheet counts.

        Where dimensions are tied nothing is said.  Where conditions of the way do not
        hold the sheet is cut by one more, which may leave too few dimensions; and where
        the rank of the matrix falls all over it, it does so on what is cut out.  Else,
        or where it is not clear whether the posture is near singular ones, False.

        Args:
            locus: The component.
            way: To the sheet.
            met: The conditions that were met.
            at: The posture before the steps.
            there: The posture.

        Raises:
            RefusedError: If it is a regular posture.
        """
        seen = self._seen_at(locus, way, len(met), there)
        if seen is not None and seen is not False:
            return seen
        if self._general.is_tied(at, replace(way, conditions=met)):
            return True
        if seen is None:
            raise RefusedError(f"the rank on it is {self._part.rank}, as in general")
        return False

    def _seen_at(
        self, locus: Locus, way: Way, met: int, there: PointRing
    ) -> tuple[int, int | None] | bool | None:
        """What is seen at a posture, whatever its dimensions; None if it is regular."""
        question = self._part.question
        moves = question == "actuation" and locus.freedom > 0
        if not all(vanishes(there.value(read(text))) for text in way.conditions):
            if self._is_small(locus, way, met + 1):
                return True
            falls = self._matrix.rank(there) < self._part.rank
            return falls and not moves and self.freedom < 0
        rank, freedom = self._numbers(there)
        if self._postures.tied and (not moves or not self._closed.closes(there)):
            # what falls all over a wider set does so where loops close
            return rank < self._part.rank and not moves
        if rank >= self._part.rank:
            return None
        if rank == locus.rank and freedom in (None, locus.freedom):
            return rank, freedom
        if freedom is not None and question == "actuation":
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

    def count(self, locus: Locus) -> int:
        """How often a component was seen as it is claimed to be."""
        return len(self._seen.get(locus.equations, ()))

    def forget(self, locus: Locus) -> None:
        """Begin anew with a component."""
        self._seen.pop(locus.equations, None)
        self.sampled.pop(locus.equations, None)

    def unseen(self, locus: Locus) -> None:
        """Look where two coordinates are 0 for regular postures on a component.

        Raises:
            RefusedError: If one is found there.
        """
        if self._postures.tied:
            return
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
        if self._postures.tied:
            return
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
        points = [next(self._points_of(locus)) for locus in loci]
        for one, two in permutations(range(len(loci)), 2):
            locus, other, point = loci[one], loci[two], points[one]
            if holds_on(other, point):
                if holds_on(locus, points[two]) or not is_whole_part(
                    self._postures, locus, other, point
                ):
                    raise RefusedError(
                        f"component {' = 0, '.join(locus.equations)} = 0 lies in "
                        f"another one"
                    )
                self.wider[other.equations] = None
                self.irreducible.pop(other.equations, None)


def _has_one_case(node: Node) -> bool:
    """Whether one equation after the other is solved, none of them in two ways.

    Opposite values of an angle count as one way, as in sin q = 0.
    """
    going = [case for case in node.cases if not case.end]
    below = [sheet.node for case in going for sheet in case.sheets]
    below += [case.kept for case in going if case.kept is not None]
    return len(going) < 2 and all(map(_has_one_case, below))
