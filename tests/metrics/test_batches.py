"""Indices of many postures at once against one posture at a time."""

from __future__ import annotations

import random

import numpy as np
import pytest
from grasping.random_hands import SPACES, hand, spd, weighted

import screwkit as sk
from screwkit.analyses.manipulability import manipulability
from screwkit.errors import UnknownNameError
from screwkit.kinematics.network import Network
from screwkit.mechanism.model import Space
from screwkit.metrics.index_function import Kind, index_function
from screwkit.metrics.locus_function import locus_function

KINDS: list[Kind] = ["kinematic", "force"]
# By case: what is varied, and a range without singular postures in it.
VARIED = {
    "stewart_alpha_beta": {"alpha": (0.2, 0.9), "beta": (-1.9, -1.2)},
    "scara_pair_hard": {"L": (0.6, 2.5)},
}


@pytest.mark.parametrize("case", VARIED)
@pytest.mark.parametrize("kind", ["kinematic", "force"])
def test_a_batch_is_its_postures(case: str, kind: Kind) -> None:
    source = np.random.default_rng(1)
    values = {name: source.uniform(*span, 5) for name, span in VARIED[case].items()}
    function = index_function(sk.load(case).mechanism, kind)
    found = function(values)
    assert found.shape == (5, function.count)
    for number in range(5):
        one = {name: repr(float(v[number])) for name, v in values.items()}
        answer = sk.manipulability(sk.load(case, set_values=one))
        index = answer.kinematic if kind == "kinematic" else answer.force
        assert np.allclose(found[number], index.finite, rtol=1e-8)


def test_batches_broadcast() -> None:
    function = index_function(sk.load("stewart_alpha_beta").mechanism)
    alpha, beta = np.linspace(0.2, 0.9, 4)[:, None], np.linspace(-1.9, -1.2, 3)
    found = function({"alpha": alpha, "beta": beta})
    assert found.shape == (4, 3, function.count)
    assert np.allclose(
        found[2, 1], function({"alpha": alpha[2, 0], "beta": beta[1]}), rtol=1e-10
    )


HANDS = [(seed, space) for space in SPACES for seed in range(200, 230)]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("seed", "space"), HANDS)
def test_one_plan_for_grasps_of_every_kind(seed: int, space: Space, kind: Kind) -> None:
    """Spare joints, loose objects and lost ranks are part of the plan, not special.

    With weights; the other route goes through singular values posture by posture.
    """
    drawn = hand(seed, space)
    source = random.Random(seed)
    size, actuated = len(drawn.drawn.o), len(drawn.drawn.a)
    if not actuated:
        return
    keys = {"twist": size, "rates": actuated, "wrench": size, "torques": actuated}
    mechanism = weighted(
        drawn.mechanism, **{key: spd(source, n) for key, n in keys.items()}
    )
    answer = manipulability(Network(mechanism))
    wanted = answer.kinematic if kind == "kinematic" else answer.force
    function = index_function(mechanism, kind)
    assert function.count == len(wanted.finite)
    found = function({})
    assert found.shape == (function.count,)
    assert np.allclose(found, wanted.finite, rtol=1e-7)


@pytest.mark.parametrize("kind", KINDS)
def test_joint_variables_of_a_table_are_arrays_too(kind: Kind) -> None:
    """Two six-joint arms; with straight wrists they lose motions and gain wrenches."""
    case = "dual_puma"
    mechanism = sk.load(case).mechanism
    names = mechanism.joint_variables
    points = np.random.default_rng(7).uniform(-2, 2, (3, len(names))).round(3)
    points[2, [names.index("qA5"), names.index("qB5")]] = 0.0
    found = index_function(mechanism, kind)(
        {name: points[:, k] for k, name in enumerate(names)}
    )
    for number, (row, point) in enumerate(zip(found, points, strict=True)):
        at = {name: repr(float(x)) for name, x in zip(names, point, strict=True)}
        there = sk.manipulability(sk.load(case, at=at))
        index = there.kinematic if kind == "kinematic" else there.force
        lost = len(row) - len(index.finite)
        assert bool(lost) == (number == 2)
        padded = [*index.finite, *[0.0] * lost]
        if kind == "force":
            padded = [*[np.inf] * lost, *index.finite]
        assert np.allclose(row, padded, rtol=1e-7)


def test_a_singular_posture_is_infinite_and_its_neighbours_are_not() -> None:
    """At α = β the base and platform triangles are alike: Hunt's singularity."""
    function = index_function(sk.load("stewart_alpha_beta").mechanism)
    found = function({"alpha": np.array([0.5, 0.5]), "beta": np.array([0.5, 0.8])})
    assert np.isinf(found[0]).any()
    assert np.isfinite(found[1]).all()


def test_unknown_names_are_refused() -> None:
    function = index_function(sk.load("stewart_alpha_beta").mechanism)
    with pytest.raises(UnknownNameError, match="alfa"):
        function({"alfa": np.zeros(2)})


def test_the_locus_vanishes_where_the_mechanism_is_singular() -> None:
    """Determinant and least singular value vanish at α = β, and not beside it."""
    mechanism = sk.load("stewart_alpha_beta").mechanism
    at = {"alpha": np.array([0.5, 0.5]), "beta": np.array([0.5, 0.8])}
    least = locus_function(mechanism, "sigma_min")(at)
    whole = locus_function(mechanism, "locus")(at)
    assert np.abs([least[0], whole[0]]).max() < 1e-12
    assert np.abs([least[1], whole[1]]).min() > 1e-8
