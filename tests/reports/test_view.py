"""The interactive picture: right places, nothing fetched, harmless with any name."""

from __future__ import annotations

import json
import math
import re
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from reports.schema_reading import fits

import screwkit as sk
from screwkit import cli
from screwkit.errors import ScrewkitError, UndecidedError
from screwkit.reports.records import from_json, json_schema_of_results, to_json
from screwkit.reports.view_page import view_page
from screwkit.results.view import PlacedScrew, View

Array = npt.NDArray[np.float64]
CASES = [
    "3rps",
    "3crr",
    "gough_6ups",
    "rhp_screw_jack",
    "hand_three_mixed",
    "five_bar_15",
    "nao_t14",
    "wedge_3p",
    "lone_body",
    "delta_ss",
    "bennett",
    "peaucellier",
]
EVERY_TYPE = """
screwkit: 1
name: every_type
geometry: posture
base: ground
platform: object
links: [ground, a, b, c, d, e, f, g, object]
joints:
  - {name: R, type: revolute, parent: ground, child: a, axis: [0, 0, 2],
     point: [1, 0, 0]}
  - {name: P, type: prismatic, parent: a, child: b, axis: [0, 3, 4], point: [2, 0, 0]}
  - {name: H, type: helical, parent: b, child: c, axis: [0, 2, 0], point: [3, 0, 1],
     pitch: 1/4}
  - {name: C, type: cylindrical, parent: c, child: d, axis: [1, 0, 0], point: [4, 1, 0]}
  - {name: U, type: universal, parent: d, child: e, axes: [[1, 0, 0], [0, 1, 0]],
     point: [5, 0, 0]}
  - {name: S, type: spherical, parent: e, child: f, point: [6, 0, 0]}
  - {name: E, type: planar, parent: f, child: g, normal: [0, 0, 1], point: [7, 0, 0]}
  - {name: F, type: fixed, parent: g, child: object, point: [8, 0, 0]}
  - {name: k1, type: point, parent: ground, child: object, point: [8, 1, 0],
     normal: [0, 1, 0]}
  - {name: k2, type: hard_finger, parent: ground, child: object, point: [8, 2, 0],
     normal: [0, 0, 1]}
  - {name: k3, type: soft_finger, parent: ground, child: object, point: [8, 3, 0],
     normal: [0, 0, 1]}
  - {name: k4, type: line, parent: ground, child: object, point: [8, 4, 0],
     normal: [0, 0, 1], line: [1, 0, 0]}
  - {name: k5, type: line_friction, parent: ground, child: object, point: [8, 5, 0],
     normal: [0, 0, 1], line: [1, 0, 0]}
  - {name: k6, type: plane, parent: ground, child: object, point: [8, 6, 0],
     normal: [0, 0, 1]}
  - {name: k7, type: complete, parent: ground, child: object, point: [8, 7, 0]}
actuated: [R]
"""


