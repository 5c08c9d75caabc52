"""Wrong weights, contacts and actuators: refused with place, cause and suggestion."""

from __future__ import annotations

from pathlib import Path

import pytest

import screwkit as sk
from screwkit import cli
from screwkit.errors import (
    MechanismFileError,
    ScrewkitError,
    UndecidedError,
    UnfitValueError,
)
from screwkit.results.manipulability import Manipulability

FILE = """screwkit: 1
name: fingers
space: planar
geometry: posture
base: palm
platform: ball
links: [palm, left, right, ball]
joints:
  - {name: A, type: revolute, parent: palm, child: left, point: [-2, 0]}
  - {name: B, type: revolute, parent: palm, child: right, point: [2, 0]}
  - {name: ca, type: hard_finger, parent: left, child: ball, point: [-1, 1]}
  - {name: cb, type: point, parent: right, child: ball, point: [1, 1], normal: [1, 0]}
actuated: [A, B]
"""


def measured(folder: Path, text: str) -> Manipulability:
    path = folder / "fingers.yaml"
    path.write_text(text, encoding="utf-8")
    return sk.manipulability(sk.load(path))


def test_the_file_itself_is_right(tmp_path: Path) -> None:
    answer = measured(tmp_path, FILE)
    assert answer.actuated == ("A", "B")


WEIGHT = "weights: {{rates: {rows}}}\n"


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("[[1, 2], [2, 1]]", "not positive definite"),
        ("[[1, 0], [1, 1]]", "not symmetric: row 2, column 1 differs"),
        ("[[0, 0], [0, 1]]", "entry 1 of a weight must be positive"),
        ("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "2"),
        ("[[1, 0], [0]]", "there are 2 rows, and row 2 has one entry"),
        ("[w, 1]", "unknown name 'w'"),
    ],
)
def test_weights_that_are_none(tmp_path: Path, rows: str, said: str) -> None:
    with pytest.raises(MechanismFileError) as caught:
        measured(tmp_path, FILE + WEIGHT.format(rows=rows))
    (fault,) = caught.value.faults
    assert said in fault.message
    assert (fault.line, fault.column > 1) == (14, True)


@pytest.mark.parametrize(
    ("rows", "value", "said"),
    [
        ("[w, 1]", "-1", "entry 1 of a weight must be positive"),
        ("[[2, w], [w, 2]]", "2", "not positive definite: its leading 2 by 2 part"),
    ],
)
def test_values_from_outside_that_spoil_a_weight(
    tmp_path: Path, rows: str, value: str, said: str
) -> None:
    text = FILE + "parameters: {w: 1}\n" + WEIGHT.format(rows=rows)
    path = tmp_path / "fingers.yaml"
    path.write_text(text, encoding="utf-8")
    assert sk.manipulability(sk.load(path, set_values={"w": "3/2"})).actuated
    for option in ("set_values", "at"):
        with pytest.raises(UnfitValueError) as caught:
            sk.load(path, **{option: {"w": value}})  # type: ignore[arg-type]
        flag = "--set" if option == "set_values" else "--at"
        assert f"{flag} w={value}: weights, rates: " in str(caught.value)
        assert said in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "said", "line"),
    [
        (", normal: [1, 0]", "", "normal", 12),
        ("normal: [1, 0]", "normal: [0, 0]", "zero", 12),
        ("actuated: [A, B]", "actuated: [A, ca]", "ca", 13),
        ("actuated: [A, B]", "actuated: [A, C]", "C", 13),
        ("child: ball, point: [-1, 1]", "child: bal, point: [-1, 1]", "'ball'", 11),
    ],
)
def test_contacts_and_actuators_that_are_none(
    tmp_path: Path, old: str, new: str, said: str, line: int
) -> None:
    with pytest.raises(MechanismFileError) as caught:
        measured(tmp_path, FILE.replace(old, new))
    first = caught.value.faults[0]
    assert said in first.message
    assert first.line == line


def test_a_platform_that_nothing_holds(tmp_path: Path) -> None:
    loose = FILE.replace("platform: ball", "platform: bell").replace(
        "ball]", "ball, bell]"
    )
    with pytest.raises(MechanismFileError, match="no limb holds the platform 'bell'"):
        measured(tmp_path, loose)


def test_a_posture_that_does_not_close(tmp_path: Path) -> None:
    """A triangle of bars moved to where its sides cannot meet."""
    path = tmp_path / "bars.yaml"
    path.write_text(
        "screwkit: 1\nname: bars\nspace: planar\ngeometry: reference\nbase: g\n"
        "platform: c\nlinks: [g, a, c, b]\njoints:\n"
        "  - {name: A, type: revolute, parent: g, child: a, point: [0, 0]}\n"
        "  - {name: B, type: revolute, parent: a, child: c, point: [0, 1]}\n"
        "  - {name: C, type: revolute, parent: c, child: b, point: [4, 1]}\n"
        "  - {name: D, type: revolute, parent: b, child: g, point: [4, 0]}\n"
        "actuated: [A]\n",
        encoding="utf-8",
    )
    moved = sk.load(path, at={"qA": "1/5", "qD": 2})
    with pytest.raises(ScrewkitError, match="qA"):
        sk.manipulability(moved)


