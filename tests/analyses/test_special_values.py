"""Where finite motion at the values of a file is another than in general."""

from __future__ import annotations

from pathlib import Path

import screwkit as sk
from screwkit.results.mobility import Mobility, SpecialValues

FOUR_BAR = """
screwkit: 1
name: four_bar
geometry: posture
base: g
platform: b
links: [g, a, b, c]
parameters: {parameters}
joints:
  - {{name: A, type: revolute, parent: g, child: a, point: [0, 0, 0], axis: [0, 0, 1]}}
  - {{name: B, type: revolute, parent: a, child: b, point: {b}, axis: [0, 0, 1]}}
  - {{name: C, type: revolute, parent: b, child: c, point: {c}, axis: [0, 0, 1]}}
  - {{name: D, type: revolute, parent: c, child: g, point: {d}, axis: [0, 0, 1]}}
"""


def both(folder: Path, **places: str) -> tuple[Mobility, SpecialValues]:
    path = folder / "case.yaml"
    path.write_text(FOUR_BAR.format(**places))
    answer = sk.mobility(sk.load(path))
    assert answer.at_values is not None
    return answer, answer.at_values


def test_a_four_bar_that_is_stretched_to_its_full_length_rests(tmp_path: Path) -> None:
    """With h = 0 the ground is as long as the three bars together."""
    general, special = both(
        tmp_path, parameters="{h: 0}", b="[1, h, 0]", c='[3, "2*h", 0]', d="[6, 0, 0]"
    )
    assert general.full_cycle.mobility == (1,)
    assert special.full_cycle.mobility == (0,)
    assert "the finite mobility is 0, in general 1" in special.differences


def test_only_a_parallelogram_translates(tmp_path: Path) -> None:
    """Four joints in one line: branches cross for all lengths.

    Where opposite bars are as long as each other, one of them translates the coupler.
    """
    general, special = both(
        tmp_path,
        parameters="{p: 1, q: 4, r: 3}",
        b="[p, 0, 0]",
        c="[q, 0, 0]",
        d="[r, 0, 0]",
    )
    assert general.platform.finite_motion_types == ("0T1R",)
    assert special.platform.finite_motion_types == ("0T1R", "1T0R")
    assert any("finite motion type" in text for text in special.differences)


CONCURRENT = """
screwkit: 1
name: concurrent
geometry: posture
base: g
platform: t
links: [g, a, b, c, t]
parameters: {e: 0}
joints:
  - {name: f0, type: revolute, parent: g, child: a, point: [3, 0, 0], axis: [0, 0, 1]}
  - {name: h0, type: revolute, parent: a, child: t, point: [1, 0, 0], axis: [0, 0, 1]}
  - {name: f1, type: revolute, parent: g, child: b, point: [0, 5, 0], axis: [0, 0, 1]}
  - {name: h1, type: revolute, parent: b, child: t, point: [0, 2, 0], axis: [0, 0, 1]}
  - {name: f2, type: revolute, parent: g, child: c, point: [-2, -4, 0], axis: [0, 0, 1]}
  - name: h2
    type: revolute
    parent: c
    child: t
    point: ["e - 1", -2, 0]
    axis: [0, 0, 1]
"""


def test_a_shaky_structure_is_told_from_a_rigid_one(tmp_path: Path) -> None:
    """A plate on three bars, whose lines meet in the origin for e = 0."""
    path = tmp_path / "case.yaml"
    path.write_text(CONCURRENT)
    answer = sk.mobility(sk.load(path))
    assert (answer.instantaneous_mobility, answer.full_cycle.mobility) == (0, (0,))
    special = answer.at_values
    assert special is not None
    assert (special.instantaneous_mobility, special.full_cycle.mobility) == (1, (0,))
    assert "the structure is shaky, in general rigid" in special.differences


def test_values_like_any_others_differ_in_nothing(tmp_path: Path) -> None:
    _, special = both(
        tmp_path, parameters="{h: 2}", b="[1, h, 0]", c='[3, "2*h", 0]', d="[6, 0, 0]"
    )
    assert special.differences == ()
