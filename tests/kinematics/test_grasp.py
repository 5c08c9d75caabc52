"""The six parameters of the grasp: published values, and round trips."""

from __future__ import annotations

import numpy as np
import pytest
from kinematics.arms import NAO_LIMBS, SIX, nao, nao_posture, nao_reference, system
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from screwkit.kinematics.grasp import (
    GraspFrame,
    grasp_displacement,
    grasp_frame,
    grasp_of,
    matrices,
)

Array = NDArray[np.float64]
NAMES = ("gamma", "b", "alpha", "d", "theta", "r")


def rebuilt(frame: GraspFrame) -> tuple[Array, Array]:
    return matrices(frame.displacement())


def test_published_grasp() -> None:
    found = grasp_of(nao(), nao_posture(), NAO_LIMBS)
    published = nao_reference()["grasp"]
    for name in NAMES:
        assert getattr(found, name) == pytest.approx(published[f"{name}11"], abs=1e-14)


def test_published_displacement() -> None:
    turn, shift = grasp_displacement(nao(), nao_posture(), NAO_LIMBS)
    expected = np.array(nao_reference()["T5_11"])
    np.testing.assert_allclose(turn, expected[:3, :3], atol=1e-14)
    np.testing.assert_allclose(shift, expected[:3, 3], atol=1e-14)


@pytest.mark.parametrize("branch", [1, -1])
def test_random_round_trips(branch: int) -> None:
    turn = Rotation.random(2000, random_state=1).as_matrix()
    shift = np.random.default_rng(2).normal(size=(2000, 3))
    frame = grasp_frame(turn, shift, branch)
    turned, shifted = rebuilt(frame)
    np.testing.assert_allclose(turned, turn, atol=1e-13)
    np.testing.assert_allclose(shifted, shift, atol=1e-12)
    assert (branch * np.sin(frame.alpha) >= 0).all()


def test_parameters_come_back_from_what_they_describe() -> None:
    source = np.random.default_rng(3)
    angles = source.uniform(-np.pi, np.pi, (2, 2000))
    alpha = source.uniform(0.01, np.pi - 0.01, 2000)
    b, d, r = source.normal(size=(3, 2000))
    given = GraspFrame(angles[0], b, alpha, d, angles[1], r)
    found = grasp_frame(*rebuilt(given), branch=1)
    for name in NAMES:
        np.testing.assert_allclose(
            getattr(found, name), getattr(given, name), atol=1e-10
        )
    other = grasp_frame(*rebuilt(given), branch=-1)
    for name in NAMES:
        np.testing.assert_allclose(
            getattr(other, name), getattr(given.other_solution(), name), atol=1e-10
        )


def test_other_solution_is_the_same_displacement() -> None:
    frame = grasp_of(nao(), nao_posture(), NAO_LIMBS)
    for one, other in zip(rebuilt(frame), rebuilt(frame.other_solution()), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-15)


@pytest.mark.parametrize("branch", [1, -1])
@pytest.mark.parametrize("facing", [1.0, -1.0])
def test_parallel_axes(facing: float, branch: int) -> None:
    source = np.random.default_rng(4)
    angles = source.uniform(-np.pi, np.pi, (2000, 1))
    turns = Rotation.from_euler("z", angles).as_matrix() @ np.diag(
        [1.0, facing, facing]
    )
    shift = source.normal(size=(2000, 3))
    frame = grasp_frame(turns, shift, branch)
    turned, shifted = rebuilt(frame)
    np.testing.assert_allclose(turned, turns, atol=1e-15)
    np.testing.assert_allclose(shifted, shift, atol=1e-15)
    np.testing.assert_array_equal(frame.r, 0.0)
    np.testing.assert_array_equal(frame.alpha, 0.0 if facing > 0 else np.pi)
    np.testing.assert_allclose(frame.gamma, np.arctan2(shift[:, 1], shift[:, 0]))
    np.testing.assert_allclose(frame.d, np.hypot(shift[:, 0], shift[:, 1]))
    np.testing.assert_allclose(frame.b, shift[:, 2])


@pytest.mark.parametrize("branch", [1, -1])
def test_nearly_parallel_axes(branch: int) -> None:
    """The error peaks at the change of rule and stays below 1e-7 of the lengths."""
    source = np.random.default_rng(5)
    sine = 10.0 ** source.uniform(-17, 0, 2000)
    alpha = np.where(source.random(2000) < 0.5, sine, np.pi - sine)
    gamma, theta = source.uniform(-np.pi, np.pi, (2, 2000))
    b, d = source.normal(size=(2, 2000))
    turn, shift = rebuilt(GraspFrame(gamma, b, alpha, d, theta, np.ones(2000)))
    frame = grasp_frame(turn, shift, branch)
    np.testing.assert_allclose(rebuilt(frame)[0], turn, atol=1.1e-8)
    np.testing.assert_allclose(rebuilt(frame)[1], shift, atol=1e-7)


def test_nothing_moved() -> None:
    frame = grasp_frame(np.eye(3), np.zeros(3))
    assert [float(getattr(frame, name)) for name in NAMES] == [0.0] * 6


def test_degenerate_and_regular_in_one_batch() -> None:
    frame = grasp_of(nao(), nao_posture(), NAO_LIMBS)
    turn, shift = rebuilt(frame)
    turns, shifts = np.stack([turn, np.eye(3)]), np.stack([shift, shift])
    both = grasp_frame(turns, shifts)
    np.testing.assert_allclose(rebuilt(both)[0], turns, atol=1e-15)
    np.testing.assert_allclose(rebuilt(both)[1], shifts, atol=1e-15)


def test_grasp_of_any_two_limbs_composes() -> None:
    arms = system([SIX, SIX, SIX], seed=5)
    batch = {name: value + np.linspace(0, 1, 7) for name, value in arms.posture.items()}

    def pair(of: int, seen_from: int) -> tuple[Array, Array]:
        return grasp_displacement(
            arms.mechanism, batch, arms.limbs, of=of, seen_from=seen_from
        )

    (r10, p10), (r21, p21), (r20, p20) = pair(1, 0), pair(2, 1), pair(2, 0)
    np.testing.assert_allclose(r10 @ r21, r20, atol=1e-14)
    np.testing.assert_allclose((r10 @ p21[..., None])[..., 0] + p10, p20, atol=1e-14)


def test_an_arm_declared_from_the_object_reaches_the_same_end() -> None:
    arms = system([SIX, SIX], backwards=0, seed=6)
    turn, shift = grasp_displacement(arms.mechanism, arms.posture, arms.limbs)
    assert arms.limbs[0][0] == ("a6", -1)
    assert np.linalg.det(turn) == pytest.approx(1.0)
    assert shift.shape == (3,)


def test_wrong_arguments() -> None:
    with pytest.raises(ValueError, match="branch"):
        grasp_frame(np.eye(3), np.zeros(3), 2)
    with pytest.raises(ValueError, match="shape"):
        grasp_frame(np.eye(4), np.zeros(3))
