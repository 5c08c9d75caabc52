"""Nearest points under equations, and ranks as equations, where both are known."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np
import pytest

import screwkit as sk
from screwkit.algebra.batch import Array
from screwkit.metrics.motion_chart import motion_chart
from screwkit.metrics.nearest_point import Problem, descended, restored
from screwkit.metrics.rank_conditions import FallenRank, rank_at
from screwkit.metrics.smooth import Batched, Conditions, by_differences, slopes
from screwkit.metrics.symbol_motion import symbol_motion
from screwkit.metrics.ways_on_motion import Space, followed

FLAT = 1e-6
"""A slope of 1e-7 ends a descent: the point is known so well, its distance better."""


def columns(*parts: Array) -> Array:
    return np.stack(parts, axis=-1)


@dataclass(frozen=True, eq=False)
class DifferencedMatrices:
    """Matrices whose derivative is not known."""

    values: Batched

    def rates(self, points: Array, left: Array, right: Array) -> Array:
        """By central differences."""
        change = np.moveaxis(slopes(self.values, points), -1, 1)
        turned = np.swapaxes(left, 1, 2)[:, None]
        return np.moveaxis(turned @ change @ right[:, None], 1, -1)


def found_from(residual: Batched, equations: Conditions, *starts: list[float]) -> Array:
    """Where descents from starts end, one row each."""
    problem = Problem(by_differences(residual), equations)
    return descended(problem, restored(problem.equations, np.array(starts)))


def test_the_foot_on_a_line_that_is_given_three_times() -> None:
    """From the origin to x + y = 2: (1, 1)."""

    def line(points: Array) -> Array:
        miss = points[:, 0] + points[:, 1] - 2
        return columns(miss, 3 * miss, -miss)

    (found,) = found_from(lambda x: x, by_differences(line), [5.0, -1.0])
    assert found == pytest.approx([1, 1], abs=FLAT)


def test_the_near_side_of_an_ellipse_and_not_the_far_end() -> None:
    """x²/4 + y² = 1 from (1/2, 0): Lagrange gives x = 2/3, y = ±√(8/9)."""

    def ellipse(points: Array) -> Array:
        return columns(points[:, 0] ** 2 / 4 + points[:, 1] ** 2 - 1)

    starts = [0.5, 0.3], [-1.0, 2.0], [1.0, 0.1]
    away = lambda x: x - np.array([0.5, 0.0])  # noqa: E731
    for found in found_from(away, by_differences(ellipse), *starts):
        assert np.abs(found) == pytest.approx([2 / 3, sqrt(8 / 9)], abs=FLAT)


def test_equations_without_a_common_zero_give_nothing() -> None:
    circle_and_line = lambda x: columns(  # noqa: E731
        x[:, 0] ** 2 + x[:, 1] ** 2 - 1, x[:, 0] - 2
    )
    found = restored(by_differences(circle_and_line), np.array([[1.0, 1.0]]))
    assert np.isnan(found).all()


def symmetric(points: Array) -> Array:
    """Singular where x = ±y, zero where both vanish."""
    x, y = points.T
    return columns(columns(x, y), columns(y, x))


def test_a_bordered_matrix_says_where_the_rank_falls() -> None:
    """From (2, 1) the line x = y is nearest, at (3/2, 3/2)."""
    here = np.array([2.0, 1.0])
    matrices = DifferencedMatrices(symmetric)
    assert rank_at(matrices, np.array([here, [1.0, 1.0]])) == 2
    (found,) = found_from(lambda x: x - here, FallenRank(matrices, 2), [*here])
    assert found == pytest.approx([1.5, 1.5], abs=FLAT)


def turning(points: Array) -> Array:
    """The distance from (1, 1) times a rotation by how far to go: 0 there alone."""
    x, y = (points - 1).T
    return columns(columns(x, y), columns(-y, x))


def test_a_rank_that_falls_by_two_at_once() -> None:
    """Both singular values are the distance from (1, 1): no curve of rank 1."""
    fallen = FallenRank(DifferencedMatrices(turning), 2)
    for found in found_from(lambda x: x, fallen, [3.0, -1.0], [0.2, 0.1]):
        assert found == pytest.approx([1, 1], abs=FLAT)


def test_a_far_start_is_not_given_up() -> None:
    """Steps are cut to 1/2, so that the miss of 20 takes forty of them."""
    far = by_differences(lambda x: x[:, :1] - 12)
    assert restored(far, np.array([[0.0, 1.0]]), 40)[0] == pytest.approx([12, 1])


def test_a_way_round_a_circle_and_none_to_another() -> None:
    """Both ways round; two circles side by side are two motions."""

    def circle(points: Array) -> Array:
        x, y = points.T
        one, two = x**2 + y**2 - 1, (x - 4) ** 2 + y**2 - 1
        return columns(one * two / 10)

    away, kept = by_differences(lambda x: x), by_differences(circle)
    space = Space(np.array([1.0, 0.0]), away, kept, tied=True)
    assert followed(space, np.array([-1.0, 0.0]))
    assert followed(space, np.array([-0.6, -0.8]))
    assert not followed(space, np.array([3.0, 0.0]))


@pytest.mark.parametrize(
    ("name", "symbols", "joints", "by_joints"),
    [
        # Four symbols of B and C, of which the fixed links leave one freedom.
        ("four_bar_planar", 1, 1, True),
        # Elbows follow the platform.
        ("3rrr_planar", 3, 3, True),
        # Axes of universal joints follow the legs.
        ("4ruu", 4, 4, True),
        # x, y, z and one angle, while the platform has six freedoms.
        ("gough_6ups", 4, 6, True),
        # Heights that the pitches tie are no symbols of the file.
        ("5H_parallel", 3, 1, False),
    ],
)
def test_which_symbols_move_a_mechanism(
    name: str, symbols: int, joints: int, by_joints: bool
) -> None:
    chart = motion_chart(sk.load(name).mechanism, {})
    known = symbol_motion(chart, chart.start)
    assert (known.symbols, known.joints) == (symbols, joints)
    assert known.by_joints is by_joints
