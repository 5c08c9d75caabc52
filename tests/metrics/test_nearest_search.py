"""Nearest points of sets that are hard to meet, where geometry says which they are."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest

from screwkit.algebra.batch import Array
from screwkit.metrics.nearest_search import Outcome, Sample, nearest
from screwkit.metrics.smooth import Batched, by_differences
from screwkit.metrics.ways_on_motion import Space

EXACT = 1e-8
"""A double zero that Newton's steps alone come to is known to 1e-7 at best."""


def looked(
    start: list[float], equations: Batched, counts: float | None = None
) -> Outcome:
    """The search in free coordinates; what counts lies further than ``counts``."""
    begin = np.array(start)
    nothing = by_differences(lambda x: np.zeros((len(x), 0)))
    space = Space(begin, by_differences(lambda x: x - begin), nothing, tied=False)
    far = -1.0 if counts is None else counts
    return nearest(
        Sample(space), by_differences(equations), lambda x: float(x[0]) > far
    )


def columns(*parts: Array) -> Array:
    return np.stack(parts, axis=-1)


@pytest.mark.parametrize(
    ("equations", "start", "there"),
    [
        # cos x + 1 touches 0 along the line x = π.
        (lambda x: columns(1 + np.cos(x[:, 0])), [0.3, 0.2], [pi, 0.2]),
        # The square of a line: the foot of (1, 1) on x = 2y + 3.
        (
            lambda x: columns((x[:, 0] - 2 * x[:, 1] - 3) ** 2),
            [1.0, 1.0],
            [1.8, -0.6],
        ),
        # A point of its own beside the curve y² = x²(x − 4).
        (
            lambda x: columns(x[:, 0] ** 2 * (x[:, 0] - 4) - x[:, 1] ** 2),
            [0.3, 0.1],
            [0.0, 0.0],
        ),
        # Where a surface that touches a plane meets another.
        (
            lambda x: columns((x[:, 0] - 1) ** 2, x[:, 0] + x[:, 1] + x[:, 2] - 3),
            [0.0, 0.0, 0.0],
            [1.0, 1.0, 1.0],
        ),
    ],
)
def test_double_zeros_are_met_exactly(
    equations: Batched, start: list[float], there: list[float]
) -> None:
    outcome = looked(start, equations)
    assert outcome.nearest is not None
    assert outcome.nearest.point == pytest.approx(there, abs=EXACT)
    gap = np.subtract(there, start)
    assert outcome.nearest.distance == pytest.approx(sqrt(gap @ gap), abs=EXACT)
    assert outcome.met > 2


def test_zeros_that_do_not_count_keep_none_behind_them_from_view() -> None:
    """Of sin 5x = 0 the first six from 0.1 lie nearer than the first that counts."""
    outcome = looked([0.1], lambda x: np.sin(5 * x), counts=2.4)
    assert outcome.nearest is not None
    assert outcome.nearest.point == pytest.approx([4 * pi / 5], abs=EXACT)
