"""Assemble, move and follow, as a person asks for them in Python."""

from __future__ import annotations

from math import cos, hypot, inf, nan, sin
from typing import Any

import numpy as np
import pytest

import screwkit as sk
from screwkit.errors import UnfitValueError, UnknownNameError

CRANK = sk.load("four_bar_planar")


def pins(case: sk.Case) -> dict[str, np.ndarray]:
    """The pins of a planar four-bar at the values of the file."""
    values = {p.name: p.value for p in case.mechanism.parameters}
    numbers = {name: float(getattr(v, "value", 0)) for name, v in values.items()}
    return {
        "B": np.array([numbers["xb"], numbers["yb"]]),
        "C": np.array([numbers["xc"], numbers["yc"]]),
        "D": np.array([numbers["d"], 0.0]),
    }


def test_a_four_bar_keeps_the_lengths_of_its_bars() -> None:
    path = sk.move(CRANK, {"A": 0.4})
    assert path.closed
    assert path.last["A"] == pytest.approx(0.4, abs=1e-12)
    at = pins(CRANK)
    coupler = hypot(*(at["C"] - at["B"]))
    for posture in path.postures:
        angles = dict(zip(path.freedoms, posture, strict=True))
        b = turned(at["B"], angles["A"])
        c = at["D"] + turned(at["C"] - at["D"], -angles["D"])  # D leads to the base
        assert hypot(*(c - b)) == pytest.approx(coupler, abs=1e-9)


def turned(vector: np.ndarray, angle: float) -> np.ndarray:
    c, s = cos(angle), sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def test_opposite_angles_of_a_bennett_linkage_stay_equal() -> None:
    """The parallelogram among skew linkages [Bennett1903]."""
    path = sk.follow(sk.load("bennett"), {"A": 1.0}, steps=12)
    assert path.closed
    assert path.reached == 1.0
    assert len(path.postures) == 13
    found = np.array(path.postures)
    a, b, c, d = (found[:, path.freedoms.index(name)] for name in "ABCD")
    np.testing.assert_allclose(a, c, atol=1e-9)
    np.testing.assert_allclose(b, d, atol=1e-9)
    assert np.all(np.diff(a) > 0)


def test_the_nearest_assembly_keeps_what_is_fixed() -> None:
    path = sk.assemble(CRANK, {"A": 0.25, "B": 0.2}, fixed=("A",))
    assert path.closed
    assert path.last["A"] == 0.25
    again = sk.move(CRANK, {"A": 0.25})
    for name, value in path.last.items():
        assert value == pytest.approx(again.last[name], abs=1e-9)


def test_what_cannot_be_reached_is_said() -> None:
    """Joint variables of a planar 3-RPR: a leg of no length left and far platform."""
    path = sk.move(sk.load("3rpr_planar"), {"P1": 60.0, "P2": 0.0, "P3": 0.0})
    assert not path.closed
    assert path.reached < 1
    assert path.reason


def test_unknown_freedoms_are_refused() -> None:
    with pytest.raises(UnknownNameError, match="did you mean"):
        sk.move(CRANK, {"AA": 1.0})


@pytest.mark.parametrize("value", [nan, inf, "x", None, [1.0], 10**400])
def test_values_that_are_no_numbers_are_refused(value: float) -> None:
    for ask in (sk.move, sk.assemble, sk.follow):
        with pytest.raises(UnfitValueError, match=r"^A = .* is no finite number; rad"):
            ask(CRANK, {"A": value})


def test_steps_that_lead_nowhere_are_refused() -> None:
    for steps, stride in ((40, 0.0), (-1, 0.1), (40, -0.1), (40, nan)):
        with pytest.raises(UnfitValueError, match=r"stride|are no motion"):
            sk.follow(CRANK, {"A": 1.0}, steps=steps, stride=stride)


def test_numbers_of_other_kinds_are_taken() -> None:
    quarter: Any = np.float32(0.25)
    assert sk.move(CRANK, {"A": quarter}).last["A"] == 0.25
