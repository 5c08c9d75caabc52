"""Bodies without a freedom between them are a mechanism too: all is answered."""

from __future__ import annotations

from pathlib import Path

import pytest

import screwkit as sk

HEAD = """screwkit: 1
name: solid
title: Bodies that are fixed to each other
geometry: posture
base: ground
platform: top
"""
LOOP = """links: [ground, middle, top]
joints:
  - {name: a, type: fixed, parent: ground, child: middle}
  - {name: b, type: fixed, parent: middle, child: top}
  - {name: c, type: fixed, parent: top, child: ground}
"""
CHAIN = """links: [ground, top]
joints:
  - {name: a, type: fixed, parent: ground, child: top}
"""


@pytest.fixture(params=[LOOP, CHAIN], ids=["loop", "chain"])
def solid(request: pytest.FixtureRequest, tmp_path: Path) -> sk.Case:
    path = tmp_path / "solid.yaml"
    path.write_text(HEAD + request.param, encoding="utf-8")
    return sk.load(path)


def test_nothing_moves(solid: sk.Case) -> None:
    found = sk.mobility(solid)
    assert found.instantaneous_mobility == 0
    assert found.full_cycle.status == "proved"
    assert found.full_cycle.mobility == (0,)


def test_no_limb_has_a_freedom_to_lose(solid: sk.Case) -> None:
    found = sk.singularities(solid)
    for limb in found.limb:
        assert (limb.generic_rank, limb.complete, limb.components) == (0, True, ())
    assert "no freedom" in str(found)
    assert "never: it has no freedom to lose" in str(found)


def test_the_one_scheme_actuates_nothing(solid: sk.Case) -> None:
    found = sk.schemes(solid)
    assert (found.size, found.total, found.admissible) == (0, 1, 1)


def test_there_is_one_configuration(solid: sk.Case) -> None:
    assert "1 configuration" in str(sk.reach(solid))
