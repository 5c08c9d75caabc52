"""Mobility partition and statics, against ranks over the rationals.

The dimension of a block is what its motions add to those of the blocks before it; the
spaces are intersected here with FLINT's rational matrices, another route altogether.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from flint import fmpq_mat
from grasping.random_grasps import PRIME, Drawn, grasp, grasps
from hypothesis import given, settings

import screwkit as sk
from screwkit.case import load_text
from screwkit.grasping import symbolic_blocks
from screwkit.grasping.partition import BLOCKS, MOVING, blocks_of
from screwkit.grasping.statics import contact_forces
from screwkit.metrics.float_ranks import float_ranks
from screwkit.metrics.indices import FloatGrasp

often = settings(max_examples=150, derandomize=True)


def null_space(columns: list[list[int]]) -> list[list[object]]:
    """Rational vectors that combine columns to zero."""
    if not columns:
        return []
    matrix = fmpq_mat([list(row) for row in zip(*columns, strict=True)])
    reduced, rank = matrix.rref()
    width = len(columns)
    pivots = [next(c for c in range(width) if reduced[r, c] != 0) for r in range(rank)]
    found = []
    for free in (c for c in range(width) if c not in pivots):
        vector: list[object] = [0] * width
        vector[free] = 1
        for row, pivot in enumerate(pivots):
            vector[pivot] = -reduced[row, free]
        found.append(vector)
    return found


def rational_dimensions(drawn: Drawn) -> tuple[int, ...]:
    """Block by block: what its motions add to the span of all blocks before it."""
    sizes = {"a": len(drawn.a), "p": len(drawn.p), "o": len(drawn.o)}
    starts = {"a": 0, "p": sizes["a"], "o": sizes["a"] + sizes["p"]}
    width = sum(sizes.values())
    known: list[list[object]] = []
    found, rank = [], 0
    for block in BLOCKS:
        parts = MOVING[block]
        places = [starts[x] + i for x in "apo" if x in parts for i in range(sizes[x])]
        for vector in null_space(
            drawn.columns("".join(x for x in "apo" if x in parts))
        ):
            whole: list[object] = [0] * width
            for place, value in zip(places, vector, strict=True):
                whole[place] = value
            known.append(whole)
        now = fmpq_mat(known).rank() if known else 0
        found.append(now - rank)
        rank = now
    return tuple(found)


@given(grasps)
@often
def test_the_numbers_are_those_of_the_definition(drawn: Drawn) -> None:
    blocks = blocks_of(drawn.exact())
    assert blocks.dimensions == rational_dimensions(drawn)
    whole = len(drawn.a) + len(drawn.p) + len(drawn.o)
    assert sum(blocks.dimensions) == whole - drawn.rank("apo")


@given(grasps)
@often
def test_bases_are_motions_of_what_their_block_moves(drawn: Drawn) -> None:
    """[J_a J_p −Gᵀ] b = 0, zeros where nothing may move, and all independent."""
    blocks = blocks_of(drawn.exact())
    columns = drawn.columns("apo")
    letters = "a" * len(drawn.a) + "p" * len(drawn.p) + "o" * len(drawn.o)
    for block, basis in blocks.basis.items():
        for vector in basis:
            moved = {x for x, value in zip(letters, vector, strict=True) if value}
            assert moved <= set(MOVING[block])
            for row in range(drawn.rows):
                total = sum(
                    x * column[row] for x, column in zip(vector, columns, strict=True)
                )
                assert total % PRIME == 0


@given(grasps)
@often
def test_mobility_parts_add_up(drawn: Drawn) -> None:
    """Nm = Nr + Ni + the coordinated motions [BicchiMelchiorri, (10)-(12)]."""
    exact = drawn.exact()
    ranks = exact.ranks
    joints = len(drawn.a) + len(drawn.p)
    redundancy = joints - drawn.rank("ap")
    indeterminacy = len(drawn.o) - drawn.rank("o")
    mobility = joints + len(drawn.o) - drawn.rank("apo")
    coordinated = drawn.rank("ap") + drawn.rank("o") - drawn.rank("apo")
    assert (ranks.redundancy, ranks.indeterminacy) == (
        len(drawn.a) - (drawn.rank("ap") - drawn.rank("p")),
        len(drawn.o) - (drawn.rank("po") - drawn.rank("p")),
    )
    assert mobility == redundancy + indeterminacy + coordinated
    assert sum(blocks_of(exact).dimensions) == mobility


def test_the_published_order_of_filling_fails_where_spans_overlap() -> None:
    """One space for all columns: blocks that were filled one by one would count twice.

    J_a, J_p and Gᵀ are one and the same column: three columns of rank one, mobility
    two; yet each pair of parts has a motion of its own, three in all.
    """
    drawn = Drawn(1, [[1]], [[1]], [[1]])
    pairs = sum(len(null_space(drawn.columns(parts))) for parts in ("ap", "ao", "po"))
    assert pairs == 3
    assert sum(blocks_of(drawn.exact()).dimensions) == 2


@given(grasps)
@often
def test_statics_part_the_forces_that_passive_joints_let_through(drawn: Drawn) -> None:
    """Dimensions by ranks of transposed matrices, (15)-(19)."""
    exact = drawn.exact()
    forces = contact_forces(exact)
    silent = drawn.rows - drawn.rank("apo")
    assert len(forces.silent) == silent == exact.ranks.static_indeterminacy
    assert len(forces.quiet) == drawn.rows - drawn.rank("ap") - silent
    assert len(forces.inner) == drawn.rows - drawn.rank("po") - silent
    total = sum(map(len, (forces.silent, forces.quiet, forces.inner, forces.others)))
    assert total == drawn.rows - drawn.rank("p") == exact.ranks.admissible
    for part, columns in (
        (forces.silent, "apo"),
        (forces.quiet, "ap"),
        (forces.inner, "po"),
        (forces.others, "p"),
    ):
        for vector in part:
            for column in drawn.columns(columns):
                work = sum(x * y for x, y in zip(vector, column, strict=True))
                assert work % PRIME == 0


def test_floats_count_as_exact_ranks_do() -> None:
    """The same numbers by singular values, where integers keep a margin."""
    for seed in range(300):
        drawn = grasp(seed)
        ja, jp, gt = (
            np.array(columns, float).reshape(len(columns), drawn.rows).T
            for columns in (drawn.a, drawn.p, drawn.o)
        )
        ranks, dimensions, gap = float_ranks(FloatGrasp(ja, jp, gt))
        exact = drawn.exact()
        assert gap > 1e3
        assert ranks == exact.ranks
        assert dimensions == blocks_of(exact).dimensions


def test_vectors_that_grow_too_long_are_left_to_numbers(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of the same dimensions, at the values of the file."""
    whole = sk.manipulability(sk.load("five_bar")).partition
    monkeypatch.setattr(symbolic_blocks, "PRODUCTS", 0)
    cut = sk.manipulability(sk.load("five_bar")).partition
    assert whole.symbolic
    assert not cut.symbolic
    assert cut.gamma == whole.gamma
    for block in cut.blocks:
        for motion in block.motions:
            assert motion.rates
            assert all(Fraction(rate) for rate in motion.rates)


