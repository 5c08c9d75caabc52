"""Limits of distances, and what is told while they are looked for."""

from __future__ import annotations

from math import atan, cos, hypot, pi, sin

import numpy as np
import pytest

import screwkit as sk
from screwkit.case import load_text
from screwkit.errors import ExpressionError, UnknownNameError
from screwkit.reports.records import from_json, to_json
from screwkit.results.distance import Distance


def test_a_planar_platform_that_may_not_turn_back() -> None:
    """Without limits the nearest posture has phi = 0.615; here the limit is reached."""
    limits = ["phi=63/100:8/10", "x=-3:3"]
    answer = sk.distance(sk.load("3rpr_planar"), length="2", within=limits)
    base = np.array([[0, 0], [6, 0], [2, 5]])
    corners = np.array([[0, 0], [2, 0], [1, 1]])

    def determinant(x: float, y: float, phi: float) -> float:
        turn = np.array([[cos(phi), -sin(phi)], [sin(phi), cos(phi)]])
        ways = np.array([x, y]) + corners @ turn.T - base
        moments = base[:, 0] * ways[:, 1] - base[:, 1] * ways[:, 0]
        return float(np.linalg.det(np.column_stack([ways, moments])))

    start = 2.0, 2.0, atan(3 / 4)
    least = 1e9
    samples = np.linspace(-3, 3, 4)
    for phi in np.linspace(0.63, 0.8, 35):
        for x in np.linspace(-3, 3, 301):
            values = [determinant(x, y, phi) for y in samples]
            for root in np.roots(np.polyfit(samples, values, 3)):
                if abs(root.imag) < 1e-9:
                    shift = hypot(x - start[0], root.real - start[1]) / 2
                    least = min(least, hypot(shift, phi - start[2]))
    (entry,) = [one for one in answer.singularities if one.kind == "actuation"]
    assert entry.nearest is not None
    assert entry.nearest.distance == pytest.approx(least, abs=2e-4)
    assert entry.nearest.values[2] == pytest.approx(0.63, abs=1e-6)
    assert from_json(to_json(answer)) == answer
    assert "within the limits phi from 0.63 to 0.8, x from" in str(answer)


def test_an_exact_plane_beyond_a_limit_is_passed_over() -> None:
    """sin(q4) = 0 at 0 and π: from 3/10, with 0 left out, π is next."""
    case = sk.load("dual_planar_arm", at={"qA2": "3/10"})

    def far(*limits: str) -> float:
        answer = sk.distance(case, within=limits)
        (found,) = [
            one.nearest
            for one in answer.singularities
            if one.component is not None and one.component.equations == ("sin(qA2)",)
        ]
        return -1.0 if found is None else found.distance

    assert far() == pytest.approx(0.3, abs=1e-12)
    assert far("qA2=1/10:4") == pytest.approx(pi - 0.3, abs=1e-6)
    assert far("qA2=1/10:3") == -1


BAR = """
screwkit: 1
name: bar
geometry: posture
base: base
platform: link
links: [base, crank, link, rocker]
vectors: {k: [0, 0, 1]}
joints:
  - {name: A, type: revolute, parent: base, child: crank, point: [0, 0, 0], axis: k}
  - {name: B, type: revolute, parent: crank, child: link, point: [1, 2, 0], axis: k}
  - {name: C, type: revolute, parent: link, child: rocker, point: [5, 3, 0], axis: k}
  - {name: D, type: revolute, parent: rocker, child: base, point: [6, 0, 0], axis: k}
actuated: [A]
"""


def test_limits_of_a_joint() -> None:
    """A crank that may not turn as far as the dead point does not come to it."""
    case = load_text(BAR)

    def dead_point(*limits: str) -> tuple[float, float] | None:
        answer = sk.distance(case, within=limits)
        (entry,) = [one for one in answer.singularities if one.kind == "actuation"]
        found = entry.nearest
        if found is None:
            return None
        return found.distance, found.values[answer.freedoms.index("A")]

    free = dead_point()
    assert free is not None
    far, turn = free
    low, high = sorted((0.0, turn))
    again = dead_point(f"A={low - 0.01}:{high + 0.01}")
    assert again == pytest.approx((far, turn), abs=1e-6)
    short = dead_point(f"A={0.9 * low}:{0.9 * high}")
    assert short is None


def test_limits_that_are_refused() -> None:
    case = sk.load("3rpr_planar")
    with pytest.raises(UnknownNameError, match="is called 'psi'"):
        sk.distance(case, within=["psi=0:1"])
    with pytest.raises(
        ExpressionError, match="begin at x = 2, which is not within 3:4"
    ):
        sk.distance(case, within=["x=3:4"])
    with pytest.raises(ExpressionError, match="is no range"):
        sk.distance(case, within=["x=3"])
    slide = case.mechanism.actuated[0]
    with pytest.raises(ExpressionError, match="'x' is no freedom"):
        sk.distance(case, within=["x=0:4", f"{slide}=-1:1"])


def test_what_is_there_already_is_told() -> None:
    told: list[Distance] = []
    answer = sk.distance(
        sk.load("five_bar"), finished=lambda name, part: told.append(part)
    )
    count = len(answer.singularities)
    assert [len(part.singularities) for part in told] == [*range(1, count)]
    assert [len(part.unfinished) for part in told] == [*range(count - 1, 0, -1)]
    assert answer.unfinished == ()
    for part in told:
        assert part.singularities == answer.singularities[: len(part.singularities)]
        text = " ".join(str(part).split())
        assert "nearest singularity so far" in text
        assert f"not looked at yet: {part.unfinished[0]}" in text
        assert from_json(to_json(part)) == part
