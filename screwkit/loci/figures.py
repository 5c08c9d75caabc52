"""Which lines of a mechanism become dependent on a piece of a locus, and how they lie.

Sets of screws are tried at exact points: independent in general, dependent on the
piece.  Of those only one whose minors vanish on the piece and nowhere else gives a
sentence; what dependent lines look like is a theorem (`figure_words`).

References: [Merlet1989]; [LongCaroKhalil2012] Table 3.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, islice
from math import prod
from typing import Literal

from screwkit.algebra.branches import Branch
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.minors import minors_of_size
from screwkit.algebra.modular import rank
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.figure_words import (
    dependent,
    dependent_about,
    dependent_along,
    dependent_directions,
)
from screwkit.loci.named_screws import NamedScrew
from screwkit.loci.pieces import Piece
from screwkit.loci.placed_features import features_of
from screwkit.loci.same_zeros import proviso, zeros_beside
from screwkit.screw.vector import Vector, add, cross

_SETS = 4_000  # sets of screws that are tried at points
_COMPARED = 12  # of which so many are compared with the piece
_COSTLIEST = 10**13  # the terms of the screws of one minor, multiplied
_OF_SEVERAL = 2  # screws whose dependence takes several equations

GIVEN = "(given"
"""What sentences with a proviso contain."""

ExactPoint = tuple[Sequence[int], int]
Column = tuple[Polynomial, ...]
NamedPoint = tuple[str, Vector[Polynomial]]


@dataclass(frozen=True)
class View:
    """Screws as vectors: whole, up to translations, or up to rotations about a point.

    Attributes:
        screws: Those that are not zero in it.
        columns: Their vectors.
        smallest: Of the sets that are tried.
        words: Given screws, the rank left to them and their rows at a random posture.
    """

    screws: tuple[NamedScrew, ...]
    columns: tuple[Column, ...]
    smallest: int
    words: Callable[[Sequence[NamedScrew], int, list[list[int]], int], str | None]

    def rows(self, point: Sequence[int], prime: int) -> list[list[int]]:
        """The vectors at an exact posture."""
        return [[residue(x, point, prime) for x in c] for c in self.columns]


class Figures:
    """Named screws in one frame, and pieces on which some of them are dependent."""

    def __init__(
        self,
        framed: FramedTwists,
        root: Branch,
        library: FactorLibrary,
        screws: Callable[[], Sequence[NamedScrew]],
        held: Callable[[], Sequence[NamedPoint]] = tuple,
        *,
        directions: Literal["first", "last"] | None = None,
        forces: Literal["first", "last"] | None = None,
    ) -> None:
        """Nothing is computed before the first piece is asked about.

        Args:
            framed: Twists of the joints.
            root: All postures.
            library: Known factors.
            screws: What may become dependent.
            held: Points through which all forces are there beside these screws.
            directions: When to look at those of lines; without it only, and first,
                where every translation, or every couple, is among the screws.
            forces: The screws are wrenches; when to look at those of lines up to
                couples normal to an axis, where all these are among the screws.
        """
        self._held = held
        self._framed = framed
        self._root = root
        self._library = library
        self._given = screws
        self._always = directions
        self._forces = forces
        self._beside: dict[object, Sequence[Polynomial] | None] = {}

    def of(self, piece: Piece, smallest: int = 1, largest: int = 5) -> str | None:
        """A sentence that holds exactly on the piece; None where none was found.

        Args:
            piece: Where screws may be dependent.
            smallest: The fewest screws that are looked at together.
            largest: The most; six lines can only be said to lie in a linear complex.
        """
        provisional: str | None = None
        for sentence, beside in self.compared(piece, smallest, largest):
            if not beside:
                return sentence
            given = proviso(self._framed.ring, beside)
            if given is not None and provisional is None:
                provisional = f"{sentence} ({given})"
        return provisional

    def compared(
        self, piece: Piece, smallest: int = 1, largest: int = 5
    ) -> Iterator[tuple[str, Sequence[Polynomial]]]:
        """What is dependent on a piece, and on which other conditions it is too.

        See `of`.  What holds on sets beside that are not known is left out.
        """
        compared = _COMPARED
        if piece.codimension > 1 and len(piece.equations) > 1:
            largest, compared = min(largest, _OF_SEVERAL), _COMPARED // 4
        on = [point for branch in piece.branches[:2] for point in branch.points]
        if not on or not self._root.points:
            return
        for view, chosen, left in islice(
            self._dependent(on, smallest, largest), compared
        ):
            sentence = self._sentence(view, chosen, left)
            key = sentence, piece.texts
            if sentence is None:
                continue
            if key not in self._beside:
                self._beside[key] = self._zeros_beside(piece, view, chosen, left)
            beside = self._beside[key]
            if beside is not None:
                yield sentence, beside

    def holding(
        self, piece: Piece, largest: int = 3
    ) -> Iterator[tuple[str, list[Polynomial]]]:
        """What is dependent on a piece and perhaps elsewhere, with its minors."""
        on = [point for branch in piece.branches for point in branch.points]
        if not on or not self._root.points:
            return
        for view, chosen, left in self._dependent(on, 1, largest):
            sentence = self._sentence(view, chosen, left)
            minors = sentence and self._minors(view, chosen, left)
            if sentence and minors:
                yield sentence, minors

    # -- ways to look at the screws ----------------------------------------------

    @cached_property
    def _screws(self) -> tuple[NamedScrew, ...]:
        return tuple(self._given())

    @cached_property
    def _views(self) -> tuple[View, ...]:
        """Short vectors first."""
        about = [v for c in self._centres for v in self._about(*c)]
        ways, along = [*self._directions()], [*self._along()]
        late = self._always == "last" and not self._has_all_free
        found = [] if late else ways
        found += [*about, *(along if self._forces == "first" else [])]
        found += self._whole()
        found += ways if late else []
        return (*found, *(along if self._forces == "last" else []))

    @cached_property
    def _has_all_free(self) -> bool:
        """Whether every translation, or every couple, is among the screws."""
        point, prime = self._root.points[0]
        free = [s.at(point, prime)[MOMENT] for s in self._screws if s.free]
        return len(free) > 2 and rank(free, prime) == 3

    def _whole(self) -> Iterator[View]:
        screws = tuple(s for s in self._screws if not s.ball)
        if len(screws) > 1:
            yield View(screws, tuple(s.column for s in screws), 2, dependent)

    def _directions(self) -> Iterator[View]:
        point, prime = self._root.points[0]
        if not self._always and not self._has_all_free:
            return
        lines: list[NamedScrew] = []  # of parallel ones the first
        ways: list[list[int]] = []
        for screw in self._screws:
            way = screw.at(point, prime)[DIRECTION]
            if screw.free or screw.ball or any(rank([w, way], prime) < 2 for w in ways):
                continue
            lines.append(screw)
            ways.append(way)
        if len(lines) > 1:
            columns = tuple(s.column[DIRECTION] for s in lines)
            yield View(
                tuple(lines),
                columns,
                2,
                lambda s, left, rows, p: dependent_directions(s, left),
            )

    def _along(self) -> Iterator[View]:
        """Where all couples normal to an axis, and no more, are among the screws."""
        point, prime = self._root.points[0]
        free = [s for s in self._screws if s.free]
        moments = [s.at(point, prime)[MOMENT] for s in free]
        if not self._forces or len(free) < 2 or rank(moments, prime) != 2:
            return
        ring = self._framed.ring

        def is_normal(way: Sequence[Polynomial]) -> bool:
            return all(
                ring.normal(_dot(screw.column[MOMENT], way)) == 0 for screw in free
            )

        axes = (a for a in features_of(self._framed).axes if a.point is not None)
        axis = next((a for a in axes if is_normal(a.direction)), None)
        lines = tuple(s for s in self._screws if s.is_line)
        if axis is None or len(lines) < 2:
            return
        columns = tuple(
            (*s.column[DIRECTION], ring.normal(_dot(s.column[MOMENT], axis.direction)))
            for s in lines
        )
        yield View(
            lines,
            columns,
            2,
            lambda s, left, rows, p: dependent_along(axis.joint, s, left),
        )

    @cached_property
    def _centres(self) -> list[NamedPoint]:
        """Points through which three independent lines pass for every posture."""
        found = [*self._held()]
        for place in features_of(self._framed).points:
            point, prime = self._root.points[0]
            through = [
                row[DIRECTION]
                for screw in self._screws
                if screw.is_line
                for row in [screw.at(point, prime)]
                if not any(
                    x % prime for x in self._moment(row, place.position, point, prime)
                )
            ]
            known = any(name == place.name for name, _ in found)
            if not known and len(through) > 2 and rank(through, prime) == 3:
                found.append((place.name, place.position))
        return found

    def _moment(
        self,
        row: Sequence[int],
        place: Vector[Polynomial],
        point: Sequence[int],
        prime: int,
    ) -> Vector[int]:
        x, y, z = (residue(v, point, prime) for v in place)
        d, m = row[DIRECTION], row[MOMENT]
        return add((m[0], m[1], m[2]), cross((d[0], d[1], d[2]), (x, y, z)))

    def _about(self, name: str, place: Vector[Polynomial]) -> Iterator[View]:
        ring = self._framed.ring
        screws, columns = [], []
        for screw in self._screws:
            d, m = screw.column[DIRECTION], screw.column[MOMENT]
            moment = add((m[0], m[1], m[2]), cross((d[0], d[1], d[2]), place))
            column = tuple(ring.without_divisors([ring.normal(v) for v in moment]))
            if not screw.ball and not screw.pitched and any(v != 0 for v in column):
                screws.append(screw)
                columns.append(column)
        if screws:
            yield View(
                tuple(screws),
                tuple(columns),
                1,
                lambda s, left, rows, p: dependent_about(name, s, left),
            )

    # -- search ------------------------------------------------------------------

    def _dependent(
        self, on: Sequence[ExactPoint], smallest: int, largest: int
    ) -> Iterator[tuple[View, tuple[int, ...], int]]:
        """Sets that lose rank on a piece, and the rank left, simplest first."""
        for view in self._views:
            point, prime = self._root.points[0]
            general = view.rows(point, prime)
            there = [(view.rows(*at), at[1]) for at in on]
            least = max(view.smallest, smallest)
            circuits = list(_circuits(least, largest, general, prime, there))
            whole = list(_classes(view.screws, general, prime, there))
            for chosen, left in sorted([*whole, *circuits], key=lambda c: c[1]):
                if left + 1 >= smallest:
                    yield view, chosen, left

    def _sentence(self, view: View, chosen: Sequence[int], left: int) -> str | None:
        point, prime = self._root.points[0]
        screws = [view.screws[i] for i in chosen]
        rows = [[residue(x, point, prime) for x in view.columns[i]] for i in chosen]
        return view.words(screws, left, rows, prime)

    def _zeros_beside(
        self, piece: Piece, view: View, chosen: Sequence[int], left: int
    ) -> list[Polynomial] | None:
        minors = self._minors(view, chosen, left)
        if minors is None:
            return None
        return zeros_beside(piece, minors, self._root, self._library)

    def _minors(
        self, view: View, chosen: Sequence[int], left: int
    ) -> list[Polynomial] | None:
        """They vanish where the rank is no larger; None if they cost too much."""
        ring = self._framed.ring
        columns = [view.columns[i] for i in chosen]
        sizes = sorted((sum(map(len, c)) for c in columns), reverse=True)
        if prod(sizes[: left + 1]) > _COSTLIEST:
            return None
        return [ring.normal(m) for m in minors_of_size(ring, columns, left + 1)]


def figure_among(figures: Iterable[Figures], piece: Piece) -> str | None:
    """A sentence for a piece, rather without a proviso; None where none was found."""
    found: str | None = None
    for own in figures:
        sentence = own.of(piece)
        if sentence is not None and GIVEN not in sentence:
            return sentence
        found = found or sentence
    return found


def _dot(a: Sequence[Polynomial], b: Sequence[Polynomial]) -> Polynomial:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _circuits(
    smallest: int,
    largest: int,
    general: Sequence[Sequence[int]],
    prime: int,
    there: Sequence[tuple[list[list[int]], int]],
) -> Iterator[tuple[tuple[int, ...], int]]:
    """Smallest sets, independent in general and dependent at all these points."""
    found: list[set[int]] = []
    tried = 0
    most = min(rank(general, prime), largest)
    for size in range(smallest, most + 1):
        for chosen in combinations(range(len(general)), size):
            tried += 1
            if tried > _SETS:
                return
            if any(known <= set(chosen) for known in found):
                continue
            if (
                all(rank([rows[i] for i in chosen], p) == size - 1 for rows, p in there)
                and rank([general[i] for i in chosen], prime) == size
            ):
                found.append(set(chosen))
                yield chosen, size - 1


def _classes(
    screws: Sequence[NamedScrew],
    general: Sequence[Sequence[int]],
    prime: int,
    there: Sequence[tuple[list[list[int]], int]],
) -> Iterator[tuple[tuple[int, ...], int]]:
    """More lines than their rank: all of a limb, of two or of all, closer there."""
    lines = [i for i, s in enumerate(screws) if s.is_line]
    limbs = sorted({screws[i].limb for i in lines})
    some = [{x} for x in limbs] + [set(pair) for pair in combinations(limbs, 2)]
    groups = [[i for i in lines if screws[i].limb in own] for own in some]
    for group in [*groups, lines] if len(limbs) > 2 else groups:
        if len(group) < 2:
            continue
        before = rank([general[i] for i in group], prime)
        after = {rank([rows[i] for i in group], p) for rows, p in there}
        left = max(after)
        if len(after) == 1 and left < before and left + 1 < len(group):
            yield tuple(group), left
