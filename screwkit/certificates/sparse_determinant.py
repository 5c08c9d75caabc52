"""The determinant of a sparse matrix of polynomials as a product.

Blocks one by one, without the common factors of rows and columns, short ones expanded.
Of a long one a short entry clears its column without fractions: the rows are multiplied
with the entry, which is divided out of the product once for each.

References: [Tarjan1972].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from typing import TypeAlias

from screwkit.algebra.block_triangles import blocks
from screwkit.algebra.division import Divisor
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.minors import minors_of
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.errors import TooLargeError
from screwkit.kinematics.whole_graph import Row

Product: TypeAlias = list[tuple[Polynomial, int]]
"""Polynomials with their powers, which may be negative."""

_SHORT = 5_000
"""Products of terms by one more column up to which a block is expanded at once."""

_LONGEST = 300_000
"""Products of terms that a step may take."""


_WORTH = 60
"""Terms of a row from which on it is tried whether earlier pivots divide it."""


def determinant(ring: TrigonometricRing, rows: Sequence[Row]) -> Product | None:
    """The determinant up to a number; empty for a constant.

    Args:
        ring: Of the entries.
        rows: As many as columns, entries by column; none is empty.

    Returns:
        None where it takes too long, or is zero.
    """
    found: Product = []
    pivots: list[Divisor] = []
    waiting = [list(rows)]
    while waiting:
        whole = waiting.pop()
        for block in blocks(whole):
            if not block.is_square:
                return None
            own = [_part(whole[k], block.columns) for k in block.rows]
            own = _without_contents(own, found)
            own = [_divided(row, pivots, found) for row in own]
            value = _expanded(ring, own, _SHORT)
            if value is None:
                smaller = _eliminated(ring, own, found)
                if smaller is None or not all(smaller):
                    return None
                pivot = found[-1][0]
                if len(pivot) > 1:
                    pivots.append(_divisor(ring, pivot))
                waiting.append(smaller)
            elif value == 0:
                return None
            else:
                found.append((value, 1))
    return [(part, power) for part, power in found if power and not part.is_constant()]


def _part(row: Row, columns: Sequence[int]) -> Row:
    return {c: row[c] for c in columns if c in row}


def _expanded(
    ring: TrigonometricRing, rows: Sequence[Row], largest: int
) -> Polynomial | None:
    """The determinant at once; None where that takes too many products of terms."""
    ordered = _by_overlap(rows)
    entries = [[row.get(c, ring.zero) for row in rows] for c in ordered]
    try:
        minors = minors_of(ring, entries, largest)
    except TooLargeError:
        return None
    value: Polynomial = minors.get((1 << len(ordered)) - 1, ring.zero)
    return value


def _by_overlap(rows: Sequence[Row]) -> list[int]:
    """Columns in an order in which few rows are begun at a time."""
    left: dict[int, set[int]] = {}
    for number, row in enumerate(rows):
        for column in row:
            left.setdefault(column, set()).add(number)
    begun: set[int] = set()
    ordered: list[int] = []
    while left:
        best = min(left, key=lambda c: (len(left[c] - begun), len(left[c]), c))
        begun |= left.pop(best)
        ordered.append(best)
    return ordered


def _without_contents(rows: Sequence[Row], found: Product) -> list[Row]:
    """The rows without common factors of rows and of columns, which go to the rest."""
    left = []
    for row in rows:
        content = _content([*row.values()])
        found.append((content, 1))
        left.append({c: value / content for c, value in row.items()})
    for column in {c for row in left for c in row}:
        content = _content([row[column] for row in left if column in row])
        if content.is_constant():
            continue
        found.append((content, 1))
        for row in left:
            if column in row:
                row[column] = row[column] / content
    return left


def _divisor(ring: TrigonometricRing, polynomial: Polynomial) -> Divisor:
    layout = Layout.of(ring)
    return Divisor(polynomial, ring, HalfAngles(ring, layout), layout)


def _divided(row: Row, pivots: Sequence[Divisor], found: Product) -> Row:
    """The row divided by earlier pivots, as often as they divide it [Bareiss1968].

    Where sines and cosines make them no common factors of polynomials.
    """
    shortest = sorted(row, key=lambda c: len(row[c]))
    for pivot in pivots:
        while sum(map(len, row.values())) > _WORTH:
            divided: Row = {}
            for column in shortest:
                quotient = pivot.divide(row[column])
                if quotient is None:
                    break
                divided[column] = quotient
            if len(divided) < len(row):
                break
            found.append((pivot.polynomial, 1))
            row = divided
    return row


def _content(entries: Sequence[Polynomial]) -> Polynomial:
    shortest = sorted(entries, key=len)
    return reduce(lambda a, b: a if a.is_constant() else a.gcd(b), shortest)


def _eliminated(
    ring: TrigonometricRing, rows: Sequence[Row], found: Product
) -> list[Row] | None:
    """One row and column less; None where every entry is too long for that."""
    touching: dict[int, list[int]] = {}
    for number, row in enumerate(rows):
        for column in row:
            touching.setdefault(column, []).append(number)
    terms = [sum(map(len, row.values())) for row in rows]
    best: tuple[int, int, int] | None = None
    for number, row in enumerate(rows):
        for column, entry in row.items():
            others = [k for k in touching[column] if k != number]
            cost = sum(
                len(rows[k][column]) * terms[number] + terms[k] * len(entry)
                for k in others
            )
            if best is None or cost < best[0]:
                best = cost, number, column
    if best is None or best[0] > _LONGEST:
        return None
    _, number, column = best
    pivot_row, entry = rows[number], rows[number][column]
    left = [row for k, row in enumerate(rows) if k != number]
    found.append((entry, 1 - sum(column in row for row in left)))
    return [_cleared(ring, row, pivot_row, column) for row in left]


def _cleared(
    ring: TrigonometricRing,
    row: Row,
    pivot_row: Mapping[int, Polynomial],
    column: int,
) -> Row:
    """The row times the pivot, less what the column of the pivot has of it."""
    if column not in row:
        return row
    pivot, entry = pivot_row[column], row[column]
    cleared: Row = {}
    for place in {**row, **pivot_row}:
        if place == column:
            continue
        value = row.get(place, ring.zero) * pivot
        if place in pivot_row:
            value = value - entry * pivot_row[place]
        value = ring.normal(value)
        if value != 0:
            cleared[place] = value
    return cleared
