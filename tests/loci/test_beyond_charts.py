"""Strata where the divisors of a sheet vanish.

A Tripteron with a hinge on its platform: limb i keeps the platform from turning about
two axes, and where its bars are in line it pushes along them.  The loops depend where
these forces do: two along one line, or three in one plane, all of them found by hand.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from math import atan2, cos, pi, sin

import numpy as np
from loci.numeric import limb_columns, value
from loci.tripterons import TRIPTERON_WITH_A_HINGE

from screwkit.algebra.polynomial_text import equation_text
from screwkit.analyses.singularities import constraint_singularities
from screwkit.case import load_text
from screwkit.loci.strata import limb_strata
from screwkit.results.singularities import ConstraintSingularities


@cache
def found() -> ConstraintSingularities:
    return constraint_singularities(load_text(TRIPTERON_WITH_A_HINGE).assembly)


def postures(x: float, y: float, z: float, s: float, t: float) -> Iterator[list[float]]:
    """One in each of seven families, as x, y, z, s1, s2, s3."""
    yield [2, 2, z, pi / 2, 0, t]  # limbs 1 and 2 push along z
    yield [2, y, 2, 0, t, -pi / 2]  # 1 and 3 along y
    yield [x, 2, 2, t, pi / 2, pi]  # 2 and 3 along x
    yield [x, 2, z, pi / 2, atan2(x - 2, z - 2), 0]  # normal to y, all three
    yield [2, y, z, atan2(z - 2, y - 2), pi, pi / 2]  # normal to x
    yield [x, y, 2, 0, -pi / 2, atan2(y - 2, x - 2)]  # normal to z
    yield [2, 2, 2, s, t, atan2(-cos(s) * cos(t), sin(s) * sin(t))]


def pushing(x: float, y: float, z: float, *bars: float) -> list[list[float]]:
    """Along the bars of limbs in which they are in line with the platform's point."""
    s1, s2, s3 = bars
    along = [
        ([0, cos(s1), sin(s1)], [0, y - 2, z - 2]),
        ([sin(s2), 0, cos(s2)], [x - 2, 0, z - 2]),
        ([cos(s3), sin(s3), 0], [x - 2, y - 2, 0]),
    ]
    return [bar for bar, arm in along if np.linalg.norm(np.cross(bar, arm)) < 1e-9]


def test_forces_of_stretched_limbs_depend_on_seven_components() -> None:
    names = ("x", "y", "z", "s1", "s2", "s3")
    assert found().complete
    assert len(found().components) == 7
    met = set()
    for numbers in postures(0.7, -1.3, 0.4, 0.6, 1.1):
        forces = pushing(*numbers)
        assert np.linalg.matrix_rank(forces, 1e-9) == len(forces) - 1
        at = dict(zip(names, numbers, strict=True))
        (own,) = (
            number
            for number, component in enumerate(found().components)
            if all(abs(value(e, at)) < 1e-9 for e in component.equations)
        )
        met.add(own)
    assert len(met) == 7


SNAKE = """
screwkit: 1
name: snake
base: base
platform: head
links: [base, b1, b2, b3, b4, b5, head]
geometry: mdh
parameters: {l: {value: 1, positive: true}}
joints:
  - {name: "1", type: revolute, parent: base, child: b1, mdh: {alpha: -pi/2}}
  - {name: "2", type: revolute, parent: b1, child: b2, mdh: {alpha: pi/2, d: l}}
  - {name: "3", type: revolute, parent: b2, child: b3, mdh: {alpha: -pi/2, d: l}}
  - {name: "4", type: revolute, parent: b3, child: b4, mdh: {alpha: pi/2, d: l}}
  - {name: "5", type: revolute, parent: b4, child: b5, mdh: {alpha: -pi/2, d: l}}
  - {name: "6", type: revolute, parent: b5, child: head, mdh: {alpha: pi/2, d: l}}
"""


def test_a_straight_arm_is_on_a_stratum_of_its_own_rank() -> None:
    """No twist is along the arm, and none turns about it."""
    case = load_text(SNAKE)
    mechanism, (limb,) = case.mechanism, case.assembly.limbs
    ring = case.assembly.limb_twists[limb.name].ring
    strata = limb_strata(case.assembly, limb)
    at = {f"q{k}": 0.0 for k in range(1, 7)} | {"l": 0.8}
    twists = limb_columns(mechanism, limb.chain, at)
    assert np.linalg.matrix_rank(twists, 1e-9) == 4
    assert strata.complete
    ranks = [
        own.rank
        for own in strata.strata
        if all(abs(value(equation_text(ring, e), at)) < 1e-9 for e in own.equations)
    ]
    assert min(ranks) == 4
