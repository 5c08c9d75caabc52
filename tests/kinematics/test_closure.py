"""Closed motions: the grasp is kept, and failures are told."""

from __future__ import annotations

import numpy as np
import pytest
from kinematics.arms import NAO_LIMBS, nao, nao_posture, planar, system
from kinematics.test_rates import EACH, SYSTEMS

from screwkit.errors import UnknownNameError
from screwkit.kinematics.closure import close_grasp, closed_motion
from screwkit.kinematics.grasp import grasp_displacement
from screwkit.kinematics.rates import rate_constraints


@EACH
def test_the_start_is_closed_by_definition(name: str) -> None:
    arms, actuated = SYSTEMS[name]
    values = {joint: arms.posture[f"q_{joint}"] for joint in actuated}
    found = close_grasp(arms.mechanism, arms.limbs, arms.posture, values)
    assert found.closed
    for joint in arms.joints:
        assert found.posture[f"q_{joint}"] == pytest.approx(arms.posture[f"q_{joint}"])


@EACH
def test_a_motion_keeps_every_grasp(name: str) -> None:
    arms, actuated = SYSTEMS[name]
    time = np.linspace(0, 1, 21)[1:]
    path = {
        joint: arms.posture[f"q_{joint}"] + 0.002 * np.sin((k + 1) * time)
        for k, joint in enumerate(actuated)
    }
    motion = closed_motion(arms.mechanism, arms.limbs, arms.posture, path)
    assert motion.closed
    assert motion.residual.max() <= 1e-12
    for limb in range(1, len(arms.limbs)):
        turn, shift = grasp_displacement(
            arms.mechanism, arms.posture, arms.limbs, of=limb
        )
        turns, shifts = grasp_displacement(
            arms.mechanism, motion.posture, arms.limbs, of=limb
        )
        assert np.abs(turns - turn).max() < 1e-11
        assert np.abs(shifts - shift).max() < 1e-11


def test_a_motion_integrates_its_rates() -> None:
    """Rates at every point of a long motion against differences along it, to 1e-7."""
    start, actuated = nao_posture(), ["1", "4", "6", "9"]
    step = 2e-3
    time = np.arange(1, 150) * step
    path = {
        n: start[f"q{n}"] + 0.04 * np.sin((k + 1) * time)
        for k, n in enumerate(actuated)
    }
    motion = closed_motion(nao(), NAO_LIMBS, start, path)
    assert motion.closed
    found = rate_constraints(nao(), motion.posture, NAO_LIMBS, actuated)
    active = np.stack(
        [0.04 * (k + 1) * np.cos((k + 1) * time) for k in range(4)], axis=-1
    )
    rates = found.rates(active)
    values = np.stack([motion.posture[f"q{n}"] for n in found.joints], axis=-1)
    slope = (
        values[:-6] * -1 + values[1:-5] * 9 - values[2:-4] * 45
        + values[4:-2] * 45 - values[5:-1] * 9 + values[6:]
    ) / (60 * step)  # fmt: skip
    np.testing.assert_allclose(rates[3:-3], slope, atol=1e-7)


def test_a_motion_ends_at_a_fold_and_says_so() -> None:
    """Short of a fold the least singular value goes to 0 like the root of the way."""
    start, actuated = nao_posture(), ["1", "2", "3", "4"]
    path = {name: np.full(60, start[f"q{name}"]) for name in actuated}
    path["2"] = start["q2"] + np.linspace(0, 1.5, 60)
    motion = closed_motion(nao(), NAO_LIMBS, start, path)
    reached = np.isfinite(motion.residual)
    count = int(reached.sum())
    assert not motion.closed
    assert 0 < count < 60
    assert reached[:count].all()
    assert (motion.residual[:count] <= 1e-12).all()
    assert np.isnan(motion.posture["q9"][count:]).all()
    closed = {name: values[:count] for name, values in motion.posture.items()}
    found = rate_constraints(nao(), closed, NAO_LIMBS, actuated)
    least = np.linalg.svd(found.g_p)[1][:, -1]
    assert least[-1] < 0.2 * least[0]


def test_a_far_target_is_reported() -> None:
    start = nao_posture()
    far = {name: start[f"q{name}"] for name in ("1", "2", "3", "4")}
    far["2"] += 1.5
    found = close_grasp(nao(), NAO_LIMBS, start, far)
    assert not found.closed
    assert found.residual > 1e-3
    assert found.iterations == 40


def test_a_batch_may_close_in_part() -> None:
    start = nao_posture()
    some = {name: start[f"q{name}"] for name in ("1", "3", "4")}
    batch = start["q2"] + np.array([[0.01, 1.5], [-0.01, np.nan]])
    found = close_grasp(nao(), NAO_LIMBS, start, {**some, "2": batch})
    assert not found.closed
    np.testing.assert_array_equal(found.residual <= 1e-12, [[True, False]] * 2)
    assert np.isinf(found.residual[1, 1])


def test_half_a_turn_off_is_not_closed() -> None:
    """Two coaxial joints: R − Rᵀ vanishes half a turn away, and that is no closure."""
    pair = system([planar(1, "0"), planar(1, "0")], seed=1)
    turned = {"a1": pair.posture["q_a1"] + np.pi, "b1": pair.posture["q_b1"]}
    found = close_grasp(pair.mechanism, pair.limbs, pair.posture, turned)
    assert not found.closed
    assert found.residual == pytest.approx(np.pi)


def test_unknown_joint() -> None:
    with pytest.raises(UnknownNameError):
        close_grasp(nao(), NAO_LIMBS, nao_posture(), {"11": 0.0})
