"""Geometry without sense: axes that vanish, parallel axes, poses of nothing, roots.

Each change is decided exactly: what is zero for all values of its symbols, or at those
of the file, is refused at its place; what merely looks like it is read.
"""

from __future__ import annotations

import pytest

from screwkit.algebra.parse import parse
from screwkit.errors import MechanismFileError
from screwkit.mechanism.files import mechanism_from_text
from screwkit.mechanism.vanishing import is_zero

TEXT = """screwkit: 1
name: degenerate
geometry: posture
base: ground
platform: plate
links: [ground, crank, rod, plate]
parameters: {a: 1, b: 1, c: {value: 2, positive: true}, d: {}}
variables: {x: 0.5, phi: {value: 0, angle: true}}
pose:
  translation: [x, 0, 1]
  rotation: {axis: z, angle: phi}
points:
  A1: [a, 0, 0]
  B1: {link: plate, at: [b, 0, 0]}
joints:
  - name: R
    type: revolute
    parent: ground
    child: crank
    axis: [0, 0, 1]
    point: A1
  - name: U
    type: universal
    parent: crank
    child: rod
    axes: [[1, 0, 0], [0, 1, 0]]
    point: A1
  - name: H
    type: helical
    parent: rod
    child: plate
    axis: [0, 0, 1]
    point: B1
    pitch: 1/2
variants:
  other: {values: {a: 3}}
"""
AXIS = "axis: [0, 0, 1]\n    point: A1"
AXES = "axes: [[1, 0, 0], [0, 1, 0]]"
ROTATION = "rotation: {axis: z, angle: phi}"


def read(old: str, new: str) -> None:
    assert TEXT.count(old) == 1
    mechanism_from_text(TEXT.replace(old, new), "file")


def test_the_file_itself_is_right() -> None:
    read("name: degenerate", "name: right")


@pytest.mark.parametrize(
    "axis",
    [
        *("[0, 0, 0]", "[a - a, 0, 0]", "[sin(pi), 0, 0]", "[1 - cos(0), 0, 0]"),
        *("B1 - B1", "B1 - A1 + A1 - B1", "cross(B1, B1)", "0*B1"),
        *("[sqrt(2)*sqrt(3) - sqrt(6), 0, 0]", "[0, sin(phi)^2 + cos(phi)^2 - 1, 0]"),
        *(
            "[0, 0, 2*cos(pi/5) - (1 + sqrt(5))/2]",
            "[0, 0, (a + b)*(a - b) - a^2 + b^2]",
        ),
        *("['cos(atan2(3, 4)) - 4/5', 0, 0]", "[sin(phi + x) - sin(x + phi), 0, 0]"),
    ],
)
def test_an_axis_that_is_zero(axis: str) -> None:
    with pytest.raises(MechanismFileError, match=r"file:20:11  .*the axis is zero; wr"):
        read(AXIS, f"axis: {axis}\n    point: A1")


@pytest.mark.parametrize(
    "axis",
    [
        *("[1e-30, 0, 0]", "[d, 0, 0]", "[0, d - x, 0]", "[sqrt(a^2) + d, 0, 0]"),
        *("B1 - A1", "[sin(pi/1000), 0, 0]", "[sqrt(2) + sqrt(3) - 3.14626, 0, 0]"),
        *("[a^2 + b^2 - d^2, 0, 0]", "[0, cos(d), 0]", "[tan(phi) + 1, 0, 0]"),
    ],
)
def test_an_axis_that_is_not_zero(axis: str) -> None:
    read(AXIS, f"axis: {axis}\n    point: A1")


@pytest.mark.parametrize(
    ("axis", "message"),
    [
        (
            "[a - b, 0, 0]",
            "file:20:11  joint 'R', axis: the axis is zero at the values",
        ),
        ("[sin(phi), 0, 0]", "the axis is zero at the values of the file"),
        ("[sqrt(c) - sqrt(2), 0, 0]", "the axis is zero at the values of the file"),
        (
            "[a - 3, 0, b - 1]",
            "file:36:19 .*the axis is zero at the .* variant 'other'",
        ),
    ],
)
def test_an_axis_that_vanishes_at_the_values(axis: str, message: str) -> None:
    with pytest.raises(MechanismFileError, match=message):
        read(AXIS, f"axis: {axis}\n    point: A1")


