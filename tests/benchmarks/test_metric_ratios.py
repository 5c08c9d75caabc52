"""Indices of many postures against a loop of scipy's generalised eigenproblems.

Run with ``python -m pytest -m benchmark tests/benchmarks -s``; every figure is printed.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from math import pi

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh, null_space

import screwkit as sk
from screwkit.metrics.index_function import index_function

pytestmark = pytest.mark.benchmark
Array = NDArray[np.float64]
POSTURES = 10_000


def seconds(call: Callable[[], object]) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def five_bar_postures() -> dict[str, Array]:
    source = np.random.default_rng(5)
    at = {"x2": -1.0, "y2": 0.0, "x3": 0.0, "y3": 0.0, "x4": 1.0, "y4": -1.0}
    return {k: v + source.uniform(-0.2, 0.2, POSTURES) for k, v in at.items()}


def by_scipy(x2: float, y2: float, x3: float, y3: float, x4: float, y4: float) -> Array:
    """The kinematic index of one posture, as a user of scipy would write it.

    Closure of the five-bar in the plane: the object is the bar BC, held by joints 1, 2
    from A and by 5, 4, 3 from E; joints 1 and 5 are actuated, all weights are one.
    """
    points = [(-1, -2), (x2, y2), (x3, y3), (x4, y4), (1, -2)]
    px, py = (x2 + x3) / 2, (y2 + y3) / 2

    def column(k: int) -> list[float]:
        x, y = points[k - 1]
        return [1.0, y - py, -(x - px)]  # (ω; v) of the reference point

    jacobian = np.zeros((6, 5))
    for row, joints in ((0, (1, 2)), (3, (5, 4, 3))):
        for k in joints:
            jacobian[row : row + 3, k - 1] = column(k)
    grasp = np.vstack([np.eye(3), np.eye(3)])
    order = [0, 4, 1, 2, 3]  # actuated first
    stacked = np.hstack([jacobian[:, order], -grasp])
    basis = null_space(stacked)
    q, u = basis[:2], basis[5:]
    return np.asarray(eigh(u.T @ u, q.T @ q, eigvals_only=True)[::-1])


def test_ten_thousand_postures_of_the_five_bar() -> None:
    postures = five_bar_postures()
    function = index_function(sk.load("five_bar_15").mechanism)
    names = list(postures)
    rows = list(zip(*postures.values(), strict=True))
    found = function(postures)
    wanted = np.array([by_scipy(**dict(zip(names, row, strict=True))) for row in rows])
    assert np.allclose(found, wanted, rtol=1e-6)
    loop = seconds(
        lambda: [by_scipy(**dict(zip(names, row, strict=True))) for row in rows]
    )
    ours = min(seconds(lambda: function(postures)) for _ in range(5))
    print(
        f"\n    {POSTURES} postures of the five-bar: {ours * 1000:.1f} ms, "
        f"scipy one by one {loop:.2f} s: {loop / ours:.0f} times"
    )
    assert loop / ours >= 50


def test_the_map_of_the_stewart_platform() -> None:
    """181 × 181 values of (α, β); a loop takes 400 of them, for the ratio."""
    case = sk.load("stewart_alpha_beta")
    ranges = ["alpha=-pi:pi:181", "beta=-pi:pi:181"]
    whole = seconds(lambda: sk.sweep(case, ranges, "kinematic.misfit"))
    function = index_function(case.mechanism)
    source = np.random.default_rng(6)
    points = source.uniform(-pi, pi, (400, 2))
    loop = seconds(lambda: [function({"alpha": a, "beta": b}) for a, b in points])
    ratio = loop / 400 * 181**2 / whole
    print(
        f"\n    Stewart map of 181 × 181: {whole:.2f} s, one posture at a time "
        f"{loop / 400 * 181**2:.0f} s: {ratio:.0f} times"
    )
    assert whole < 30
    assert ratio > 10


@pytest.mark.parametrize("name", ["five_bar_15", "five_bar_24"])
def test_one_whole_analysis(name: str) -> None:
    """All indices with exact counts and bases, against the null space alone in sympy.

    Sympy gets the symbolic matrix [J −Gᵀ] ready made.
    """
    import sympy

    grasp = sk.load(name).grasp
    j, g = grasp.J.to_sympy(), grasp.G.to_sympy()
    matrix = sympy.Matrix.hstack(j, -g.T)
    other = seconds(lambda: matrix.nullspace(simplify=True))
    case = sk.load(name)
    sk.manipulability(case)
    best = min(seconds(lambda: sk.manipulability(sk.load(name))) for _ in range(5))
    print(
        f"\n    {name}: all of it in {best * 1000:.0f} ms with reading the file, "
        f"null space in sympy {other * 1000:.0f} ms: {other / best:.1f} times"
    )
    assert other / best > 1


GRASPS = [
    "five_bar_15", "nao_t14", "dual_puma", "scara_pair_hard", "hand_three_mixed",
    "stewart_alpha_beta", "dual_planar_3r", "delta_ss", "gough_6sps", "h4",
]  # fmt: skip


@pytest.mark.parametrize("name", GRASPS)
def test_one_analysis_at_a_posture(name: str) -> None:
    """All of it against reading the file; 50 ms are the goal on a quiet machine."""
    sk.manipulability(sk.load(name))
    reading = min(seconds(lambda: sk.load(name)) for _ in range(9))
    cases = [sk.load(name) for _ in range(9)]
    best = min(seconds(partial(sk.manipulability, case)) for case in cases)
    print(
        f"\n    {name}: {best * 1000:.0f} ms, reading its file {reading * 1000:.0f}: "
        f"{best / reading:.1f} times that"
    )
    assert best / reading < 10
