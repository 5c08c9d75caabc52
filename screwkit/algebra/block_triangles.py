"""Sparse matrices as block triangles: what a rank depends on, block by block.

Rows and columns are matched; what can be reached from unmatched columns is a wide block
with independent rows, what can be reached from unmatched rows a tall one with
independent columns, and the rest falls into square blocks, one for every strongly
connected part.  If each block has full rank in general, the matrix loses rank exactly
where one of its blocks does: what lies above the diagonal can give back no more than
was lost on it.

References: [DulmageMendelsohn1958], [Tarjan1972].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

Pattern: TypeAlias = Sequence[Mapping[int, Any]]
"""For every row the columns of its entries that are not zero."""


@dataclass(frozen=True)
class Block:
    """Rows and columns of a diagonal block.

    Attributes:
        rows: Numbers of its rows.
        columns: Numbers of its columns.
    """

    rows: tuple[int, ...]
    columns: tuple[int, ...]

    @property
    def is_square(self) -> bool:
        """Whether it is lost where its determinant vanishes."""
        return len(self.rows) == len(self.columns)


def structural_rank(rows: Pattern) -> int:
    """The largest rank that any entries in these places can have."""
    return len(_matching(rows))


def blocks(rows: Pattern) -> tuple[Block, ...]:
    """The diagonal blocks, connected wide ones first, then square, then tall ones.

    Args:
        rows: At least one entry in each.
    """
    column_of = _matching(rows)
    row_of = {column: row for row, column in column_of.items()}
    touching: dict[int, list[int]] = {}
    for number, line in enumerate(rows):
        for column in line:
            touching.setdefault(column, []).append(number)
    wide_columns = {c for c in touching if c not in row_of}
    wide_rows: set[int] = set()
    waiting = list(wide_columns)
    while waiting:
        for row in touching[waiting.pop()]:
            if row not in wide_rows:
                wide_rows.add(row)
                waiting.append(column_of[row])
                wide_columns.add(column_of[row])
    tall_rows = {r for r in range(len(rows)) if r not in column_of}
    tall_columns: set[int] = set()
    unmatched = list(tall_rows)
    while unmatched:
        for column in rows[unmatched.pop()]:
            if column not in tall_columns:
                tall_columns.add(column)
                unmatched.append(row_of[column])
                tall_rows.add(row_of[column])
    square = [r for r in column_of if r not in wide_rows and r not in tall_rows]
    return (
        *_connected(rows, wide_rows, wide_columns),
        *_strongly_connected(rows, square, column_of),
        *_connected(rows, tall_rows, tall_columns),
    )


def _matching(rows: Pattern) -> dict[int, int]:
    """A largest matching: a column for every row that has one."""
    row_of: dict[int, int] = {}
    found: dict[int, int] = {}
    for start in sorted(range(len(rows)), key=lambda r: len(rows[r])):
        before: dict[int, int] = {}  # column: the row from which it was reached
        waiting = [start]
        free: int | None = None
        while waiting and free is None:
            row = waiting.pop()
            for column in rows[row]:
                if column in before:
                    continue
                before[column] = row
                if column not in row_of:
                    free = column
                    break
                waiting.append(row_of[column])
        while free is not None:
            row = before[free]
            previous = found.get(row)
            found[row], row_of[free] = free, row
            free = previous
    return found


def _connected(rows: Pattern, own: set[int], columns: set[int]) -> list[Block]:
    """A part without connection to the rest of its kind is a block of its own."""
    touching: dict[int, list[int]] = {column: [] for column in columns}
    for row in sorted(own):
        for column in rows[row]:
            if column in touching:
                touching[column].append(row)
    left = {*own}
    found = []
    while left:
        start = min(left)
        reached, seen = {start}, set()
        waiting = [start]
        while waiting:
            for column in rows[waiting.pop()]:
                if column in seen or column not in touching:
                    continue
                seen.add(column)
                fresh = [r for r in touching[column] if r not in reached]
                reached.update(fresh)
                waiting += fresh
        left -= reached
        found.append(Block(tuple(sorted(reached)), tuple(sorted(seen))))
    return found


def _strongly_connected(
    rows: Pattern, square: Sequence[int], column_of: Mapping[int, int]
) -> list[Block]:
    """Square blocks: rows that reach each other over matched columns."""
    row_at = {column_of[row]: row for row in square}
    after = {r: [row_at[c] for c in rows[r] if c in row_at] for r in square}
    index: dict[int, int] = {}
    low: dict[int, int] = {}
    stack: list[int] = []
    on_stack: set[int] = set()
    found: list[Block] = []
    for root in square:
        if root in index:
            continue
        walk = [(root, iter(after[root]))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on_stack.add(root)
        while walk:
            here, ahead = walk[-1]
            following = next(ahead, None)
            if following is None:
                walk.pop()
                if walk:
                    low[walk[-1][0]] = min(low[walk[-1][0]], low[here])
                if low[here] == index[here]:
                    part = stack[stack.index(here) :]
                    del stack[-len(part) :]
                    on_stack.difference_update(part)
                    members = tuple(sorted(part))
                    found.append(
                        Block(members, tuple(sorted(column_of[r] for r in members)))
                    )
            elif following not in index:
                index[following] = low[following] = len(index)
                stack.append(following)
                on_stack.add(following)
                walk.append((following, iter(after[following])))
            elif following in on_stack:
                low[here] = min(low[here], index[following])
    return found