def test_a_singular_posture_is_an_answer(tmp_path: Path) -> None:
    """The finger in line with the contact: what it cannot move is told, not refused."""
    line = FILE.replace("point: [-2, 0]", "point: [-3, 1]").replace(
        "point: [2, 0]", "point: [1, 3]"
    )
    answer = measured(tmp_path, line)
    assert answer.kinematic.zero + answer.kinematic.infinite > 0


def test_symbols_without_numbers_are_asked_for(tmp_path: Path) -> None:
    loose = FILE.replace("joints:", "parameters: {w: {}}\njoints:").replace(
        "[-2, 0]", "[-w, 0]"
    )
    with pytest.raises(UndecidedError, match="w"):
        measured(tmp_path, loose)


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("[A, B]", "[A, B]\nweights: {twist: [1, -1, 1]}", 14, "must be positive"),
        ("[A, B]", "[A, B]\nweights: {contact_forces: [1]}", 14, "6 entries"),
        ("[A, B]", "[A, B]\nweights: {tourques: [1]}", 14, "did you mean 'torques'"),
        ("[A, B]", "[A, cb]", 13, "cannot be actuated"),
        (", normal: [1, 0]", "", 12, "needs it"),
        ("type: hard_finger", "type: hardfinger", 11, "did you mean 'hard_finger'"),
        ("type: hard_finger", "type: soft_finger", 11, "does not exist in a planar"),
        ("point: [1, 1], ", "", 12, "'point' is missing"),
    ],
)
def test_the_program_says_where(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    old: str,
    new: str,
    line: int,
    said: str,
) -> None:
    """Exit code 3, nothing on standard output, one fault with its line and column."""
    path = tmp_path / "fingers.yaml"
    path.write_text(FILE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(SystemExit) as stop:
        cli.main(["manipulability", str(path), "--quiet"])
    out, err = capsys.readouterr()
    assert stop.value.code == 3
    assert out == ""
    first, *rest = err.splitlines()
    assert f"{path.name}:{line}:" in first
    assert said in first
    assert rest == ["1 error; nothing was computed"]


def test_a_singular_posture_exits_as_done(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The left finger points at its contact: along itself it moves nothing."""
    path = tmp_path / "fingers.yaml"
    path.write_text(FILE.replace("[-2, 0]", "[-3, 1]"), encoding="utf-8")
    with pytest.raises(SystemExit) as stop:
        cli.main(["manipulability", str(path), "--quiet"])
    out, _ = capsys.readouterr()
    assert stop.value.code == 0
    assert "WHO MOVES WITH WHOM" in out


def test_a_posture_that_is_not_reached_is_undecided(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Bars of √5 each: beyond a right angle at A they do not span from B to D."""
    path = tmp_path / "bars.yaml"
    path.write_text(
        "screwkit: 1\nname: bars\nspace: planar\ngeometry: reference\nbase: g\n"
        "platform: c\nlinks: [g, a, c, b]\njoints:\n"
        "  - {name: A, type: revolute, parent: g, child: a, point: [0, 0]}\n"
        "  - {name: B, type: revolute, parent: a, child: c, point: [2, 0]}\n"
        "  - {name: C, type: revolute, parent: c, child: b, point: [3, 2]}\n"
        "  - {name: D, type: revolute, parent: b, child: g, point: [4, 0]}\n"
        "actuated: [A]\n",
        encoding="utf-8",
    )
    with pytest.raises(SystemExit) as stop:
        cli.main(["manipulability", str(path), "--quiet", "--at", "qA=5/2"])
    out, err = capsys.readouterr()
    assert stop.value.code == 1
    assert "qA" in out + err


def test_a_mistyped_actuator_is_answered_with_a_joint_that_can_be_one(
    tmp_path: Path,
) -> None:
    """The contact 'ca' is as near to 'a9', but no motor can drive it."""
    text = FILE.replace("name: A,", "name: a1,").replace("[A, B]", "[a9, B]")
    with pytest.raises(MechanismFileError) as caught:
        measured(tmp_path, text)
    assert "unknown joint 'a9' (did you mean 'a1'?)" in caught.value.faults[0].message


def test_palm_contacts_alone_have_nothing_to_actuate(tmp_path: Path) -> None:
    lines = [x for x in FILE.splitlines() if "revolute" not in x and "act" not in x]
    text = "\n".join(lines).replace("parent: left", "parent: palm")
    text = text.replace("parent: right", "parent: palm").replace("left, right, ", "")
    answer = str(measured(tmp_path, text))
    assert "nothing can be actuated" in answer
    assert "all joints are taken" not in answer
