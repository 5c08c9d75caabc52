"""Bodies that only hang on a mechanism add their freedoms to every mobility."""

from __future__ import annotations

import pytest

import screwkit as sk
from screwkit.case import load_text
from screwkit.results.singularities import Component

FILE = """
screwkit: 1
name: hung
space: spatial
geometry: posture
base: base
platform: coupler
links: [base, crank, coupler, rocker, ball, slider]
variables: {xb: 1, yb: 2, xc: 5, yc: 3}
vectors: {k: [0, 0, 1]}
points: {B: [xb, yb, 0], C: [xc, yc, 0]}
joints:
  - {name: A, type: revolute, parent: base, child: crank, axis: k, point: [0, 0, 0]}
  - {name: B, type: revolute, parent: crank, child: coupler, axis: k, point: B}
  - {name: C, type: revolute, parent: coupler, child: rocker, axis: k, point: C}
  - {name: D, type: revolute, parent: rocker, child: base, axis: k, point: [6, 0, 0]}
  - {name: T, type: spherical, parent: coupler, child: ball, point: [1, 0, 1]}
  - {name: S, type: prismatic, parent: ball, child: slider, axis: [0, 1, 1]}
actuated: [A, S]
"""
ON_A_LINE = {"yb": "0", "yc": "0"}
DEAD_POINT = {"xb": "1", "yb": "2", "xc": "7/2", "yc": "1"}  # B, C and D on a line


def of(components: tuple[Component, ...], text: str) -> Component:
    return next(c for c in components if text in " ".join(c.equations))


def test_components_count_what_mobility_counts() -> None:
    found = sk.singularities(load_text(FILE))
    flat = of(found.constraint.components, "yc")
    # Of the four hinges in one plane two rates are free; ball and slide move besides.
    assert flat.mobility == (4 - 2) + 4
    there = sk.mobility(load_text(FILE, set_values=ON_A_LINE))
    assert there.instantaneous_mobility == flat.mobility
    assert found.actuation is not None
    dead = of(found.actuation.components, "xb*yc")
    # With crank and slide held the rocker's dead point leaves one rate, the ball three.
    assert dead.mobility == 1 + 3
    there = sk.mobility(load_text(FILE, set_values=DEAD_POINT))
    assert there.actuation is not None
    assert there.actuation.remaining_mobility == dead.mobility


def test_strata_count_what_mobility_counts() -> None:
    strata = sk.singularities(load_text(FILE), strata=2).strata
    assert strata is not None
    assert strata.generic.mobility == 1 + 4
    posed = [(s, dict(s.posture)) for s in strata.strata if s.posture]
    assert len(posed) > 3
    for stratum, posture in posed:
        if all(value == int(value) for value in posture.values()):
            values = {name: str(int(value)) for name, value in posture.items()}
            there = sk.mobility(load_text(FILE, set_values=values))
            assert there.instantaneous_mobility == stratum.state.mobility
    assert max(stratum.state.mobility for stratum, _ in posed) == 2 + 4


@pytest.mark.parametrize("case", ["hand_three_hard", "nao_t14"])
def test_check_counts_the_freedoms_that_mobility_counts(
    case: str, capsys: pytest.CaptureFixture[str]
) -> None:
    from screwkit.catalogue import check_case  # noqa: PLC0415

    check_case(case, {}, as_json=False, quiet=False)
    freedoms = sk.mobility(sk.load(case)).topology.freedoms
    assert f" joints with {freedoms} freedoms" in capsys.readouterr().out
