"""Measured grasps in words, in TeX, in a page and as documents, from files alone."""

from __future__ import annotations

import json
import re
from functools import cache
from math import pi
from pathlib import Path

import numpy as np
import pytest
from grasping.cooperating import REFERENCE

import screwkit as sk
from screwkit.reports import latex, page
from screwkit.reports.article_manipulability import manipulability_section
from screwkit.reports.draw_print import picture
from screwkit.reports.panels import panels_of
from screwkit.reports.records import from_json, to_json
from screwkit.reports.sections import answer_blocks
from screwkit.reports.text import render
from screwkit.results.manipulability import Cooperative, Manipulability

PUBLISHED = json.loads((REFERENCE / "cooperating.json").read_text(encoding="utf-8"))[
    "cases"
]["bicchi_prattichizzo_fivebar"]
FIVE_BARS = {
    "five_bar_15": "actuated_15",
    "five_bar_24": "actuated_24",
    "five_bar_all": "actuated_12345",
}
NAME = r"\input{x} $_^%&#~{}<b>&amp;é"
HAND = """screwkit: 1
name: hand
title: 'TITLE'
units: 'mm & <i>'
{space}geometry: posture
base: 'palm NAME'
platform: 'ball NAME'
links: ['palm NAME', 'l NAME', 'r NAME', 'ball NAME']
joints:
  - {{name: '1 NAME', type: revolute, parent: 'palm NAME', child: 'l NAME', {first}}}
  - {{name: '2 NAME', type: prismatic, parent: 'palm NAME', child: 'r NAME', {second}}}
  - {{name: 'c NAME', type: hard_finger, parent: 'l NAME', child: 'ball NAME', {third}}}
  - {{name: 'd NAME', type: hard_finger, parent: 'r NAME', child: 'ball NAME', {last}}}
actuated: ['1 NAME', '2 NAME']
limbs: {{'left NAME': ['1 NAME', 'c NAME'], 'right NAME': ['2 NAME', 'd NAME']}}
"""
PLACES = {
    "spatial": (
        "axis: [0, 0, 1], point: [0, 0, 0]",
        "axis: [1, 2, 2]",
        "point: [1, 0, 1], normal: [1, 0, 0]",
        "point: [3, 1, 1], normal: [0, 1, 0]",
    ),
    "planar": (
        "point: [0, 0]",
        "axis: [3, 4]",
        "point: [1, 0]",
        "point: [3, 1]",
    ),
}


@cache
def measured(name: str) -> Manipulability:
    return sk.manipulability(sk.load(name))


def hostile(folder: Path, space: str) -> Manipulability:
    first, second, third, last = PLACES[space]
    text = HAND.format(
        space="space: planar\n" if space == "planar" else "",
        first=first,
        second=second,
        third=third,
        last=last,
    )
    path = folder / "hand.yaml"
    path.write_text(text.replace("NAME", NAME).replace("TITLE", NAME), encoding="utf-8")
    return sk.manipulability(sk.load(path))


@pytest.mark.parametrize("name", FIVE_BARS)
def test_the_digits_of_the_paper_are_there(name: str) -> None:
    """As printed, after rounding: 9.74, 0.51 for the bar driven at its base."""
    text = render(answer_blocks(measured(name)))
    printed = PUBLISHED[FIVE_BARS[name]]["published"]
    numbers = [float(x) for x in re.findall(r"(?<![\w.])\d+\.\d{3,}", text)]
    wanted = [*printed["kin"], *printed.get("internal", ())]
    for value in wanted:
        digits = len(str(value).partition(".")[2])
        assert value in [round(x, digits) for x in numbers], value


def test_the_answer_of_the_five_bar_in_words() -> None:
    text = render(answer_blocks(measured("five_bar_15")))
    for said in (
        "mobility 2, connectivity 2, redundancy 0, indeterminacy 0",
        "actuated: 1, 5; passive: 2, 3, 4",
        "exactly: x² − 41 x/4 + 5 = 0",
        "balanced without torque: (0, 2; −1)",
        "and 1 infinite for structural wrenches",
        "1 m counts as 1 rad",
    ):
        assert said in " ".join(text.split()), said
    for word in ("nan", "None", "inf "):
        assert word not in text


