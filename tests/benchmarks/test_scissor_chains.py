"""Chains of scissors: exact work that grows with their length and no faster.

The timed tests run with ``python -m pytest -m benchmark tests/benchmarks -s``.
"""

from __future__ import annotations

import gc
import sys
import time
from fractions import Fraction
from functools import cache, partial
from typing import Any

import pytest
from benchmarks.baselines import best, say

from screwkit.algebra.expression import Number
from screwkit.case import Case
from screwkit.kinematics.network import Motion, Network, motion
from screwkit.mechanism.model import Joint, JointType, Mechanism
from screwkit.questions import mobility


def vector(x: int, y: int, z: int) -> tuple[Number, Number, Number]:
    return Number(Fraction(x)), Number(Fraction(y)), Number(Fraction(z))


@cache
def scissor_chain(cells: int) -> Mechanism:
    """Bars a and b of each cell cross at a pivot; ends are hinged to the next cell."""
    joints = []

    def hinge(name: str, parent: str, child: str, x: int, y: int) -> None:
        joints.append(
            Joint(
                name,
                JointType.REVOLUTE,
                parent,
                child,
                (f"q_{name}",),
                axes=(vector(0, 0, 1),),
                point=vector(x, y, 0),
            )
        )

    for i in range(cells):
        hinge(f"piv{i}", f"a{i}", f"b{i}", 2 * i, 0)
        if i + 1 < cells:
            hinge(f"up{i}", f"a{i}", f"b{i + 1}", 2 * i + 1, 1)
            hinge(f"dn{i}", f"b{i}", f"a{i + 1}", 2 * i + 1, -1)
    return Mechanism(
        name="scissor_chain",
        title="Scissor chain",
        base="a0",
        platform=f"a{cells - 1}",
        links=tuple(f"{bar}{i}" for i in range(cells) for bar in "ab"),
        joints=tuple(joints),
        geometry="posture",
    )


def exact_motion(cells: int) -> Motion:
    """Graph, twists and rank from the mechanism, at two postures."""
    return Network(scissor_chain(cells)).motion


@pytest.mark.benchmark
def test_scissor_chain_grows_with_its_length() -> None:
    """2000 cells: 11 994 equations, 5 998 columns, mobility 1.

    Growth is measured in processor time with garbage collection off, whose share grows
    with all that the process holds; the time for 2000 cells is printed with it too.
    """
    at = exact_motion(2000)
    assert (len(at.network.labels), len(at.network.loops)) == (5998, 1999)
    assert (at.rank, at.mobility) == (5997, 1)
    collected = best(lambda: exact_motion(2000))
    gc.disable()
    try:
        short = best(lambda: exact_motion(500), 9, time.process_time)
        long = best(lambda: exact_motion(2000), 9, time.process_time)
    finally:
        gc.enable()
    say(
        f"scissor chain: {short:.3f} s for 500 cells, {long:.3f} s for 2000: "
        f"{long / short:.1f} times for 4 times the length; with garbage collection "
        f"{collected:.3f} s"
    )
    assert collected < 5
    assert long / short <= 5


@pytest.mark.benchmark
def test_mobility_of_a_scissor_chain_grows_with_its_length() -> None:
    """The whole answer: limbs, counts, platform, full-cycle mobility."""
    chains = {cells: scissor_chain(cells) for cells in (500, 2000)}
    whole = mobility(Case(chains[2000]))
    assert (whole.loop_rank, whole.instantaneous_mobility) == (5997, 1)
    times = dict.fromkeys(chains, 60.0)
    gc.disable()
    try:
        for cells in 5 * tuple(chains):
            gc.collect()
            case = Case(chains[cells])
            seconds = best(partial(mobility, case), 1, time.process_time)
            times[cells] = min(times[cells], seconds)
    finally:
        gc.enable()
    short, long = times.values()
    say(
        f"mobility of a scissor chain: {short:.2f} s for 500 cells, {long:.2f} s for "
        f"2000: {long / short:.1f} times for 4 times the length"
    )
    assert long < 5
    assert long / short <= 5


def calls(case: Case) -> int:
    """How many functions of Python the whole answer calls."""
    count = 0

    def entered(_frame: object, event: str, _argument: object) -> None:
        nonlocal count
        count += event == "call"

    sys.setprofile(entered)
    try:
        mobility(case)
    finally:
        sys.setprofile(None)
    return count


def test_four_times_the_length_takes_four_times_the_steps() -> None:
    """What no clock and no busy machine disturbs: the steps are counted."""
    mobility(Case(scissor_chain(50)))  # modules are loaded, tables are made
    short, long = (calls(Case(scissor_chain(cells))) for cells in (125, 500))
    assert long / short < 4.1


def dense_matrix(at: Motion) -> Any:
    """J_c with all its zeros, as FLINT takes it."""
    from flint import nmod_mat

    network, prime = at.network, at.posture.prime
    column = {label: k for k, label in enumerate(network.labels)}
    matrix = nmod_mat(6 * len(network.loops), len(column), prime)
    for number, loop in enumerate(network.loops):
        for joint, sign in loop:
            for label in network.labels_of[joint]:
                for k, entry in enumerate(at.posture.twists[label]):
                    matrix[6 * number + k, column[label]] = sign * entry % prime
    return matrix


@pytest.mark.benchmark
@pytest.mark.parametrize(("cells", "goal"), [(500, 50), (1600, 1000)])
def test_scissor_chain_against_a_dense_matrix(cells: int, goal: float) -> None:
    """The same rank of the same matrix modulo the same prime."""
    at = exact_motion(cells)
    matrix = dense_matrix(at)
    whole = best(lambda: exact_motion(cells), 5)
    rank = best(lambda: motion(at.network, at.posture), 5)
    start = time.perf_counter()
    assert int(matrix.rank()) == at.rank
    theirs = time.perf_counter() - start
    say(
        f"scissor chain of {cells} cells: nmod_mat.rank {theirs:.2f} s; the same rank "
        f"sparse {1e3 * rank:.1f} ms: {theirs / rank:.0f} times; with graph, twists "
        f"and a second prime {1e3 * whole:.0f} ms: {theirs / whole:.0f} times"
    )
    assert theirs / rank >= goal
