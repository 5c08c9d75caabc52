"""Pairs and triples of arms, on bases that are turned against each other.

What is expected comes from elementary geometry, or from singular values.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from loci.numeric import value

import screwkit as sk
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.factors import factor
from screwkit.algebra.points import rank_at
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.case import Case, load_text
from screwkit.kinematics.limb_parts import SideBySide
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.kinematics.told_parts import told_parts
from screwkit.loci.dependence import Dependence, dependent_zeros
from screwkit.loci.local_codimension import codimension_around
from screwkit.loci.loop_drop import loop_drop
from screwkit.loci.open_branches import lying_where
from screwkit.loci.rank_drop import extensors
from screwkit.loci.standing_screws import standing_minors, standing_screws
from screwkit.loci.strata import in_ring, limb_strata
from screwkit.loci.wrench_sums import height_of
from screwkit.loci.wrench_vectors import Vector, spanning_wrenches

SCARA = ("", "d: 0.325", "d: 0.225", "")
PAIR = """
screwkit: 1
name: pair
title: Two SCARA arms carrying one tray
source: constructed
units: m
space: spatial
geometry: mdh
base: bench
platform: tray
links: [bench, {links}, tray]
joints:
{joints}
actuated: [A1, A2, A3, B1]
limbs:
  a: [A1, A2, A3, A4]
  b: [B1, B2, B3, B4]
"""


def scara_pair(first: str, second: str) -> Case:
    """Two arms of the same size, each on the base that its first cell gives."""
    lines, links = [], []
    for arm, base in (("A", first), ("B", second)):
        parent = "bench"
        for number, cell in enumerate((base, *SCARA[1:]), 1):
            name = f"{arm}{number}"
            kind = "prismatic" if number == 3 else "revolute"
            links.append(name.lower())
            lines.append(
                f"  - {{name: {name}, type: {kind}, parent: {parent}, "
                f"child: {name.lower()}, mdh: {{{cell}}}}}"
            )
            parent = name.lower()
        lines.append(
            f"  - {{name: grip_{arm}, type: fixed, parent: {parent}, child: tray}}"
        )
    text = PAIR.format(links=", ".join(links), joints="\n".join(lines))
    return load_text(text)


def test_scara_arms_on_turned_bases_lie_in_one_line() -> None:
    """Both stretched or folded on the line of the two columns, and nowhere else.

    The angle of that line is fixed by irrational numbers.
    """
    case = scara_pair("d: 0.2", "gamma: pi/5, d: 0.7")
    angle = math.pi / 5
    found = sk.singularities(case).constraint
    assert found.complete
    (component,) = found.components
    assert component.codimension == 4
    assert component.rank == 3
    columns = np.array([0.2, 0.0]), 0.7 * np.array([math.cos(angle), math.sin(angle)])
    along = math.atan2(*(columns[1] - columns[0])[::-1])
    for folds in product((0, math.pi), repeat=4):
        at = {
            "qA1": along + folds[0],
            "qA2": folds[1],
            "qB1": along - angle + folds[2],
            "qB2": folds[3],
        }
        assert all(abs(value(e, at)) < 1e-12 for e in component.equations)
        at |= {"qA1": at["qA1"] + 0.1}
        assert any(abs(value(e, at)) > 1e-3 for e in component.equations)


@cache
def three_arms() -> tuple[list[list[Vector]], list[tuple[float, ...]]]:
    """The force of each arm, along the line of its two centres; and the shoulders."""
    case = sk.load("three_arms").assembly
    root = case.root(case.common_twists.ring)
    library = case.library(root.ring)
    limbs = [told_parts(case, limb) for limb in case.limbs]
    systems = []
    for limb in limbs:
        columns = [root.column(p) for p in limb if not isinstance(p, SideBySide)]
        (chart,) = extensors(root, columns, 5, library)
        systems.append(spanning_wrenches(root, chart, height_of(limbs), 5, library))
    turns = (0, 2 * math.pi / 3, -2 * math.pi / 3)
    return systems, [(math.cos(t), math.sin(t), 0.0) for t in turns]


def test_arms_allow_turning_about_their_shoulders_at_every_posture() -> None:
    """First come the lines through two shoulders, which two arms allow each."""
    systems, shoulders = three_arms()
    case = sk.load("three_arms").assembly
    root = case.root(case.common_twists.ring)
    screws = standing_screws(root, systems)
    assert screws is not None
    names = {"x0": 1.0, "x1": 0.3, "r3": math.sqrt(3)}
    seen = set()
    for screw in screws[:3]:
        numbers = np.array([value(str(x).replace("^", "**"), names) for x in screw])
        through = [
            k
            for k, at in enumerate(shoulders)
            if np.allclose(np.cross(at, numbers[:3]), numbers[3:], atol=1e-9)
        ]
        seen.add(tuple(through))
    assert seen == {(0, 1), (0, 2), (1, 2)}


def test_works_on_these_lines_are_factors_of_a_minor() -> None:
    """Minors vanish together where the three forces are dependent: in one pencil."""
    systems, shoulders = three_arms()
    case = sk.load("three_arms").assembly
    root = case.root(case.common_twists.ring)
    ring, library = root.ring, case.library(root.ring)
    at = root.points[0]
    minors = standing_minors(root, systems, at, (10**6, 10**4), library)
    products = [m for m in minors if len(factor(ring, m, library).factors) == 3]
    assert products
    flat = _direction_angles(shoulders, (0.3, 0.2, 0.0))
    skew = _direction_angles(shoulders, (0.3, 0.2, 0.7))
    for angles, lost in ((flat, True), (skew, False)):
        sizes = [abs(value(str(m), _generators(ring, angles))) for m in minors]
        assert (max(sizes) < 1e-9) is lost


def _direction_angles(
    shoulders: list[tuple[float, ...]], target: tuple[float, ...]
) -> dict[str, float]:
    """Angles 1 and 2 that lead the third axis of each arm to a point.

    An arm is turned to its place, leant by the angle whose tangent is 3/4; the third
    axis is what the first two turn.
    """
    found = {}
    lean = math.atan(3 / 4)
    for arm, at in zip("ABC", shoulders, strict=True):
        x, y, z = np.array(target) - np.array(at)
        turn = math.atan2(at[1], at[0])
        x, y = (
            x * math.cos(turn) + y * math.sin(turn),
            y * math.cos(turn) - x * math.sin(turn),
        )
        y, z = (
            y * math.cos(lean) + z * math.sin(lean),
            z * math.cos(lean) - y * math.sin(lean),
        )
        found[f"q{arm}1"] = math.atan2(y, x)
        found[f"q{arm}2"] = math.atan2(math.hypot(x, y), -z)
    return found


def _generators(ring: TrigonometricRing, angles: dict[str, float]) -> dict[str, float]:
    """Values of the ring's generators, by their internal names."""
    found = {"x0": 1.0, "x1": 0.3, "r3": math.sqrt(3)}
    for number, ((name, _),) in enumerate(ring.basis):
        turned = angles.get(name, 0.4)
        found |= {f"s{number}": math.sin(turned), f"c{number}": math.cos(turned)}
    return found