def test_formulas_are_set_as_formulas() -> None:
    source = latex.render(manipulability_section(measured("five_bar_all")))
    assert r"x^{2} - \frac{7\,x}{10} + \frac{1}{15} = 0" in source
    assert r"\frac{7}{20} + \frac{\sqrt{201}}{60}" in source
    assert r"\frac{74}{675}" in source
    assert source.isascii()
    assert source.count(r"\begin{table}") == source.count(r"\end{table}") >= 2
    assert len(re.findall(r"\\label\{", source)) == len(
        set(re.findall(r"\\label\{[^}]*\}", source))
    )


@pytest.mark.parametrize("space", PLACES)
def test_hostile_names_are_text_everywhere(tmp_path: Path, space: str) -> None:
    answer = hostile(tmp_path, space)
    blocks = (*answer_blocks(answer), *manipulability_section(answer))
    source = latex.render(blocks)
    assert r"\input" not in source.replace(r"\textbackslash{}input", "")
    # What TeX reads as a command is none of the file's.
    plain = re.sub(r"\\[&%$#_{}~^]|\\textbackslash\{\}|\\text\w+\{\}", "", source)
    assert plain.count("{") == plain.count("}")
    whole = page.document("t", "b", (), blocks)
    assert "<b>" not in whole
    assert "<i>" not in whole
    assert "&lt;b&gt;" in whole
    assert NAME in " ".join(render(answer_blocks(answer)).split())
    assert picture(panels_of(answer), "svg").startswith(b"<?xml")


@pytest.mark.parametrize("space", PLACES)
def test_documents_hold_any_name(tmp_path: Path, space: str) -> None:
    answer = hostile(tmp_path, space)
    text = json.dumps(to_json(answer), allow_nan=False)
    assert from_json(json.loads(text)) == answer


def test_a_singular_posture_is_a_document() -> None:
    """Infinite values are counted; no number of JSON is infinite or none."""
    singular = sk.load("stewart_alpha_beta", set_values={"beta": "0"})
    answer = sk.manipulability(singular)
    assert answer.kinematic.infinite == 3
    text = json.dumps(to_json(answer), allow_nan=False)
    assert from_json(json.loads(text)) == answer
    said = " ".join(render(answer_blocks(answer)).split())
    assert "infinite in 3 directions" in said


def test_a_map_with_holes_is_a_document_and_a_sentence() -> None:
    """α = β on the diagonal of a square: three postures of nine are singular."""
    ranges = [f"{name}=0:{pi / 6!r}:3" for name in ("alpha", "beta")]
    found = sk.sweep(sk.load("stewart_alpha_beta"), ranges, "kinematic.max")
    assert np.isinf(np.diag(found.values)).all()
    assert found.answer.singular == 3
    assert list(found.answer.numbers).count(None) == 3
    text = json.dumps(to_json(found.answer), allow_nan=False)
    assert from_json(json.loads(text)) == found.answer
    said = render(answer_blocks(found.answer))
    assert "3 points are infinite: the actuators do not hold the platform" in said


@pytest.mark.parametrize("name", ["dual_puma", "hand_three_hard", "stewart_alpha_beta"])
def test_half_axes_in_space_span_the_ellipsoids(name: str) -> None:
    """Σ a aᵀ over the half-axes of a panel is the ellipsoid's matrix, to its scale."""
    answer = measured(name)
    panels = panels_of(answer)
    cooperative = answer.cooperative
    if isinstance(cooperative, Cooperative):
        wanted = {
            "external force": cooperative.external_force,
            "absolute velocity": cooperative.absolute_velocity,
        }
        vectors = {key: np.array(e.linear) for key, e in wanted.items()}
    else:
        vectors = {
            title: np.array(e.semi_axes)[:, None] * np.array(e.directions)
            for title, e in (
                ("velocity for unit rates", answer.translation),
                ("force for unit torques", answer.forces),
            )
        }
    seen = 0
    for panel in panels:
        if panel.title not in vectors:
            continue
        (system,) = (e for e in panel.ellipses if e.role == "system")
        own, given = np.array(system.axes), vectors[panel.title]
        assert np.allclose(system.centre, answer.point)
        drawn, shape = own.T @ own, given.T @ given
        assert np.allclose(drawn / np.trace(drawn), shape / np.trace(shape))
        crossed = own @ own.T
        assert np.allclose(crossed, np.diag(np.diag(crossed)), atol=1e-9)
        seen += 1
    assert seen == 2
    assert picture(panels, "png").startswith(b"\x89PNG")