LOOSE = """
screwkit: 1
name: loose
space: spatial
geometry: posture
base: base
platform: arm
links: [base, arm, one, two, three, four]
vectors: {k: [0, 0, 1]}
joints:
  - {name: A, type: revolute, parent: base, child: arm, axis: k, point: [0, 0, 0]}
  - {name: M, type: revolute, parent: one, child: two, axis: k, point: [1, 0, 0]}
  - {name: N, type: revolute, parent: two, child: three, axis: k, point: [0, 2, 0]}
  - {name: O, type: revolute, parent: three, child: four, axis: AXIS, point: [3, 3, 0]}
  - {name: Q, type: revolute, parent: four, child: one, axis: k, point: [4, 1, 0]}
actuated: [A]
"""


@pytest.mark.parametrize(
    ("axis", "idle"),
    [
        ("[0, 0, 1]", 1),  # a planar four-bar: 4 freedoms less 3 equations
        ("[0, 1, 1]", 0),  # three parallel hinges and a skew one: a triangle, rigid
    ],
)
def test_what_hangs_on_nothing_keeps_its_loops_closed(axis: str, idle: int) -> None:
    found = sk.mobility(load_text(LOOSE.replace("AXIS", axis)))
    assert found.instantaneous_mobility == 1 + idle
    gamma = found.partition.gamma
    assert gamma is not None
    assert (gamma.p_r, gamma.ao_c) == (idle, 1)
    blocks = found.partition.blocks
    said = [motion.words for block in blocks for motion in block.motions]
    assert len(said) == 1 + idle
    assert "M moves" not in said
