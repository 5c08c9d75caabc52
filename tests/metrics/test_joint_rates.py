"""Rates of joint spaces against differences, and screws of contacts."""

from __future__ import annotations

import numpy as np
import pytest

import screwkit as sk
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.joint_space import JointSpace, joint_space, pose_origin
from screwkit.metrics.limited import Limits
from screwkit.metrics.rank_conditions import FallenRank, ScrewField
from screwkit.metrics.smooth import by_differences, slopes

FLAT = 1e-8
"""What differences with steps of 1e-6 tell of a slope."""


def numbers(name: str) -> tuple[Mechanism, PostureModel]:
    mechanism = sk.load(name).mechanism
    fixed = with_values(mechanism, declared_values(mechanism))
    return fixed, posture_model(fixed)


def space_of(name: str, *contacts: str, posed: bool = False) -> JointSpace:
    mechanism, model = numbers(name)
    point = pose_origin(mechanism, model) if posed else None
    return joint_space(model, None, point, contacts)


@pytest.mark.parametrize(
    ("name", "posed"),
    [
        ("stewart_alpha_beta", False),
        ("stewart_alpha_beta", True),
        ("rssr", False),
        ("bennett", False),
        ("4H_equal_pitch", False),
    ],
)
def test_rates_are_differences(name: str, posed: bool) -> None:
    """Off the closed postures as well, with balls, screws, slides and contacts."""
    space = space_of(name, *(f"c{i}" for i in range(1, 7)), posed=posed)
    count = len(space.model.labels)
    points = np.random.default_rng(4).uniform(-0.7, 0.7, (3, count))
    for function in (space.kept, space.away):
        expected = slopes(function.values, points)
        assert function.slopes(points) == pytest.approx(expected, abs=FLAT)
    forms = np.random.default_rng(5).normal(size=(3, 2, count, 6))
    expected = np.einsum("bcfx,bfxn->bcn", forms, slopes(space.screws.values, points))
    assert space.screws.rates(points, forms) == pytest.approx(expected, abs=FLAT)


def test_rates_of_bordered_ranks_are_differences() -> None:
    space = space_of("stewart_alpha_beta")
    field = ScrewField(space.model.labels, space.screws, space.forest)
    fallen = FallenRank(field.of_loops([f"L{i}" for i in range(1, 7)]), 30)
    points = np.random.default_rng(4).uniform(-0.7, 0.7, (2, 36))
    own = fallen.around(points)
    # Each row keeps its own border, so that rows are nudged one by one.
    for i, point in enumerate(points):
        alone = fallen.around(points[i : i + 1], 73)
        nudge = 1e-6 * np.eye(36)
        values = alone.values(np.concatenate([[point], point + nudge, point - nudge]))
        expected = (values[1:37] - values[37:]).T / 2e-6
        assert own.slopes(points)[i] == pytest.approx(expected, abs=FLAT)


def test_tangents_of_a_contact_stay_tangents() -> None:
    """The leg carries the normal, along its slide; the platform turns both axes."""
    space = space_of("stewart_alpha_beta", "c1")
    labels = space.model.labels
    points = np.random.default_rng(4).uniform(-1, 1, (5, 36))
    screws = space.screws.values(points)
    normal = screws[:, labels.index("L1"), 3:]
    for label in ("c1:0", "c1:1"):
        axis = screws[:, labels.index(label), :3]
        assert (axis * normal).sum(axis=1) == pytest.approx(0, abs=1e-12)


def test_limits_are_kept_and_reached() -> None:
    limits = Limits(np.array([-1.0, -np.inf]), np.array([3.0, np.inf]))
    points = np.random.default_rng(4).normal(size=(50, 2)) * 5
    inside = limits.within(points)
    assert inside[:, 0].min() >= -1
    assert inside[:, 0].max() <= 3
    assert (inside[:, 1] == points[:, 1]).all()
    for point in ([-1.0, 7.0], [3.0, 0.0], [0.4, -2.0]):
        there = limits.within(limits.coordinates(np.array(point)))
        assert there == pytest.approx(point)
    square = by_differences(lambda x: x**2)
    own = limits.of(square)
    expected = slopes(lambda x: limits.within(x) ** 2, points)
    assert own.slopes(points) == pytest.approx(expected, abs=1e-6)