class Reading(HTMLParser):
    """Elements in order, and whether every one is closed where it has to be."""

    VOID = frozenset({"meta", "input", "br"})

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.texts: list[tuple[str, str]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open:
            self.texts.append((self.open[-1], data))

    def cells(self) -> list[str]:
        return [text for tag, text in self.texts if tag == "td"]

    def shapes(self) -> Any:
        scripts = [text for tag, text in self.texts if tag == "script"]
        return json.loads(scripts[0])


def read(page: str) -> Reading:
    reading = Reading()
    reading.feed(page)
    reading.close()
    assert not reading.open
    return reading


@cache
def seen(name: str) -> View:
    return sk.view(sk.load(name))


def written(tmp_path: Path, text: str) -> sk.Case:
    path = tmp_path / "written.yaml"
    path.write_text(text, encoding="utf-8")
    return sk.load(path)


@pytest.mark.parametrize("name", CASES)
def test_the_page_is_whole_and_names_every_joint_and_body(name: str) -> None:
    answer = seen(name)
    page = view_page(answer)
    reading = read(page)
    mechanism = sk.load(name).mechanism
    cells, items = reading.cells(), reading.shapes()["items"]
    labels = {
        group: {
            part
            for item in items
            if item["type"] == "Label" and item["group"] == group
            for part in item["text"].split(", ")
        }
        for group in ("joint names", "link names")
    }
    for joint in mechanism.joints:
        assert joint.name in cells
        assert joint.name in labels["joint names"]
    for link in mechanism.links:
        assert link in cells
        assert link in labels["link names"]
    coordinates = [
        x for item in items for x in np.ravel(item.get("points", item["at"]))
    ]
    assert all(math.isfinite(x) for x in coordinates if x is not None)


@pytest.mark.parametrize("name", ["3rps", "nao_t14"])
def test_nothing_is_fetched(name: str) -> None:
    page = view_page(seen(name))
    assert not re.search(r"https?:|//[a-z]|url\(|@import|fetch|XMLHttp|import\(", page)
    reading = read(page)
    attributes = {key for _, attrs in reading.elements for key in attrs}
    assert not attributes & {"src", "href", "srcset", "action", "data", "onload"}
    tags = [tag for tag, _ in reading.elements]
    assert not set(tags) & {"link", "img", "iframe", "object", "embed", "base", "form"}
    (policy,) = (
        attrs["content"]
        for tag, attrs in reading.elements
        if tag == "meta" and "http-equiv" in attrs
    )
    assert policy is not None
    assert policy.startswith("default-src 'none';")


def test_spherical_joints_stand_where_the_pose_puts_them() -> None:
    """The platform's points, by the rotation matrix of the file's angle."""
    turn, shift = 0.7, np.array([0.5, -0.25, 5.0])
    own = {
        "S13": (2, -1, 0),
        "S23": (2, 2, 0),
        "S33": (-2, 2, 0),
        "S43": (-2, -1, 1),
        "S53": (0, -2, 0),
        "S63": (1, -2, 0),
    }
    at = {"phi": "0.7", "x": "0.5", "y": "-0.25", "z": "5"}
    answer = sk.view(sk.load("gough_6sps", at=at))
    c, s = math.cos(turn), math.sin(turn)
    rotation = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    wanted = [rotation @ point + shift for point in np.array(list(own.values()))]
    items = read(view_page(answer)).shapes()["items"]
    balls = np.array([item["at"] for item in items if item["type"] == "Ball"])
    for point in wanted:
        assert np.linalg.norm(balls - point, axis=1).min() < 1e-12
    outline = next(
        item["points"]
        for item in items
        if item["type"] == "Stroke"
        and item["group"] == "links"
        and len(item["points"]) == 6
        and item["points"][0][2] > 3
    )
    assert {tuple(np.round(p, 9)) for p in outline} == {
        tuple(np.round(p, 9)) for p in wanted
    }


def faces(items: list[dict[str, Any]], at: tuple[float, ...]) -> list[Array]:
    """The polygons of the mark at a point."""
    return [
        np.array(item["points"])
        for item in items
        if item["type"] == "Stroke" and item["closed"] and item["at"] == list(at)
    ]


def test_marks_follow_the_axes_of_the_file(tmp_path: Path) -> None:
    """Cylinders have their ends across the axis and their middle on the point."""
    answer = sk.view(written(tmp_path, EVERY_TYPE))
    items = read(view_page(answer)).shapes()["items"]
    for at, axis in (
        ((1, 0, 0), (0, 0, 1)),
        ((2, 0, 0), (0, 0.6, 0.8)),
        ((3, 0, 1), (0, 1, 0)),
        ((4, 1, 0), (1, 0, 0)),
        ((7, 0, 0), (0, 0, 1)),
    ):
        polygons = faces(items, at)
        ends = [p.mean(axis=0) for p in polygons[:2]]
        assert np.allclose(ends[0], -ends[1])
        unit = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        assert np.allclose(unit, axis)
        heights = {round(float(point @ unit), 9) for p in polygons for point in p}
        assert len(heights) == 2
    cross = [p.mean(axis=0) for p in faces(items, (5, 0, 0)) if len(p) > 4]
    directions = {tuple(np.round(np.abs(p) / np.linalg.norm(p), 9)) for p in cross}
    assert directions == {(1, 0, 0), (0, 1, 0)}
    normals = [
        item["direction"]
        for item in items
        if item["type"] == "Head" and item["group"] == "joints"
    ]
    assert normals == [[0, 1, 0], *[[0, 0, 1]] * 5]  # k1 … k6


def test_driven_joints_are_filled(tmp_path: Path) -> None:
    answer = sk.view(written(tmp_path, EVERY_TYPE))
    assert [f.label for f in answer.freedoms if f.actuated] == ["R"]
    items = read(view_page(answer)).shapes()["items"]
    fills = {
        tuple(item["at"]): item["fill"]
        for item in items
        if item["type"] == "Stroke" and item["closed"] and item["at"]
    }
    assert fills[1, 0, 0] == "#000000"
    assert fills[2, 0, 0] == fills[3, 0, 1] == fills[5, 0, 0] == "#FFFFFF"


def test_one_arm_of_a_universal_joint_is_filled_alone(tmp_path: Path) -> None:
    driven = EVERY_TYPE.replace("actuated: [R]", 'actuated: ["U:1"]')
    items = read(view_page(sk.view(written(tmp_path, driven)))).shapes()["items"]
    rings = [
        (np.abs(np.mean(item["points"], axis=0)).argmax(), item["fill"])
        for item in items
        if item["type"] == "Stroke"
        and item["closed"]
        and item["at"] == [5, 0, 0]
        and len(item["points"]) > 4
    ]
    assert {(int(k), fill) for k, fill in rings} == {(0, "#FFFFFF"), (1, "#000000")}


def test_a_contact_that_was_moved_takes_its_normal_along() -> None:
    """In the finger, normal and link keep the angle that they have in the file."""
    moved = sk.view(sk.load("hand_three_mixed", at={"qpitch1": "0.1", "qyaw2": "0.2"}))
    assert not moved.posture.exact
    shapes = {shape.name: shape for shape in moved.scene.joints}
    turned = 0
    for k, angle in ((1, 0.0), (2, 2 * math.pi / 3), (3, 4 * math.pi / 3)):
        u = np.array([math.cos(angle), math.sin(angle), 0])
        link = 2 * u - np.array([0, 0, 1])  # B - C
        tip, knee = shapes[f"tip{k}"], shapes[f"knee{k}"]
        normal, now = np.array(tip.direction), np.subtract(knee.point, tip.point)
        assert np.linalg.norm(now) == pytest.approx(np.linalg.norm(link))
        assert normal @ now == pytest.approx(-u @ link)
        assert normal @ knee.direction == pytest.approx(0)
        turned += int(np.linalg.norm(normal + u) > 0.05)
    assert turned


def test_no_scheme_is_shown_where_none_is_declared(tmp_path: Path) -> None:
    free = EVERY_TYPE.replace("actuated: [R]\n", "")
    answer = sk.view(written(tmp_path, free))
    assert not any(f.actuated for f in answer.freedoms)
    assert not any(shape.actuated for shape in answer.scene.joints)


def test_a_helix_keeps_its_pitch_whatever_the_length_of_its_axis(
    tmp_path: Path,
) -> None:
    answer = sk.view(written(tmp_path, EVERY_TYPE))
    (helix,) = (f for f in answer.freedoms if f.joint == "H")
    assert (helix.kind, helix.pitch) == ("screw", 0.25)
    assert helix.direction == (0, 1, 0)


# -- the screws of the platform, by singular values of what the picture shows ---------


def coordinates(screw: Any) -> Array:
    """(direction; moment) of a drawn screw or freedom."""
    direction = np.array(screw.direction)
    if screw.pitch is None:
        return np.concatenate([np.zeros(3), direction])
    moment = np.cross(screw.point, direction) + screw.pitch * direction
    return np.concatenate([direction, moment])


def power(wrench: PlacedScrew, twist: PlacedScrew) -> float:
    f, t = coordinates(wrench), coordinates(twist)
    return float(f[:3] @ t[3:] + f[3:] @ t[:3])


def rank(rows: Array) -> int:
    values = np.linalg.svd(rows, compute_uv=False)
    assert not np.any((values > 1e-10) & (values < 1e-6))  # a margin
    return int((values > 1e-8).sum())


SERIAL = {
    "3rps": [["R11", "P12", "S13"], ["R21", "P22", "S23"], ["R31", "P32", "S33"]],
    "3crr": None,
    "bennett": None,
    "nao_t14": [["1", "2", "3", "4", "5"], ["6", "7", "8", "9", "10"]],
    "five_bar": None,
}


@pytest.mark.parametrize(
    ("name", "at"),
    [
        ("3rps", {"u": "0.2", "v": "-0.1"}),
        ("3crr", {}),
        ("bennett", {}),
        ("nao_t14", {"q2": "0.3", "q4": "0.4", "q6": "0.5", "q9": "-0.7"}),
        ("five_bar", {}),
        ("five_bar", {"qA": "0.25"}),
    ],
)
def test_twists_are_those_of_every_limb_and_wrenches_do_no_work(
    name: str, at: dict[str, str]
) -> None:
    case = sk.load(name, at=at)
    answer = sk.view(case)
    twists = np.array([coordinates(t) for t in answer.twists])
    assert rank(twists) == len(answer.twists)
    assert len(answer.twists) + len(answer.wrenches) == 6
    for wrench in answer.wrenches:
        for twist in answer.twists:
            assert abs(power(wrench, twist)) < 1e-9
    common, limbs = 6, SERIAL[name] or [list(limb.joints) for limb in case.limbs]
    held = []
    for joints in limbs:
        rows = np.array(
            [coordinates(f) for f in answer.freedoms if {f.joint, f.label} & {*joints}]
        )
        assert rank(np.concatenate([rows, twists])) == rank(rows)
        held.append(np.linalg.svd(rows)[2][rank(rows) :])
    common -= rank(np.concatenate(held))
    assert len(answer.twists) == common


def test_a_moved_posture_says_on_what_it_rests() -> None:
    answer = sk.view(sk.load("five_bar", at={"qA": "0.25"}))
    assert not answer.posture.exact
    values = dict(zip(answer.posture.variables, answer.posture.values, strict=True))
    assert abs(values["qA"] - 0.25) < 1e-9
    assert "known in floating point alone" in str(answer)
    assert "known in floating point alone" in view_page(answer)
    assert "floating point" not in str(seen("five_bar_15"))


def test_a_moved_planar_mechanism_keeps_to_its_plane() -> None:
    """Its wrenches are forces of the plane and couples about its normal."""
    answer = sk.view(sk.load("five_bar_15", at={"q1": "0.3"}))
    assert (len(answer.twists), len(answer.wrenches)) == (2, 1)
    (force,) = answer.wrenches
    assert force.kind == "force"
    assert abs(force.direction[2]) < 1e-12
    # The passive joints 2, 3 and 4 bear a force through 2 alone if 1 turns.
    assert all(abs(power(force, twist)) < 1e-12 for twist in answer.twists)


def test_what_may_be_drawn_anywhere_is_drawn() -> None:
    """A grasp without a point stands at its arm, sliding joints alone at the base."""
    points = {shape.name: shape.point for shape in seen("nao_t14").scene.joints}
    assert points["grasp_right"] == points["5"]
    assert points["grasp_left"] == points["10"]
    assert len(seen("wedge_3p").scene.joints) == 3


# -- names, and what is no place for a picture ----------------------------------------


HOSTILE = [
    "<script>alert(1)</script>",
    "</script><img src=x onerror=alert(1)>",
    "<!--<script>",
    "\"'><svg onload=alert(1)>&lt;\\u003c",
]


def test_hostile_names_are_text(tmp_path: Path) -> None:
    one, two, three, four = (json.dumps(name) for name in HOSTILE)
    case = written(
        tmp_path,
        f"""
screwkit: 1
name: hostile
title: {two}
units: {three}
geometry: posture
base: {one}
platform: {two}
links: [{one}, {two}]
joints:
  - {{name: {three}, type: revolute, parent: {one}, child: {two}, axis: [0, 0, 1],
     point: [0, 0, 0]}}
  - {{name: {four}, type: spherical, parent: {one}, child: {two}, point: [1, 0, 0]}}
""",
    )
    page = view_page(sk.view(case))
    reading = read(page)
    tags = [tag for tag, _ in reading.elements]
    assert tags.count("script") == 2
    assert page.count("<script") == page.count("</script") == 2
    assert "<!--" not in page
    assert not {"img", "svg"} & set(tags)
    assert not any(
        "onerror" in attrs or "onload" in attrs for _, attrs in reading.elements
    )
    assert set(HOSTILE) <= set(reading.cells())
    labels = {i["text"] for i in reading.shapes()["items"] if i["type"] == "Label"}
    assert set(HOSTILE) <= labels


def test_the_script_never_parses_text_of_a_file() -> None:
    script = [t for tag, t in read(view_page(seen("3rps"))).texts if tag == "script"][1]
    assert not re.search(r"innerHTML|outerHTML|document\.write|eval|Function\(", script)
    assert len(script.splitlines()) < 200


@pytest.mark.parametrize("name", CASES)
def test_a_view_is_a_document_like_any_other(name: str) -> None:
    answer = seen(name)
    document = json.loads(json.dumps(to_json(answer)))
    assert document["question"] == "view"
    assert from_json(document) == answer
    schema = json_schema_of_results()
    assert fits(schema["$defs"]["View"], document, schema["$defs"])


def test_the_same_view_is_the_same_page() -> None:
    assert view_page(seen("3rps")) == view_page(sk.view(sk.load("3rps")))


def test_an_ending_that_is_no_page_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ScrewkitError, match=r"\.html"):
        sk.view(sk.load("3rps"), tmp_path / "view.pdf")
    assert not list(tmp_path.iterdir())


