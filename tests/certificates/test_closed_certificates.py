"""Certificates where loops tie joint variables: proofs at closed postures, and lies."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from screwkit.algebra.angle_elimination import eliminated
from screwkit.algebra.eliminated_sums import sums_without, without_square_roots
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.sums_of_conditions import Combination
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.case import load, load_text
from screwkit.certificates.checking import check
from screwkit.certificates.findings import Findings
from screwkit.certificates.signs import Signs
from screwkit.certificates.texts import RefusedError
from screwkit.certificates.written import from_text
from screwkit.questions import singularities
from screwkit.verification import verify

FOUR_BAR = """
screwkit: 1
name: four_bar
space: planar
geometry: mdh
base: ground
platform: coupler
links: [ground, crank, coupler, tip, rocker]
parameters:
  l1: {value: 4, positive: true}
  l2: {value: 3, positive: true}
  l3: {value: 4, positive: true}
  l4: {value: 4, positive: true}
joints:
  - {name: "1", type: revolute, parent: ground, child: crank, mdh: {}}
  - {name: "2", type: revolute, parent: crank, child: coupler, mdh: {d: l1}}
  - {name: t, type: fixed, parent: coupler, child: tip, mdh: {d: l2}}
  - {name: "3", type: revolute, parent: rocker, child: tip, mdh: {d: l3}}
  - {name: "4", type: revolute, parent: ground, child: rocker, mdh: {d: l4}}
actuated: ["1"]
"""

CRANK_ROCKER = """
screwkit: 1
name: crank_rocker
space: planar
geometry: reference
base: ground
platform: coupler
links: [ground, crank, coupler, rocker]
points: {A: [0, 0], B: [0, 1], C: [3, 4], D: [5, 0]}
joints:
  - {name: "1", type: revolute, parent: ground, child: crank, point: A}
  - {name: "2", type: revolute, parent: crank, child: coupler, point: B}
  - {name: "3", type: revolute, parent: coupler, child: rocker, point: C}
  - {name: "4", type: revolute, parent: ground, child: rocker, point: D}
actuated: ["1"]
"""

RSSR = """
screwkit: 1
name: rssr
geometry: reference
base: g
platform: r
links: [g, a, c, r]
joints:
  - {name: "1", type: revolute, parent: g, child: a, point: [0, 0, 0], axis: [0, 0, 1]}
  - {name: "2", type: spherical, parent: a, child: c, point: [1, 0, 0]}
  - {name: "3", type: spherical, parent: c, child: r, point: [3, 2, 1]}
  - {name: "4", type: revolute, parent: g, child: r, point: [3, 0, 0], axis: [0, 1, 3]}
