"""Sparse matrices of polynomials made small without touching where they lose rank.

An entry that vanishes nowhere is a pivot: with it one row and one column go, and the
rank falls by one everywhere.  A row that has lost all its entries goes too.  What is
left is a block triangle, see `algebra.block_triangles`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.algebra.branches import Branch
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.kinematics.whole_graph import Row

_LONGEST = 400
"""Products of terms that one pivot may take; others are left to the minors."""


@dataclass(frozen=True)
class Pivot:
    """An entry that was taken out with its row and its column.

    Attributes:
        row: Number of its row in the whole matrix.
        column: Number of its column.
        entry: Its value then, zero nowhere.
        multiplied: Numbers of the rows that were multiplied with it.
    """

    row: int
    column: int
    entry: Polynomial
    multiplied: tuple[int, ...]


@dataclass(frozen=True)
class Reduced:
    """What is left of a matrix.

    A minor of the whole matrix that holds all pivots is, up to a number, one of the
    rows that are left times each pivot's entry, divided by it once for every row of
    the minor that was multiplied with it.

    Attributes:
        rows: None is empty.
        numbers: Their numbers in the whole matrix.
        pivots: What was taken out; the rank is their number and that of the rows.
    """

    rows: tuple[Row, ...]
    numbers: tuple[int, ...]
    pivots: tuple[Pivot, ...]


def reduced(branch: Branch, rows: Sequence[Row], columns: int | None = None) -> Reduced:
    """A matrix without rows and columns that nowhere-zero entries clear.

    Args:
        branch: Where the entries are taken, in the generators left on it.
        rows: By column.
        columns: How many of them may be cleared; by default all.
    """
    left = {k: _without_content(row) for k, row in enumerate(rows) if row}
    judged: dict[str, bool] = {}
    pivots: list[Pivot] = []
    while True:
        choice = _cheapest(branch, [*left.values()], judged, columns)
        if choice is None:
            break
        number, column = [*left][choice[0]], choice[1]
        pivot_row = left.pop(number)
        entry = pivot_row[column]
        # A constant entry divides the row, and multiplies nothing.
        touched = () if entry.is_constant() else left
        multiplied = tuple(k for k in touched if column in left[k])
        pivots.append(Pivot(number, column, entry, multiplied))
        cleared = {
            k: _cleared(branch, row, pivot_row, column) for k, row in left.items()
        }
        left = {k: _without_content(row) for k, row in cleared.items() if row}
    return Reduced(tuple(left.values()), tuple(left), tuple(pivots))


def _cheapest(
    branch: Branch, rows: Sequence[Row], judged: dict[str, bool], columns: int | None
) -> tuple[int, int] | None:
    """The pivot that takes the fewest products of terms."""
    touching: dict[int, list[int]] = {}
    for number, row in enumerate(rows):
        for column in row:
            touching.setdefault(column, []).append(number)
    best: tuple[int, int, int] | None = None
    for number, row in enumerate(rows):
        terms = sum(map(len, row.values()))
        for column, entry in row.items():
            if columns is not None and column >= columns:
                continue
            others = [rows[k] for k in touching[column] if k != number]
            cost = sum(len(other[column]) for other in others) * terms
            cost += sum(map(_terms, others)) * (len(entry) - 1)
            if cost > _LONGEST or (best is not None and cost >= best[0]):
                continue
            if _is_nonzero(branch, entry, judged):
                best = cost, number, column
    return None if best is None else best[1:]


def _terms(row: Row) -> int:
    return sum(map(len, row.values()))


def _is_nonzero(branch: Branch, entry: Polynomial, judged: dict[str, bool]) -> bool:
    if entry.is_constant():
        return True
    key = str(entry)
    if key not in judged:
        judged[key] = branch.assumptions.is_nonzero(branch.ring, entry) or any(
            primitive(entry) == primitive(square) for square in branch.divisors
        )
    return judged[key]


def _cleared(branch: Branch, row: Row, pivot_row: Row, column: int) -> Row:
    """The row times the pivot, less what the column of the pivot has of it."""
    if column not in row:
        return row
    ring = branch.ring
    pivot, entry = pivot_row[column], row[column]
    if pivot.is_constant():
        entry, pivot = entry / pivot.coeffs()[0], ring.one
    found: Row = {}
    for place in {**row, **pivot_row}:
        if place == column:
            continue
        value = row.get(place, ring.zero) * pivot
        if place in pivot_row:
            value = value - entry * pivot_row[place]
        value = ring.normal(value)
        if value != 0:
            found[place] = value
    return found


def _without_content(row: Row) -> Row:
    """A row without a number that all its entries share."""
    first = next(iter(row.values()))
    scale = first.coeffs()[0]
    return row if scale == 1 else {k: value / scale for k, value in row.items()}
