"""Indices against scipy's generalised eigenproblems and against brute force.

References: [BicchiPrattichizzo] eqs. (8), (11)-(13), (20)-(24).
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh, null_space
from scipy.optimize import minimize

from screwkit.metrics.indices import FloatGrasp, Weights, indices

Array = NDArray[np.float64]
SEEDS = range(12)


def spd(source: np.random.Generator, size: int) -> Array:
    root = source.normal(size=(size, size))
    return np.asarray(root @ root.T + 0.3 * np.eye(size))


def given(weight: Array | None) -> Array:
    assert weight is not None
    return weight


def inverse(weight: Array | None) -> Array:
    return np.asarray(np.linalg.inv(given(weight)), float)


def driven_grasp(seed: int, actuated: int = 6) -> tuple[FloatGrasp, Weights]:
    """Rows and actuators such that every motion of the object is driven."""
    source = np.random.default_rng(seed)
    rows, passive = 9, 3
    grasp = FloatGrasp(
        source.normal(size=(rows, actuated)),
        source.normal(size=(rows, passive)),
        source.normal(size=(rows, 6)),
    )
    weights = Weights(
        twist=spd(source, 6),
        rates=spd(source, actuated),
        wrench=spd(source, 6),
        torques=spd(source, actuated),
        forces=spd(source, rows),
    )
    return grasp, weights


def motions(grasp: FloatGrasp) -> tuple[Array, Array]:
    """A basis of all motions: its parts (q_a) and (u)."""
    stacked = np.hstack([grasp.ja, grasp.jp, -grasp.gt])
    basis = null_space(stacked)
    return basis[: grasp.ja.shape[1]], basis[-grasp.gt.shape[1] :]


@pytest.mark.parametrize("seed", SEEDS)
def test_kinematic_values_are_eigenvalues(seed: int) -> None:
    """(13): det(UᵀW_uU − λ QᵀW_qQ) = 0 where no motion leaves one of them at rest."""
    grasp, weights = driven_grasp(seed)
    q, u = motions(grasp)
    wanted = eigh(
        u.T @ given(weights.twist) @ u,
        q.T @ given(weights.rates) @ q,
        eigvals_only=True,
    )
    found = indices(grasp, weights).kinematic
    assert np.allclose(found.finite, wanted[::-1], rtol=1e-8)
    assert (found.infinite, found.zero) == (0, 0)


@pytest.mark.parametrize("seed", SEEDS)
def test_force_values_are_eigenvalues(seed: int) -> None:
    """(24) where every contact force is felt: wrench G φ against torque J_aᵀ φ."""
    source = np.random.default_rng(seed)
    grasp = FloatGrasp(
        source.normal(size=(6, 6)), np.zeros((6, 0)), source.normal(size=(6, 6))
    )
    weights = Weights(wrench=spd(source, 6), torques=spd(source, 6))
    torque, wrench = grasp.ja.T, grasp.gt.T[[3, 4, 5, 0, 1, 2]]
    wanted = eigh(
        wrench.T @ given(weights.wrench) @ wrench,
        torque.T @ given(weights.torques) @ torque,
        eigvals_only=True,
    )
    assert np.allclose(indices(grasp, weights).force.finite, wanted[::-1], rtol=1e-7)


@pytest.mark.parametrize("seed", SEEDS)
def test_principal_directions_belong_to_their_values(seed: int) -> None:
    """A motion with these parts exists, and its ratio is the value."""
    grasp, weights = driven_grasp(seed)
    found = indices(grasp, weights).kinematic
    q, u = motions(grasp)
    for value, task, joint in zip(found.finite, found.task, found.joint, strict=True):
        share = np.linalg.lstsq(u, task, rcond=None)[0]
        rates = q @ share
        assert np.allclose(u @ share, task, atol=1e-8)
        ratio = (task @ given(weights.twist) @ task) / (
            rates @ given(weights.rates) @ rates
        )
        assert np.isclose(ratio, value, rtol=1e-7)
        turned = rates / np.linalg.norm(rates)
        assert min(np.abs(turned - joint).max(), np.abs(turned + joint).max()) < 1e-6


@pytest.mark.parametrize("seed", SEEDS)
def test_redundant_joints_take_the_least_effort(seed: int) -> None:
    """With more actuators than motions the value is that of the least rates (8)."""
    grasp, weights = driven_grasp(seed, actuated=8)
    found = indices(grasp, weights).kinematic
    top = found.task[0]
    stacked = np.hstack([grasp.ja, grasp.jp])
    wanted = grasp.gt @ top
    # The rates of least W_q norm, with passive rates free: a Lagrange system.
    free = np.zeros((11, 11))
    free[:8, :8] = given(weights.rates)
    system = np.block([[free, stacked.T], [stacked, np.zeros((9, 9))]])
    right = np.concatenate([np.zeros(11), wanted])
    rates = np.linalg.lstsq(system, right, rcond=None)[0][:8]
    assert np.isclose(
        (top @ given(weights.twist) @ top) / (rates @ given(weights.rates) @ rates),
        found.finite[0],
        rtol=1e-7,
    )
    assert found.zero == 8 - len(found.finite)


@pytest.mark.parametrize("seed", SEEDS)
def test_velocity_and_force_ellipsoids_are_dual(seed: int) -> None:
    """With dual weights the force values are the inverses of the kinematic ones."""
    grasp, weights = driven_grasp(seed)
    swap = [3, 4, 5, 0, 1, 2]
    dual = Weights(
        twist=weights.twist,
        rates=weights.rates,
        wrench=inverse(weights.twist)[np.ix_(swap, swap)],
        torques=inverse(weights.rates),
    )
    found = indices(grasp, dual)
    assert np.allclose(found.force.finite, 1 / found.kinematic.finite[::-1], rtol=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_weights_scale_as_they_must(seed: int) -> None:
    grasp, weights = driven_grasp(seed)
    plain = indices(grasp, weights)
    scaled = indices(
        grasp,
        Weights(
            4 * given(weights.twist),
            9 * given(weights.rates),
            4 * given(weights.wrench),
            9 * given(weights.torques),
            weights.forces,
        ),
    )
    assert np.allclose(scaled.kinematic.finite, 4 / 9 * plain.kinematic.finite)
    assert np.allclose(scaled.force.finite, 4 / 9 * plain.force.finite)
    assert np.allclose(scaled.internal.finite, plain.internal.finite / 9)


@pytest.mark.parametrize("seed", SEEDS)
def test_internal_forces_are_stationary_ratios(seed: int) -> None:
    """(22), (23): contact forces in balance on the object, against their torques."""
    source = np.random.default_rng(seed)
    grasp = FloatGrasp(
        source.normal(size=(9, 9)), np.zeros((9, 0)), source.normal(size=(9, 6))
    )
    weights = Weights(torques=spd(source, 9), forces=spd(source, 9))
    inner = null_space(grasp.gt.T)
    torque = grasp.ja.T @ inner
    wanted = eigh(
        inner.T @ weights.forces @ inner,
        torque.T @ given(weights.torques) @ torque,
        eigvals_only=True,
    )
    assert np.allclose(indices(grasp, weights).internal.finite, wanted[::-1], rtol=1e-7)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_worst_case_by_brute_force(seed: int) -> None:
    """(24): over all torques that balance a wrench the least, over H the worst.

    The greatest value is the greatest ratio of wrench to least torque, found here by
    climbing from random wrenches.
    """
    source = np.random.default_rng(seed)
    grasp = FloatGrasp(
        source.normal(size=(8, 8)), np.zeros((8, 0)), source.normal(size=(8, 3))
    )
    found = indices(grasp, Weights()).force
    g, torques = grasp.gt.T[[1, 2, 0]], grasp.ja.T
    inner = torques @ null_space(g)
    off = np.eye(8) - inner @ np.linalg.pinv(inner)

    def ratio(wrench: Array) -> float:
        force = np.linalg.lstsq(g, wrench, rcond=None)[0]
        least = off @ torques @ force
        return float(wrench @ wrench / (least @ least))

    starts = source.normal(size=(12, 3))
    best = max(
        ratio(minimize(lambda w: -np.log(ratio(w)), start, method="BFGS").x)
        for start in starts
    )
    assert np.isclose(best, found.finite[0], rtol=1e-5)


def test_rank_loss_is_counted_and_never_a_huge_number() -> None:
    """An object that nothing holds in one direction, and a joint that moves nothing."""
    gt = np.eye(3)
    gt[2, 2] = 0.0
    grasp = FloatGrasp(np.diag([1.0, 2.0, 0.0]), np.zeros((3, 0)), gt)
    found = indices(grasp, Weights())
    assert (found.kinematic.infinite, found.kinematic.zero) == (1, 1)
    assert np.allclose(found.kinematic.finite, [4.0, 1.0])
    assert np.isfinite(found.kinematic.finite).all()
    assert np.allclose(np.abs(found.kinematic.infinite_task), [[0, 0, 1]])
    assert np.allclose(np.abs(found.kinematic.zero_joint), [[0, 0, 1]])
    # A third component that nobody feels: static indeterminacy.
    assert found.internal.infinite == 1
