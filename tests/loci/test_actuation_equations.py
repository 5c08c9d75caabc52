"""Equations of an actuation singularity hold where the platform moves, and not beside.

Two limbs with four passive joints: their twists are dependent on a set of codimension
three.  Three conditions that vanish there vanish elsewhere too.
"""

from __future__ import annotations

import math

import pytest
from loci.numeric import values

from screwkit.analyses.singularities import actuation_singularities
from screwkit.case import load_text
from screwkit.results.singularities import ActuationSingularities

LIMBS = """
screwkit: 1
name: two_limbs
geometry: posture
base: base
platform: top
links: [base, k1, k2, k3, k4, top]
parameters: {b: {value: 1/2, positive: true}, h: {value: 6/5, positive: true}}
variables: {phi: {value: 1/5, angle: true}, psi: {value: 3/10, angle: true}, y: 4/5}
pose: {translation: [0, y, 3], rotation: {euler: zyx, angles: [phi, psi, pi/2]}}
points:
  A0: {link: base, at: [-1, h/2, 0]}
  B0: {link: top, at: [1, 0, 0]}
  A1: {link: base, at: [0, 0, -b]}
  B1: {link: top, at: [0, 2, 0]}
vectors:
  e3: [0, 0, 1]
  u: {link: top, at: [0, 1, 0]}
  w: {link: top, at: [1, 0, 0]}
joints:
  - {name: P1, type: prismatic, parent: base, child: k1, axis: [0, 1, 0]}
  - {name: H1, type: helical, parent: k1, child: k2, axis: "cross(B0 - A0, e3)",
     point: [h, 0, -1], pitch: 1}
  - {name: R1, type: revolute, parent: k2, child: top, point: A0, axis: u}
  - {name: P2, type: prismatic, parent: base, child: k3, axis: [1, 1, 0]}
  - {name: H2, type: helical, parent: k3, child: k4, axis: "cross(B1 - A1, e3)",
     point: [3/2, b, -2], pitch: 1/2}
  - {name: R2, type: revolute, parent: k4, child: top, point: A1, axis: w}
actuated: [P1, H2]
"""


@pytest.fixture(scope="module")
def actuation() -> ActuationSingularities:
    assembly = load_text(LIMBS).assembly
    return actuation_singularities(assembly, assembly.mechanism.actuated)


def test_a_regular_posture_is_on_no_component(
    actuation: ActuationSingularities,
) -> None:
    # The axes of H1, R1 and R2 point along [−1, −1, 0], [0, −1, 0] and [0, 0, 1] at
    # this posture where h = 1: three independent directions, and P2 translates. So the
    # four passive twists are independent, and nothing moves.
    posture = {
        "phi": math.pi / 2,
        "psi": -math.pi / 2,
        "y": -0.5,
        "b": 0.7,
        "h": 1.0,
    }
    for component in actuation.components:
        assert max(abs(values(component.equations, posture))) > 1e-3


def test_the_platform_moves_on_the_component(actuation: ActuationSingularities) -> None:
    (component,) = actuation.components
    assert (component.codimension, component.platform_freedom) == (3, 1)
