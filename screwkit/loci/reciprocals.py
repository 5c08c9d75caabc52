"""Which of a mechanism's own lines are reciprocal to given screws, and a basis of them.

Candidates are tried at a random exact point first; those that are taken are proved
reciprocal by normal forms.  Where the geometry offers too few, signed minors complete
the basis, and a screw is made a pure force where that is possible rationally: a force
of the system is added to it.

References: [LongCaroKhalil2012] (26)-(32).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

from screwkit.algebra.polynomial_text import text
from screwkit.algebra.ring import S
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import DIRECTION, MOMENT, SCREW_DIMENSION
from screwkit.kinematics.frames import FramedTwists
from screwkit.kinematics.subspaces import dimension
from screwkit.loci.constructions import Geometry
from screwkit.loci.features import Axis, Features
from screwkit.loci.lines import Candidate, Catalogue
from screwkit.loci.placed_features import Residue, features_of
from screwkit.screw.nullspace import (
    Column,
    has_pitch,
    reciprocal_product,
    residues,
    sample,
    shortened,
)
from screwkit.screw.vector import Vector, cross, dot, normal

LONGEST = 4000  # characters of a screw that is not avoided
COMBINED = 600  # terms of screws that are combined to one without pitch


@dataclass(frozen=True)
class FoundScrew:
    """A screw, and the line it lies on where the geometry names one.

    Attributes:
        column: (direction, moment), exact.
        name: The line; empty for directions and for screws without a named line.
        how: The line as a force lies on it; empty for unnamed screws.
        point: A point of its line, where a named one is known.
        elsewhere: The same screw in a frame where it is shorter; its pitch is the same.
    """

    column: Column
    name: str = ""
    how: str = ""
    point: Vector[Polynomial] | None = None
    elsewhere: Column | None = None

    @property
    def is_free(self) -> bool:
        """Whether it is a couple or a translation."""
        return all(value == 0 for value in self.column[DIRECTION])


class Finder:
    """The candidate lines of some joints, tried at one exact point.

    Attributes:
        framed: The twists of the joints.
        features: Of the joints, and the lines of forces added to them.
    """

    def __init__(
        self,
        framed: FramedTwists,
        base: str,
        forces: Mapping[str, FoundScrew] | None = None,
        *,
        whole: bool = False,
    ) -> None:
        """Prepare the candidates.

        Args:
            framed: Twists in the base frame.
            base: The link whose frame that is.
            forces: Lines of forces, by what they are called.
            whole: Of the platform: lines of the base frame first, joints not combined.
        """
        self.framed = framed
        self.ring: TrigonometricRing = framed.ring
        self.features: Features[Polynomial] = features_of(framed)
        self._forces = dict(forces or {})
        self._exact: Geometry[Polynomial] = self._geometry()
        catalogue = Catalogue(
            self.features, base, self._parallel, tuple(self._forces), whole
        )
        self._tried: list[tuple[Candidate, list[int]]] = []
        for candidate in catalogue.candidates():
            direction, moment = candidate.screw(self._at_point)
            row = [v.value for v in (*direction, *moment)]
            if any(row):
                self._tried.append((candidate, row))

    # -- geometry over three rings ----------------------------------------------

    def _geometry(self) -> Geometry[Polynomial]:
        o, i, ring = self.ring.zero, self.ring.one, self.ring
        return Geometry(
            self.features,
            (o, o, o),
            ((i, o, o), (o, i, o), (o, o, i)),
            {
                called: (force.column[DIRECTION], force.column[MOMENT])
                for called, force in self._forces.items()
            },
            lambda vector: normal(ring, vector),
        )

    @cached_property
    def _at_point(self) -> Geometry[Residue]:
        _, prime = sample(self.ring)

        def at(vector: Sequence[Polynomial]) -> Vector[Residue]:
            x, y, z = (Residue(v, prime) for v in residues(self.ring, vector))
            return x, y, z

        return _mapped(self._exact, at)

    @cached_property
    def _sizes(self) -> Geometry[_Size]:
        def sizes(vector: Sequence[Polynomial]) -> Vector[_Size]:
            x, y, z = (_Size(len(v)) for v in vector)
            return x, y, z

        return _mapped(self._exact, sizes)

    @cached_property
    def _parallel(self) -> tuple[tuple[str, str], ...]:
        """Pairs of axes, not on one line, that are parallel for every posture."""
        found = []
        for a, b in combinations(self._at_point.features.axes, 2):
            if a.point is None or b.point is None:
                continue
            if not any(v.value for v in cross(a.direction, b.direction)):
                offset = tuple(p - q for p, q in zip(b.point, a.point, strict=True))
                if any(v.value for v in cross(a.direction, offset)):
                    found.append((a.joint, b.joint))
        return tuple(found)

    # -- search ------------------------------------------------------------------

    def reciprocal_to(
        self, columns: Sequence[Column], beyond: Sequence[Sequence[int]] = ()
    ) -> list[Candidate]:
        """Candidates reciprocal to these screws at the point, simplest first.

        Args:
            columns: The screws.
            beyond: Rows at the point; candidates in their span are left out.
        """
        _, prime = sample(self.ring)
        rows = [residues(self.ring, column) for column in columns]
        size = dimension(beyond, prime)
        found = [
            candidate
            for candidate, screw in self._tried
            if all(_product(row, screw) % prime == 0 for row in rows)
            and (not beyond or dimension([*beyond, screw], prime) > size)
        ]
        return sorted(found, key=lambda c: (not c.free, c.rank, self._size(c)))

    def _size(self, candidate: Candidate) -> int:
        """A bound for the number of terms."""
        direction, moment = candidate.screw(self._sizes)
        return sum(v.terms for v in (*direction, *moment))

    def exact(self, candidate: Candidate, columns: Sequence[Column]) -> FoundScrew:
        """The candidate as polynomials, proved reciprocal to ``columns``.

        Raises:
            ArithmeticError: If it is not, which the trial at a random point has made
                all but impossible.
        """
        direction, moment = candidate.screw(self._exact)
        cleared = self.ring.without_divisors((*direction, *moment))
        column = shortened(self.ring, cleared)
        if any(reciprocal_product(self.ring, column, c) != 0 for c in columns):
            raise ArithmeticError(f"not reciprocal after all: {candidate.how}")
        point = None
        if candidate.point is not None:
            point = normal(self.ring, candidate.point(self._exact))
        return FoundScrew(column, candidate.name, candidate.how, point)

    def basis(
        self,
        columns: Sequence[Column],
        size: int,
        complete: Callable[[], Sequence[FoundScrew]],
        first: Sequence[FoundScrew] = (),
    ) -> list[FoundScrew]:
        """Independent screws reciprocal to ``columns``.

        Args:
            columns: The screws.
            size: How many are wanted.
            complete: A basis to fill up with.
            first: Taken before any other.
        """
        _, prime = sample(self.ring)
        chosen = list(first)
        rows = [residues(self.ring, screw.column) for screw in chosen]
        for longest in (LONGEST, None):
            if len(chosen) == size:
                break
            for candidate in self.reciprocal_to(columns, rows):
                screw = self.exact(candidate, columns)
                row = residues(self.ring, screw.column)
                if dimension([*rows, row], prime) == len(rows):
                    continue
                if longest and not self._is_short(screw.column, longest):
                    continue
                chosen.append(self._named_most_simply(candidate, screw, columns))
                rows.append(row)
                if len(chosen) == size:
                    break
        if len(chosen) < size:
            for screw in complete():
                row = residues(self.ring, screw.column)
                if dimension([*rows, row], prime) > len(rows):
                    chosen.append(pure(self.ring, screw, chosen))
                    rows.append(row)
        return chosen

    def _named_most_simply(
        self, candidate: Candidate, screw: FoundScrew, columns: Sequence[Column]
    ) -> FoundScrew:
        """The line as an axis where it is one: in the fewest parts, proved the same."""
        row = next(row for known, row in self._tried if known is candidate)
        shortest = self._said[self._key(row)]
        if shortest.parts >= candidate.parts:
            return screw
        other = self.exact(shortest, columns)
        if not proportional(self.ring, screw.column, other.column):
            return screw
        if _terms(other.column) <= _terms(screw.column):
            return other
        return replace(screw, name=other.name, how=other.how)

    @cached_property
    def _said(self) -> dict[tuple[int, ...], Candidate]:
        """Of the candidates on one line the one of the fewest parts."""
        found: dict[tuple[int, ...], Candidate] = {}
        for candidate, row in self._tried:
            key = self._key(row)
            if key not in found or candidate.parts < found[key].parts:
                found[key] = candidate
        return found

    def _key(self, row: Sequence[int]) -> tuple[int, ...]:
        """A row up to a factor."""
        _, prime = sample(self.ring)
        inverse = pow(next(value for value in row if value), -1, prime)
        return tuple(value * inverse % prime for value in row)

    def _is_short(self, column: Column, longest: int) -> bool:
        if sum(len(value) for value in column) * 4 > longest:
            return False
        return sum(len(text(self.ring, value)) for value in column) <= longest


def pure(
    ring: TrigonometricRing, screw: FoundScrew, system: Sequence[FoundScrew]
) -> FoundScrew:
    """The screw w itself if it has pitch 0, else w·B − w′·q, which has, if w′ exists.

    With q = f·m of w and B = f·m′ + f′·m, for a force or couple w′ of the system, the
    combination B w − q w′ is a pure force: B² q − q B B = 0.
    """
    column = screw.column
    if not has_pitch(ring, column) or _terms(column) > COMBINED:
        return screw
    pitch = ring.normal(dot(column[DIRECTION], column[MOMENT]))
    best: Column | None = None
    for other in system:
        if has_pitch(ring, other.column) or _terms(other.column) > COMBINED:
            continue
        mixed = reciprocal_product(ring, column, other.column)
        if mixed == 0:
            continue
        combined = shortened(
            ring,
            [
                ring.normal(mixed * a - pitch * b)
                for a, b in zip(column, other.column, strict=True)
            ],
        )
        if best is None or _terms(combined) < _terms(best):
            best = combined
    if best is None or _terms(best) * 12 > max(LONGEST, 12 * _terms(column)):
        return screw
    return FoundScrew(best)


def proportional(
    ring: TrigonometricRing, one: Sequence[Polynomial], other: Sequence[Polynomial]
) -> bool:
    """Whether two screws, neither of them zero, differ by a factor alone."""
    pivot = next(i for i, value in enumerate(one) if value != 0)
    return all(
        ring.normal(a * other[pivot] - b * one[pivot]) == 0
        for a, b in zip(one, other, strict=True)
    )


def span_of(
    ring: TrigonometricRing, limbs: Sequence[Sequence[FoundScrew]]
) -> list[FoundScrew]:
    """An independent part of several systems together, free ones first."""
    _, prime = sample(ring)
    together = [screw for limb in limbs for screw in limb]
    chosen: list[FoundScrew] = []
    rows: list[list[int]] = []
    for screw in sorted(together, key=lambda s: not s.is_free):
        row = residues(ring, screw.column)
        if len(rows) < SCREW_DIMENSION and dimension([*rows, row], prime) > len(rows):
            chosen.append(screw)
            rows.append(row)
    return chosen


class _Size:
    """An upper bound for the number of terms, with the operations of a scalar."""

    __slots__ = ("terms",)

    def __init__(self, terms: int) -> None:
        self.terms = terms

    def __add__(self, other: _Size) -> _Size:
        return _Size(self.terms + other.terms)

    def __sub__(self, other: _Size) -> _Size:
        return _Size(self.terms + other.terms)

    def __mul__(self, other: _Size) -> _Size:
        return _Size(self.terms * other.terms)

    def __neg__(self) -> _Size:
        return self


def _mapped(
    exact: Geometry[Polynomial],
    at: Callable[[Sequence[Polynomial]], Vector[S]],
) -> Geometry[S]:
    """The same geometry over another ring, whose scalars are their own normal form."""
    features = exact.features
    x, y, z = (at(unit) for unit in exact.units)
    return Geometry(
        Features(
            tuple(
                Axis(
                    a.joint,
                    a.limb,
                    at(a.direction),
                    None if a.point is None else at(a.point),
                )
                for a in features.axes
            ),
            tuple(replace(p, position=at(p.position)) for p in features.points),
            features.planes,
        ),
        at(exact.origin),
        (x, y, z),
        {
            called: (at(along), at(moment))
            for called, (along, moment) in exact.forces.items()
        },
        lambda vector: vector,
    )


def _product(left: Sequence[int], right: Sequence[int]) -> int:
    return sum(
        a * b for a, b in zip(left, (*right[MOMENT], *right[DIRECTION]), strict=True)
    )


def _terms(column: Sequence[Polynomial]) -> int:
    return sum(len(value) for value in column)