def test_a_symbol_without_a_value_is_asked_for(tmp_path: Path) -> None:
    case = written(
        tmp_path,
        """
screwkit: 1
name: open
geometry: posture
base: g
platform: b
links: [g, b]
parameters: {a: {positive: true}}
joints:
  - {name: "1", type: revolute, parent: g, child: b, axis: [0, 0, 1], point: [a, 0, 0]}
""",
    )
    with pytest.raises(
        UndecidedError, match="a picture needs numbers, and a has no val"
    ):
        sk.view(case)


# -- the command ----------------------------------------------------------------------


def screwkit(*words: str) -> int:
    with pytest.raises(SystemExit) as left:
        cli.main(["view", *words])
    return int(left.value.code or 0)


def test_the_command_says_where_the_page_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "arm.yaml").write_text(EVERY_TYPE, encoding="utf-8")
    assert screwkit("own/arm.yaml") == 0
    assert "wrote own/every_type_view.html" in capsys.readouterr().out
    assert (folder / "every_type_view.html").is_file()
    assert screwkit("bennett", "--json") == 0
    document = json.loads(capsys.readouterr().out)
    assert document["file"] == "bennett_view.html"
    assert (document["case"], document["question"]) == ("bennett", "view")
    read((tmp_path / "bennett_view.html").read_text(encoding="utf-8"))


