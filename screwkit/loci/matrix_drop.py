"""Where a sparse matrix of polynomials has less than its generic rank.

The matrix is made small (`sparse_rank`) and taken as a block triangle.  A square block
is lost where its determinant vanishes.  Of other blocks a few minors are drawn at exact
points: their common factors give what one equation says, the rest is searched by case
distinction, and a candidate on which the rank stays shows a minor that is missing.

References: [CoxLittleOShea] §9.1 (determinantal varieties), [DulmageMendelsohn1958].
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from screwkit.algebra.block_triangles import Block, blocks, structural_rank
from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import Factor, factor
from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.errors import TooLargeError
from screwkit.kinematics.whole_graph import Row
from screwkit.loci.pieces import Piece, lies_in
from screwkit.loci.sparse_rank import reduced

RankAt: TypeAlias = Callable[[Point, int], int]
"""Rank of the whole matrix at an exact point modulo a prime."""

Choice: TypeAlias = tuple[tuple[int, ...], tuple[int, ...]]
"""Rows and columns of a minor."""

_PRODUCTS = 2_000_000
"""Products of terms in the expansion of a determinant by one more column."""

_DRAWN, _TOGETHER = 40, 6
"""Choices of rows and columns that are tried, and minors that are asked together."""

_LONG = 4_000
"""Terms of minors beyond which no further one is asked with them."""


@dataclass
class MatrixZeros:
    """Where a matrix loses rank, as far as it was found.

    Attributes:
        branches: On each the rank is lower, at exact points.
        open: Branches that were not decided, each with the least codimension of zeros
            on it; every further zero lies on one of them.
        too_large: Sizes of blocks whose determinants are too long to expand.
    """

    branches: list[Branch] = field(default_factory=list)
    open: list[tuple[Branch, int]] = field(default_factory=list)
    too_large: list[tuple[int, int]] = field(default_factory=list)

    def leave(self, branches: Sequence[Branch], codimension: int) -> None:
        """Take note of branches that were not decided."""
        self.open += [(branch, codimension) for branch in branches]


def matrix_zeros(
    branch: Branch, rows: Sequence[Row], rank_at: RankAt, search: Search
) -> MatrixZeros:
    """Where on a branch a matrix has less than its rank there.

    Args:
        branch: Irreducible.
        rows: In the generators of the whole ring.
        rank_at: The same matrix at points.
        search: Budget, known factors, and what to leave out.
    """
    found = MatrixZeros()
    if not branch.points:
        found.leave([branch], 0)
        return found
    generic = max(rank_at(*point) for point in branch.points)
    waiting = [branch]
    while waiting:
        here = waiting.pop()
        for zeros in _of_blocks(here, rows, found, search):
            for part in zeros:
                if not part.points:
                    found.leave([part], 0)
                elif max(rank_at(*point) for point in part.points) < generic:
                    found.branches.append(part)
                else:
                    waiting.append(part)
        if search.budget <= 0 and waiting:
            found.leave(waiting, 0)
            break
    return found


def _of_blocks(
    branch: Branch, rows: Sequence[Row], found: MatrixZeros, search: Search
) -> Iterator[Sequence[Branch]]:
    """Candidates, block by block."""
    if not branch.points:
        found.leave([branch], 0)
        return
    small = reduced(branch, [_on(branch, row) for row in rows]).rows
    if not small:
        return
    point, prime = max(branch.points, key=lambda at: _rank(small, *at))
    size = _rank(small, point, prime)
    if structural_rank(small) == size:
        parts = blocks(small)
    else:
        columns = {column for row in small for column in row}
        parts = (Block(tuple(range(len(small))), tuple(sorted(columns))),)
    for part in parts:
        own = [_kept(small[k], part.columns) for k in part.rows]
        if part.is_square and _rank(own, point, prime) == len(own):
            minors = _minors(branch, own, [(tuple(range(len(own))), part.columns)])
        else:
            choices = _choices(own, part.columns, point, prime)
            minors = _minors(branch, own, choices)
        if not minors:
            found.too_large.append((len(part.rows), len(part.columns)))
            found.leave([branch], 1)
            continue
        yield from _zeros(branch, minors, found, search)


def _on(branch: Branch, row: Row) -> Row:
    values = branch.column([*row.values()])
    return {k: v for k, v in zip(row, values, strict=True) if v != 0}


def _kept(row: Row, columns: Sequence[int]) -> Row:
    return {column: row[column] for column in columns if column in row}


def _rank(rows: Sequence[Row], point: Point, prime: int) -> int:
    columns = sorted({column for row in rows for column in row})
    return rank(_residues(rows, columns, point, prime), prime)


def _residues(
    rows: Sequence[Row], columns: Sequence[int], point: Point, prime: int
) -> list[list[int]]:
    return [
        [residue(row[c], point, prime) if c in row else 0 for c in columns]
        for row in rows
    ]


def _choices(
    rows: Sequence[Row], columns: Sequence[int], point: Point, prime: int
) -> list[Choice]:
    """Rows and columns of minors that do not vanish at a point, cheap ones first."""
    source = random.Random(len(rows))
    values = dict(
        zip(
            columns,
            zip(*_residues(rows, columns, point, prime), strict=True),
            strict=True,
        )
    )
    weight = {c: sum(len(row[c]) for row in rows if c in row) for c in columns}
    found: dict[Choice, int] = {}
    for number in range(_DRAWN):
        order = sorted(columns, key=lambda c: weight[c])
        heights = sorted(range(len(rows)), key=lambda r: _weight(rows[r]))
        if number:
            order = source.sample(order, len(order))
            heights = source.sample(heights, len(heights))
            if number % 2:
                order.sort(key=lambda c: weight[c] + source.randrange(4))
        across = [[values[c][h] for h in heights] for c in order]
        chosen = [order[k] for k in independent(across, prime)]
        lines = [[values[c][h] for c in chosen] for h in heights]
        kept = tuple(sorted(heights[k] for k in independent(lines, prime)))
        own = sorted(chosen)
        cost = sum(weight[c] for c in own)
        found.setdefault((kept, tuple(own)), cost)
    return sorted(found, key=lambda choice: found[choice])


def _weight(row: Mapping[int, Polynomial]) -> int:
    return sum(map(len, row.values()))


def minors_at(
    branch: Branch, rows: Sequence[Row], point: Point, prime: int, most: int
) -> list[Polynomial]:
    """Minors of the size of the rank at a point, that do not vanish there.

    Args:
        branch: In whose ring the rows are.
        rows: Of the matrix.
        point: Exact.
        prime: Its modulus.
        most: How many are asked for; short ones first.
    """
    columns = sorted({column for row in rows for column in row})
    choices = _choices(rows, columns, point, prime)
    return _minors(branch, rows, choices, most)


def _minors(
    branch: Branch,
    rows: Sequence[Row],
    choices: Sequence[Choice],
    most: int = _TOGETHER,
) -> list[Polynomial]:
    """The determinants of some choices, as many as are not too long together."""
    ring = branch.ring
    found: list[Polynomial] = []
    for lines, columns in choices:
        ordered = _by_overlap(rows, lines, columns)
        entries = [[rows[k].get(c, ring.zero) for k in lines] for c in ordered]
        try:
            minors = minors_of(ring, entries, _PRODUCTS)
        except TooLargeError:
            continue
        found += [m for m in minors.values() if m not in found]
        if len(found) >= most or sum(map(len, found)) > _LONG:
            break
    return found


def _by_overlap(
    rows: Sequence[Row], lines: Sequence[int], columns: Sequence[int]
) -> list[int]:
    """Columns in an order in which few rows are begun at a time."""
    left = {c: {k for k in lines if c in rows[k]} for c in columns}
    begun: set[int] = set()
    ordered: list[int] = []
    while left:
        best = min(left, key=lambda c: (len(left[c] - begun), len(left[c]), c))
        begun |= left.pop(best)
        ordered.append(best)
    return ordered


def _zeros(
    branch: Branch, minors: Sequence[Polynomial], found: MatrixZeros, search: Search
) -> Iterator[Sequence[Branch]]:
    """Common zeros of minors: those of each common factor, then what lies deeper."""
    shared = _common_factors(branch, minors, search)
    pieces: list[Piece] = []
    for one in shared:
        own = replace(search, found=[], unfinished=[], special=[])
        zeros = common_zeros(branch, one.equations, own)
        search.budget = own.budget
        found.leave(zeros.open, 1)
        pieces += [Piece(b.conditions, (b,)) for b in zeros.branches]
        yield zeros.branches
    if len(minors) == 1:
        return
    own = replace(
        search,
        found=[],
        unfinished=[],
        special=[],
        skip=lambda b: search.skip(b) or any(lies_in(b, piece) for piece in pieces),
    )
    zeros = common_zeros(branch, minors, own)
    search.budget = own.budget - 1
    found.leave(zeros.open, 2)
    yield zeros.branches


def _common_factors(
    branch: Branch, minors: Sequence[Polynomial], search: Search
) -> list[Factor]:
    """Factors of all minors that can vanish."""
    common: dict[str, Factor] | None = None
    for minor in minors:
        own = {f.key: f for f, _ in factor(branch.ring, minor, search.library).factors}
        common = (
            own if common is None else {k: f for k, f in own.items() if k in common}
        )
    return [
        f
        for f in (common or {}).values()
        if len(f.equations) > 1
        or not branch.assumptions.is_nonzero(branch.ring, f.polynomial)
    ]