@pytest.mark.parametrize(
    ("axes", "message"),
    [
        ("[[1, 0, 0], [2, 0, 0]]", "26:11  joint 'U', axes: the two axes .*parallel"),
        ("[[1, 0, 0], [-1/3, 0, 0]]", "parallel; give two directions"),
        ("[[a, 0, 0], [2*a, 0, 0]]", "parallel; give two directions"),
        ("[[a, b, 0], [a*d, b*d, 0]]", "parallel; give two directions"),
        ("[A1, A1 + A1]", "parallel; give two directions"),
        ("[[cos(phi), sin(phi), 0], [1, tan(phi), 0]]", "parallel; give two"),
        ("[[1, 1, 0], [a, b, 0]]", "parallel at the values of the file"),
        ("[[3, 1, 0], [a, b, 0]]", "36:19 .*parallel at the values of variant 'other'"),
        ("[[1, 0, 0], [a - a, 0, 0]]", "26:23  joint 'U', axes, 1: the axis is zero"),
        ("[[1, 0, 0]]", "two entries are expected"),
        ("[1, 0, 0]", "two entries are expected"),
    ],
)
def test_axes_of_a_universal_joint(axes: str, message: str) -> None:
    with pytest.raises(MechanismFileError, match=message):
        read(AXES, f"axes: {axes}")


def test_axes_that_are_parallel_nowhere() -> None:
    read(AXES, "axes: [[1, 1, 0], [a, d, 0]]")
    read(AXES, "axes: [[1, 0, 0], [1, 1e-20, 0]]")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("A1: [a, 0, 0]", "A1: [1/(a - b), 0, 0]", "13:8 .*'a - b' is 0 at the values"),
        ("A1: [a, 0, 0]", "A1: [1/(a - a), 0, 0]", "13:8 .*'a - a' is 0$"),
        (
            "A1: [a, 0, 0]",
            "A1: [1/(a - 3), 0, 0]",
            "'a - 3' is 0 at .* variant 'other'",
        ),
        ("A1: [a, 0, 0]", "A1: [1/0, 0, 0]", "division by zero"),
        (
            "A1: [a, 0, 0]",
            "A1: [sqrt(a - c), 0, 0]",
            r"'sqrt\(a - c\)', is not real at",
        ),
        ("A1: [a, 0, 0]", "A1: [sqrt(-2), 0, 0]", "root of a negative number"),
        ("A1: [a, 0, 0]", "A1: [sqrt(1 - sqrt(2)), 0, 0]", "root of a negative number"),
        (
            "A1: [a, 0, 0]",
            "A1: [cos(asin(c)), 0, 0]",
            "asin takes numbers from -1 to 1",
        ),
        ("A1: [a, 0, 0]", "A1: [tan(pi/2), 0, 0]", "is infinite"),
        (
            "A1: [a, 0, 0]",
            "A1: ['tan(atan2(1, a - 1))', 0, 0]",
            "is infinite at the values",
        ),
        (
            "A1: [a, 0, 0]",
            "A1: ['cos(atan2(a - b, 0))', 0, 0]",
            "atan2.0, 0. at the val",
        ),
        (
            "c: {value: 2",
            "c: {value: -2",
            "7:37 .*declared positive, but the value is -2",
        ),
        ("c: {value: 2", "c: {value: sqrt(a - 2)", "root of a negative|no real number"),
        ("pitch: 1/2", "pitch: 1/(a - b)", "is 0 at the values of the file"),
        (
            "    pitch: 1/2\n",
            "",
            "the key 'pitch' is missing; a helical joint needs it",
        ),
        ("point: B1", "point: B2", r"unknown name 'B2' \(did you mean 'B1'\?\)"),
        ("{link: plate, at: [b, 0, 0]}", "[b, 0, 0]", "9:1  pose: no point or vector"),
        (
            "link: plate, at: [b",
            "link: rod, at: [b",
            "14:14 .*frame of 'rod' is not known",
        ),
        ("link: plate, at: [b", "link: plte, at: [b", r"did you mean 'plate'\?"),
        (
            "  translation:",
            "  link: rod\n  translation:",
            "the pose is that of the platf",
        ),
        ("A1: [a, 0, 0]", "A1: B1 + [1, 0, 0]", "'\\['"),
        ("A1: [a, 0, 0]", "A1: 2*A1", "13:3 .*'A1' depends on itself"),
        ("A1: [a, 0, 0]", "A1: [a, 0]", "three coordinates, but 2 were found"),
        ("A1: [a, 0, 0]", "A1: [a, 0, 0, 1]", "three coordinates, but 4 were found"),
        ("A1: [a, 0, 0]", "A1: a", "vector"),
        (
            ROTATION,
            "rotation: {quaternion: [0, 0, 0, 0]}",
            "11:26 .*quaternion is zero",
        ),
        (
            ROTATION,
            "rotation: {quaternion: [a - a, 0, 0, 0]}",
            "the quaternion is zero;",
        ),
        (
            ROTATION,
            "rotation: {quaternion: [a - b, 0, 0, 0]}",
            "zero at the values of the",
        ),
        (ROTATION, "rotation: {quaternion: [1, 0, 0]}", "four entries, not 3"),
        (
            ROTATION,
            "rotation: {axis: [a - b, 0, 0], angle: 1}",
            "zero at the values of",
        ),
        (
            ROTATION,
            "rotation: {axis: [a - a, 0, 0], angle: 1}",
            "axis: the axis is zero",
        ),
        (ROTATION, "rotation: {axis: z}", "has the keys axis and angle"),
        (ROTATION, "rotation: {euler: zy, angles: [0, 0]}", "no order of axes"),
        ("variables: {x: 0.5,", "variables: {x: y,", "unknown name 'y'"),
        ("variables: {x: 0.5,", "variables: {x: d + 1,", "'d' has no value to compute"),
        (
            "child: crank",
            "child: wheel",
            "unknown link 'wheel'; the links are ground, cr",
        ),
        ("child: crank", "child: ground", "to itself; parent and child are two bodies"),
    ],
)
def test_one_change(old: str, new: str, message: str) -> None:
    with pytest.raises(MechanismFileError, match=message) as caught:
        read(old, new)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize(
    ("old", "new"),
    [
        *(("pitch: 1/2", f"pitch: {pitch}") for pitch in ("0", "-1/2", "a - b", "d")),
        ("A1: [a, 0, 0]", "A1: [1/(a - d), sqrt(d), acos(d)*0]"),
        ("A1: [a, 0, 0]", "A1: [sqrt(a - b), 1/(a + b), 0]"),
        (ROTATION, "rotation: {quaternion: [a, b, c, d]}"),
        (ROTATION, "rotation: {quaternion: [0, 0, 1e-9, 0]}"),
    ],
)
def test_what_is_legal(old: str, new: str) -> None:
    read(old, new)


