"""Slices of singular loci: what is drawn is singular, and all of it is drawn."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

import screwkit as sk
from screwkit import cli
from screwkit.errors import (
    ExpressionError,
    ScrewkitError,
    UndecidedError,
    UnknownNameError,
)
from screwkit.kinematics.values import with_values
from screwkit.reports.draw_slice import chains, legend_text, slice_picture
from screwkit.reports.records import from_json, to_json
from screwkit.results.singularities import Component, Singularities
from screwkit.sliced import sliced_singularities
from screwkit.sweeps.slices import curves_of, slice_of, slicing_of
from screwkit.sweeps.zero_lines import zero_lines

Array = npt.NDArray[np.float64]
MAGIC = {".pdf": b"%PDF", ".svg": b"<?xml", ".png": b"\x89PNG"}


def curve(name: str, *ranges: str) -> list[tuple[tuple[str, ...], Array]]:
    """The equations of each component of a slice, and the ends of its segments."""
    mechanism = sk.load(name).mechanism
    slicing = slicing_of(mechanism, ranges)
    answer = sk.singularities(sk.Case(with_values(mechanism, slicing.fixed)))
    return [
        (found.component.equations, np.array(found.segments).reshape(-1, 2))
        for found in curves_of(answer, slicing)
    ]


# -- curves of known functions --------------------------------------------------------


def test_a_circle_is_one_closed_line_of_its_length() -> None:
    axis = np.linspace(-1, 1, 101)
    segments = zero_lines(lambda x, y: x**2 + y**2 - 0.49, axis, axis)
    points = np.array(segments)
    assert np.abs(np.hypot(*points.reshape(-1, 2).T) - 0.7).max() < 1e-14
    (chain,) = chains(segments)
    assert chain[0] == chain[-1]
    length = np.linalg.norm(points[:, 1] - points[:, 0], axis=1).sum()
    assert length == pytest.approx(2 * math.pi * 0.7, rel=1e-3)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("shift", [0.001, -0.001])
def test_branches_that_pass_through_one_cell_are_told_apart(
    sign: float, shift: float
) -> None:
    """Of x y = c each branch stays in its quadrant, also where both cross a cell."""
    axis = np.linspace(-1, 1, 10)  # the origin is in the middle of a cell
    segments = zero_lines(lambda x, y: sign * (x * y - shift), axis, axis)
    for one, two in segments:
        assert one[0] * two[0] > 0
        assert one[1] * two[1] > 0
    assert len(chains(segments)) == 2


def test_nothing_is_drawn_where_there_is_no_value_or_no_change_of_sign() -> None:
    axis = np.linspace(-1, 1, 21)
    assert zero_lines(lambda x, y: x**2 + y**2, axis, axis) == ()

    def half(x: Array, y: Array) -> Array:
        return np.where(y > 0, np.nan, x - 0.03)

    points = np.array(zero_lines(half, axis, axis)).reshape(-1, 2)
    assert len(points)
    assert points[:, 1].max() == 0
    assert np.abs(points[:, 0] - 0.03).max() < 1e-14


# -- curves of mechanisms, by singular values of the lines of their legs --------------


def least(rows: Array) -> Array:
    """The least singular value beside the greatest, of a matrix."""
    sizes = np.linalg.svd(rows, compute_uv=False)
    return np.asarray(sizes[..., -1] / sizes[..., 0])


def legs_of_3rpr(x: Array, y: Array) -> Array:
    """Forces of the plane along the legs, (fx, fy; mz)."""
    c, s = 0.8, 0.6  # phi = atan(3/4)
    base = np.array([[0, 0], [6, 0], [2, 5]])
    own = np.array([[0, 0], [2, 0], [1, 1]])
    turned = own @ np.array([[c, -s], [s, c]]).T
    ends = np.stack([x, y], axis=-1)[..., None, :] + turned
    along = ends - base
    moment = base[:, 0] * along[..., 1] - base[:, 1] * along[..., 0]
    return np.concatenate([along, moment[..., None]], axis=-1)


def legs_of_gough(x: Array, y: Array) -> Array:
    """Forces along the legs, (f; m), with the numbers of the file."""
    base = np.array(
        [[5, 1, 0], [3, 4, 0], [-3, 4, 0], [-5, 1, 0], [-1, -5, 0], [2, -5, 1]]
    )
    own = np.array(
        [[2, -1, 0], [2, 2, 0], [-2, 2, 0], [-2, -1, 1], [0, -2, 0], [1, -2, 0]]
    )
    place = np.stack([x, y, np.full_like(x, 6.0)], axis=-1)
    along = place[..., None, :] + own - base
    return np.concatenate([along, np.cross(base, along)], axis=-1)


@pytest.mark.parametrize(
    ("name", "legs", "reach"),
    [("3rpr_planar", legs_of_3rpr, 5), ("gough_6sps", legs_of_gough, 12)],
)
def test_every_point_of_a_curve_is_singular_and_no_curve_is_missing(
    name: str, legs: Callable[[Array, Array], Array], reach: int
) -> None:
    ranges = [f"{axis}=-{reach}:{reach}:101" for axis in "xy"]
    (found,) = (points for _, points in curve(name, *ranges) if len(points))
    on = least(legs(found[:, 0], found[:, 1]))
    assert on.max() < 1e-12
    # Off the curve, by a step of the grid across each segment, the legs hold.
    step = found[1::2] - found[::2]
    step /= np.linalg.norm(step, axis=1, keepdims=True)
    off = found[::2] + 0.02 * reach * np.stack([-step[:, 1], step[:, 0]], axis=1)
    assert np.median(least(legs(off[:, 0], off[:, 1]))) > 1e4 * on.max()
    # The determinant of the legs changes its sign on the same edges, and no others.
    axis = np.linspace(-reach, reach, 101)
    by_legs = zero_lines(lambda x, y: np.linalg.det(legs(x, y)), axis, axis)
    own = {tuple(np.round(point, 7)) for point in np.array(by_legs).reshape(-1, 2)}
    drawn = {tuple(np.round(point, 7)) for point in found}
    assert drawn
    near = np.array(sorted(drawn))
    assert all(np.abs(near - point).max(axis=1).min() < 1e-6 for point in own)
    assert len(own) == len(drawn)


def test_joint_variables_of_a_table_may_be_sliced() -> None:
    """The right arm of the humanoid: q4 = 0, π and the wrist on the axis 1."""
    found = dict(curve("nao_t14", "q2=-3:3:61", "q4=-3.5:3.5:71"))
    lines = {equations: points for equations, points in found.items() if len(points)}
    straight = lines["sin(q4)",]
    assert {round(abs(y), 9) for y in straight[:, 1]} == {0, round(math.pi, 9)}
    others = [p for equations, p in lines.items() if "q4" not in equations[0]]
    wrist = math.atan(-0.105 / 0.015)
    branches = {round(wrist, 9), round(wrist + math.pi, 9)}
    assert any({round(x, 9) for x in p[:, 0]} == branches for p in others)
    slicing = slicing_of(sk.load("nao_t14").mechanism, ["q2=-3:3", "q4=-3:3"])
    assert slicing.units == ("rad", "rad")


def test_units_are_said_where_the_file_says_what_a_symbol_is() -> None:
    mechanism = sk.load("3rpr_planar").mechanism
    assert slicing_of(mechanism, ["x=0:1", "phi=0:1"]).units == ("dm", "rad")
    mechanism = sk.load("3rps").mechanism
    assert slicing_of(mechanism, ["u=0:1", "z=0:1"]).units == ("", "dm")


# -- what cannot be drawn, and pictures -----------------------------------------------


def test_what_has_no_curve_is_said(tmp_path: Path) -> None:
    """Two equations in five_bar_15, and a sum of squares put in for another one."""
    case = sk.load("five_bar_15")
    place = tmp_path / "slice.svg"
    answer = sk.singularities(case, slices=["x2=-4:4", "y2=-4:4"], output=place)
    assert answer.slice is not None
    notes = {one.equations: one.note for one in answer.slice.components}
    assert "several equations" in notes["y2 + 2", "x2 + 1"]
    assert "not drawn: y2 + 2 = 0, x2 + 1 = 0: several" in str(answer)
    assert f"wrote {place}" in " ".join(str(answer).split())
    assert answer.actuation is not None
    never = Component(("x2^2 + y2^2",), 1, (), 2)
    other = replace(answer, actuation=replace(answer.actuation, components=(never,)))
    slicing = slicing_of(case.mechanism, ["x2=-4:4", "y2=-4:4"])
    last = curves_of(other, slicing)[-1]
    assert last.segments == ()
    assert last.component.note == "it does not change its sign on the grid"
    long = Component((" + ".join(["x2"] * 1_000) + " - 500",), 1, (), 2)
    other = replace(answer, actuation=replace(answer.actuation, components=(long,)))
    last = curves_of(other, slicing)[-1]
    assert np.allclose(np.asarray(last.segments)[..., 0], 1 / 2)


def test_open_loci_and_slices_that_are_singular_throughout_are_marked() -> None:
    case = sk.load("3rpr_planar")
    slicing = slicing_of(case.mechanism, ["x=-4:8:21", "y=-4:8:21"])
    fixed = with_values(case.mechanism, slicing.fixed)
    answer = sk.singularities(sk.Case(fixed))
    assert slice_of(answer, slicing, curves_of(answer, slicing)).remark == ""
    assert answer.actuation is not None
    half = replace(answer, actuation=replace(answer.actuation, complete=False))
    assert "not proved" in slice_of(half, slicing, ()).remark
    held = sk.load("3rpr_planar", actuated=["P1", "P2"]).mechanism
    loose = sk.singularities(sk.Case(with_values(held, slicing.fixed)))
    assert "everywhere in the slice" in slice_of(loose, slicing, ()).remark


def test_what_is_lost_in_the_whole_slice_is_said(tmp_path: Path) -> None:
    """At q9 = 0 the axes 8 and 10 of the left arm are one line, whatever q2 and q4."""
    slices, place = ["q2=-3:3:21", "q4=-3:3:21"], tmp_path / "slice.svg"
    told = sk.singularities(sk.load("nao_t14"), slices=slices, output=place).slice
    assert told is not None
    lost = "left is singular in the whole slice: rank 4, in general 5"
    assert lost in told.remark
    free = sk.load("nao_t14", at={"q9": "pi/2"})
    told = sk.singularities(free, slices=slices, output=place).slice
    assert told is not None
    assert "whole slice" not in told.remark
    assert told.fixed[0] == "q9 = pi/2"
    assert "q9 = 0" not in told.fixed


@pytest.mark.parametrize("ending", MAGIC)
def test_the_same_slice_is_the_same_file(ending: str, tmp_path: Path) -> None:
    case = sk.load("3rpr_planar")
    contents = []
    for number in range(2):
        place = tmp_path / f"{number}{ending}"
        answer = sk.singularities(case, slices=["x=-4:8:41", "y=-4:8:41"], output=place)
        contents.append(place.read_bytes())
    assert contents[0].startswith(MAGIC[ending])
    assert contents[0] == contents[1]
    document = json.loads(json.dumps(to_json(answer)))
    assert from_json(document) == answer


def test_a_legend_says_what_happens_and_any_title_can_be_drawn() -> None:
    case = sk.load("3rpr_planar")
    slicing = slicing_of(case.mechanism, ["x=-4:8:21", "y=-4:8:21"])
    answer: Singularities = sk.singularities(
        sk.Case(with_values(case.mechanism, slicing.fixed))
    )
    curves = curves_of(answer, slicing)
    (component,) = (one.component for one in curves)
    assert " ".join(legend_text(component).split()) == (
        "actuation: 75 x² − 25 x y + 25 y² − 351 x + 63 y = 0: "
        "lines A1 B1, A2 B2 and A3 B3 meet in one point or are parallel"
    )
    named = replace(component, geometry="axes a$_{x}^\\%&#~<b> meet")
    shown = " ".join(legend_text(named).split())
    assert shown.endswith("axes a$_{x}^\\%&#~<b> meet")
    drawn = replace(slice_of(answer, slicing, curves), components=(named,))
    lines = [one.segments for one in curves]
    assert slice_picture(drawn, lines, r"a$_{x}^\%&#~<b>é", "svg")


# -- refusals -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("slices", "error", "words"),
    [
        (["x=-1:1"], ExpressionError, "twice, not 1"),
        (["x=-1:1", "y=-1:1", "phi=0:1"], ExpressionError, "not 3"),
        (["x=-1:1", "x=-2:2"], ExpressionError, "'x' is sliced twice"),
        (["x=1:-1", "y=-1:1"], ExpressionError, "ascends"),
        (["x=-1:1:1", "y=-1:1"], ExpressionError, "two values or more"),
        (["x=-1", "y=-1:1"], ExpressionError, "no range"),
        (["z=-1:1", "y=-1:1"], UnknownNameError, "no symbol 'z'"),
        (["qP1=-1:1", "y=-1:1"], UnknownNameError, "no symbol 'qP1'"),
        ([], ScrewkitError, "--slice"),
    ],
)
def test_what_is_no_slice_is_refused(
    slices: list[str], error: type[Exception], words: str, tmp_path: Path
) -> None:
    with pytest.raises(error, match=words):
        sk.singularities(
            sk.load("3rpr_planar"), slices=slices, output=tmp_path / "slice.svg"
        )
    assert not list(tmp_path.iterdir())


def test_a_symbol_without_a_value_is_asked_for() -> None:
    mechanism = sk.load("3rpr_planar").mechanism
    open_ones = tuple(
        replace(p, value=None) if p.name == "a2" else p for p in mechanism.parameters
    )
    with pytest.raises(UndecidedError, match="a2 has none: --set a2="):
        slicing_of(replace(mechanism, parameters=open_ones), ["x=0:1", "y=0:1"])


def screwkit(*words: str) -> int:
    with pytest.raises(SystemExit) as left:
        cli.main(["singularities", *words])
    return int(left.value.code or 0)


def test_the_command_draws_a_slice(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    place = str(tmp_path / "slice.pdf")
    ranges = ("--slice", "x=-4:8:41", "--slice", "y=-4:8:41")
    assert screwkit("3rpr_planar", *ranges, "-o", place, "--set", "a2=7") == 0
    assert Path(place).read_bytes().startswith(b"%PDF")
    assert "SLICE" in capsys.readouterr().out
    assert screwkit("3rpr_planar", *ranges) == 2
    assert "-o FILE" in capsys.readouterr().err
    assert screwkit("3rpr_planar", "-o", place) == 2
    assert screwkit("3rpr_planar", *ranges, "-o", str(tmp_path / "slice.txt")) == 2


def test_a_dimension_that_varies_may_be_singular(tmp_path: Path) -> None:
    """Struts along y = 0 and y = 3 and one that rises by c − 1: parallel at c = 1."""
    legs = [
        f"  - {{name: R{k}, type: revolute, parent: base, child: a{k}, point: A{k}}}\n"
        f"  - {{name: P{k}, type: prismatic, parent: a{k}, child: b{k}, axis: l{k}}}\n"
        f"  - {{name: Q{k}, type: revolute, parent: b{k}, child: top, point: B{k}}}\n"
        for k in "123"
    ]
    path = tmp_path / "struts.yaml"
    path.write_text(
        "screwkit: 1\nname: struts\nspace: planar\ngeometry: posture\n"
        "base: base\nplatform: top\nlinks: [base, top, a1, b1, a2, b2, a3, b3]\n"
        "parameters: {c: 2}\nvariables: {x: 2}\npose: {translation: [x, 0, 0]}\n"
        "points:\n  A1: [0, 0, 0]\n  A2: [0, 3, 0]\n  A3: [0, 1, 0]\n"
        "  B1: {link: top, at: [0, 0, 0]}\n  B2: {link: top, at: [0, 3, 0]}\n"
        "  B3: {link: top, at: [0, c, 0]}\n"
        "vectors: {l1: B1 - A1, l2: B2 - A2, l3: B3 - A3}\n"
        f"joints:\n{''.join(legs)}actuated: [P1, P2, P3]\n"
    )
    ranges = "x=1:5:9", "c=0:4:9"
    answer = sliced_singularities(
        sk.load(path), ranges, tmp_path / "struts.svg", sk.singularities
    )
    assert answer.slice is not None
    (drawn,) = answer.slice.components
    assert (drawn.parts, drawn.equations) == (("actuation",), ("c - 1",))
    assert drawn.segments == 8
