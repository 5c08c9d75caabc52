"""Values from outside: what the file demands of its symbols holds for them too."""

from __future__ import annotations

from pathlib import Path

import pytest

from screwkit import cli
from screwkit.algebra.text import expression_text
from screwkit.case import Case, load
from screwkit.errors import (
    ExpressionError,
    MechanismFileError,
    UnfitValueError,
    UnknownNameError,
)

TEXT = """screwkit: 1
name: crank
geometry: posture
base: ground
platform: arm
links: [ground, arm]
parameters:
  a: {value: 1, positive: true}
  b: 2*a
  k: {value: 2, nonzero: true}
  m: {value: b - 1, positive: true}
  n: {}
variables: {x: 1, y: 2}
points: {P: [sqrt(a), b/k, 1/(x - 3)]}
vectors: {u: [x - 1, 0, y*n]}
joints:
  - {name: A, type: revolute, parent: ground, child: arm, axis: u, point: P}
variants:
  wide: {values: {a: 4}}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "crank.yaml"
    path.write_text(TEXT, encoding="utf-8")
    return path


def values(case: Case) -> dict[str, str]:
    return {
        p.name: expression_text(p.value)
        for p in case.mechanism.parameters
        if p.value is not None
    }


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"a": "-1"}, "--set a=-1: 'a' is declared positive, but the value is -1"),
        ({"a": "2 - sqrt(4)"}, "'a' is declared positive, but the value is 0"),
        ({"k": "0"}, "--set k=0: 'k' is declared nonzero"),
        ({"k": "sin(pi)"}, "'k' is declared nonzero, but the value is 0"),
        ({"a": "1/4"}, "--set a=1/4: 'm' is declared positive, but the value is -0.5"),
        ({"x": "3"}, "--set x=3: points, P, 2: division by zero: 'x - 3' is 0"),
        (
            {"y": "0", "x": "1"},
            "--set y=0 --set x=1: joint 'A', axis: the axis is zero",
        ),
        (
            {"x": "1", "n": "0", "k": 5},
            "--set x=1 --set n=0: joint 'A', axis: the axis",
        ),
        ({"b": "asin(2)"}, "asin takes numbers from -1 to 1"),
    ],
)
def test_values_that_contradict_the_file_are_refused(
    file: Path, given: dict[str, object], message: str
) -> None:
    with pytest.raises((UnfitValueError, ExpressionError)) as caught:
        load(file, set_values=given)
    assert message in str(caught.value)
    with pytest.raises((UnfitValueError, ExpressionError)) as caught:
        load(file, at=given)
    assert message.replace("--set", "--at") in str(caught.value)


def test_values_computed_from_others_follow(file: Path) -> None:
    assert values(load(file))["m"] == "1"
    found = values(load(file, set_values={"a": "3"}))
    assert (found["b"], found["m"]) == ("6", "5")
    wide = load(file, variant="wide")
    assert (values(wide)["b"], values(wide)["m"]) == ("8", "7")
    found = values(load(file, variant="wide", set_values={"a": "2"}))
    assert (found["b"], found["m"]) == ("4", "3")
    found = values(load(file, variant="wide", at={"b": "a + 1"}))
    assert found["m"] == "4"


def test_a_variant_does_not_excuse_what_is_set(file: Path) -> None:
    with pytest.raises(UnfitValueError, match=r"--set k=0: 'k' is declared nonzero"):
        load(file, variant="wide", set_values={"k": "0"})


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        ("{value: 1, positive: true}", "{value: -1, positive: true}", "a"),
        ("{value: 2, nonzero: true}", "{value: 0, nonzero: true}", "k"),
        ("{x: 1,", "{x: 3,", "x"),
        ("b: 2*a", "b: 2*a + b", "b"),
        ("b: 2*a", "b: n", "n"),
    ],
)
def test_a_value_that_is_replaced_is_no_fault_of_the_file(
    tmp_path: Path, old: str, new: str, name: str
) -> None:
    path = tmp_path / "crank.yaml"
    path.write_text(TEXT.replace(old, new), encoding="utf-8")
    with pytest.raises(MechanismFileError):
        load(path)
    load(path, set_values={name: "5"})
    load(path, at={name: "5"})
    with pytest.raises(MechanismFileError):
        load(path, set_values={"y": "5"})


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"a": "foo"}, "--set a=foo: unknown name 'foo'; a number or an expression"),
        ({"foo": "3"}, "--set foo=3: no symbol 'foo' in crank; it has a, b, k, m, n"),
        ({"qA": "3"}, "--set qA=3: 'qA' is a joint variable"),
    ],
)
def test_what_is_no_value_names_option_and_symbol(
    file: Path, given: dict[str, str], message: str
) -> None:
    with pytest.raises((ExpressionError, UnknownNameError)) as caught:
        load(file, set_values=given)
    assert message in str(caught.value)


@pytest.mark.parametrize("command", ["check", "mobility"])
def test_the_commands_refuse_in_the_same_words(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stop:
        cli.main([command, "bennett", "--set", "a=0", "--quiet"])
    assert stop.value.code == 2
    said = capsys.readouterr().err
    assert said == (
        "screwkit: --set a=0: 'a' is declared nonzero, but the value is 0\n"
    )


def test_a_freedom_named_twice_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="'A' stands twice"):
        load("bennett", actuated=["A", "B", "A"])


def test_an_unknown_actuator_is_told_which_there_are() -> None:
    with pytest.raises(
        UnknownNameError, match=r"'Z' in bennett; there are A, B, C, D$"
    ):
        load("bennett", actuated=["Z"])
    with pytest.raises(UnknownNameError, match=r"did you mean 'A'"):
        load("bennett", actuated=["A:1"])