def test_the_command_takes_a_posture_and_a_scheme(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = str(tmp_path / "v.html")
    words = ("3rps", "-o", place, "--set", "a=5/2", "--at", "z=4", "--actuated", "R11")
    assert screwkit(*words, "--json") == 0
    document = json.loads(capsys.readouterr().out)
    assert document["given"] == ["a = 5/2", "z = 4"]
    points = {joint["name"]: joint["point"] for joint in document["scene"]["joints"]}
    assert points["R11"] == [2.5, 0, 0]
    assert points["S13"] == [1, 0, 4]
    assert [f["label"] for f in document["freedoms"] if f["actuated"]] == ["R11"]


def test_bad_input_has_the_exit_codes_of_every_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = str(tmp_path / "v.html")
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text(EVERY_TYPE.replace("type: revolute", "type: revolve"))
    assert screwkit("no_such_case", "-o", place) == 2
    assert screwkit("bennett", "-o", str(tmp_path / "v.pdf")) == 2
    assert screwkit("bennett", "-o", place, "--at", "nothing=1") == 2
    assert screwkit(str(wrong), "-o", place) == 3
    assert "did you mean 'revolute'" in capsys.readouterr().err
    assert not Path(place).exists()


def test_a_browser_that_is_missing_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    place = tmp_path / "v.html"
    asked = []

    def nothing(address: str) -> bool:
        asked.append(address)
        return False

    monkeypatch.setattr("webbrowser.open", nothing)
    assert screwkit("bennett", "-o", str(place)) == 0
    assert asked == []
    assert screwkit("bennett", "-o", str(place), "--open") == 5
    assert asked == [place.resolve().as_uri()]
    assert "no browser was found" in capsys.readouterr().err
    assert place.is_file()
