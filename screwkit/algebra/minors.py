"""All minors of a list of columns: the one core routine of the engine.

Determinants, null vectors, reciprocal screws, actuation wrenches and the scan of all
actuation schemes are all read from this table.  Nothing is divided while it is built,
so it is right over any commutative ring.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from typing import Any, TypeAlias

from screwkit.algebra.ring import Ring, S
from screwkit.errors import TooLargeError

Bits: TypeAlias = int  # a set of row or column numbers, one bit each
MinorsOfColumns: TypeAlias = Mapping[Bits, S]  # by row set; zero minors are absent
MinorTable: TypeAlias = dict[Bits, dict[Bits, S]]  # by column set, then row set


def minor_table(
    ring: Ring[S],
    columns: Sequence[Sequence[S]],
    height: int,
    largest: int | None = None,
) -> MinorTable[S]:
    """Expand every minor of ``columns`` once, along its last column.

    Args:
        ring: Gives normal forms and decides zero.
        columns: Each of ``height`` scalars in normal form.
        height: Number of rows.
        largest: Do not build minors of more columns than this.

    Returns:
        ``table[columns][rows]`` for every set of columns; minors that are zero for
        every posture are absent.
    """
    limit = height if largest is None else min(height, largest)
    entries = [
        [(row, x) for row, x in enumerate(column) if not ring.is_zero(x)]
        for column in columns
    ]
    table: MinorTable[S] = {0: {0: ring.one}}
    for chosen in range(1, 1 << len(columns)):
        if chosen.bit_count() > limit:
            continue
        last = chosen.bit_length() - 1
        table[chosen] = _extended(ring, table[chosen ^ 1 << last], entries[last])
    return table


def minors_of_size(ring: Ring[S], columns: Sequence[Sequence[S]], size: int) -> list[S]:
    """All minors of some columns that have a size and are not zero."""
    if size == len(columns):
        return [*minors_of(ring, columns).values()]
    height = len(columns[0]) if columns else 0
    table = minor_table(ring, columns, height, size)
    return [
        minor
        for chosen, minors in table.items()
        if chosen.bit_count() == size
        for minor in minors.values()
    ]


def _extended(
    ring: Ring[S], minors: Mapping[Bits, S], column: Sequence[tuple[int, S]]
) -> dict[Bits, S]:
    sums: dict[Bits, S] = {}
    for rows, minor in minors.items():
        for row, entry in column:
            if rows >> row & 1:
                continue
            term = minor * entry
            if (rows >> row).bit_count() & 1:
                term = -term
            larger = rows | 1 << row
            sums[larger] = sums[larger] + term if larger in sums else term
    normal = {rows: ring.normal(value) for rows, value in sums.items()}
    return {rows: value for rows, value in normal.items() if not ring.is_zero(value)}


def minors_of(
    ring: Ring[S], columns: Sequence[Sequence[S]], largest: int | None = None
) -> dict[Bits, S]:
    """The minors that take all ``columns``, by row set.

    Args:
        ring: Gives normal forms and decides zero.
        columns: Scalars in normal form; polynomials where ``largest`` is given.
        largest: Products of terms that one more column may take.

    Raises:
        TooLargeError: If a column would take more, before it is multiplied out.
    """
    minors: dict[Bits, S] = {0: ring.one}
    for column in columns:
        entries = [(row, x) for row, x in enumerate(column) if not ring.is_zero(x)]
        if largest is not None:
            held(products_of_terms(minors, entries), largest)
        minors = _extended(ring, minors, entries)
    return minors


def products_of_terms(
    minors: Mapping[Bits, Any], column: Sequence[tuple[int, Any]]
) -> int:
    """How many terms are multiplied with each other to expand one more column."""
    return sum(
        len(minor) * len(entry)
        for rows, minor in minors.items()
        for row, entry in column
        if not rows >> row & 1
    )


def held(products: int, largest: int) -> None:
    """Refuse what takes too many products of terms.

    Raises:
        TooLargeError: If there are more than the largest number.
    """
    if products > largest:
        millions = f"{products / 1e6:.2g} million"
        if products >= 1e8:
            millions = f"{products / 1e6:,.0f} million"
        raise TooLargeError(f"{millions} products of terms")


def determinant(ring: Ring[S], columns: Sequence[Sequence[S]]) -> S:
    """Determinant of a square matrix given by its columns."""
    return minors_of(ring, columns).get((1 << len(columns)) - 1, ring.zero)


def complement_sign(rows: Bits, height: int) -> int:
    """Sign of the permutation that lists ``rows`` first, then the others."""
    inversions, others = 0, 0
    for row in range(height):
        if rows >> row & 1:
            inversions += others
        else:
            others += 1
    return -1 if inversions & 1 else 1


def dual(ring: Ring[S], minors: Mapping[Bits, S], height: int) -> dict[Bits, S]:
    """Dual of an extensor: of twists, the extensor of their reciprocal wrenches.

    The row numbers of the result count the six coordinates of a linear form, that is
    (m; f) for twists (ω; v).
    """
    full = (1 << height) - 1
    return {
        full ^ rows: -value if complement_sign(full ^ rows, height) < 0 else value
        for rows, value in minors.items()
    }


def joined(
    ring: Ring[S],
    left: Mapping[Bits, S],
    right: Mapping[Bits, S],
    largest: int | None = None,
) -> dict[Bits, S]:
    """The join (wedge) of two extensors given by their coordinates.

    Args:
        ring: Gives normal forms and decides zero.
        left: By set of rows; polynomials where ``largest`` is given.
        right: As ``left``.
        largest: Products of terms that it may take.

    Raises:
        TooLargeError: If it would take more, before anything is multiplied out.
    """
    if largest is not None:
        held(products_of_join(left, right), largest)
    sums: dict[Bits, S] = {}
    for a, x in left.items():
        for b, y in right.items():
            if a & b:
                continue
            term = x * y
            if _shuffle_is_odd(a, b):
                term = -term
            union = a | b
            sums[union] = sums[union] + term if union in sums else term
    normal = {rows: ring.normal(value) for rows, value in sums.items()}
    return {rows: value for rows, value in normal.items() if not ring.is_zero(value)}


def products_of_join(left: Mapping[Bits, Any], right: Mapping[Bits, Any]) -> int:
    """How many terms are multiplied with each other to join two extensors."""
    return sum(
        len(x) * len(y) for a, x in left.items() for b, y in right.items() if not a & b
    )


def _shuffle_is_odd(left: Bits, right: Bits) -> bool:
    inversions = 0
    while right:
        low = right & -right
        inversions += (left & ~(low | (low - 1))).bit_count()
        right ^= low
    return bool(inversions & 1)


def combined(
    ring: Ring[S],
    extensors: Sequence[Mapping[Bits, S]],
    height: int,
    largest: int | None = None,
) -> dict[Bits, S]:
    """Join of the duals of several twist extensors: the wrenches of all limbs together.

    Where the limbs' passive twists just fill the loop equations, the result has the one
    coordinate of the full set of rows, and that is the determinant of the passive
    columns of the loop constraint matrix, up to sign (Grassmann–Cayley meet).

    Args:
        ring: Gives normal forms and decides zero.
        extensors: Of twists.
        height: Coordinates of a twist.
        largest: Products of terms that one join may take.

    Raises:
        TooLargeError: If a join would take more, before it is multiplied out.
    """
    duals = [dual(ring, minors, height) for minors in extensors]
    duals.sort(key=len)
    return reduce(lambda left, right: joined(ring, left, right, largest), duals)
