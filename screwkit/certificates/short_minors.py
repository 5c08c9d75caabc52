"""Minors of a sparse matrix that are products of small determinants.

Entries that vanish nowhere are taken out first, with their rows and columns.  What is
left is a block triangle, so that a minor is the product of one of each diagonal block;
those are drawn at an exact point and fall into blocks again.

References: [DulmageMendelsohn1958], [Tarjan1972].
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from screwkit.algebra.block_triangles import Block, blocks, structural_rank
from screwkit.algebra.branches import Branch
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.sparse_determinant import determinant
from screwkit.kinematics.whole_graph import Row
from screwkit.loci.sparse_rank import Pivot, reduced

_DRAWN = 40
"""Choices of rows and columns of one block."""

_OFFERED = 12
"""Minors of the whole matrix."""

_LONG = 4_000
"""Terms of the minors of one block beyond which no further one is expanded."""


@dataclass(frozen=True)
class ShortMinor:
    """A minor as a product.

    Attributes:
        rows: Numbers of its rows.
        columns: Numbers of its columns.
        parts: Polynomials with their powers; some may be negative.
    """

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    parts: tuple[tuple[Polynomial, int], ...]

    @property
    def terms(self) -> int:
        """Of all parts together."""
        return sum(len(part) for part, _ in self.parts)


def short_minors(
    branch: Branch,
    rows: Sequence[Row],
    point: Point,
    prime: int,
    source: random.Random,
) -> Iterator[ShortMinor]:
    """Minors of the rank at a point that do not vanish there, short ones first.

    Args:
        branch: Where the entries are taken.
        rows: Entries by column, in the generators left on the branch.
        point: An exact point of the branch.
        prime: Its modulus.
        source: Draws rows and columns.
    """
    small = reduced(branch, rows)
    if not small.rows:
        yield _product(small.pivots, ())
        return
    lines = dict(zip(small.numbers, small.rows, strict=True))
    columns = sorted({column for row in small.rows for column in row})
    values = {
        k: [residue(row[c], point, prime) if c in row else 0 for c in columns]
        for k, row in lines.items()
    }
    height = rank([*values.values()], prime)
    whole = (Block(tuple(range(len(lines))), tuple(columns)),)
    parts = blocks(small.rows) if structural_rank(small.rows) == height else whole
    choices: list[list[ShortMinor]] = []
    for part in parts:
        own = {small.numbers[k]: small.rows[k] for k in part.rows}
        at = {k: {c: values[k][columns.index(c)] for c in part.columns} for k in own}
        found = _of_block(branch, own, at, prime, source)
        if not found and not any(map(any, (row.values() for row in at.values()))):
            continue
        choices.append(found)
    if not all(choices):
        return
    for number in range(min(_OFFERED, max(map(len, choices), default=1))):
        chosen = [own[min(number, len(own) - 1)] for own in choices]
        yield _product(small.pivots, chosen)


def _product(pivots: Sequence[Pivot], factors: Sequence[ShortMinor]) -> ShortMinor:
    rows = (*(p.row for p in pivots), *(row for own in factors for row in own.rows))
    columns = (
        *(p.column for p in pivots),
        *(c for own in factors for c in own.columns),
    )
    powers = [1 - len({*p.multiplied} & {*rows}) for p in pivots]
    parts = [(p.entry, power) for p, power in zip(pivots, powers, strict=True) if power]
    return ShortMinor(
        rows, columns, (*parts, *(part for own in factors for part in own.parts))
    )


def _of_block(
    branch: Branch,
    rows: Mapping[int, Row],
    values: Mapping[int, Mapping[int, int]],
    prime: int,
    source: random.Random,
) -> list[ShortMinor]:
    """Minors of a block, short ones first."""
    columns = sorted({c for row in values.values() for c in row})
    weight = {c: sum(len(row[c]) for row in rows.values() if c in row) for c in columns}
    heavy = {k: sum(map(len, row.values())) for k, row in rows.items()}
    seen: set[tuple[tuple[int, ...], tuple[int, ...]]] = set()
    found: list[ShortMinor] = []
    for number in range(_DRAWN):
        order = sorted(columns, key=lambda c: weight[c])
        heights = sorted(rows, key=lambda k: heavy[k])
        if number:
            order = source.sample(order, len(order))
            heights = source.sample(heights, len(heights))
            if number % 2:
                order.sort(key=lambda c: weight[c] + source.randrange(4))
                heights.sort(key=lambda k: heavy[k] + source.randrange(8))
        across = [[values[k][c] for k in heights] for c in order]
        chosen = [order[i] for i in independent(across, prime)]
        if not chosen:
            return []
        lines = [[values[k][c] for c in chosen] for k in heights]
        kept = tuple(sorted(heights[i] for i in independent(lines, prime)))
        choice = kept, tuple(sorted(chosen))
        if choice in seen:
            continue
        seen.add(choice)
        minor = _expanded(branch, rows, *choice)
        if minor is not None:
            found.append(minor)
            if sum(own.terms for own in found) > _LONG:
                break
    return sorted(found, key=lambda own: own.terms)


def _expanded(
    branch: Branch,
    rows: Mapping[int, Row],
    kept: Sequence[int],
    columns: Sequence[int],
) -> ShortMinor | None:
    """A minor as a product; None where it is too long."""
    pattern = [{c: rows[k][c] for c in columns if c in rows[k]} for k in kept]
    parts = determinant(branch.ring, pattern)
    return (
        None if parts is None else ShortMinor(tuple(kept), tuple(columns), tuple(parts))
    )