def test_a_part_of_a_component_is_told_from_a_component() -> None:
    """A further condition makes a piece smaller; the locus around it is as before."""
    assembly = sk.load("dual_planar_arm").assembly
    limbs = [told_parts(assembly, limb) for limb in assembly.limbs]
    ring, height = assembly.common_twists.ring, height_of(limbs)
    root, library = assembly.root(ring), assembly.library(ring)
    strata = [
        in_ring(limb_strata(assembly, limb), assembly.limb_twists[limb.name].ring, ring)
        for limb in assembly.limbs
    ]
    (component,) = loop_drop(root, limbs, strata, Search(library)).pieces
    whole = component.branches[0]
    columns = loop_columns(limbs, height)
    assert component.codimension == 4  # all bars in one line
    assert codimension_around(ring, columns, 4, whole.points[0]) == 4
    free = next(s for s in ring.sines if whole.value(s) not in (0, 1, -1))
    part = restricted(whole, whole.value(free))[0]
    assert rank_at(columns, *part.points[0]) == 2
    assert codimension_around(ring, columns, 5, part.points[0]) == 4


def test_a_search_that_ends_on_a_part_does_not_list_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It says instead how large the component is that it has not found."""

    def missing(branch: Branch, *others: Any, **options: Any) -> Dependence:
        """The zeros, each with one more condition."""
        zeros = dependent_zeros(branch, *others, **options)
        parts = []
        for whole in zeros.branches:
            sines = (s for s in whole.ring.sines if whole.value(s) not in (0, 1, -1))
            free = next(sines)
            parts += restricted(whole, whole.value(free))
        return replace(zeros, branches=tuple(parts))

    monkeypatch.setattr("screwkit.loci.either_way.dependent_zeros", missing)
    answer = sk.singularities(sk.load("dual_planar_arm")).constraint
    assert not answer.complete
    assert not answer.components
    assert "components of codimension 4 of which parts were found" in answer.reason


def test_what_is_left_is_placed_by_the_conditions_of_the_limbs() -> None:
    """Short conditions are written; long ones and those beyond three are counted."""
    assembly = sk.load("dual_planar_arm").assembly
    ring = assembly.common_twists.ring
    a, b = (ring.cosine_sine(name)[1] for name in ("qA2", "qB2"))
    assert (
        lying_where(ring, [[a, -b]]) == "they lie where sin(qA2) = 0 and sin(qB2) = 0"
    )
    assert lying_where(ring, [[], [a]]) == (
        "they lie where no limb is singular, or where sin(qA2) = 0"
    )
    assert lying_where(ring, [[a]] * 5).endswith(
        "or where 2 other sets of conditions hold"
    )
    assert lying_where(ring, [[a] * 40]) == ""
