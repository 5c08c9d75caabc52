"""Ranges of tables that tie their joint variables: they start where these close.

Expected values are plane trigonometry at the postures, or follow by hand.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan2, cos, hypot, sin
from pathlib import Path

import numpy as np
import pytest

import screwkit as sk
from screwkit.algebra.expression import Number
from screwkit.case import Case
from screwkit.errors import UndecidedError
from screwkit.finite.table_search import closed_posture
from screwkit.kinematics.values import declared_values, with_values
from screwkit.sweeps.objective import objective_of

HEAD = """screwkit: 1
name: linkage
geometry: mdh
base: base
platform: rod
links: [base, crank, rod, rocker, tip]
"""
FOUR_BAR = (
    HEAD
    + """parameters: {{g: {{{value}}}}}
joints:
  - {{name: A, type: revolute, parent: base, child: crank, mdh: {{}}}}
  - {{name: B, type: revolute, parent: crank, child: rod, mdh: {{d: 1}}}}
  - {{name: C, type: revolute, parent: rod, child: rocker, mdh: {{d: 3}}}}
  - {{name: E, type: fixed, parent: rocker, child: tip, mdh: {{d: 2}}}}
  - {{name: D, type: revolute, parent: base, child: tip, mdh: {{d: g}}}}
actuated: [A]
"""
)
SQUARE = (  # its sides turn the corners by offsets
    HEAD
    + """parameters: {a: {value: 2}}
joints:
  - {name: A, type: revolute, parent: base, child: crank, mdh: {}, offset: pi/2}
  - {name: B, type: revolute, parent: crank, child: rod, mdh: {d: a}, offset: -pi/2}
  - {name: C, type: revolute, parent: rod, child: rocker, mdh: {d: 2}, offset: -pi/2}
  - {name: E, type: fixed, parent: rocker, child: tip, mdh: {d: a}}
  - {name: D, type: revolute, parent: base, child: tip, mdh: {d: 2}, offset: -pi/2}
actuated: [A]
"""
)
SLIDER = (  # a crank of 1, a rod of 3; the slider's variable counts from s
    HEAD
    + """parameters: {s: {value: 4}}
joints:
  - {name: A, type: revolute, parent: base, child: crank, mdh: {}}
  - {name: B, type: revolute, parent: crank, child: rod, mdh: {d: 1}}
  - {name: C, type: revolute, parent: rod, child: rocker, mdh: {d: 3}}
  - {name: E, type: fixed, parent: rocker, child: tip, mdh: {gamma: pi/2, alpha: pi/2}}
  - {name: D, type: prismatic, parent: base, child: tip,
     mdh: {gamma: pi/2, alpha: pi/2, r: s}}
actuated: [A]
"""
)
BENNETT = (
    HEAD
    + """joints:
  - {name: A, type: revolute, parent: base, child: crank, mdh: {}}
  - {name: B, type: revolute, parent: crank, child: rod, mdh: {d: 1, alpha: pi/6}}
  - {name: C, type: revolute, parent: rod, child: rocker, mdh: {d: 2, alpha: pi/2}}
  - {name: E, type: fixed, parent: rocker, child: tip, mdh: {d: 1, alpha: pi/6}}
  - {name: D, type: revolute, parent: base, child: tip, mdh: {d: -2, alpha: -pi/2}}
