"""Pictures and words of measured grasps: reproducible, to scale, safe with any name."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reports.schema_reading import fits

import screwkit as sk
from screwkit.errors import ScrewkitError
from screwkit.reports.draw_map import map_picture
from screwkit.reports.draw_print import picture
from screwkit.reports.figures import Form
from screwkit.reports.panels import Panel, panels_of
from screwkit.reports.records import (
    Result,
    from_json,
    json_schema_of_results,
    to_json,
)
from screwkit.reports.sections import answer_blocks
from screwkit.reports.text import render
from screwkit.results.manipulability import Manipulability
from screwkit.results.scene import BodyShape, JointShape, Scene

MAGIC = {"pdf": b"%PDF", "svg": b"<?xml", "png": b"\x89PNG"}
HOSTILE = r"a$_{x}^\%&#~<b>é"
CASES = ["five_bar_15", "dual_planar_3r", "hand_three_hard", "scara_pair_hard"]


@cache
def measured(name: str) -> Manipulability:
    return sk.manipulability(sk.load(name))


@pytest.mark.parametrize("form", MAGIC)
@pytest.mark.parametrize("name", ["dual_planar_3r", "hand_three_hard"])
def test_the_same_picture_is_the_same_file(name: str, form: Form) -> None:
    panels = panels_of(measured(name))
    first = picture(panels, form)
    assert first.startswith(MAGIC[form])
    assert first == picture(panels, form)


@pytest.mark.parametrize("role", ["platform", "link"])
def test_outlines_do_not_cross_themselves(role: str) -> None:
    """Contacts at the corners of a square, listed crosswise: the shoelace area is 4."""
    corners = ((-1.0, 1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, -1.0))
    body = BodyShape("b", tuple((x, y, 0.0) for x, y in corners), role)
    joint = JointShape("j", "contact", (-1.0, 1.0, 0.0), (0.0, 0.0, 0.0), False)
    scene = Scene((body,), (joint,), True, (0.0, 0.0, 0.0), 2.0)
    drawn = picture([Panel("p", scene, (), "")], "svg").decode()
    areas = []
    for path in re.findall(r'<path d="(M [^"]*)"', drawn):
        ends = [float(x) for x in re.findall(r"-?\d+\.?\d*", path)]
        xy = np.reshape(ends, (-1, 2)) if len(ends) in (8, 10) else np.zeros((1, 2))
        x, y = xy.T
        wide = np.ptp(x) * np.ptp(y)
        twice = abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1)))
        areas.append((wide, twice / 2 / wide if wide else 0.0))
    # Page and axes are full rectangles; the body is the next in size.
    sizes = sorted({round(area, 3): full for area, full in areas}.items())
    assert [full for _, full in sizes[-3:]] == pytest.approx([1, 1, 1])


@pytest.mark.parametrize("name", CASES)
def test_half_axes_are_to_scale(name: str) -> None:
    """Within a panel every ellipse has one scale; lengths are those of the answer."""
    answer = measured(name)
    panels = panels_of(answer)
    assert panels
    for panel in panels:
        longest = max(
            float(np.linalg.norm(axis)) for e in panel.ellipses for axis in e.axes
        )
        assert 0.2 * panel.scene.size < longest < 0.5 * panel.scene.size
    if not hasattr(answer.cooperative, "arms"):
        velocity = [np.linalg.norm(axis) for axis in panels[0].ellipses[0].axes]
        wanted = np.array(answer.translation.semi_axes)
        found = np.array(sorted(velocity, reverse=True))
        assert np.allclose(found / found[0], wanted[: len(found)] / wanted[0])


def test_two_arms_get_the_four_panels_of_the_paper() -> None:
    titles = [panel.title for panel in panels_of(measured("dual_planar_3r"))]
    assert titles == [
        "external force",
        "absolute velocity",
        "internal force",
        "relative velocity",
    ]


@pytest.mark.parametrize("form", MAGIC)
def test_any_name_can_be_drawn(form: Form) -> None:
    answer = measured("dual_planar_3r")
    assert answer.scene is not None
    scene = replace(
        answer.scene,
        joints=tuple(replace(j, name=HOSTILE) for j in answer.scene.joints),
        bodies=tuple(replace(b, name=HOSTILE) for b in answer.scene.bodies),
        unit=HOSTILE,
    )
    panels = panels_of(replace(answer, scene=scene))
    assert picture(panels, form).startswith(MAGIC[form])


@pytest.mark.parametrize("form", MAGIC)
def test_maps_of_one_and_of_two_symbols(form: Form) -> None:
    x = np.linspace(0, 1, 5)
    curve = map_picture(["x"], [x.tolist()], (x**2).tolist(), "index", form)
    values = np.outer(x, x + 1)
    values[2, 2] = np.inf
    level = map_picture(
        ["x", HOSTILE], [x.tolist(), x.tolist()], values.tolist(), "i", form, (0.5, 1)
    )
    assert curve.startswith(MAGIC[form])
    assert level.startswith(MAGIC[form])
    assert level == map_picture(
        ["x", HOSTILE], [x.tolist(), x.tolist()], values.tolist(), "i", form, (0.5, 1)
    )
    with pytest.raises(ScrewkitError):
        map_picture(["x", "y", "z"], [x.tolist()] * 3, [[0.0]], "index", form)


@pytest.mark.parametrize("name", CASES)
def test_the_words_have_the_numbers(name: str) -> None:
    answer = measured(name)
    text = render(answer_blocks(answer))
    partition = answer.partition
    assert (
        f"mobility {partition.mobility}, connectivity {partition.connectivity}" in text
    )
    for value in (*answer.kinematic.finite[:1], *answer.force.finite[:1]):
        assert f"{value:.6f}"[:4].rstrip("0").rstrip(".") in text
    assert "None" not in text
    assert "nan" not in text.lower().split()


def answers(folder: Path) -> list[Any]:
    reached = sk.reach(sk.load("dual_planar_3r"), (1.1, 1.3), {"a3": 0, "b3": 0})
    swept = sk.sweep(sk.load("stewart_alpha_beta"), ["alpha=0:1:3", "beta=0.1:1:2"])
    return [*map(measured, CASES), reached, swept.answer]


def test_documents_read_back_and_fit_their_schema(tmp_path: Path) -> None:
    definitions = json_schema_of_results()["$defs"]
    for result in answers(tmp_path):
        known: Result = result
        data = json.loads(json.dumps(to_json(known)))
        assert from_json(data) == known
        assert fits(definitions[type(known).__name__], data, definitions)
