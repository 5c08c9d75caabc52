"""Rates of passive and cut joints: published values, block form, other arms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from kinematics.arms import (
    ENDING_IN_A_SLIDE,
    NAO_LIMBS,
    SEVEN,
    SIX,
    SIX_B,
    SLIDING,
    System,
    nao,
    nao_posture,
    nao_reference,
    planar,
    system,
)

from screwkit.errors import UnknownNameError
from screwkit.kinematics.loops import loop_matrix, ring_at, stacked
from screwkit.kinematics.rates import (
    InadmissibleSchemeError,
    SingularPostureError,
    rate_constraints,
)

REFERENCE = nao_reference()
SCHEMES = [pytest.param(s, id=str(s["actuated"])) for s in REFERENCE["schemes"]]

SYSTEMS = {
    "two_six": (system([SIX, SIX_B], seed=1), ("a1", "a2", "a3", "a4", "a5", "a6")),
    "seven": (
        system([SEVEN, SEVEN], seed=2),
        ("b1", "b2", "b3", "b4", "a1", "a5", "a6", "a7"),
    ),
    "three": (
        system([SIX, SEVEN, SLIDING], seed=3),
        ("a1", "b2", "c1", "a3", "b5", "c2"),
    ),
    "slides": (system([SLIDING, SLIDING], seed=4), ("a1", "a2", "b1", "b2")),
    "cut_a_slide": (
        system([SIX, ENDING_IN_A_SLIDE], seed=5),
        ("a1", "a2", "a3", "b1", "b2", "b3"),
    ),
    "backwards": (
        system([SIX, SIX_B], backwards=1, seed=6),
        ("a1", "a2", "a3", "b1", "b2", "b3"),
    ),
    "planar": (system([planar(3, "0.1"), planar(3, "1")], seed=7), ("a1", "a2", "b1")),
}
EACH = pytest.mark.parametrize("name", SYSTEMS)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_published_rates(scheme: dict[str, Any]) -> None:
    actuated = [str(i) for i in scheme["actuated"]]
    found = rate_constraints(nao(), nao_posture(), NAO_LIMBS, actuated)
    assert found.cut == ("10",)
    rates = found.rates(np.array(REFERENCE["active_rates"]))
    np.testing.assert_allclose(rates, scheme["rates"], atol=1e-12)
    assert np.linalg.cond(found.g_p) == pytest.approx(
        scheme["condition_number_of_Gp"], rel=1e-10
    )


def test_blocks_of_the_paper() -> None:
    """The column of the cut joint is (0, 0, 1, 0, 0, 0), with the sign of the loop."""
    found = rate_constraints(nao(), nao_posture(), NAO_LIMBS, ["1", "2", "3", "7"])
    assert found.matrix.frames == ("l5",)
    column = [float(x) for x in found.matrix.column(0, "10")]
    assert column == [0, 0, -1, 0, 0, 0]
    assert found.cut_rows == (2,)
    shapes = [
        getattr(found, n).shape for n in ("g_a", "g_p", "g_ac", "g_pc", "g_c", "g")
    ]
    assert shapes == [(5, 4), (5, 5), (1, 4), (1, 5), (1, 1), (5, 4)]
    np.testing.assert_allclose(found.g_p @ found.g, -found.g_a, atol=1e-13)


def test_another_cut_where_the_last_joint_is_actuated() -> None:
    found = rate_constraints(nao(), nao_posture(), NAO_LIMBS, ["1", "2", "6", "10"])
    assert found.cut == ("9",)


def test_cut_in_the_other_limb_where_one_is_all_actuated() -> None:
    arms, actuated = SYSTEMS["two_six"]
    found = rate_constraints(arms.mechanism, arms.posture, arms.limbs, actuated)
    assert found.cut == ("b6",)
    other = [f"b{i}" for i in range(1, 7)]
    found = rate_constraints(arms.mechanism, arms.posture, arms.limbs, other)
    assert found.cut == ("a6",)


def _constraints_hold(arms: System, rates: np.ndarray) -> None:
    matrix = loop_matrix(
        arms.mechanism, ring_at(arms.mechanism, arms.posture), arms.limbs
    )
    residual = stacked(matrix.entries) @ rates
    assert np.abs(residual).max() < 1e-11 * max(1.0, float(np.abs(rates).max()))


@EACH
def test_rates_solve_the_loop_equations(name: str) -> None:
    arms, actuated = SYSTEMS[name]
    found = rate_constraints(arms.mechanism, arms.posture, arms.limbs, actuated)
    active = np.linspace(-1, 1, len(actuated))
    rates = found.rates(active)
    _constraints_hold(arms, rates)
    np.testing.assert_array_equal(
        rates[[found.joints.index(n) for n in actuated]], active
    )


@EACH
def test_cut_columns_are_zero_in_the_kept_rows(name: str) -> None:
    arms, actuated = SYSTEMS[name]
    found = rate_constraints(arms.mechanism, arms.posture, arms.limbs, actuated)
    whole = stacked(found.matrix.entries)
    columns = whole[:, [found.joints.index(n) for n in found.cut]]
    assert not columns[list(found.kept_rows)].any()
    np.testing.assert_array_equal(np.abs(found.g_c), np.eye(len(found.cut)))


@EACH
def test_where_the_loop_is_cut_does_not_matter(name: str) -> None:
    arms, actuated = SYSTEMS[name]
    active = np.linspace(-1, 1, len(actuated))

    def rates(cuts: tuple[str, ...] | None) -> np.ndarray:
        return rate_constraints(
            arms.mechanism, arms.posture, arms.limbs, actuated, cuts=cuts
        ).rates(active)

    usual = rates(None)
    np.testing.assert_allclose(rates(()), usual, atol=1e-11)
    first = [
        next(n for n, _ in limb if n not in actuated)
        for limb in arms.limbs
        if any(n not in actuated for n, _ in limb)
    ]
    cuts = tuple(first[-(len(arms.limbs) - 1) :])
    np.testing.assert_allclose(rates(cuts), usual, atol=1e-11)


def test_a_batch_is_its_postures() -> None:
    arms, actuated = SYSTEMS["three"]
    source = np.random.default_rng(8)
    batch = {n: source.uniform(0.3, 1.2, (4, 5)) for n in arms.posture}
    active = source.normal(size=(4, 5, len(actuated)))
    together = rate_constraints(arms.mechanism, batch, arms.limbs, actuated)
    rates = together.rates(active)
    assert together.g.shape == (4, 5, 10, 6)
    for index in np.ndindex(4, 5):
        one = {n: float(v[index]) for n, v in batch.items()}
        alone = rate_constraints(arms.mechanism, one, arms.limbs, actuated)
        np.testing.assert_allclose(rates[index], alone.rates(active[index]), rtol=1e-8)


def test_singular_postures() -> None:
    posture = {n: np.array([v, v, v]) for n, v in nao_posture().items()}
    posture["q9"] = np.array([-0.8, 0.0, 0.3])
    scheme = ["1", "2", "3", "7"]
    with pytest.raises(SingularPostureError, match="1 of 3 postures") as caught:
        rate_constraints(nao(), posture, NAO_LIMBS, scheme)
    assert caught.value.postures == (1,)
    found = rate_constraints(nao(), posture, NAO_LIMBS, scheme, singular="nan")
    rates = found.rates(np.ones(4))
    assert np.isnan(rates[1][[3, 4, 5, 7, 8, 9]]).all()
    assert np.isfinite(rates[[0, 2]]).all()


def test_an_inadmissible_scheme_is_singular_everywhere() -> None:
    source = np.random.default_rng(9)
    posture = {n: source.uniform(-1, 1, 20) for n in nao_posture()}
    with pytest.raises(SingularPostureError, match="20 of 20"):
        rate_constraints(nao(), posture, NAO_LIMBS, ["1", "2", "6", "7"])


def test_schemes_that_fail_by_counting() -> None:
    with pytest.raises(InadmissibleSchemeError, match="actuate more"):
        rate_constraints(nao(), nao_posture(), NAO_LIMBS, ["1", "2", "3"])
    everything = [n for limb in NAO_LIMBS for n in limb]
    with pytest.raises(InadmissibleSchemeError, match="limbs 1, 2 have no passive"):
        rate_constraints(nao(), nao_posture(), NAO_LIMBS, everything)
    with pytest.raises(SingularPostureError, match="actuate fewer"):
        rate_constraints(nao(), nao_posture(), NAO_LIMBS, ["1", "2", "3", "7", "8"])


def test_wrong_names_and_cuts() -> None:
    with pytest.raises(UnknownNameError, match="no joint '11'"):
        rate_constraints(nao(), nao_posture(), NAO_LIMBS, ["11"])
    with pytest.raises(InadmissibleSchemeError, match="cannot be cut"):
        rate_constraints(
            nao(), nao_posture(), NAO_LIMBS, ["1", "2", "6", "10"], cuts=["10"]
        )
    with pytest.raises(ValueError, match="every limb but one"):
        rate_constraints(
            nao(), nao_posture(), NAO_LIMBS, ["1", "2", "3", "7"], cuts=["9", "10"]
        )
    with pytest.raises(ValueError, match="twice"):
        rate_constraints(nao(), nao_posture(), NAO_LIMBS, ["1", "1", "2", "3"])
