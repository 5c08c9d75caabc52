"""Random hands, measured whole, against the definitions over the rationals.

Null spaces are rational; finite values are those of the generalised eigenproblems of
[BicchiPrattichizzo] eqs. (8), (13), (20)-(24), posed on rational bases and solved by
scipy, with cross terms kept.
"""

from __future__ import annotations

import random
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
import sympy
from flint import fmpq, fmpq_mat
from grasping.random_grasps import Drawn
from grasping.random_hands import SPACES, Array, Hand, hand, spd, weighted
from grasping.test_partition import null_space, rational_dimensions
from scipy.linalg import eigh

from screwkit.analyses.manipulability import manipulability
from screwkit.grasping.partition import BLOCKS
from screwkit.kinematics.network import Network
from screwkit.mechanism.model import Space
from screwkit.results.manipulability import Manipulability

SEEDS = range(40)
EVERY = [(seed, space) for space in SPACES for seed in SEEDS]
Rows = list[list[object]]


@cache
def measured(seed: int, space: Space) -> tuple[Hand, Manipulability]:
    drawn = hand(seed, space)
    return drawn, manipulability(Network(drawn.mechanism))


def rank(rows: Rows) -> int:
    return int(fmpq_mat(rows).rank()) if rows and rows[0] else 0


def beyond(known: Rows, more: Rows) -> Rows:
    """Those of ``more`` that complete the span of ``known``."""
    found, count = list(known), rank(known)
    chosen = []
    for vector in more:
        if rank([*found, vector]) > count:
            found.append(vector)
            chosen.append(vector)
            count += 1
    return chosen


def pairs(drawn: Drawn) -> Rows:
    """(q_a, u) of all motions."""
    a, p = len(drawn.a), len(drawn.p)
    return [[*v[:a], *v[a + p :]] for v in null_space(drawn.columns("apo"))]


def actuated_at_rest(drawn: Drawn) -> Rows:
    """R, as vectors q_a."""
    a = len(drawn.a)
    return beyond([], [v[:a] for v in null_space(drawn.columns("ap"))])


def object_let_go(drawn: Drawn) -> Rows:
    """I, as vectors u."""
    p = len(drawn.p)
    return beyond([], [v[p:] for v in null_space(drawn.columns("po"))])


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_the_partition_of_a_hand(seed: int, space: Space) -> None:
    drawn, answer = measured(seed, space)
    columns, partition = drawn.drawn, answer.partition
    gamma = partition.gamma
    assert tuple(getattr(gamma, b) for b in BLOCKS) == rational_dimensions(columns)
    mobility = len(null_space(columns.columns("apo")))
    redundancy = len(null_space(columns.columns("ap")))
    assert partition.mobility == mobility
    assert partition.redundancy == redundancy
    assert partition.connectivity == mobility - redundancy
    assert partition.indeterminacy == len(null_space(columns.columns("o")))
    assert answer.kinematic.zero == len(actuated_at_rest(columns))
    assert answer.kinematic.infinite == len(object_let_go(columns))
    coordinated = rank(pairs(columns)) - answer.kinematic.zero
    assert len(answer.kinematic.finite) == coordinated - answer.kinematic.infinite


def transposed(columns: Rows, rows: int) -> Rows:
    """The rows of given columns: as columns they are those of the transpose."""
    return [[column[i] for column in columns] for i in range(rows)]


def unfelt(drawn: Drawn, parts: str) -> Rows:
    """Contact forces φ that these columns do not feel."""
    columns: Rows = [list(column) for column in drawn.columns(parts)]
    if not columns:
        return [[int(i == k) for i in range(drawn.rows)] for k in range(drawn.rows)]
    return null_space(transposed(columns, drawn.rows))  # type: ignore[arg-type]


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_the_statics_of_a_hand(seed: int, space: Space) -> None:
    drawn, answer = measured(seed, space)
    columns, statics = drawn.drawn, answer.statics
    admissible, silent = unfelt(columns, "p"), unfelt(columns, "apo")
    quiet, inner = unfelt(columns, "ap"), unfelt(columns, "po")
    assert statics.admissible == len(admissible)
    assert statics.indeterminacy == len(silent)
    assert statics.structural == len(quiet) - len(silent)
    assert statics.internal == len(inner) - len(silent)
    assert statics.transmitted == len(admissible) - rank([*quiet, *inner])
    assert statics.balances_all == (not object_let_go(columns))
    assert answer.internal_force.infinite == len(silent)
    assert answer.active_force.zero == statics.internal
    assert answer.passive_force.infinite == statics.structural


