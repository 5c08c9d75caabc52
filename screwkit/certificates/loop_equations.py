"""The loop equations of a joint graph in symbols, for the search of proofs.

The same matrices as in `graph_matrix`, there rebuilt at postures.
"""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.minor_choice import Minor
from screwkit.certificates.short_minors import short_minors
from screwkit.certificates.steps import added, followed
from screwkit.kinematics.whole_graph import Row, WholeGraph


@dataclass(frozen=True)
class LoopEquations:
    """The matrix of a part by loop equations.

    Attributes:
        freedoms: Those that are columns.
        closed: The rows of C by their number in six coordinates of each loop.
        held: Those of [C; P].
        asks_held: Whether [C; P] is the matrix of the part.
    """

    freedoms: tuple[str, ...]
    closed: Mapping[int, Row]
    held: Mapping[int, Row]
    asks_held: bool

    @classmethod
    def of(
        cls, graph: WholeGraph, locked: Collection[str] = (), *, asks_held: bool = False
    ) -> LoopEquations:
        """Those of a joint graph.

        Args:
            graph: The mechanism, or a limb as a mechanism of its own.
            locked: Freedoms without a column.
            asks_held: Whether [C; P] is asked for.
        """
        freedoms, closed = graph.numbered_equations(locked)
        _, held = graph.numbered_equations(locked, held=True)
        return cls(freedoms, closed, held, asks_held)

    def without(self, freedom: str) -> LoopEquations:
        """The same with one column less."""
        gone = self.freedoms.index(freedom)
        left = (*self.freedoms[:gone], *self.freedoms[gone + 1 :])
        closed, held = (_without(rows, gone) for rows in (self.closed, self.held))
        return replace(self, freedoms=left, closed=closed, held=held)

    @property
    def labels(self) -> tuple[tuple[str, ...], ...]:
        """The freedoms, in one group."""
        return (self.freedoms,)

    @property
    def single(self) -> bool:
        """Whether the platform's freedom is not asked for."""
        return False

    @property
    def rows(self) -> Mapping[int, Row]:
        """Of the matrix of the part."""
        return self.held if self.asks_held else self.closed

    @property
    def entries(self) -> Iterator[Polynomial]:
        """All of them, one after the other."""
        return (x for row in self.rows.values() for x in row.values())

    def row(self, place: int) -> int:
        """The number of a row, which is its own."""
        return place

    def rank_at(self, point: Point, prime: int) -> int:
        """The rank at a point."""
        return self._rank(self.rows, point, prime)

    def freedom_at(self, point: Point, prime: int) -> int:
        """Dimension of the platform's twists at a point."""
        held = self._rank(self.held, point, prime)
        return held - self._rank(self.closed, point, prime)

    def _rank(self, rows: Mapping[int, Row], point: Point, prime: int) -> int:
        dense = [[0] * len(self.freedoms) for _ in rows]
        for line, row in zip(dense, rows.values(), strict=True):
            for column, entry in row.items():
                line[column] = residue(entry, point, prime)
        return rank(dense, prime)

    def minors(
        self, branch: Branch, point: Point, prime: int, source: random.Random
    ) -> Iterator[Minor]:
        """Minors that are not zero at a point of a branch, of the rank there."""
        numbers = list(self.rows)
        on_branch: list[Row] = [{} for _ in numbers]
        powers: dict[int, dict[str, int]] = {}
        for column in range(len(self.freedoms)):
            places = [k for k, n in enumerate(numbers) if column in self.rows[n]]
            entries = [self.rows[numbers[k]][column] for k in places]
            values, powers[column] = followed(branch, entries) if entries else ([], {})
            for k, value in zip(places, values, strict=True):
                if value != 0:
                    on_branch[k][column] = value
        for found in short_minors(branch, on_branch, point, prime, source):
            rows = sorted(numbers[k] for k in found.rows)
            columns = sorted(found.columns)
            over = added(*(powers[c] for c in columns))
            yield Minor(tuple(columns), tuple(rows), found.parts, over)


def _without(rows: Mapping[int, Row], gone: int) -> dict[int, Row]:
    """Rows without a column; those that have no other entry are left out."""
    left = {
        number: {k - (k > gone): x for k, x in row.items() if k != gone}
        for number, row in rows.items()
    }
    return {number: row for number, row in left.items() if row}
