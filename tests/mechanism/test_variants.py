"""Variants of a file: its own symbols at other values, with other claims."""

from __future__ import annotations

from pathlib import Path

import pytest

from screwkit.algebra.text import expression_text
from screwkit.case import load
from screwkit.errors import MechanismFileError, UnknownCaseError, UnknownNameError
from screwkit.mechanism.files import mechanism_from_text

TEXT = """screwkit: 1
name: slider
title: A slider on a turntable
known_for: having a variant
geometry: mdh
base: ground
platform: tool
links: [ground, arm, tool]
parameters:
  a: {value: 1, positive: true}
  b: a/4
  k: {value: 2, nonzero: true}
variables: {x: 0.5}
joints:
  - {name: "1", type: revolute, parent: ground, child: arm, mdh: {d: a}}
  - {name: "2", type: prismatic, parent: arm, child: tool, mdh: {d: b, r: k + x}}
expected:
  mobility.loop_rank: {value: 0, status: derived, source: there is no loop}
variants:
  wide:
    title: the arm four times as long
    values: {a: 4, x: sqrt(2)/2}
    expected:
      mobility.topology.joints: {value: 2, status: derived, source: counted}
  plain:
    values: {k: -1}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "slider.yaml"
    path.write_text(TEXT, encoding="utf-8")
    return path


def values(source: object, variant: str | None = None) -> dict[str, str]:
    mechanism = load(str(source), variant=variant).mechanism
    return {
        p.name: expression_text(p.value)
        for p in mechanism.parameters
        if p.value is not None
    }


def test_what_it_is_known_for(file: Path) -> None:
    assert load(file).mechanism.known_for == "having a variant"
    two_lines = TEXT.replace("having a variant", '"having\\na variant"')
    with pytest.raises(MechanismFileError, match=r"4:12  .*one line of text"):
        mechanism_from_text(two_lines, "slider")


def test_a_variant_replaces_values_and_claims(file: Path) -> None:
    plain, wide = load(file), load(file, variant="wide")
    assert plain.variants == ("wide", "plain")
    assert values(file) == {"a": "1", "b": "1/4", "k": "2", "x": "1/2"}
    assert values(file, "wide") == {"a": "4", "b": "1", "k": "2", "x": "sqrt(2)/2"}
    assert wide.mechanism.joints == plain.mechanism.joints
    assert wide.name == "slider"
    title = "A slider on a turntable: the arm four times as long"
    assert wide.mechanism.title == title
    assert [claim.question for claim in wide.claims] == ["mobility.topology.joints"]
    other = load(file, variant="plain")
    assert other.claims == ()
    assert other.mechanism.title == "A slider on a turntable: plain"


def test_a_variant_in_the_name_of_the_case(file: Path) -> None:
    assert load(f"{file}#wide").mechanism == load(file, variant="wide").mechanism
    with pytest.raises(UnknownNameError, match=r"'wid' of slider .*mean 'wide'"):
        load(f"{file}#wid")
    with pytest.raises(UnknownCaseError, match="no bundled case"):
        load("no_such_file#wide")
    with pytest.raises(UnknownNameError, match="it has none"):
        load("nao_t14", variant="x")


def test_a_file_whose_name_has_the_mark(tmp_path: Path) -> None:
    path = tmp_path / "a#wide"
    path.write_text(TEXT, encoding="utf-8")
    assert values(path)["a"] == "1"
    assert values(f"{path}#wide")["a"] == "4"


def test_numbers_are_set_on_top_of_a_variant(file: Path) -> None:
    case = load(file, variant="wide", set_values={"a": "7"})
    assert [p.name for p in case.mechanism.parameters] == ["b", "k", "x"]
    row = case.mechanism.joint("1").mdh
    assert row is not None
    assert expression_text(row.d) == "7"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("{a: 4,", "{§aa: 4,", r"unknown symbol 'aa' \(did you mean 'a'\?\)"),
        ("{a: 4,", "{§q1: 4,", "'q1' is a joint variable"),
        ("{a: 4,", "{a: §b + 1,", "contains the symbol 'b'"),
        ("{a: 4,", "{a: §-4,", "declared positive, but the value is -4"),
        ("{a: 4,", "{a: §asin(2),", "from -1 to 1"),
        ("{k: -1}", "{k: §0}", "declared nonzero, but the value is 0"),
        ("{k: -1}", "§[1]", "a mapping is expected, but a list"),
        ("  plain:", "  §no plain:", "is no name"),
        ("values: {k: -1}", "§vlues: {k: -1}", r"did you mean 'values'"),
        ("counted}", "counted, §sorce: x}", r"did you mean 'source'"),
        (
            "status: derived, source: counted",
            "status: §deried, source: counted",
            "unknown 'deried' .*'derived'",
        ),
    ],
)
def test_faults_of_variants(old: str, new: str, message: str) -> None:
    assert TEXT.count(old) == 1
    before, _, after = TEXT.replace(old, new).partition("§")
    place = (before.count("\n") + 1, len(before) - before.rfind("\n"))
    with pytest.raises(MechanismFileError, match=message) as caught:
        mechanism_from_text(before + after, "slider")
    assert place in [(fault.line, fault.column) for fault in caught.value.faults]


def test_a_value_that_follows_is_checked_too() -> None:
    text = TEXT.replace("b: a/4", "b: 1/(a - 4)")
    with pytest.raises(
        MechanismFileError, match=r"22:13 .*'a - 4' is 0 at the .* 'wide'"
    ):
        mechanism_from_text(text, "slider")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "mobility.loop_rank",
            "§mobility.loop_rnk",
            r"expected: no 'loop_rnk' in mobility \(did you mean 'loop_rank'\?\); all",
        ),
        ("mobility.loop_rank", "§mobilty.loop_rank#a b", r"did you mean 'mobility'\?"),
        ("mobility.loop_rank", "§mobility.loop_rank.x", "is a single value; there is"),
        ("mobility.loop_rank", "§screws.limbs.left", "a list; a position from 0"),
        (
            "mobility.loop_rank",
            "§''",
            "no '' among the questions; allowed: mob",
        ),
        (
            "mobility.topology.joints",
            "§mobility.topology.joint",
            r"variants, wide, expected: .* \(did you mean 'joints'\?\)",
        ),
    ],
)
def test_claims_on_places_that_no_result_has(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    assert TEXT.count(old) == 1
    before, _, after = TEXT.replace(old, new).partition("§")
    place = f"{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}"
    path = tmp_path / "slider.yaml"
    path.write_text(before + after, encoding="utf-8")
    with pytest.raises(MechanismFileError, match=f"yaml:{place} .*{message}"):
        load(path)


@pytest.mark.parametrize(
    "question",
    [
        "mobility.at_values.platform.motion_type",
        "mobility.loop_rank#what a reader says (of it)",
        "mobility#as a whole",
        "screws.limbs.3.twist_details.0.kind",
        "screws.actuation_wrenches.0.pitch",
        "singularities.limb.0.components.1.solutions.0.values",
        "schemes.reason",
        "mobility.workings.0.value",
        "manipulability.kinematic.finite",
    ],
)
def test_claims_on_places_that_a_result_may_have(tmp_path: Path, question: str) -> None:
    path = tmp_path / "slider.yaml"
    path.write_text(TEXT.replace("mobility.loop_rank", f"{question!r}"), "utf-8")
    assert load(path).claims[0].question == question