actuated: ["1"]
"""


@cache
def written(text: str) -> str:
    """The certificate of a mechanism, by way of a file."""
    name = text.split("name: ", 1)[1].split("\n", 1)[0]
    place = Path(_FOLDER[0]) / f"{name}.yaml"
    place.write_text(text, encoding="utf-8")
    answer = singularities(load(place), certificate=True)
    assert answer.certificate is not None
    return answer.certificate


_FOLDER = [""]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path) -> None:
    _FOLDER[0] = str(tmp_path)


@pytest.mark.parametrize("text", [FOUR_BAR, CRANK_ROCKER, RSSR])
def test_lists_at_closed_postures_are_proved(text: str, tmp_path: Path) -> None:
    path = tmp_path / "certificate.json"
    path.write_text(written(text), encoding="utf-8")
    found = verify(None, str(path))
    assert found.accepted, found.reason
    assert all(part.proved for part in found.parts)
    assert not found.missing
    answer = singularities(load_text(text))
    listed = [*(limb.components for limb in answer.limb), answer.constraint.components]
    if answer.actuation is not None:
        listed.append(answer.actuation.components)
    parts = from_text(written(text)).parts
    assert [[c.equations for c in own] for own in listed] == [
        [locus.equations for locus in part.components] for part in parts
    ]


def test_a_list_without_its_component_has_no_proof() -> None:
    """Dead points of a four-bar: what proves its list does not prove the empty one."""
    document = json.loads(written(FOUR_BAR))
    part = document["parts"][-1]
    part["components"] = []
    assert "component" in refused(document, FOUR_BAR)


def refused(document: dict[str, Any], text: str) -> str:
    certificate = from_text(json.dumps(document))
    with pytest.raises(RefusedError) as refusal:
        check(certificate, load_text(text).mechanism, 5)
    return str(refusal.value)


def part_of(document: dict[str, Any], question: str) -> Any:
    return next(p for p in document["parts"] if p["question"] == question)


def another_demand(document: dict[str, Any]) -> None:
    """B and C on one line with D is what no loop demands."""
    demand = part_of(document, "constraint")["demands"][0]
    demand["equation"] = f"{demand['equation']} + l1"


def the_demand_of_another_equation(document: dict[str, Any]) -> None:
    demands = part_of(document, "constraint")["demands"]
    demands[0]["number"] = demands[1]["number"]


def a_demand_by_a_multiple_that_it_is_not(document: dict[str, Any]) -> None:
    part_of(document, "constraint")["demands"][0]["times"] = "2"


def one_demand_less(document: dict[str, Any]) -> None:
    part_of(document, "constraint")["demands"].pop()


def open_postures(document: dict[str, Any]) -> None:
    part_of(document, "constraint")["closed"].pop()


def open_postures_of_a_component(document: dict[str, Any]) -> None:
    (locus,) = part_of(document, "actuation")["components"]
    locus["reach"][0]["roots"].pop()


def a_lower_rank(document: dict[str, Any]) -> None:
    part_of(document, "constraint")["rank"] -= 1


@pytest.mark.parametrize(
    "forge",
    [
        another_demand,
        the_demand_of_another_equation,
        a_demand_by_a_multiple_that_it_is_not,
        one_demand_less,
        open_postures,
        open_postures_of_a_component,
        a_lower_rank,
    ],
)
def test_forgeries_are_refused(forge: Callable[[dict[str, Any]], None]) -> None:
    document = json.loads(written(FOUR_BAR))
    forge(document)
    refused(document, FOUR_BAR)


def dead_points(document: dict[str, Any]) -> Any:
    """The component of the crank: coupler and rocker on one line."""
    (locus,) = part_of(document, "actuation")["components"]
    return locus


def findings(document: dict[str, Any]) -> Findings:
    certificate = from_text(json.dumps(document))
    return check(certificate, load_text(FOUR_BAR).mechanism, 5)[-1]


def test_a_component_at_closed_postures_is_met_on_all_sheets() -> None:
    """By hand: the loop's equations and the component's say l2·sin q3 = 0."""
    document = json.loads(written(FOUR_BAR))
    assert not findings(document).sampled_components
    del dead_points(document)["cover"]
    assert findings(document).sampled_components


def test_open_postures_say_nothing_of_a_component() -> None:
    """Of the crank's: where no loop closes the coupler may rest or move."""
    document = json.loads(written(FOUR_BAR))
    dead_points(document)["cover"] = {"number": 0, "sheet": True}
    assert findings(document).sampled_components


def sheets_of_sine(node: Any) -> list[Any]:
    for case in node["cases"]:
        if case["equations"] in (["sin(q3)"], ["-sin(q3)"]):
            sheets: list[Any] = case["sheets"]
            return sheets
    return sheets_of_sine(node["cases"][0]["sheets"][0]["node"])


def test_a_sheet_of_a_component_is_not_left_out() -> None:
    document = json.loads(written(FOUR_BAR))
    sheets = sheets_of_sine(dead_points(document)["cover"])
    assert len(sheets) == 2
    sheets.pop()
    refused(document, FOUR_BAR)


def test_another_component_is_not_met_by_the_same_tree() -> None:
    """Crank and rocker on one line with the ground, where nothing is singular."""
    document = json.loads(written(FOUR_BAR))
    dead_points(document)["equations"] = ["sin(q1 - q4)"]
    refused(document, FOUR_BAR)


