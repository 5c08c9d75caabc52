"""Minors of a matrix of screws on a branch: which are not zero there, cheap ones first.

A minor of the loop constraint matrix is the meet of the limbs' extensors: rows that are
left out are filled up with unit twists (Grassmann–Cayley), so that each limb's minors
are expanded alone.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import prod

from screwkit.algebra.branches import Branch
from screwkit.algebra.minors import combined, joined, minors_of
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.steps import added, followed
from screwkit.errors import TooLargeError
from screwkit.kinematics.assembly import loop_rows

TRIED = 16
"""Orders of columns and rows from which minors are chosen."""

COSTLIEST = 10**13
"""Products of terms in the expansion of one minor, at most; most cancel on the way."""

_FILLED = 3 * 10**6


@dataclass(frozen=True)
class Matrix:
    """The matrix of a part.

    Attributes:
        limbs: By limb, the columns of its freedoms; one limb stands for its own twists,
            more for the loop constraint matrix.
        labels: By limb, its freedoms.
        places: Which coordinates of a twist the columns hold.
        single: Whether the matrix is that of one limb.
    """

    limbs: tuple[tuple[tuple[Polynomial, ...], ...], ...]
    labels: tuple[tuple[str, ...], ...]
    places: tuple[int, ...]
    single: bool

    @property
    def columns(self) -> list[tuple[int, int]]:
        """(limb, number in it) of every column."""
        return [(i, k) for i, limb in enumerate(self.limbs) for k in range(len(limb))]

    @property
    def entries(self) -> Iterator[Polynomial]:
        """All of them, one after the other."""
        return (x for limb in self.limbs for column in limb for x in column)

    def row(self, place: int) -> int:
        """The row, counted in all six coordinates of each loop."""
        loop, coordinate = divmod(place, len(self.places))
        return 6 * loop + self.places[coordinate]

    def at(self, point: Point, prime: int) -> list[list[int]]:
        """The columns at a point."""
        values = [
            [[residue(x, point, prime) for x in column] for column in limb]
            for limb in self.limbs
        ]
        return values[0] if self.single else loop_rows(values)

    def rank_at(self, point: Point, prime: int) -> int:
        """The rank at a point."""
        return rank(self.at(point, prime), prime)

    def freedom_at(self, point: Point, prime: int) -> int:
        """Dimension of the platform's twists at a point."""
        own = (
            rank([[residue(x, point, prime) for x in c] for c in limb], prime)
            for limb in self.limbs
        )
        return sum(own) - self.rank_at(point, prime)

    def minors(
        self, branch: Branch, point: Point, prime: int, source: random.Random
    ) -> Iterator[Minor]:
        """Minors that are not zero at a point of a branch, of the rank there."""
        return minors_on(branch, self, point, prime, source)


@dataclass(frozen=True)
class Minor:
    """A minor that is not zero on a branch.

    Attributes:
        columns: Numbers among all columns.
        rows: Numbers among the rows that the matrix holds.
        parts: Their product, by powers, is the minor on the branch, times powers of the
            steps' divisors.
        over: These powers.
    """

    columns: tuple[int, ...]
    rows: tuple[int, ...]
    parts: tuple[tuple[Polynomial, int], ...]
    over: dict[str, int]

    @property
    def terms(self) -> int:
        """Of all parts together."""
        return sum(len(part) for part, _ in self.parts)


def minors_on(
    branch: Branch, matrix: Matrix, point: Point, prime: int, source: random.Random
) -> Iterator[Minor]:
    """Minors that are not zero at a point of a branch, of the rank there.

    Those that take too long to expand are left out.
    """
    on_branch = [[followed(branch, column) for column in limb] for limb in matrix.limbs]
    columns = matrix.columns
    weights = [sum(map(len, on_branch[i][k][0])) for i, k in columns]
    values = matrix.at(point, prime)
    if not values or not values[0]:
        yield Minor((), (), (), {})
        return
    seen: set[tuple[tuple[int, ...], tuple[int, ...]]] = set()
    for attempt in range(TRIED):
        limbs = [limb for limb, _ in columns] if attempt % 2 else []
        chosen, rows = _choice(values, weights, prime, limbs, source, attempt)
        if (chosen, rows) in seen:
            continue
        seen.add((chosen, rows))
        picked = [columns[number] for number in chosen]
        try:
            value = _expanded(branch, matrix, on_branch, picked, rows)
        except TooLargeError:
            continue
        if value != 0:
            over = added(*(on_branch[i][k][1] for i, k in picked))
            yield Minor(chosen, rows, ((value, 1),), over)


def _choice(
    values: Sequence[Sequence[int]],
    weights: Sequence[int],
    prime: int,
    limbs: Sequence[int],
    source: random.Random,
    attempt: int,
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Columns and rows of a minor that is not zero, short columns preferred.

    Where ``limbs`` are given, the columns of one limb after the other.
    """
    order = sorted(
        range(len(values)),
        key=lambda i: weights[i] * (source.uniform(0.3, 1.0) if attempt else 1.0),
    )
    if limbs:
        places_of = [*{*limbs}]
        source.shuffle(places_of)
        order.sort(key=lambda i: places_of.index(limbs[i]))
    elif attempt % 6 == 4:
        source.shuffle(order)
    places = list(range(len(values[0])))
    if attempt:
        source.shuffle(places)
    chosen = sorted(order[i] for i in independent([values[i] for i in order], prime))
    across = [[values[i][place] for i in chosen] for place in places]
    rows = sorted(places[i] for i in independent(across, prime))
    return tuple(chosen), tuple(rows)


def _expanded(
    branch: Branch,
    matrix: Matrix,
    on_branch: Sequence[Sequence[tuple[list[Polynomial], dict[str, int]]]],
    picked: Sequence[tuple[int, int]],
    rows: Sequence[int],
) -> Polynomial:
    ring = branch.ring
    if matrix.single:
        chosen = [[on_branch[i][k][0][row] for row in rows] for i, k in picked]
        return minors_of(ring, chosen, _FILLED).get((1 << len(chosen)) - 1, ring.zero)
    height = len(matrix.places)
    extensors = []
    for limb in range(len(matrix.limbs)):
        own = [on_branch[i][k][0] for i, k in picked if i == limb]
        extensor = {
            bits: value
            for bits, value in minors_of(ring, own, _FILLED).items()
            if bits.bit_count() == len(own)
        }
        if limb:
            for coordinate in range(height):
                if (limb - 1) * height + coordinate not in rows:
                    extensor = joined(ring, extensor, {1 << coordinate: ring.one})
        if not extensor:
            return ring.zero
        extensors.append(extensor)
    if prod(sum(map(len, own.values())) for own in extensors) > COSTLIEST:
        raise TooLargeError("a minor of the loop constraint matrix")
    return combined(ring, extensors, height).get((1 << height) - 1, ring.zero)
