"""Sparse elimination against FLINT's dense matrices."""

from __future__ import annotations

import random

import pytest
from flint import nmod_mat
from hypothesis import given, settings
from hypothesis import strategies as st

from screwkit.algebra.elimination_modulo import SparseRow, eliminated

LARGE = 2**61 - 1
PRIMES = (2, 3, 7, 65537, LARGE)
laws = settings(max_examples=150, derandomize=True)


def combined(
    one: dict[int, int], other: dict[int, int], factor: int, prime: int
) -> dict[int, int]:
    """One row and a multiple of another."""
    total = {c: one.get(c, 0) + factor * other.get(c, 0) for c in one | other}
    return {c: x % prime for c, x in total.items() if x % prime}


@st.composite
def matrices(draw: st.DrawFn) -> tuple[list[dict[int, int]], int, int]:
    """Sparse rows, some of them combinations of others; the width; the prime."""
    prime = draw(st.sampled_from(PRIMES))
    width = draw(st.integers(0, 14))
    entries = st.integers(1, min(prime - 1, 9) or 1)
    columns = st.integers(0, max(width - 1, 0))
    row = st.dictionaries(columns, entries, max_size=min(width, 5))
    rows = draw(st.lists(row, max_size=16)) if width else []
    for one, other in draw(st.lists(st.tuples(*[st.integers(0, 15)] * 2), max_size=5)):
        if max(one, other) < len(rows):
            factor = draw(entries)
            rows.append(combined(rows[one], rows[other], factor, prime))
    return rows, width, prime


def dense(rows: list[dict[int, int]], width: int, prime: int) -> nmod_mat:
    entries = [row.get(column, 0) for row in rows for column in range(width)]
    return nmod_mat(len(rows), width, entries, prime)


def check(rows: list[dict[int, int]], width: int, prime: int) -> None:
    found = eliminated(rows, width, prime)
    rank = int(dense(rows, width, prime).rank()) if rows and width else 0
    assert found.rank == rank
    vectors = found.null_vectors()
    assert len(vectors) == len(found.free) == width - rank
    for vector in vectors:
        assert all(0 < x < prime for x in vector.values())
        for row in rows:
            assert sum(x * row.get(c, 0) for c, x in vector.items()) % prime == 0
    if vectors:
        assert int(dense(vectors, width, prime).rank()) == len(vectors)


@laws
@given(matrices())
def test_rank_and_null_space_are_those_of_flint(
    given: tuple[list[dict[int, int]], int, int],
) -> None:
    check(*given)


@laws
@given(matrices())
def test_pivots_and_rows_span_the_same(
    given: tuple[list[dict[int, int]], int, int],
) -> None:
    """Each pivot row is a combination of the given ones, and together they are all."""
    rows, width, prime = given
    found = eliminated(rows, width, prime)
    echelon = [{pivot: 1, **row} for pivot, row in found.pivots.items()]
    if echelon:
        together = dense([*rows, *echelon], width, prime)
        assert int(together.rank()) == found.rank
        assert int(dense(echelon, width, prime).rank()) == found.rank


@laws
@given(matrices(), st.randoms(use_true_random=False))
def test_order_of_rows_is_a_matter_of_speed(
    given: tuple[list[dict[int, int]], int, int], source: random.Random
) -> None:
    rows, width, prime = given
    mixed = list(rows)
    source.shuffle(mixed)
    assert eliminated(mixed, width, prime).rank == eliminated(rows, width, prime).rank


@pytest.mark.parametrize("seed", range(4))
def test_a_band_of_a_few_hundred_columns(seed: int) -> None:
    """In the order of a sweep, with rows twice, mod a prime of 61 bits."""
    source = random.Random(seed)
    width = 250
    starts = sorted(source.randrange(width - 8) for _ in range(240))
    rows = [
        {c: source.randrange(1, LARGE) for c in source.sample(range(at, at + 8), 4)}
        for at in starts
    ]
    rows += [dict(source.choice(rows)) for _ in range(20)]
    check(sorted(rows, key=min), width, LARGE)


class CountingPrime(int):
    """A modulus that counts how often something is reduced by it."""

    reductions = 0

    def __rmod__(self, value: int) -> int:
        CountingPrime.reductions += 1
        return value % int(self)


def test_each_pivot_is_eliminated_once() -> None:
    """A row that meets a chain of pivots, each holding the two that follow it.

    Eliminated in their order, no pivot comes back: 2 reductions each.  In another one
    the work is the number of ways along the chain, which doubles with every other link.
    """
    size = 22
    rows = [{i: 1, i + 1: 1, i + 2: 1} for i in range(size)]
    CountingPrime.reductions = 0
    eliminated([*rows, {0: 1, size + 2: 1}], size + 3, CountingPrime(LARGE))
    assert CountingPrime.reductions < 10 * size


def test_given_rows_are_left_alone() -> None:
    rows: list[SparseRow] = [{0: 1, 1: 2}, {0: 3, 2: 1}]
    eliminated(rows, 3, 7)
    assert rows == [{0: 1, 1: 2}, {0: 3, 2: 1}]


def test_nothing_is_a_matrix_too() -> None:
    assert eliminated([], 0, LARGE).null_vectors() == []
    assert eliminated([{}], 2, LARGE).null_vectors() == [{0: 1}, {1: 1}]
