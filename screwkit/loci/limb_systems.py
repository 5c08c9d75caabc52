"""What a limb with loops inside lets its platform do, as an extensor on a branch.

Parts in series add their twists, chains side by side their wrenches; both are joins of
extensors, and the dual leads from one to the other.  An extensor is freed from common
factors, so that it holds wherever it is not zero and no rank is special; where that may
fail is kept beside it, as the polynomials that then all vanish.

References: [Hunt1978], §13; [CoxLittleOShea] §9.1.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from math import comb
from typing import TypeAlias
from weakref import WeakKeyDictionary

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.minors import Bits, dual, joined
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.limb_parts import Part, Parts, SideBySide, motion_at
from screwkit.loci.limb_extensors import primitive_extensor
from screwkit.loci.rank_drop import Column, extensors

Extensor: TypeAlias = Mapping[Bits, Polynomial]
Ideal: TypeAlias = tuple[Polynomial, ...]

CHOICES = 400
"""Choices of vectors with which one extensor is filled up by another."""


class UnclearError(Exception):
    """No extensor was found that holds in general on the branch."""


@dataclass(frozen=True)
class System:
    """The twists, or the forms that vanish on them, in general on a branch.

    Attributes:
        extensor: Its coordinates by set of rows.
        limits: Outside the common zeros of each of these lists, the extensor is right.
    """

    extensor: Extensor
    limits: tuple[Ideal, ...]

    @property
    def dimension(self) -> int:
        """Of the space that the extensor stands for."""
        return next(iter(self.extensor)).bit_count()


def limb_system(
    branch: Branch, parts: Parts, height: int, library: FactorLibrary
) -> System:
    """The twists of parts in series, in general on a branch.

    Args:
        branch: Irreducible, with exact points.
        parts: In the generators of the whole ring; they are restricted here.
        height: Coordinates of a twist.
        library: Factors met before.

    Raises:
        UnclearError: If there is no exact point, or no extensor was found that is right
            there.
    """
    if not branch.points:
        raise UnclearError
    return _Systems(branch, height, library).in_series(parts)


_CHAINS: WeakKeyDictionary[FactorLibrary, dict[tuple[int, str], System]]
_CHAINS = WeakKeyDictionary()  # of joints in series, which most conditions leave alone


@dataclass(frozen=True)
class _Systems:
    branch: Branch
    height: int
    library: FactorLibrary

    def in_series(self, parts: Parts) -> System:
        columns = [part for part in parts if not isinstance(part, SideBySide)]
        blocks = [part for part in parts if isinstance(part, SideBySide)]
        found = self._of_columns(columns)
        behind: list[Part] = list(columns)
        for block in blocks:
            behind.append(block)
            both = found, self._side_by_side(block)
            found = self._sum(both, self._dimension(behind))
        if not self._is_right(found, parts):
            raise UnclearError
        return found

    def _of_columns(self, columns: Parts) -> System:
        if not columns:
            return System({0: self.branch.ring.one}, ())
        vectors = [part for part in columns if not isinstance(part, SideBySide)]
        size = self._dimension(columns)
        known = _CHAINS.setdefault(self.library, {})
        key = size, self._shown(vectors)
        if key not in known:
            known[key] = self._one_of(extensors(self.branch, vectors, size))
        return known[key]

    def _shown(self, vectors: Sequence[Column]) -> str:
        """The vectors on the branch, and whatever of it their extensor depends on."""
        branch = self.branch
        columns = [[str(x) for x in branch.column(vector)] for vector in vectors]
        divisors = [str(divisor) for divisor in branch.divisors]
        return f"{columns}{divisors}{[str(p.value) for p in branch.pending]}"

    def _side_by_side(self, block: SideBySide) -> System:
        """The dual of the join of the chains' forms."""
        ring, height = self.branch.ring, self.height
        forms = [self._dual(self.in_series(chain)) for chain in block.chains]
        found = forms[0]
        for number, other in enumerate(forms[1:], 2):
            first = SideBySide(block.chains[:number])
            size = height - self._dimension([first])
            found = self._sum((found, other), size)
        return System(dual(ring, found.extensor, height), found.limits)

    def _dual(self, system: System) -> System:
        extensor = dual(self.branch.ring, system.extensor, self.height)
        return System(extensor, system.limits)

    def _sum(self, both: tuple[System, System], size: int) -> System:
        """What two systems span together, of that dimension."""
        larger, smaller = sorted(both, key=lambda s: -s.dimension)
        ring = self.branch.ring
        missing = size - larger.dimension
        if missing == smaller.dimension:
            charts = [joined(ring, larger.extensor, smaller.extensor)]
        else:
            vectors = list(self._vectors(smaller))
            if comb(len(vectors), missing) > CHOICES:
                raise UnclearError
            charts = [
                reduce(lambda a, b: joined(ring, a, b), chosen, dict(larger.extensor))
                for chosen in combinations(vectors, missing)
            ]
        found = self._one_of([chart for chart in charts if chart])
        return System(found.extensor, (*larger.limits, *smaller.limits, *found.limits))

    def _vectors(self, system: System) -> Iterator[Extensor]:
        """Vectors that span a system wherever its extensor is not zero."""
        seen: set[str] = set()
        for kept in combinations(range(self.height), system.dimension - 1):
            rest = sum(1 << row for row in kept)
            vector: dict[Bits, Polynomial] = {}
            for row in range(self.height):
                entry = system.extensor.get(rest | 1 << row)
                if rest >> row & 1 or entry is None:
                    continue
                before = (rest & ((1 << row) - 1)).bit_count()
                vector[1 << row] = -entry if before & 1 else entry
            if vector:
                vector = dict(self._primitive(vector)[0])
                key = _text(vector)
                if key not in seen:
                    seen.add(key)
                    yield vector

    def _one_of(self, charts: Sequence[Extensor]) -> System:
        """The shortest of proportional charts, and where it, or all of them, vanish."""
        if not charts:
            raise UnclearError
        parted = [self._primitive(chart) for chart in charts]
        there = [one for one in parted if self._is_there(one[0])]
        if not there:
            raise UnclearError
        chosen, content = min(there, key=lambda one: sum(map(len, one[0].values())))
        text = _text(chosen)
        limits: list[Ideal] = [tuple(chosen.values())]
        single = all(len(factor) == 1 for _, own in parted for factor in own)
        if len(parted) == 1:
            limits += content
        elif single and all(_text(one) == text for one, _ in parted):
            limits.append(tuple(self._product(own) for _, own in parted))
        else:
            limits.append(tuple(v for chart in charts for v in chart.values()))
        vanishing = [
            ideal for ideal in limits if not any(p.is_constant() for p in ideal)
        ]
        return System(chosen, tuple(vanishing))

    def _product(self, factors: Sequence[Ideal]) -> Polynomial:
        ring = self.branch.ring
        return ring.normal(
            reduce(lambda a, b: a * b, (f[0] for f in factors), ring.one)
        )

    def _primitive(self, chart: Extensor) -> tuple[Extensor, tuple[Ideal, ...]]:
        """A chart without common factors, up to sign, and those as equations."""
        ring = self.branch.ring
        found = primitive_extensor(ring, chart, self.library)
        rest = dict(found.coordinates)
        if next(iter(rest.values())).coeffs()[0] < 0:
            rest = {rows: -value for rows, value in rest.items()}
        return rest, tuple(factor.equations for factor, _ in found.content)

    def _is_there(self, chart: Extensor) -> bool:
        return all(
            any(residue(value, point, prime) for value in chart.values())
            for point, prime in self.branch.points
        )

    def _dimension(self, parts: Parts) -> int:
        return max(
            motion_at(parts, self.height, point, prime).dimension
            for point, prime in self.branch.points
        )

    def _is_right(self, system: System, parts: Parts) -> bool:
        """Whether, at exact points, the extensor stands for what the parts allow."""
        for point, prime in self.branch.points:
            twists = motion_at(parts, self.height, point, prime).twists
            if len(twists) != system.dimension:
                return False
            at_point = {
                rows: residue(value, point, prime)
                for rows, value in system.extensor.items()
            }
            if not any(at_point.values()):
                return False
            if any(_wedge(at_point, twist, prime) for twist in twists):
                return False
        return True


def _wedge(extensor: Mapping[Bits, int], vector: Sequence[int], prime: int) -> bool:
    """Whether the join of an extensor with a vector is not zero, modulo a prime."""
    sums: dict[Bits, int] = {}
    for rows, value in extensor.items():
        for row, entry in enumerate(vector):
            if rows >> row & 1:
                continue
            term = value * int(entry)
            if (rows >> row).bit_count() & 1:
                term = -term
            larger = rows | 1 << row
            sums[larger] = sums.get(larger, 0) + term
    return any(value % prime for value in sums.values())


def _text(chart: Extensor) -> str:
    return str(sorted((rows, str(value)) for rows, value in chart.items()))