def test_loops_that_tie_nothing_demand_nothing() -> None:
    """The same linkage with its joints where symbols say: every posture is closed."""
    text = """
screwkit: 1
name: bars
space: planar
base: ground
platform: coupler
links: [ground, left, right, coupler]
geometry: posture
variables: {x: 0.2, y: 1, u: 1.3, v: 1.2}
joints:
  - {name: A, type: revolute, parent: ground, child: left, point: [0, 0]}
  - {name: B, type: revolute, parent: ground, child: right, point: [1, 0]}
  - {name: C, type: revolute, parent: left, child: coupler, point: [x, y]}
  - {name: D, type: revolute, parent: right, child: coupler, point: [u, v]}
"""
    document = json.loads(written(text))
    document["parts"][0]["demands"] = [{"equation": "x - u", "number": 0}]
    assert "ties" in refused(document, text)


def test_schemes_are_not_spoken_of() -> None:
    """The crank holds a four-bar at random open postures too: that says nothing."""
    document = json.loads(written(FOUR_BAR))
    own = part_of(document, "constraint")
    document["schemes"] = {
        "origin": own["origin"],
        "angles": own["angles"],
        "schemes": [{"actuated": ["1"], "freedom": 0}],
        "form": "loops",
    }
    assert "tie" in refused(document, FOUR_BAR)


# -- one angle in numbers ------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "never"),
    [
        ("5 + 3*cos(q) + 2*sin(q)", True),  # 25 > 9 + 4
        ("2 + cos(q)*sin(q)", True),
        ("25*cos(q)^2 + 60*sin(q) + 299", True),
        ("3 + 3*cos(q)", False),  # at π alone
        ("3 - 3*cos(q)", False),
        ("cos(q)^2 - sin(q)", False),
        ("3 + 2*cos(q) + 2*cos(p)", False),  # two angles: −1 at π, π
    ],
)
def test_polynomials_in_one_angle_without_a_zero(text: str, never: bool) -> None:
    assert Signs(set(), set()).never_zero(parse(text)) is never


# -- unknowns taken out --------------------------------------------------------------


def polynomials(*texts: str) -> tuple[TrigonometricRing, list[Polynomial]]:
    seen = SurveyRing()
    for text in texts:
        evaluate(parse(text), seen)
    ring = TrigonometricRing(seen)
    return ring, [ring.normal(evaluate(parse(text), ring)) for text in texts]


@pytest.mark.parametrize(
    "texts",
    [
        # two by a pair
        ("3*cos(p) + 2*sin(q) - 1", "sin(p)*cos(q) + cos(p) + 2"),
        # two lengths
        ("x*cos(p) + 2", "x*sin(p) + 3"),
        # a pair, and a third equation in which it is put in
        ("3*cos(p) + 2*sin(q) - 1", "sin(p)*cos(q) + cos(p) + 2", "x - cos(q)"),
    ],
)
def test_what_is_left_is_a_sum_of_multiples(texts: tuple[str, ...]) -> None:
    ring, conditions = polynomials(*texts)
    kept = [("angle", 0)]
    plan = eliminated(ring, conditions, kept, plain=True)
    assert plan is not None
    found = [*sums_without(ring, conditions, kept)]
    assert len(found) == len(plan.left) > 0
    for own in found:
        total = ring.zero
        for times, condition in zip(own.times, conditions, strict=True):
            total += times * condition
        assert ring.normal(total) == own.value != 0
        assert {*unknowns(ring, own.value)} <= {*kept}


def test_square_roots_go_with_the_conjugate() -> None:
    """(x + √2)(x − √2) = x² − 2."""
    ring, (own, wanted, other) = polynomials("x + sqrt(2)", "x^2 - 2", "x - sqrt(2)")
    value, times = without_square_roots(ring, Combination(own, (ring.one,)))
    assert (value, times) == (wanted, (other,))
