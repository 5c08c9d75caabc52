"""A limb's twists on a branch: its rank, minors that show it, wrenches that do no work.

References: [LongCaroKhalil2012] (4)-(9), (26).
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.equations_told import Multiple
from screwkit.certificates.looped_limbs import (
    FILLED,
    line_of,
    minors_of_limb,
    stands_still,
    wrenches_with_reactions,
)
from screwkit.certificates.records import OfLimb
from screwkit.certificates.steps import added, followed
from screwkit.conventions import SCREW_DIMENSION
from screwkit.errors import TooLargeError
from screwkit.loci.wrench_vectors import Vector, size_of, spanning_wrenches

Loci: TypeAlias = tuple[tuple[Polynomial, ...], ...]
"""The equations of each."""

Shown: TypeAlias = Callable[[Sequence[Polynomial]], tuple[Multiple, ...] | None]
"""Which of some values are multiples of conditions; None where one is not 0."""


@dataclass(frozen=True)
class LimbSystem:
    """The twists of a limb in all six coordinates; [P; C] where it has loops inside.

    Attributes:
        name: Of the limb.
        labels: Its freedoms that are not locked.
        columns: Their twists; what the loops inside say of each follows on its twist.
        height: Of the columns.
        below: By rank: where the limb's is lower; None where that is not proved, or
            joints are locked.
    """

    name: str
    labels: tuple[str, ...]
    columns: tuple[tuple[Polynomial, ...], ...]
    below: Callable[[int], Loci | None]
    height: int = SCREW_DIMENSION

    @property
    def is_chain(self) -> bool:
        """Whether there are no loops inside."""
        return self.height == SCREW_DIMENSION


@dataclass(frozen=True)
class Wrench:
    """A covector, and why it annihilates the twists of its limb.

    Attributes:
        covector: In the order of the coordinates of a twist; reactions of the loops
            inside the limb follow.
        work: Products with twists, by number of the freedom, that vanish as multiples
            of a condition.
        line: The wrench alone, without reactions and common factors.
        weight: What the line is multiplied by.
        terms: Of the wrench alone; of the line alone where it stands still.  What such
            a one is multiplied by is a squared axis as a rule, zero at no real posture.
    """

    covector: Vector
    work: tuple[Multiple, ...]
    line: Vector
    weight: Polynomial
    terms: int


@dataclass(frozen=True)
class RankClaim:
    """Why the rank of a limb is no less than some number.

    Attributes:
        said: Without wrenches.
        minor: The product that must not vanish, by powers; None where the limb's part
            is used.
        over: Powers of divisors of steps that it was multiplied by.
    """

    said: OfLimb
    minor: tuple[tuple[Polynomial, int], ...] | None
    over: dict[str, int]


@dataclass(frozen=True)
class LimbHere:
    """A limb on a branch, at one of its points.

    Attributes:
        columns: On the branch, with powers of the steps' divisors they were multiplied
            by.
        at: The point and its prime.
        values: Of the columns there.
        rank: At the point.
    """

    system: LimbSystem
    branch: Branch
    columns: tuple[tuple[list[Polynomial], dict[str, int]], ...]
    at: tuple[Point, int]
    values: tuple[tuple[int, ...], ...]
    rank: int

    @classmethod
    def of(cls, system: LimbSystem, branch: Branch, at: tuple[Point, int]) -> LimbHere:
        """A limb at a point of a branch."""
        columns = tuple(followed(branch, column) for column in system.columns)
        values = tuple(
            tuple(residue(x, *at) for x in column) for column in system.columns
        )
        return cls(system, branch, columns, at, values, rank(values, at[1]))

    @property
    def is_known(self) -> bool:
        """Whether the limb's own part says where its rank is less than here."""
        return self.system.below(self.rank) is not None

    def wrenches(self, library: FactorLibrary, shown: Shown) -> list[Wrench]:
        """Covectors that annihilate its twists, and span all that do at the point.

        Those of which that cannot be shown are left out.

        Raises:
            TooLargeError: If they are too long.
        """
        found = self._annihilating(library)
        if not self.branch.pending:  # then the other twists depend on the chosen ones
            return [self._wrench(covector, (), library) for covector in found]
        pairs = ((covector, shown(self._works(covector))) for covector in found)
        return [
            self._wrench(own, work, library) for own, work in pairs if work is not None
        ]

    def _wrench(
        self, covector: Vector, work: tuple[Multiple, ...], library: FactorLibrary
    ) -> Wrench:
        ring, whole = self.branch.ring, covector[:SCREW_DIMENSION]
        if self.system.is_chain:  # then it has no common factors
            return Wrench(covector, work, whole, ring.one, size_of(whole))
        line, weight = line_of(ring, covector, library)
        terms = size_of(line if stands_still(ring, line) else whole)
        return Wrench(covector, work, line, weight, terms)

    def _annihilating(self, library: FactorLibrary) -> list[Vector]:
        columns = [column for column, _ in self.columns]
        if not self.system.is_chain and columns:
            return wrenches_with_reactions(self.branch, columns, self.at, library)
        order = sorted(range(len(columns)), key=self._weight)
        chosen = independent([self.values[k] for k in order], self.at[1])
        own = [columns[order[k]] for k in chosen]
        extensor = minors_of(self.branch.ring, own, FILLED)
        height = self.system.height
        return spanning_wrenches(self.branch, extensor, height, self.rank, library)

    def _works(self, covector: Vector) -> list[Polynomial]:
        ring = self.branch.ring
        return [
            ring.normal(
                sum((a * b for a, b in zip(covector, own, strict=True)), ring.zero)
            )
            for own in self.system.columns
        ]

    def _weight(self, number: int) -> int:
        return sum(map(len, self.columns[number][0]))

    def claim(self, source: random.Random | None) -> RankClaim:
        """That its rank is no less than here.

        Raises:
            TooLargeError: If that takes a minor that is too long.
        """
        if self.is_known:
            return RankClaim(OfLimb(self.system.name, self.rank), None, {})
        if not self.system.is_chain:
            return self._product(source or random.Random(1))
        order = sorted(range(len(self.columns)), key=self._weight)
        places = list(range(SCREW_DIMENSION))
        if source is not None:
            source.shuffle(order)
            source.shuffle(places)
        found = independent([self.values[k] for k in order], self.at[1])
        chosen = sorted(order[k] for k in found)
        across = [[self.values[k][place] for k in chosen] for place in places]
        rows = sorted(places[k] for k in independent(across, self.at[1]))
        ring = self.branch.ring
        entries = [[self.columns[k][0][row] for row in rows] for k in chosen]
        minors = minors_of(ring, entries, FILLED)
        value = minors.get((1 << len(chosen)) - 1, ring.zero)
        labels = tuple(self.system.labels[k] for k in chosen)
        said = OfLimb(self.system.name, self.rank, tuple(rows), labels)
        over = added(*(self.columns[k][1] for k in chosen))
        return RankClaim(said, ((value, 1),), over)

    def _product(self, source: random.Random) -> RankClaim:
        columns = [column for column, _ in self.columns]
        minors = minors_of_limb(self.branch, columns, self.at, source)
        if not minors:
            raise TooLargeError("the minors of a limb with loops inside")
        found = min(minors[: 1 + source.randrange(2)], key=lambda own: own.terms)
        chosen, rows = sorted(found.columns), tuple(sorted(found.rows))
        labels = tuple(self.system.labels[k] for k in chosen)
        over = added(*(self.columns[k][1] for k in chosen))
        said = OfLimb(self.system.name, self.rank, rows, labels)
        return RankClaim(said, found.parts, over)
