"""Mechanisms moved to joint variables by `at`, against what their links allow."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from math import acos, atan2, cos, hypot, pi, sin, sqrt, tan
from pathlib import Path

import numpy as np
import pytest
from loci.numeric import Array

import screwkit as sk
from screwkit import cli
from screwkit.errors import ExpressionError, UndecidedError, UnknownNameError
from screwkit.questions import mobility
from screwkit.reports.records import from_json, to_json
from screwkit.results.mobility import AtPosture, Mobility

REFERENCE = Path(__file__).parents[1] / "reference" / "nao_expected.json"


def moved(case: str, **at: object) -> AtPosture:
    found = mobility(sk.load(case, at=at)).at_posture
    assert found is not None
    return found


def reached(case: str, **at: object) -> tuple[AtPosture, dict[str, float]]:
    found = moved(case, **at)
    assert found.closed, found.reason
    assert not found.reason
    q = dict(zip(found.variables, found.values, strict=True))
    return found, {name.removeprefix("q"): value for name, value in q.items()}


def screwkit(*words: str) -> int:
    with pytest.raises(SystemExit) as stop:
        cli.main(list(words))
    assert isinstance(stop.value.code, int)
    return stop.value.code


def turned(vector: Array, angle: float) -> Array:
    c, s = cos(angle), sin(angle)
    return np.array([[c, -s], [s, c]]) @ vector


# -- closed loops are moved as their links demand --------------------------------------

A, B, C, D = map(np.array, ([0.0, 0.0], [1.0, 2.0], [5.0, 3.0], [6.0, 0.0]))
CRANK, COUPLER, ROCKER, FRAME = sqrt(5), sqrt(17), sqrt(10), 6.0
FURTHEST = acos((CRANK**2 + FRAME**2 - (COUPLER + ROCKER) ** 2) / (2 * CRANK * FRAME))
"""Where coupler and rocker lie in one line: the crank turns no further."""


@pytest.mark.parametrize(
    ("text", "angle"), [("-1/5", -0.2), ("pi/4", pi / 4), ("-pi/6", -pi / 6), ("0", 0)]
)
def test_the_four_bar_turns_as_trigonometry_says(text: str, angle: float) -> None:
    found, q = reached("four_bar_planar", qA=text)
    assert q["A"] == pytest.approx(angle, abs=1e-12)
    crank = turned(B - A, angle)
    # The rocker by the law of cosines, on the side on which it stands in the file.
    across = D - crank
    reach = hypot(*across)
    inner = acos((COUPLER**2 + reach**2 - ROCKER**2) / (2 * COUPLER * reach))
    coupler = atan2(across[1], across[0]) + inner
    start = atan2(*(C - B)[::-1])
    assert q["A"] + q["B"] == pytest.approx(coupler - start, abs=1e-9)
    joint = crank + COUPLER * np.array([cos(coupler), sin(coupler)])
    rocker = atan2(*(joint - D)[::-1]) - atan2(*(C - D)[::-1])
    assert -q["D"] == pytest.approx(rocker, abs=1e-9)  # D moves the base on the rocker
    assert sum(q.values()) == pytest.approx(0, abs=1e-9)
    assert (found.loop_rank, found.redundant_constraints) == (3, 3)
    assert (found.instantaneous_mobility, found.motion_type) == (1, "0T1R")
    assert (found.remaining_mobility, found.remaining_platform_freedom) == (0, 0)


@pytest.mark.parametrize("angle", ["pi/3", "pi"])
def test_the_four_bar_stops_where_coupler_and_rocker_are_in_line(angle: str) -> None:
    found = moved("four_bar_planar", qA=angle)
    assert not found.closed
    stop = FURTHEST - atan2(2, 1)
    assert f"the mechanism turns back at qA = {stop:.6g}: a dead point" in found.reason
    last = dict(zip(found.variables, found.values, strict=True))["qA"]
    assert last == pytest.approx(stop, abs=1e-9)


def test_angles_too_far_to_be_followed_are_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert screwkit("mobility", "bennett", "--at", "qA=1e9") == 2
    assert "A would move by 1e+09, too far to be followed" in capsys.readouterr().err
    found, _ = reached("bennett", qA="4*pi + 1")
    assert found.values[0] == pytest.approx(4 * pi + 1)


def test_the_bennett_linkage_keeps_its_product_of_tangents() -> None:
    """tan(A/2)·tan(B/2) of the angles at neighbouring corners is constant [Bennett]."""
    corners = [np.array(p) for p in ((3, 0, 1), (1, 2, -1), (-3, 0, 1), (-1, -2, -1))]

    def angle(k: int) -> float:
        before, here, after = (corners[i % 4] for i in (k - 1, k, k + 1))
        cosine = (before - here) @ (after - here)
        sizes = np.linalg.norm(before - here) * np.linalg.norm(after - here)
        return acos(float(cosine / sizes))

    constant = tan(angle(0) / 2) * tan(angle(1) / 2)
    for text in ("pi/3", "-2/5", "1"):
        found, q = reached("bennett", qA=text)
        # Each axis is the product of the sides before and behind: they open by q.
        first, second = angle(0) + q["A"], angle(1) + q["B"]
        assert tan(first / 2) * tan(second / 2) == pytest.approx(constant, rel=1e-8)
        assert (q["C"], q["D"]) == pytest.approx((q["A"], q["B"]), abs=1e-9)
        assert (found.loop_rank, found.motion_type, found.couples) == (3, "0T1R", 2)


LEGS = {  # foot, and the corner of the platform at the posture of the file
    "1": (np.array([0.0, 0.0]), np.array([2.0, 2.0])),
    "2": (np.array([6.0, 0.0]), np.array([3.6, 3.2])),
    "3": (np.array([2.0, 5.0]), np.array([2.2, 3.4])),
}


@pytest.mark.parametrize(
    "lengths", [("1/2", "-1/4", "3/10"), ("0", "1", "0"), ("-1/3", "2/5", "sqrt(2)/2")]
)
def test_the_planar_platform_goes_where_its_legs_put_it(
    lengths: tuple[str, str, str],
) -> None:
    wanted = dict(zip(("qP1", "qP2", "qP3"), lengths, strict=True))
    found, q = reached("3rpr_planar", **wanted)
    numbers = {"sqrt(2)/2": sqrt(2) / 2}
    ends = {}
    for leg, (foot, corner) in LEGS.items():
        text = wanted[f"qP{leg}"]
        over, _, under = text.partition("/")
        number = numbers.get(text) or float(over) / float(under or 1)
        assert q[f"P{leg}"] == pytest.approx(number, abs=1e-9)
        stretched = 1 + number / float(np.linalg.norm(corner - foot))
        ends[leg] = foot + turned(stretched * (corner - foot), q[f"R{leg}"])
    turns = [q[f"R{leg}"] + q[f"Q{leg}"] for leg in LEGS]
    assert turns == pytest.approx([turns[0]] * 3, abs=1e-9)
    for leg in ("2", "3"):
        side = LEGS[leg][1] - LEGS["1"][1]
        assert ends[leg] - ends["1"] == pytest.approx(turned(side, turns[0]), abs=1e-9)
    assert (found.motion_type, found.loop_rank) == ("2T1R", 6)
    assert (found.redundant_constraints, found.remaining_mobility) == (6, 0)


def test_two_motors_place_the_point_of_the_five_bar() -> None:
    """The point is at its distances from both elbows."""
    found, q = reached("five_bar", qA="pi/6", qE="-pi/6")
    left = turned(np.array([-1.0, 2.0]), pi / 6)
    right = np.array([4.0, 0.0]) + turned(np.array([1.0, 2.0]), pi / 6)
    point = left + turned(np.array([3.0, 2.0]), q["A"] + q["B"])
    assert np.linalg.norm(point - right) == pytest.approx(hypot(3, 2), abs=1e-9)
    turn = q["A"] + q["B"] + q["C"]
    other = right + turned(np.array([-3.0, 2.0]), turn)
    assert point == pytest.approx(other, abs=1e-9)
    assert (found.motion_type, found.instantaneous_mobility) == ("1T1R", 2)
    assert found.remaining_mobility == 0


def test_other_answers_stay_those_of_the_file() -> None:
    here = mobility(sk.load("four_bar_planar"))
    there = mobility(sk.load("four_bar_planar", at={"qA": "-1/5"}))
    assert here.at_posture is None
    assert (there.loop_rank, there.platform) == (here.loop_rank, here.platform)
    assert there.at_values == here.at_values


# -- symbols of posture files ----------------------------------------------------------


def test_a_symbol_of_a_posture_is_put_in() -> None:
    """B, C and D in one line: a dead point of the crank."""
    answer = mobility(sk.load("four_bar_planar", at={"yb": "9", "xb": "3", "d": "6"}))
    assert answer.at_posture is None
    assert answer.at_values is not None
    assert answer.at_values.actuation is not None
    assert answer.at_values.actuation.remaining_mobility == 1
    given = sk.load("four_bar_planar", set_values={"yb": "9", "xb": "3", "d": "6"})
    assert mobility(given) == answer


def test_a_symbol_and_a_joint_variable_together() -> None:
    """The mechanism is moved from the posture that the symbols describe."""
    _, q = reached("four_bar_planar", yc="4", qA="1/10")
    crank = turned(B - A, 0.1)
    joint = crank + turned(np.array([4.0, 2.0]), q["A"] + q["B"])
    assert np.linalg.norm(joint - D) == pytest.approx(hypot(1, 4), abs=1e-9)


# -- joint variables that nothing ties together ----------------------------------------


@cache
def strata() -> Mapping[str, Mapping[str, int]]:
    found: Mapping[str, Mapping[str, int]] = json.loads(REFERENCE.read_text())["strata"]
    return found


@pytest.mark.parametrize(
    ("at", "stratum"),
    [
        ({"q4": "0"}, "sin(q4)=0"),
        ({"q4": "pi"}, "sin(q4)=0"),
        ({"q4": "0", "q9": "-pi"}, "sin(q4)=sin(q9)=0"),
        ({"q2": "-pi/3"}, "T2=0"),
        ({"q2": "-pi/3", "q7": "pi/3"}, "T2=T7=0"),
        ({"q2": "atan(-sqrt(3))", "q7": "pi/3 - pi"}, "T2=T7=0"),
        ({"q2": "-pi/3", "q7": "pi/3", "q4": "0"}, "T2=T7=sin(q4)=0, cos(q3)!=0"),
        ({"q2": "pi/3", "q7": "-pi/3"}, "generic"),
        ({"q6": "pi/5", "q1": "pi/5"}, "q6=q1"),
    ],
)
def test_nao_at_angles_is_exact(at: dict[str, str], stratum: str) -> None:
    """With r3 = √3·d3 the singular angles of the shoulders are ∓π/3."""
    lengths = {"d3": "1", "r3": "sqrt(3)"}
    answer = mobility(sk.load("nao_t14", set_values=lengths, at=at))
    expected = strata()[stratum]
    assert answer.at_posture is None
    assert answer.generic
    assert answer.loop_rank == expected["rank_loop"]
    assert answer.instantaneous_mobility == expected["mobility"]
    assert answer.platform.twist_dimension == expected["platform_twist_dimension"]


def test_nao_is_singular_at_the_lengths_of_the_file_only() -> None:
    """tan(q2) = −r3/d3 = −7: nothing special for other lengths."""
    answer = mobility(sk.load("nao_t14", at={"q2": "-atan(7)", "q7": "atan(7)"}))
    assert (answer.loop_rank, answer.platform.twist_dimension) == (6, 4)
    assert answer.at_values is not None
    assert answer.at_values.loop_rank == 5
    assert answer.at_values.platform.twist_dimension == 3


# -- what is not there -----------------------------------------------------------------


def test_unknown_names_and_what_is_no_constant() -> None:
    with pytest.raises(UnknownNameError, match=r"no symbol 'qAA'.*did you mean 'qA'"):
        sk.load("four_bar_planar", at={"qAA": "1"})
    with pytest.raises(UnknownNameError, match=r"no symbol 'q44'.*did you mean 'q4'"):
        sk.load("nao_t14", at={"q44": "0"})
    with pytest.raises(ExpressionError, match="'x'"):
        sk.load("four_bar_planar", at={"qA": "x + 1"})


def test_exit_codes_of_the_command_line(capfd: pytest.CaptureFixture[str]) -> None:
    case = ("mobility", "four_bar_planar", "--json", "--at")
    assert screwkit(*case, "qA=-1/5") == 0
    there = json.loads(capfd.readouterr().out)["at_posture"]
    assert there["closed"] is True
    assert there["values"][0] == pytest.approx(-0.2)
    assert screwkit(*case, "qA=pi") == 1
    assert json.loads(capfd.readouterr().out)["at_posture"]["closed"] is False
    assert screwkit(*case, "qAA=1") == 2
    output, errors = capfd.readouterr()
    assert "did you mean 'qA'" in errors
    assert json.loads(output)["error"]["kind"] == "usage"


@pytest.mark.parametrize("angle", ["-1/5", "pi"])
def test_json_keeps_where_the_mechanism_came_to(angle: str) -> None:
    answer = mobility(sk.load("four_bar_planar", at={"qA": angle}))
    back = from_json(json.loads(json.dumps(to_json(answer))))
    assert isinstance(back, Mobility)
    assert back == answer
    assert back.at_posture is not None


def test_a_held_angle_in_symbols_takes_the_values_of_the_file() -> None:
    """As `singularities` prints it; generic and at the values it is one family."""
    at = {"q2": "atan(-r3/d3)", "q7": "atan(r3/d3)"}
    answer = sk.mobility(sk.load("nao_t14", at=at))
    assert (answer.loop_rank, answer.platform.twist_dimension) == (5, 3)
    assert answer.at_values is not None
    assert answer.at_values.loop_rank == 5
    assert answer.at_values.platform.motion_type == answer.platform.motion_type


@pytest.mark.parametrize("question", [sk.screws, sk.singularities, sk.schemes])
def test_what_is_proved_is_not_asked_where_only_numbers_are_known(
    question: Callable[[sk.Case], object],
) -> None:
    moved = sk.load("four_bar_planar", at={"qA": "3/10"})
    with pytest.raises(UndecidedError, match="loops tie qA to other joint variables"):
        question(moved)
