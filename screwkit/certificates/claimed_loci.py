"""Whether what a certificate lists is there: ranks, components, none in another."""

from __future__ import annotations

from collections.abc import Iterator

from screwkit.algebra.all_roots import NoResidueError
from screwkit.algebra.exact_point import PointRing
from screwkit.certificates.closed_postures import ClosedPostures
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.irreducible_equations import Shape, shape_of
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Locus, Node
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError, read


class ClaimedLoci:
    """The components of one part under examination.

    Args:
        postures: Of the mechanism and the part.
        matrix: Of the part.
        sheets: Of conditions.
        closed: Its closed postures.
    """

    def __init__(
        self,
        postures: Postures,
        matrix: ScrewMatrix | GraphMatrix,
        sheets: Sheets,
        closed: ClosedPostures,
    ) -> None:
        self._postures, self._matrix, self._sheets = postures, matrix, sheets
        self._closed = closed
        self._part = postures.part
        self.freedom = -1
        """Of a limb by its loop equations: what it allows the platform in general."""
        self._seen: dict[tuple[str, ...], list[tuple[int, int | None]]] = {}
        self._products: set[tuple[str, ...]] = set()
        self.sampled: dict[tuple[str, ...], None] = {}
        """Equations of components of which only some postures were seen."""
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

    def sheet(self, locus: Locus, way: Way) -> None:
        """Look at all sheets of a way on which the equations of a component hold.

        Where several conditions meet it is said that only some postures were seen.
        """
        active = self._sheets.active(way)
        if len(active) > 1:
            self.sampled[locus.equations] = None
            return
        text = next(iter(active), None)
        if text and shape_of(self._sheets, text, way) is not Shape.IRREDUCIBLE:
            self._products.add(locus.equations)
        self._look(locus, way, text)

    def covered(self, locus: Locus, cover: Node) -> None:
        """Note what is known of a component when all of its tree was looked at."""
        left = self._products | {*self.sampled}
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