def floats(rows: Rows, width: int) -> Array:
    """Vectors as columns."""
    entries = [[float(str_fraction(x)) for x in row] for row in rows]
    return np.array(entries, float).reshape(len(rows), width).T


def str_fraction(value: object) -> Fraction:
    return Fraction(str(value))


def least(vectors: Array, free: Array, metric: Array) -> Array:
    """Gram matrix of vectors, each at its least over x + free·y."""
    across = vectors.T @ metric @ free
    plain = vectors.T @ metric @ vectors
    if not free.shape[1]:
        return np.asarray(plain)
    return np.asarray(
        plain - across @ np.linalg.solve(free.T @ metric @ free, across.T)
    )


def values(above: Array, below: Array) -> Array:
    if not len(above):
        return np.zeros(0)
    return np.asarray(eigh(above, below, eigvals_only=True)[::-1])


def numeric(weight: list[list[Fraction]]) -> Array:
    return np.array([[float(x) for x in row] for row in weight]).reshape(
        len(weight), len(weight)
    )


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_the_indices_of_a_hand(seed: int, space: Space) -> None:
    """With weights that mix all coordinates; ranks are lost and joints are spare."""
    drawn, plain = measured(seed, space)
    columns, source = drawn.drawn, random.Random(seed)
    size, a = len(columns.o), len(columns.a)
    if not a:
        return
    w_u, w_q, w_w, w_t = (spd(source, n) for n in (size, a, size, a))
    mechanism = weighted(drawn.mechanism, twist=w_u, rates=w_q, wrench=w_w, torques=w_t)
    answer = manipulability(Network(mechanism))
    unit = np.sqrt(np.array(drawn.lengths, float))

    rest, loose = actuated_at_rest(columns), object_let_go(columns)
    none_a, none_u = [0] * a, [0] * size
    known: Rows = [[*v, *none_u] for v in rest] + [[*none_a, *v] for v in loose]
    both = floats(beyond(known, pairs(columns)), a + size)
    rates = unit[:, None] * both[:a]
    at_rest = unit[:, None] * floats(rest, a)
    wanted = values(
        least(both[a:], floats(loose, size), numeric(w_u)),
        least(rates, at_rest, numeric(w_q)),
    )
    assert np.allclose(answer.kinematic.finite, wanted, rtol=1e-7, atol=1e-9)

    ja, _, gt = drawn.floats()
    g = gt.T[[1, 2, 0] if size == 3 else [3, 4, 5, 0, 1, 2]]
    silent, quiet = unfelt(columns, "apo"), unfelt(columns, "ap")
    inner, admissible = unfelt(columns, "po"), unfelt(columns, "p")
    structural, internal = beyond(silent, quiet), beyond(silent, inner)
    rest_of = beyond([*silent, *structural, *internal], admissible)
    s, h, k = (floats(x, columns.rows) for x in (structural, internal, rest_of))
    above = least(g @ k, g @ s, numeric(w_w))
    below = least(ja.T @ k, ja.T @ h, numeric(w_t))
    wanted = values(above, below)
    assert np.allclose(answer.force.finite, wanted, rtol=1e-7, atol=1e-9)

    # (20): over S the worst wrench, any torque; internal torques turn into nothing.
    open_h = np.concatenate([k, h], axis=1)
    active = values(
        least(g @ open_h, g @ s, numeric(w_w)),
        least(ja.T @ open_h, np.zeros((a, 0)), numeric(w_t)),
    )
    zeros = np.zeros(answer.active_force.zero)
    found = [*answer.active_force.finite, *zeros]
    assert np.allclose(found, active, rtol=1e-7, atol=1e-9)

    # (21): over H the least torque; the reciprocal of what is infinite is zero.
    open_s = np.concatenate([k, s], axis=1)
    passive = values(
        least(ja.T @ open_s, ja.T @ h, numeric(w_t)),
        least(g @ open_s, np.zeros((size, 0)), numeric(w_w)),
    )
    zeros = np.zeros(answer.passive_force.infinite)
    found = [*(1 / np.array(answer.passive_force.finite))[::-1], *zeros]
    assert np.allclose(found, passive, rtol=1e-7, atol=1e-9)

    # (22), (23): contact forces (f; m) of plain length, apart from the silent ones.
    acting = np.array([[float(x) for x in row] for row in drawn.acting])
    metric = acting @ acting.T
    x = floats(silent, columns.rows)
    wanted = values(
        least(h, x, metric), least(ja.T @ h, np.zeros((a, 0)), numeric(w_t))
    )
    assert np.allclose(answer.internal_force.finite, wanted, rtol=1e-7, atol=1e-9)
    assert plain.partition.gamma == answer.partition.gamma


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_dual_weights_make_dual_indices(seed: int, space: Space) -> None:
    """W_w = σ W_u⁻¹, W_τ = σ W_q⁻¹: reciprocals, whatever ranks are lost (E13)."""
    drawn, _ = measured(seed, space)
    source = random.Random(seed + 1)
    size, a = len(drawn.drawn.o), len(drawn.drawn.a)
    if not a:
        return
    w_u, w_q = spd(source, size), spd(source, a)
    # u is (ω; v) and w is (f; m): v goes with f.
    order = [1, 2, 0] if size == 3 else [3, 4, 5, 0, 1, 2]
    turned = [[w_u[i][j] for j in order] for i in order]
    mechanism = weighted(
        drawn.mechanism,
        twist=w_u,
        rates=w_q,
        wrench=inverse(turned, 3),
        torques=inverse(w_q, 3),
    )
    answer = manipulability(Network(mechanism))
    wanted = [1 / x for x in reversed(answer.kinematic.finite)]
    assert np.allclose(answer.force.finite, wanted, rtol=1e-7)


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_polynomials_have_the_values_for_roots(seed: int, space: Space) -> None:
    """Exact coefficients, by another route than the floats: monic, of full degree."""
    _, answer = measured(seed, space)
    for index in (answer.kinematic, answer.force, answer.internal_force):
        if not index.polynomial:
            continue
        polynomial = sympy.Poly(sympy.sympify(index.polynomial), sympy.Symbol("x"))
        assert polynomial.LC() == 1
        assert polynomial.degree() == len(index.finite)
        for value in index.finite:
            exact = abs(polynomial.eval(sympy.Rational(value)))
            slope = abs(polynomial.diff().eval(sympy.Rational(value)))
            scale = sum(
                abs(c) * value**k for k, c in enumerate(polynomial.all_coeffs()[::-1])
            )
            assert exact <= 1e-7 * value * slope or exact <= 1e-12 * scale


def inverse(weight: list[list[Fraction]], factor: int) -> list[list[Fraction]]:
    found = fmpq_mat(
        [[fmpq(x.numerator, x.denominator) for x in row] for row in weight]
    ).inv()
    return [
        [factor * str_fraction(found[i, j]) for j in range(len(weight))]
        for i in range(len(weight))
    ]


def test_the_hands_are_of_every_kind() -> None:
    """The samples have every block, and every loss of rank, somewhere."""
    gammas = [measured(*which)[1].partition.gamma for which in EVERY]
    for block in BLOCKS:
        assert any(getattr(gamma, block) for gamma in gammas), block
    statics = [measured(*which)[1].statics for which in EVERY]
    for name in ("transmitted", "internal", "structural", "indeterminacy"):
        assert any(getattr(one, name) for one in statics), name
