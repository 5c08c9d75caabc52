"""Block triangles: every entry in its place, and the rank that of the blocks."""

from __future__ import annotations

import random

from hypothesis import given
from hypothesis import strategies as st

from screwkit.algebra.block_triangles import blocks, structural_rank
from screwkit.algebra.modular import rank

PRIME = 2**61 - 1

patterns = st.lists(
    st.sets(st.integers(0, 6), min_size=1, max_size=4), min_size=1, max_size=7
)


def random_rows(pattern: list[set[int]], seed: int) -> list[dict[int, int]]:
    source = random.Random(seed)
    return [{c: source.randrange(1, PRIME) for c in sorted(row)} for row in pattern]


def rank_of(rows: list[dict[int, int]], columns: list[int]) -> int:
    return rank([[row.get(c, 0) for c in columns] for row in rows], PRIME)


@given(patterns, st.integers(0, 5))
def test_blocks_have_full_rank_and_add_up(pattern: list[set[int]], seed: int) -> None:
    rows = random_rows(pattern, seed)
    found = blocks(rows)
    columns = sorted({c for row in rows for c in row})
    assert sorted(r for b in found for r in b.rows) == list(range(len(rows)))
    assert sorted(c for b in found for c in b.columns) == columns
    sizes = []
    for block in found:
        own = [rows[r] for r in block.rows]
        sizes.append(rank_of(own, list(block.columns)))
        assert sizes[-1] == min(len(block.rows), len(block.columns))
    assert sum(sizes) == rank_of(rows, columns) == structural_rank(rows)


@given(patterns, st.integers(0, 5), st.integers(0, 50))
def test_the_rank_falls_exactly_where_a_block_does(
    pattern: list[set[int]], seed: int, choice: int
) -> None:
    """One entry of a block is made special, so that a square block is lost."""
    rows = random_rows(pattern, seed)
    found = blocks(rows)
    columns = sorted({c for row in rows for c in row})
    before = rank_of(rows, columns)
    block = found[choice % len(found)]
    line = block.rows[choice % len(block.rows)]
    own = list(block.columns)
    lost = dict.fromkeys(own, 0)  # the row of the block is zero, what is above stays
    changed = [*rows]
    changed[line] = {k: v for k, v in rows[line].items() if k not in lost}
    after = rank_of([changed[r] for r in block.rows], own)
    full = min(len(block.rows), len(own))
    assert (rank_of(changed, columns) < before) == (after < full)
