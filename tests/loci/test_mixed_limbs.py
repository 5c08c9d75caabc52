"""A mechanism with one limb that has loops inside and two serial ones, in floats."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from loci.numeric import Array, value, values
from loci.searching import solved
from loci.test_hybrid_loci import At, clear_rank, freedom, mobility

from screwkit.case import load_text
from screwkit.questions import singularities
from screwkit.results.singularities import Component, Singularities

MIXED = """
screwkit: 1
name: mixed
title: Two serial limbs and one with a parallelogram
source: made up
units: m
space: spatial
geometry: posture
base: base
platform: platform
links: [base, platform, sl1, bar1, rp, rm, bar2, s2, t2, s3, t3]
parameters:
  b: {value: 1, positive: true}
  c: {value: 1, positive: true}
variables:
  x: 0
  y: 0
  z: 0
  s1: 5
  s2: 5
  s3: 5
pose: {translation: [x, y, z]}
vectors:
  i: [1, 0, 0]
  j: [0, 1, 0]
  k: [0, 0, 1]
  n1: cross(B1 - S1, j)
points:
  P: {link: platform, at: [0, 0, 0]}
  S1: [-s1, 0, 0]
  S1p: S1 + c*j
  S1m: S1 - c*j
  B1: {link: platform, at: [-b, 0, 0]}
  B1p: B1 + c*j
  B1m: B1 - c*j
  S2: [0, -s2, 0]
  M2: [x/2, -s2/2, z/3]
  B2: {link: platform, at: [0, -b, 0]}
  S3: [0, 0, -s3]
  M3: [x/3, y/2, -s3/2]
  B3: {link: platform, at: [0, 0, -b]}
reference_point: P
joints:
  - {name: P1, type: prismatic, parent: base, child: sl1, axis: i, point: S1}
  - {name: Ra1, type: revolute, parent: sl1, child: bar1, axis: j, point: S1}
  - {name: p1, type: revolute, parent: bar1, child: rp, axis: n1, point: S1p}
  - {name: m1, type: revolute, parent: bar1, child: rm, axis: n1, point: S1m}
  - {name: p2, type: revolute, parent: rp, child: bar2, axis: n1, point: B1p}
  - {name: m2, type: revolute, parent: rm, child: bar2, axis: n1, point: B1m}
  - {name: Rb1, type: revolute, parent: bar2, child: platform, axis: j, point: B1}
  - {name: C2, type: cylindrical, parent: base, child: s2, axis: j, point: S2}
  - {name: R2, type: revolute, parent: s2, child: t2, axis: j, point: M2}
  - {name: E2, type: revolute, parent: t2, child: platform, axis: j, point: B2}
  - {name: C3, type: cylindrical, parent: base, child: s3, axis: k, point: S3}
  - {name: R3, type: revolute, parent: s3, child: t3, axis: k, point: M3}
  - {name: E3, type: revolute, parent: t3, child: platform, axis: k, point: B3}
actuated: [P1, "C2:1", "C3:1"]
"""
FREE = ("x", "y", "z", "s1", "s2", "s3")


@cache
def answer() -> Singularities:
    return singularities(load_text(MIXED))


def drawn(seed: int) -> dict[str, float]:
    source = np.random.default_rng(seed)
    return {each: float(source.uniform(0.4, 1.9)) for each in ("b", "c", *FREE)}


def at(posture: dict[str, float]) -> At:
    return At(load_text(MIXED).mechanism, given=posture)


def on(component: Component) -> dict[str, float]:
    start = drawn(7)

    def residuals(x: Array) -> Array:
        moved = dict(zip(FREE, map(float, x), strict=True))
        return values(component.equations, {**start, **moved})

    found = solved(residuals, np.array([start[each] for each in FREE]))
    assert found is not None
    return {**start, **dict(zip(FREE, map(float, found), strict=True))}


def test_generic_ranks() -> None:
    found, whole = answer(), at(drawn(1))
    assert clear_rank(whole.loop_matrix()) == found.constraint.generic_rank
    assert found.actuation is not None
    assert not freedom(whole.platform(found.actuation.actuated))
    assert [limb.generic_rank for limb in found.limb] == [4, 4, 4]


def test_components_lose_what_is_said() -> None:
    found = answer()
    assert found.constraint.components
    for component in found.constraint.components:
        whole = at(on(component))
        assert clear_rank(whole.loop_matrix()) == component.rank
        assert freedom(whole.platform()) == component.platform_freedom
    assert found.actuation is not None
    parts = [*found.actuation.components, *found.actuation.idle]
    for component in parts:
        whole = at(on(component))
        left = freedom(whole.platform(found.actuation.actuated))
        assert left == component.platform_freedom
        assert mobility(whole, found.actuation.actuated) == component.mobility
    assert [c.platform_freedom for c in parts] == [1, 0, 0, 0]


def test_a_joint_has_an_axis_on_every_component() -> None:
    """n1 = (−z, 0, s1 − b + x): both zero is no posture of the mechanism."""
    found = answer()
    assert found.actuation is not None
    for component in (*found.constraint.components, *found.actuation.components):
        posture = on(component)
        along = value("s1 - b + x", posture)
        assert np.hypot(along, posture["z"]) > 1e-3


@pytest.mark.parametrize("seed", range(3))
def test_regular_postures_lie_on_no_component(seed: int) -> None:
    found = answer()
    assert found.actuation is not None
    for component in (*found.constraint.components, *found.actuation.components):
        assert np.max(np.abs(values(component.equations, drawn(seed)))) > 1e-3
