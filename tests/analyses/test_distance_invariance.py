"""Distances of a mechanism turned, scaled and measured in another unit.

Turning everything and scaling it by k is an isometry of the motions when the length
that counts as one radian is scaled too: distances in radians stay, lengths grow k
times, and nearest postures move with the mechanism.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np
import pytest

import screwkit as sk
from screwkit.case import load_text
from screwkit.results.distance import Distance, NearestPosture

BASE = [(0, 0), (6, 1), (2, 5)]
PLATFORM = [(0, 0), (2, 0), (1, 2)]
PLACE = (2, 1)
TURN = ((Fraction(3, 5), Fraction(-4, 5)), (Fraction(4, 5), Fraction(3, 5)))
SAME = ((Fraction(1), Fraction(0)), (Fraction(0), Fraction(1)))


@cache
def answer(scale: str = "1", *, turned: bool = False, length: str = "") -> Distance:
    """A platform on three sliding legs, scaled and turned about the origin."""
    k, rows = Fraction(scale), TURN if turned else SAME

    def moved(point: tuple[int, int]) -> list[str]:
        return [str(k * (r[0] * point[0] + r[1] * point[1])) for r in rows]

    lines = [
        "screwkit: 1",
        "name: moved_copy",
        "title: Platform on three sliding legs",
        "source: made for a test",
        f"units: {'m' if k == 1 else 'dm'}",
        "space: planar",
        "geometry: posture",
        "base: base",
        "platform: platform",
        "links: [base, platform, u0, w0, u1, w1, u2, w2]",
        "variables:",
        *(f"  {n}: {x}" for n, x in zip("xy", moved(PLACE), strict=True)),
        "  phi: {value: 4/5, angle: true}",
        "pose: {translation: [x, y], rotation: {axis: z, angle: phi}}",
        "points:",
    ]
    for i, point in enumerate(BASE):
        lines.append(f"  A{i}: [{', '.join(moved(point))}]")
    for i, point in enumerate(PLATFORM):
        lines.append(f"  B{i}: {{link: platform, at: [{', '.join(moved(point))}]}}")
    lines.append("joints:")
    for i in range(3):
        lines += [
            f"  - {{name: R{i}, type: revolute, parent: base, child: u{i}, "
            f"axis: [0, 0, 1], point: A{i}}}",
            f"  - {{name: P{i}, type: prismatic, parent: u{i}, child: w{i}, "
            f"axis: B{i} - A{i}}}",
            f"  - {{name: S{i}, type: revolute, parent: w{i}, child: platform, "
            f"axis: [0, 0, 1], point: B{i}}}",
        ]
    lines += ["actuated: [P0, P1, P2]", "reference_point: B0"]
    return sk.distance(load_text("\n".join(lines) + "\n"), length=length)


def nearest(found: Distance) -> dict[str, NearestPosture]:
    """The nearest posture of every singularity, by what it is called."""
    return {
        f"{one.kind} {one.limb} {one.number}": one.nearest
        for one in found.singularities
        if one.nearest is not None
    }


def length_of(found: Distance) -> float:
    assert found.measure is not None
    assert found.measure.length is not None
    return found.measure.length


@pytest.mark.parametrize(
    ("scale", "turned"), [("1", True), ("10", False), ("10", True)]
)
def test_a_moved_copy_is_as_far(scale: str, turned: bool) -> None:
    plain, copy = answer(), answer(scale, turned=turned)
    k = float(scale)
    assert length_of(copy) == pytest.approx(k * length_of(plain), rel=1e-6)
    before, after = nearest(plain), nearest(copy)
    assert before
    assert before.keys() == after.keys()
    places = [plain.variables.index(name) for name in ("x", "y", "phi")]
    assert copy.variables == plain.variables
    rows = np.array(TURN if turned else SAME, float)
    for name, one in before.items():
        other = after[name]
        assert other.distance == pytest.approx(one.distance, rel=1e-6)
        assert (other.rank, other.connected) == (one.rank, one.connected)
        (x, y, phi), there = (np.array(p.values)[places] for p in (one, other))
        if name.startswith("actuation"):  # one nearest posture alone
            assert there[:2] == pytest.approx(k * rows @ [x, y], abs=1e-6 * k)
            assert there[2] == pytest.approx(phi, abs=1e-6)


def test_a_given_length_is_scaled_with_the_unit() -> None:
    """The same mechanism in metres and decimetres, 2 m and 20 dm for one radian."""
    metres, decimetres = answer(length="2"), answer("10", length="20")
    for found, unit, length in ((metres, "m", 2), (decimetres, "dm", 20)):
        assert found.measure is not None
        assert found.measure.given
        assert (found.measure.unit, found.measure.length) == (unit, length)
    before, after = nearest(metres), nearest(decimetres)
    assert before.keys() == after.keys()
    for name, one in before.items():
        assert after[name].distance == pytest.approx(one.distance, rel=1e-6)


def test_a_longer_radian_makes_shifts_cheaper() -> None:
    """The way found with the short one is a bound for the long one, and conversely."""
    short, long = answer(length="2"), answer(length="20")
    before, after = nearest(short), nearest(long)
    assert before.keys() == after.keys()
    x, y, phi = (short.variables.index(name) for name in ("x", "y", "phi"))
    for name, one in before.items():
        x_there, y_there, phi_there = (one.values[i] for i in (x, y, phi))
        shift = np.hypot(x_there - PLACE[0], y_there - PLACE[1])
        turn = phi_there - short.posture[phi]
        assert one.distance == pytest.approx(np.hypot(turn, shift / 2), rel=1e-6)
        bound = np.hypot(turn, shift / 20)
        assert one.distance / 10 <= after[name].distance <= bound * (1 + 1e-9)
        assert bound < one.distance
