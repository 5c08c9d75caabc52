"""Sparse elimination modulo a prime: rank and null space of loop equations.

A large mechanism has thousands of equations with a dozen entries each.  Rows are
dictionaries; each is reduced by the pivots that came before and contributes its own
first column.  Where rows come in the order in which a sweep over the joint graph meets
them, a row touches only its neighbours and the work grows linearly.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush

SparseRow = Mapping[int, int]
"""Residues by column; zeros absent."""


@dataclass(frozen=True)
class Eliminated:
    """Row echelon form of a sparse matrix.

    Attributes:
        prime: The modulus.
        width: Number of columns.
        pivots: For each pivot column, in the order of elimination, its row without the
            pivot entry, scaled to pivot 1; later pivots may still occur in it.
    """

    prime: int
    width: int
    pivots: Mapping[int, SparseRow] = field(default_factory=dict)

    @property
    def rank(self) -> int:
        """Rank of the matrix."""
        return len(self.pivots)

    @property
    def free(self) -> tuple[int, ...]:
        """Columns without a pivot."""
        return tuple(c for c in range(self.width) if c not in self.pivots)

    def null_vectors(self) -> list[dict[int, int]]:
        """Basis of the null space, one vector for each free column."""
        prime = self.prime
        uses: dict[int, list[int]] = {}
        order = {pivot: number for number, pivot in enumerate(self.pivots)}
        for pivot, row in self.pivots.items():
            for column in row:
                uses.setdefault(column, []).append(pivot)
        basis = []
        for free in self.free:
            reached = _reached_from(free, uses)
            vector = {free: 1}
            for pivot in sorted(reached, key=order.__getitem__, reverse=True):
                row = self.pivots[pivot]
                value = -sum(vector[c] * x for c, x in row.items() if c in vector)
                if value % prime:
                    vector[pivot] = value % prime
            basis.append(vector)
        return basis


def _reached_from(free: int, uses: Mapping[int, Sequence[int]]) -> set[int]:
    """The pivots whose value can depend on a free column."""
    reached: set[int] = set()
    waiting = [free]
    while waiting:
        for pivot in uses.get(waiting.pop(), ()):
            if pivot not in reached:
                reached.add(pivot)
                waiting.append(pivot)
    return reached


def eliminated(rows: Iterable[SparseRow], width: int, prime: int) -> Eliminated:
    """Row echelon form; the pivot of a row is its first column left.

    Args:
        rows: The matrix, best in the order of a sweep.
        width: Number of columns.
        prime: The modulus.
    """
    pivots: dict[int, dict[int, int]] = {}
    order: dict[int, int] = {}
    for source in rows:
        row = dict(source)
        # A pivot row holds no earlier pivot, so each is eliminated once if they are
        # taken in the order in which they were found.
        pending = [(order[column], column) for column in row if column in pivots]
        heapify(pending)
        while pending:
            _, column = heappop(pending)
            factor = row.pop(column, 0)
            if not factor:
                continue
            for other, value in pivots[column].items():
                if other not in row and other in order:
                    heappush(pending, (order[other], other))
                left = (row.get(other, 0) - factor * value) % prime
                if left:
                    row[other] = left
                else:
                    row.pop(other, None)
        if row:
            pivot = min(row)
            inverse = pow(row.pop(pivot), -1, prime)
            order[pivot] = len(order)
            pivots[pivot] = {c: x * inverse % prime for c, x in row.items()}
    return Eliminated(prime, width, pivots)
