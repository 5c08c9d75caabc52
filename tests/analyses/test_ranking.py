"""Schemes by conditioning: against the kinematic index, exact loci and scalings."""

from __future__ import annotations

import csv
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest

import screwkit as sk
from screwkit.delivery import deliver_schemes, only_balanced
from screwkit.errors import ExpressionError, UnknownNameError
from screwkit.reports.records import from_json, to_json
from screwkit.results.schemes import Ranking, Schemes
from screwkit.results.undecided import Undecided

NAO = {f"q{k}": 0.37 * k - 1.9 for k in range(1, 11)}


def ranked(case: sk.Case | str, **options: object) -> Schemes:
    mechanism = sk.load(case) if isinstance(case, str) else case
    return sk.schemes(mechanism, work=0, **options)  # type: ignore[arg-type]


def ranking(case: sk.Case | str, **options: object) -> Ranking:
    found = ranked(case, **options).ranking
    assert isinstance(found, Ranking)
    return found


def points(values: dict[str, float]) -> list[str]:
    """Ranges of one point each."""
    return [f"{name}={value}:{value}" for name, value in values.items()]


@pytest.mark.parametrize(
    ("name", "at", "sets", "options"),
    [
        ("nao_t14", NAO, {}, {}),
        # Axes that turn beside slides, so that the length weighs rates too.
        ("tricept", {}, {"h": 4.5, "alpha": 0.3, "beta": 0.2}, {}),
        # Idle motions that actuators see: two arms of seven joints hold one object.
        (
            "dual_iiwa",
            None,
            {},
            {"size": 7},
        ),
    ],
)
def test_the_index_is_the_square_root_of_the_extreme_kinematic_values(
    name: str,
    at: dict[str, float] | None,
    sets: dict[str, float],
    options: dict[str, object],
) -> None:
    """`manipulability` gets there by the grasp's matrices, one scheme at a time."""
    case = sk.load(name)
    if at is None:
        names = case.mechanism.joint_variables
        at = {x: 0.31 * k - 2 for k, x in enumerate(names)}
        options = {**options, "candidates": case.assembly.joints[1:10]}
    found = ranking(
        case, rank=1, within=points({**at, **sets}), length="0.4", **options
    )
    assert (found.length, found.postures) == (0.4, 1)
    step = max(1, len(found.schemes) // 4)
    for one in found.schemes[::step]:
        posed = sk.load(
            name,
            actuated=list(one.actuated),
            set_values={n: str(x) for n, x in sets.items()},
            at={n: str(x) for n, x in at.items()},
        )
        finite = sk.manipulability(posed, length="0.4").kinematic.finite
        assert one.median == one.worst
        assert one.median == pytest.approx(sqrt(min(finite) / max(finite)), rel=1e-7)


def test_a_scheme_is_at_zero_exactly_where_its_locus_is() -> None:
    """On q6 = q1 the exact loci say which schemes fail; elsewhere none does."""
    loci = {
        s.actuated: set(s.locus)
        for s in sk.schemes(sk.load("nao_t14")).schemes
        if s.admissible
    }
    at = {**NAO, "q1": 0.7, "q6": 0.7}
    failing = {
        one.actuated
        for one in ranking("nao_t14", rank=1, within=points(at)).schemes
        if one.median < 1e-9
    }
    wanted = {
        actuated
        for actuated, locus in loci.items()
        if locus & {"sin(q6 - q1)", "sin(q1 - q6)"}
    }
    assert failing == wanted
    assert 0 < len(wanted) < len(loci)
    elsewhere = ranking("nao_t14", rank=1, within=points(NAO))
    assert min(one.worst for one in elsewhere.schemes) > 1e-9


def test_three_orthogonal_slides_are_even_everywhere() -> None:
    """The slides of the tripteron carry one coordinate each: the map is 1."""
    found = ranking("tripteron", rank=20)
    best = {one.actuated: one for one in found.schemes}["P11", "P21", "P31"]
    assert best.worst == pytest.approx(1, abs=1e-12)
    assert found.schemes[0].median == pytest.approx(1, abs=1e-12)


def test_numbers_do_not_depend_on_the_scale() -> None:
    small, large = (
        ranking(sk.load("nao_t14", set_values=lengths), rank=16)
        for lengths in (
            {"b1": "0.1", "d3": "0.015", "r1": "0.1", "r3": "0.105", "r5": "0.11"},
            {"b1": "100", "d3": "15", "r1": "100", "r3": "105", "r5": "110"},
        )
    )
    assert large.length == pytest.approx(1000 * small.length, rel=1e-12)
    assert [s.actuated for s in small.schemes] == [s.actuated for s in large.schemes]
    for one, other in zip(small.schemes, large.schemes, strict=True):
        assert one.median == pytest.approx(other.median, rel=1e-9)


def test_the_order_is_that_of_the_medians_and_the_same_every_time() -> None:
    one, other = (ranking("nao_t14", rank=30) for _ in range(2))
    assert one == other
    medians = [scheme.median for scheme in one.schemes]
    assert medians == sorted(medians, reverse=True)
    assert all(0 <= s.worst <= s.median <= 1 for s in one.schemes)
    answer = ranked("nao_t14", rank=1)
    assert isinstance(answer.ranking, Ranking)
    listed = {s.actuated for s in answer.schemes if s.admissible}
    assert {s.actuated for s in answer.ranking.schemes} == listed


def test_the_length_is_the_mean_square_distance_of_the_axes(tmp_path: Path) -> None:
    """Two parallel axes at distances 3 and 4 from the origin, which stays in place."""
    file = tmp_path / "door.yaml"
    file.write_text(
        "screwkit: 1\nname: door\nspace: spatial\ngeometry: posture\nbase: g\n"
        "platform: p\nlinks: [g, a, p]\nunits: m\nvariables:\n  x: 0\n  w: 2\n"
        "  t: {value: 0, angle: true}\njoints:\n"
        "  - {name: A, type: revolute, parent: g, child: a, axis: [0, 0, 2],"
        " point: [3, 0, 7]}\n"
        "  - {name: B, type: revolute, parent: a, child: p,"
        ' axis: [0, 0, "w*(2 + sin(t)) - w"], point: [x, 4, 0]}\n',
        encoding="utf-8",
    )
    found = ranking(sk.load(file), rank=8, within=["x=1:2"])
    assert found.length == pytest.approx(sqrt(25 / 2))
    ranges = {one.symbol: one for one in found.ranges}
    assert (ranges["x"].start, ranges["x"].stop, ranges["x"].given) == (1, 2, True)
    assert (ranges["t"].start, ranges["t"].stop, ranges["t"].angle) == (-pi, pi, True)
    reach = found.length / 2
    assert ranges["w"].start == pytest.approx(2 - reach)
    assert not ranges["w"].angle


def test_postures_that_do_not_exist_are_left_out_and_counted(tmp_path: Path) -> None:
    """A leg of length 1 above a point at distance x; beyond it there is none."""
    file = tmp_path / "leg.yaml"
    file.write_text(
        "screwkit: 1\nname: leg\nspace: planar\ngeometry: posture\nbase: g\n"
        "platform: p\nlinks: [g, a, p]\nvariables:\n  x: 0.5\njoints:\n"
        "  - {name: A, type: revolute, parent: g, child: a, point: [0, 0]}\n"
        '  - {name: B, type: revolute, parent: a, child: p, point: [x, "sqrt(1-x^2)"]}'
        "\n",
        encoding="utf-8",
    )
    found = ranking(sk.load(file), rank=400, within=["x=0:2"])
    drawn = 2 * np.random.default_rng(found.seed).random(400)
    assert found.undefined == int((drawn > 1).sum())
    assert found.postures == 400 - found.undefined
    none = ranked(sk.load(file), rank=5, within=["x=2:3"]).ranking
    assert isinstance(none, Undecided)
    assert "none of the 5 postures" in none.reason


def test_a_file_of_numbers_has_one_posture() -> None:
    found = ranked("generic_7r", rank=50)
    assert isinstance(found.ranking, Ranking)
    assert (found.ranking.postures, found.ranking.ranges) == (1, ())
    assert "at the one posture of the file" in str(found)


def test_wrong_ranges_are_refused() -> None:
    nao = sk.load("nao_t14")
    for text, error, message in (
        ("q1", ExpressionError, "write NAME=FROM:TO"),
        ("q1=0:1:5", ExpressionError, "write NAME=FROM:TO"),
        ("q1=1:0", ExpressionError, "ends before it starts"),
        ("q11=0:1", UnknownNameError, "no symbol 'q11' to draw"),
    ):
        with pytest.raises(error, match=message):
            ranked(nao, rank=2, within=[text])


def test_the_text_shows_order_numbers_and_what_they_are() -> None:
    answer = ranked("nao_t14", rank=12)
    assert isinstance(answer.ranking, Ranking)
    text = " ".join(str(answer).split())
    assert "admissible, best conditioned first actuated median worst locus" in text
    best = answer.ranking.schemes[0]
    after = text.split("worst locus")[1].split()
    assert tuple(after[:4]) == best.actuated
    assert float(after[4]) == pytest.approx(best.median, rel=5e-3)
    assert "median and worst over 12 closed postures" in text
    assert "m, the root mean square distance of the turning axes" in text
    assert "random numbers of seed 1" in text


def test_what_is_ranked_travels(tmp_path: Path) -> None:
    answer = ranked("nao_t14", rank=3)
    assert from_json(to_json(answer)) == answer
    even = only_balanced(answer)
    assert isinstance(even.ranking, Ranking)
    assert {s.actuated for s in even.ranking.schemes} == {
        s.actuated for s in even.schemes if s.admissible
    }
    table = tmp_path / "schemes.csv"
    deliver_schemes(table)(answer)
    rows = list(csv.DictReader(table.read_text("utf-8").splitlines()))
    shown = {r["actuated"]: (r["median"], r["worst"]) for r in rows if r["median"]}
    assert shown == {
        " ".join(s.actuated): (str(s.median), str(s.worst))
        for s in answer.ranking.schemes  # type: ignore[union-attr]
    }
    page = tmp_path / "schemes.tex"
    deliver_schemes(page)(answer)
    content = page.read_text("utf-8")
    assert "best conditioned first" in content
    assert "Median" in content
