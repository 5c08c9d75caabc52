"""Wrong weights, contacts and actuators: refused with place, cause and suggestion."""

from __future__ import annotations

from pathlib import Path

import pytest

import screwkit as sk
from screwkit.errors import MechanismFileError, ScrewkitError, UndecidedError
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
        ("[[1, 0], [0]]", "row"),
    ],
)
def test_weights_that_are_none(tmp_path: Path, rows: str, said: str) -> None:
    with pytest.raises(MechanismFileError) as caught:
        measured(tmp_path, FILE + WEIGHT.format(rows=rows))
    (fault,) = caught.value.faults
    assert said in fault.message
    assert (fault.line, fault.column > 1) == (14, True)


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