def test_points_that_refer_to_each_other() -> None:
    with pytest.raises(MechanismFileError) as caught:
        read("A1: [a, 0, 0]", "A1: 2*B2\n  B2: A1 + A1")
    first, second = caught.value.faults
    assert (first.line, first.column) == (13, 3)
    assert "'A1' depends on itself through 'B2'" in first.message
    assert "'B2' depends on itself through 'A1'" in second.message


def test_all_of_them_at_once() -> None:
    text = TEXT.replace(AXIS, "axis: [a - b, 0, 0]\n    point: A1").replace(
        "point: B1", "point: B7"
    )
    text = text.replace(AXES, "axes: [[a, 0, 0], [2*a, 0, 0]]").replace(
        "1/2", "1/(a-b)"
    )
    with pytest.raises(MechanismFileError) as caught:
        mechanism_from_text(text, "file")
    words = ["at the values", "parallel", "unknown name 'B7'", "division by zero"]
    found = [fault.message for fault in caught.value.faults]
    assert len(found) == len(words)
    assert all(w in message for w, message in zip(words, found, strict=True))


def test_what_named_points_spread_is_reported_once() -> None:
    text = TEXT.replace(
        "B1: {link: plate, at: [b,", "B1: {link: plate, at: [1/(a - b),"
    )
    text = text.replace(AXIS, "axis: B1 - A1\n    point: A1")
    with pytest.raises(MechanismFileError) as caught:
        mechanism_from_text(text, "file")
    (fault,) = caught.value.faults
    assert fault.line == 14


REFERENCE = TEXT.replace("geometry: posture", "geometry: reference").replace(
    TEXT[TEXT.index("pose:") : TEXT.index("points:")], ""
)


def test_frames_of_a_reference_file_are_that_of_the_base() -> None:
    mechanism_from_text(REFERENCE.replace("link: plate", "link: rod"), "file")


PLANAR = """screwkit: 1
name: flat
space: planar
geometry: posture
base: ground
platform: plate
links: [ground, plate]
parameters: {a: 1}
joints:
  - name: R
    type: revolute
    parent: ground
    child: plate
    axis: [0, 0, a]
    point: [a, 0]
  - {name: P, type: prismatic, parent: ground, child: plate, axis: [a, 1]}
"""


def test_planar_files() -> None:
    mechanism_from_text(PLANAR, "flat")
    for old, new, message in (
        ("[0, 0, a]", "[0, a, 1]", "in a planar file this direction is along z"),
        ("[a, 1]", "[a, 1, a]", "in a planar file this direction is in the xy plane"),
        ("[a, 1]", "[a - 1, 0]", "the axis is zero at the values of the file"),
        ("P, type: prismatic", "P, type: helical", "does not exist in a planar file"),
    ):
        with pytest.raises(MechanismFileError, match=message):
            mechanism_from_text(PLANAR.replace(old, new), "flat")
    mechanism_from_text(PLANAR.replace("[0, 0, a]", "[a - a, 0, a]"), "flat")


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("0", True),
        ("a - a", True),
        ("1/(a - b) - 1/(a - b)", True),
        ("sin(a + b) - sin(a)*cos(b) - cos(a)*sin(b)", True),
        ("sqrt(a) - sqrt(a)", True),
        ("a - b", False),
        ("sin(pi/7)", False),
        ("sqrt(3)*a - sqrt(2)*a", False),
        ("sqrt(a^2) - a", None),
        ("asin(0)", None),
        ("(a + b + c + x + y + z)^64 - (z + b + c + x + y + a)^64", None),
    ],
)
def test_zero_is_proved_or_open(text: str, answer: bool | None) -> None:
    assert is_zero(parse(text)) is answer
