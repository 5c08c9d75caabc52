"""Patterns of singular limbs whose conditions hold on several parts at once."""

from __future__ import annotations

from loci.numeric import value

import screwkit as sk
from screwkit.case import load_text

TWINS = """
screwkit: 1
name: twins
space: planar
geometry: posture
base: base
platform: platform
links: [base, platform, a1, b1, a2, b2, a3, b3]
variables:
  x: 0.3
  y: 0.7
  t1: {value: 2.1, angle: true}
  cx: 2
  cy: -1
  t3: {value: 0.4, angle: true}
pose: {translation: [x, y]}
vectors:
  u1: [cos(t1), sin(t1)]
  u3: [cos(t3), sin(t3)]
points:
  A: [4, 0]
  B: {link: platform, at: [1, 0]}
  O: [0, 0]
  P: {link: platform, at: [0, 0]}
  C1: 2*u1
  C2: [cx, cy]
  C3: A + 2*u3
joints:
  - {name: R11, type: revolute, parent: base, child: a1, point: O}
  - {name: R12, type: revolute, parent: a1, child: b1, point: C1}
  - {name: R13, type: revolute, parent: b1, child: platform, point: P}
  - {name: R21, type: revolute, parent: base, child: a2, point: A}
  - {name: R22, type: revolute, parent: a2, child: b2, point: C2}
  - {name: R23, type: revolute, parent: b2, child: platform, point: B}
  - {name: R31, type: revolute, parent: base, child: a3, point: A}
  - {name: R32, type: revolute, parent: a3, child: b3, point: C3}
  - {name: R33, type: revolute, parent: b3, child: platform, point: B}
"""


def test_two_legs_of_length_zero_beside_two_along_one_line() -> None:
    """By hand: B lies on A, both arms fold there, and O C1 P points to A as well.

    Then three forces go through A, whatever directions the folded arms have.  With the
    first arm bent there are two, and they are independent.
    """
    constraint = sk.singularities(load_text(TWINS)).constraint

    def is_told(t1: float) -> bool:
        at = {"x": 3.0, "y": 0.0, "t1": t1, "cx": -0.9, "cy": 2.5, "t3": -1.75}
        return any(
            max(abs(value(text, at)) for text in one.equations) < 1e-12
            for one in constraint.components
        )

    assert constraint.complete
    assert is_told(0.0)
    assert not is_told(0.6)
