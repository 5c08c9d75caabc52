"""Parts of one size on which the same conditions hold are components of their own."""

from __future__ import annotations

from functools import cache
from math import atan2, cos, pi, sin

import numpy as np
import pytest
from loci.numeric import value
from loci.tripterons import TRIPTERON

import screwkit
from screwkit.case import load_text
from screwkit.results.singularities import ConstraintSingularities


@cache
def constraint() -> ConstraintSingularities:
    return screwkit.singularities(load_text(TRIPTERON)).constraint


def postures(source: np.random.Generator) -> list[dict[str, float]]:
    """One on each part, by hand.

    All arms are stretched: y·s1 = z·c1, x·c2 = z·s2 and x·s3 = y·c3, from the point
    where the slides meet; and the arms point parallel to one plane:
    c1·c2·c3 + s1·s2·s3 = 0.  Multiplied by x·y·z the last one says 2·x·y·z = 0 if none
    of the sines and cosines is 0.
    """
    k, a, b = source.uniform(0.4, 1.2, 3)
    third = atan2(-cos(a) * cos(b), sin(a) * sin(b))
    parts = [
        (0, 0, 0, a, b, third),
        (0, k * cos(a), k * sin(a), a, 0, pi / 2),
        (k * sin(a), 0, k * cos(a), pi / 2, a, 0),
        (k * cos(a), k * sin(a), 0, 0, pi / 2, a),
        (0, 0, k, pi / 2, 0, a),
        (k, 0, 0, a, pi / 2, 0),
        (0, k, 0, 0, a, pi / 2),
    ]
    names = ("x", "y", "z", "s1", "s2", "s3")
    shift = (2, 2, 2, 0, 0, 0)
    return [
        {n: p + s for n, p, s in zip(names, part, shift, strict=True)} for part in parts
    ]


def directions(at: dict[str, float]) -> list[list[float]]:
    """Of the forces that stretched arms bear."""
    one, two, three = at["s1"], at["s2"], at["s3"]
    return [
        [0, cos(one), sin(one)],
        [sin(two), 0, cos(two)],
        [cos(three), sin(three), 0],
    ]


def test_parts_on_which_the_same_conditions_hold_are_listed_apart() -> None:
    found = constraint()
    assert found.complete
    assert [component.codimension for component in found.components] == [4] * 7
    source = np.random.default_rng(5)
    met: set[tuple[int, ...]] = set()
    for _ in range(3):
        for at in postures(source):
            assert np.linalg.matrix_rank(directions(at), tol=1e-9) == 2
            on = [
                number
                for number, own in enumerate(found.components)
                if all(abs(value(e, at)) < 1e-9 for e in own.equations)
            ]
            assert len(on) == 1
            met.add(tuple(on))
    assert met == {(number,) for number in range(7)}


@pytest.mark.parametrize("place", range(7))
def test_a_posture_beside_a_part_is_regular(place: int) -> None:
    """With one arm no longer stretched, or turned out of the plane."""
    at = postures(np.random.default_rng(8))[place]
    found = constraint().components
    for name in at:
        beside = at | {name: at[name] + 0.05}
        on = [
            c for c in found if all(abs(value(e, beside)) < 1e-9 for e in c.equations)
        ]
        stretched = [
            (beside["y"] - 2) * sin(beside["s1"])
            - (beside["z"] - 2) * cos(beside["s1"]),
            (beside["x"] - 2) * cos(beside["s2"])
            - (beside["z"] - 2) * sin(beside["s2"]),
            (beside["x"] - 2) * sin(beside["s3"])
            - (beside["y"] - 2) * cos(beside["s3"]),
        ]
        all_are = max(map(abs, stretched)) < 1e-9
        dependent = np.linalg.matrix_rank(directions(beside), tol=1e-9) < 3
        assert bool(on) == (all_are and dependent)
