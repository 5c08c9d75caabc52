"""Accelerations: published values, differences along closed motions, invariance."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from kinematics.arms import (
    NAO_LIMBS,
    derivatives,
    nao,
    nao_posture,
    nao_reference,
)
from kinematics.test_rates import EACH, SYSTEMS

from screwkit.algebra.modular import ModularRing, prime_for
from screwkit.kinematics.accelerations import (
    accelerations,
    lie_bracket,
    velocity_products,
)
from screwkit.kinematics.closure import close_grasp
from screwkit.kinematics.loops import loop_matrix
from screwkit.kinematics.rates import rate_constraints

REFERENCE = nao_reference()
SCHEMES = [pytest.param(s, id=str(s["actuated"])) for s in REFERENCE["schemes"]]
RATES = np.array(REFERENCE["active_rates"])
ACCELERATIONS = np.array(REFERENCE["active_accelerations"])
STEP = 1e-3


@pytest.mark.parametrize("scheme", SCHEMES)
def test_published_accelerations(scheme: dict[str, Any]) -> None:
    actuated = [str(i) for i in scheme["actuated"]]
    found = rate_constraints(nao(), nao_posture(), NAO_LIMBS, actuated)
    result = accelerations(found, RATES, ACCELERATIONS)
    np.testing.assert_allclose(result, scheme["accelerations"], atol=2e-9)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_differences_along_the_closed_motion(scheme: dict[str, Any]) -> None:
    """Rates to 1e-10, accelerations to 2e-8; without J̇ they are 0.1 to 17 off."""
    actuated = [str(i) for i in scheme["actuated"]]
    start = nao_posture()
    time = np.arange(-3, 4) * STEP
    path = {
        name: start[f"q{name}"] + RATES[k] * time + ACCELERATIONS[k] * time**2 / 2
        for k, name in enumerate(actuated)
    }
    motion = close_grasp(nao(), NAO_LIMBS, start, path)
    assert motion.closed
    found = rate_constraints(nao(), start, NAO_LIMBS, actuated)
    values = np.stack([motion.posture[f"q{n}"] for n in found.joints], axis=-1)
    first, second = derivatives(values, STEP)
    result = accelerations(found, RATES, ACCELERATIONS)
    np.testing.assert_allclose(found.rates(RATES), first, atol=1e-10)
    np.testing.assert_allclose(result, second, atol=2e-8)
    # J_c q̇ in place of J̇_c q̇, as printed, adds nothing at all: it is zero.
    as_printed = found.assembled(
        ACCELERATIONS,
        found.passive_rates(ACCELERATIONS),
        found.cut_rates(ACCELERATIONS),
    )
    error = float(np.abs(as_printed - second).max())
    assert error == pytest.approx(float(scheme["error_of_eq_13_as_printed"]), rel=1e-6)


@EACH
def test_other_arms_against_differences(name: str) -> None:
    arms, actuated = SYSTEMS[name]
    count = len(actuated)
    rates = 0.3 * np.cos(np.arange(count))
    forced = 0.4 * np.sin(1 + np.arange(count))
    time = np.arange(-3, 4) * STEP
    path = {
        joint: arms.posture[f"q_{joint}"] + rates[k] * time + forced[k] * time**2 / 2
        for k, joint in enumerate(actuated)
    }
    motion = close_grasp(arms.mechanism, arms.limbs, arms.posture, path)
    assert motion.closed
    found = rate_constraints(arms.mechanism, arms.posture, arms.limbs, actuated)
    values = np.stack([motion.posture[f"q_{n}"] for n in found.joints], axis=-1)
    first, second = derivatives(values, STEP)
    np.testing.assert_allclose(found.rates(rates), first, rtol=1e-8, atol=1e-9)
    result = accelerations(found, rates, forced)
    np.testing.assert_allclose(result, second, rtol=1e-6, atol=1e-6)


@EACH
def test_where_the_loop_is_cut_does_not_matter(name: str) -> None:
    arms, actuated = SYSTEMS[name]
    active = np.linspace(-1, 1, len(actuated))
    usual, uncut = (
        accelerations(
            rate_constraints(
                arms.mechanism, arms.posture, arms.limbs, actuated, cuts=cuts
            ),
            active,
            active[::-1],
        )
        for cuts in (None, ())
    )
    np.testing.assert_allclose(uncut, usual, rtol=1e-10, atol=1e-10)


def test_a_batch_is_its_postures() -> None:
    arms, actuated = SYSTEMS["three"]
    source = np.random.default_rng(10)
    batch = {n: source.uniform(0.3, 1.2, 6) for n in arms.posture}
    rates, forced = source.normal(size=(2, 6, len(actuated)))
    together = accelerations(
        rate_constraints(arms.mechanism, batch, arms.limbs, actuated), rates, forced
    )
    for i in range(6):
        one = {n: float(v[i]) for n, v in batch.items()}
        alone = rate_constraints(arms.mechanism, one, arms.limbs, actuated)
        expected = accelerations(alone, rates[i], forced[i])
        np.testing.assert_allclose(together[i], expected, rtol=1e-7)


def test_jacobi_identity_over_residues() -> None:
    ring = ModularRing(3, prime_for(2, [], 7))
    x, y, z = ([ring.symbol(f"{n}{i}") for i in range(6)] for n in "xyz")
    terms = [
        lie_bracket(a, lie_bracket(b, c))
        for a, b, c in ((x, y, z), (y, z, x), (z, x, y))
    ]
    assert all(sum(parts, ring.zero) == 0 for parts in zip(*terms, strict=True))
    assert all(value == 0 for value in lie_bracket(x, x))


def test_products_of_rates_over_residues_are_quadratic() -> None:
    ring = ModularRing(4, prime_for(2, [], 8))
    matrix = loop_matrix(nao(), ring, NAO_LIMBS)
    rates = {name: ring.symbol(f"rate{name}") for name in matrix.joints}
    twice = {name: rate + rate for name, rate in rates.items()}
    once = velocity_products(matrix, rates, ring)
    doubled = velocity_products(matrix, twice, ring)
    assert all(a * 4 == b for a, b in zip(once, doubled, strict=True))