actuated: [A]
"""
)


def loaded(folder: Path, text: str, **options: object) -> Case:
    path = folder / "linkage.yaml"
    path.write_text(text, encoding="utf-8")
    return sk.load(path, **options)  # type: ignore[arg-type]


def four_bar(value: str = "value: 3") -> str:
    return FOUR_BAR.format(value=value)


def settled(case: Case) -> dict[str, float]:
    """Where the program finds it closed."""
    mechanism = case.mechanism
    found = closed_posture(with_values(mechanism, declared_values(mechanism)))
    assert found.closed
    return dict(found.values)


def rod_speed(start: dict[str, float], frame: float, turned: float = 0) -> float:
    """ω² + |v|² of the rod for a unit rate of the crank, turned on from its start.

    v is that of the point of the rod that was at the pivot of the crank to begin with.
    The rod turns about the point where the lines of crank and rocker meet; its joint C
    is at 3 from B and at 2 from D, on the side where it was.
    """
    first, second = start["qA"], start["qA"] + start["qB"]
    before = np.array([cos(first), sin(first)])
    near = before + 3 * np.array([cos(second), sin(second)])
    crank, d = first + turned, np.array([frame, 0.0])
    b = np.array([cos(crank), sin(crank)])
    x, y = d - b
    size = hypot(x, y)
    along = (9 - 4 + size**2) / (2 * size)
    off = np.sqrt(9 - along**2)
    foot = b + along / size * np.array([x, y])
    normal = np.array([-y, x]) / size
    both = (foot + off * normal, foot - off * normal)
    c = min(both, key=lambda p: float(np.linalg.norm(p - near)))
    # b·t = d + (c − d)·u is the centre; the end of the crank is at b for t = 1.
    t, _ = np.linalg.solve(np.stack([b, d - c], axis=1), d)
    rate = 1 / (1 - t)  # v of B is that of the crank
    turn = atan2(*(c - b)[::-1]) - second
    rows = np.array([[cos(turn), -sin(turn)], [sin(turn), cos(turn)]])
    point = b - rows @ before
    return float(rate**2 * (1 + ((point - t * b) ** 2).sum()))


def test_a_crank_is_turned_from_where_the_table_closes(tmp_path: Path) -> None:
    case = loaded(tmp_path, four_bar())
    start, steps = settled(case), np.array([0.0, 0.15, 0.3])
    first, *_, last = map(float, start["qA"] + steps)
    found = sk.sweep(case, [f"qA={first!r}:{last!r}:3"]).values
    wanted = [rod_speed(start, 3.0, float(step)) for step in steps]
    assert np.allclose(found, wanted, rtol=1e-7)


def test_lengths_are_varied_where_the_table_closes_with_them(tmp_path: Path) -> None:
    """Not at 0, where the links lie on one line and do not meet."""
    found = sk.sweep(loaded(tmp_path, four_bar()), ["g=2.5:3.5:3"]).values
    for value, frame in zip(found, (2.5, 3.0, 3.5), strict=True):
        start = settled(loaded(tmp_path, four_bar(f"value: {frame}")))
        assert np.isclose(value, rod_speed(start, frame), rtol=1e-7)


def test_a_frame_that_is_too_long_has_no_value(tmp_path: Path) -> None:
    """The others reach 1 + 3 + 2."""
    found = sk.sweep(loaded(tmp_path, four_bar()), ["g=3:7:2"], "force.max")
    assert np.isfinite(found.values[0])
    assert np.isnan(found.values[1])
    assert found.answer.undefined == 1


def test_a_table_that_closes_nowhere_is_refused(tmp_path: Path) -> None:
    """`load` refuses it at once; a mechanism from elsewhere may come so far."""
    mechanism = loaded(tmp_path, four_bar()).mechanism
    far = with_values(mechanism, {"g": Number(Fraction(7))})
    with pytest.raises(UndecidedError, match="no closed posture was found"):
        objective_of(far, "kinematic.min", ("qA",))


def test_a_table_without_a_value_is_refused(tmp_path: Path) -> None:
    case = loaded(tmp_path, four_bar("positive: true"))
    with pytest.raises(UndecidedError, match="g must have a value there"):
        sk.sweep(case, ["g=3:4:2"])


def test_a_table_closed_at_0_for_every_length_stays_there(tmp_path: Path) -> None:
    """The coupler of a parallelogram moves as the end of its crank, of length a."""
    found = sk.sweep(loaded(tmp_path, SQUARE), ["a=1:3:3", "qA=0:0.4:2"]).values
    assert np.allclose(found, [[1, 1], [4, 4], [9, 9]])
    assert np.allclose(
        sk.sweep(loaded(tmp_path, SQUARE), ["a=1:3:3"]).values, [1, 4, 9]
    )


def test_a_table_closed_at_0_for_one_length_alone_is_closed_for_the_others(
    tmp_path: Path,
) -> None:
    """Where the slider counts from changes nothing: in line, the rod turns about C.

    The end of the crank moves at 1, at 3 from C: ω = 1/3, and the point at the origin,
    at 4 from C, moves at 4/3.
    """
    found = sk.sweep(loaded(tmp_path, SLIDER), ["s=3:5:5"]).values
    assert np.allclose(found, 17 / 9)


@pytest.mark.parametrize("text", [BENNETT, four_bar()], ids=["bennett", "four-bar"])
@pytest.mark.parametrize("kind", ["kinematic", "force"])
def test_ranges_agree_with_single_postures(
    tmp_path: Path, text: str, kind: str
) -> None:
    case = loaded(tmp_path, text)
    first = settled(case)["qA"]
    found = sk.sweep(case, [f"qA={first!r}:{first + 0.2!r}:3"], f"{kind}.max").values
    for step, value in zip((0.0, 0.1, 0.2), found, strict=True):
        here = loaded(tmp_path, text, at={"qA": repr(first + step)})
        finite = getattr(sk.manipulability(here), kind).finite
        assert np.isclose(value, finite[0], rtol=1e-7)
