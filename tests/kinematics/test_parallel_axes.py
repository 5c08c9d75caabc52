"""Sums of angles along parallel axes, in files that say where axes are at zero."""

from __future__ import annotations

from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.case import load_text
from screwkit.kinematics.parallel_axes import parallel_basis
from screwkit.kinematics.placement import joint_twists

ARM = """
screwkit: 1
name: arm
geometry: reference
base: ground
platform: e
links: [ground, a, b, c, d, e]
parameters: {t: {value: 2, positive: true}}
joints:
  - {name: one, type: revolute, parent: ground, child: a, axis: [0, 0, 2],
     point: [0, 0, 0], variable: p}
  - {name: two, type: revolute, parent: a, child: b, axis: [0, 0, -1],
     point: [1, 0, 0], variable: q}
  - {name: slide, type: prismatic, parent: b, child: c, axis: [1, 0, 0], variable: s}
  - {name: three, type: revolute, parent: c, child: d, axis: [0, 0, t],
     point: [2, 0, 0], variable: r}
  - {name: four, type: revolute, parent: d, child: e, axis: [1, 0, 0],
     point: [2, 0, 0], variable: u}
"""


def basis_of(origin: str) -> list[dict[str, int]]:
    mechanism = load_text(ARM).mechanism
    names = [joint.name for joint in mechanism.joints]
    seen = SurveyRing()
    joint_twists(mechanism, seen, mechanism.base)
    found = parallel_basis(mechanism, names, origin, TrigonometricRing(seen))
    return [dict(form) for form in found]


def test_angles_add_up_along_a_run_with_the_senses_of_the_axes() -> None:
    """By hand: the second axis points down; a slide turns nothing."""
    assert basis_of("ground") == [
        {"p": 1},
        {"q": 1, "p": -1},
        # That t is positive is not asked: 2 t says nothing of the sense to a ring.
        {"r": 1},
        {"u": 1},
    ]


def test_a_run_that_is_followed_back_turns_the_other_way() -> None:
    assert basis_of("c") == [{"r": 1}, {"q": 1}, {"u": 1}, {"p": 1, "q": -1}]
