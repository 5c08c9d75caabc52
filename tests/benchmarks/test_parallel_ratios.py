"""Parallel robots with symbols: ratios against named baselines in one run.

Run with ``python -m pytest -m benchmark tests/benchmarks -s``; every figure is printed.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from benchmarks.baselines import as_terms, best, domain_matrix_seconds, say
from loci.symbolic_platforms import numeric_points, six_ups, symbolic_points

import screwkit as sk
from screwkit.algebra.polynomial_text import text
from screwkit.analyses.singularities import (
    actuation_singularities,
    constraint_singularities,
)
from screwkit.case import Case
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.rank_drop import extensors
from screwkit.loci.wrench_sums import sum_minors
from screwkit.mechanism.model import Mechanism
from screwkit.questions import singularities

pytestmark = pytest.mark.benchmark


def limbs_of(assembly: Assembly) -> list[list[list[Any]]]:
    """The twists of each limb that are left when the actuated joints are locked."""
    actuated = assembly.mechanism.actuated
    return [
        assembly.told([joint for joint in limb.joints if joint not in actuated])
        for limb in assembly.limbs
    ]


def expansion(mechanism: Mechanism) -> tuple[Assembly, Callable[[], list[Any]]]:
    """From the twists of the limbs to the determinant, expanded."""
    assembly = Assembly(mechanism)
    ring = assembly.common_twists.ring
    root, library = assembly.root(ring), assembly.library(ring)
    limbs = limbs_of(assembly)

    def expand() -> list[Any]:
        charts = [extensors(root, limb, len(limb), library)[0] for limb in limbs]
        return sum_minors(ring, charts, ((),) * len(charts), 6)

    return assembly, expand


def lines_of(assembly: Assembly) -> list[list[Any]]:
    """The six lines of the struts: (f; m) of the wrench that each limb transmits."""
    ring = assembly.common_twists.ring
    root, library = assembly.root(ring), assembly.library(ring)
    found = []
    for limb in limbs_of(assembly):
        chart = extensors(root, limb, 5, library)[0]
        found.append([chart.get(63 ^ 1 << row, ring.zero) for row in range(6)])
    return found


def test_six_struts_with_numbers_against_domain_matrix(tmp_path: Path) -> None:
    """Position and quaternion are symbols; sympy gets the lines ready made."""
    mechanism = six_ups(tmp_path, numeric_points(), quaternion=True)
    assembly, expand = expansion(mechanism)
    ring = assembly.common_twists.ring
    first = best(expand, 1, time.process_time)
    (minor,) = expand()
    printing = best(lambda: text(ring, minor), 1, time.process_time)
    ours = best(expand, 9)
    columns = [[as_terms(x) for x in line] for line in lines_of(assembly)]
    rows = [[column[row] for column in columns] for row in range(6)]
    theirs, finished = domain_matrix_seconds(
        ring.names, [rows], factor=False, timeout=200
    )
    say(
        f"6-UPS, numbers: {len(minor)} terms in {1e3 * ours:.0f} ms; DomainMatrix "
        f"{'' if finished else '> '}{theirs:.2f} s: {theirs / ours:.0f} times; "
        f"the first time it takes {1e3 * first:.0f} ms, printing it "
        f"{1e3 * printing:.0f} ms"
    )
    assert theirs / ours >= 70
    assert first <= 3 * printing


def test_six_struts_with_symbols_for_all_points(tmp_path: Path) -> None:
    """24 coordinates of points, three of the position, nine entries of the rotation."""
    mechanism = six_ups(tmp_path, symbolic_points(gauge=True), quaternion=False)
    assembly, expand = expansion(mechanism)
    ring = assembly.common_twists.ring
    ours = best(expand, 3, time.process_time)
    (minor,) = expand()
    printing = best(lambda: text(ring, minor), 1, time.process_time)
    say(
        f"6-UPS, all symbols in a gauge: {len(minor)} terms in {1e3 * ours:.0f} ms, "
        f"printed in {printing:.1f} s"
    )
    assert len(minor) == 164_016
    assert ours < 1
    assert ours <= 3 * printing


def test_six_struts_without_a_gauge_are_refused_at_once(tmp_path: Path) -> None:
    mechanism = six_ups(tmp_path, symbolic_points(gauge=False), quaternion=False)
    case = Case(mechanism)
    start = time.process_time()
    actuation = singularities(case).actuation
    seconds = time.process_time() - start
    assert actuation is not None
    say(f"6-UPS, no gauge: {actuation.reason}, in {seconds:.1f} s")
    assert "million terms, and was not expanded" in actuation.reason
    assert seconds < 10


@pytest.mark.parametrize("name", ["3rpr_planar", "3rrr_planar"])
def test_planar_platforms_with_all_dimensions(name: str) -> None:
    """Locus with its proof of irreducibility, the constraint part and all of it.

    A new case each time: nothing is known from the run before.
    """
    cases = iter([sk.load(name) for _ in range(9)])

    def fresh() -> Assembly:
        return next(cases).assembly

    def actuation() -> None:
        assembly = fresh()
        answer = actuation_singularities(assembly, assembly.mechanism.actuated)
        assert answer.complete

    loci = best(actuation, 3, time.process_time)
    constraint = best(lambda: constraint_singularities(fresh()), 3, time.process_time)
    whole = best(lambda: singularities(next(cases)), 3, time.process_time)
    case = sk.load(name)
    found = singularities(case)
    factors: Sequence[Any] = [
        factor
        for library in case.assembly.libraries.values()
        for factor in library.factors.values()
    ]
    say(
        f"{name}: actuation locus {loci:.2f} s, constraint {constraint:.2f} s, all of "
        f"it {whole:.2f} s; {len(factors)} factors, "
        f"{sum(f.certified for f in factors)} proved irreducible"
    )
    assert found.actuation is not None
    assert all(factor.certified for factor in factors)
    assert loci < 2
    assert whole < 2
