"""Exponentials, displacements of bodies, the loop Jacobian against its definition."""

from __future__ import annotations

import numpy as np
import pytest
from finite.sample_linkages import Z, ball, model, pins, ring, slide, turn
from scipy.linalg import expm

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import (
    body_jacobian,
    carried,
    exponential,
    inverse,
    loop_jacobian,
    misses,
    moved,
    rebased,
    stance_of,
)
from screwkit.finite.posture_model import (
    PosedJoint,
    PostureModel,
    characteristic_length,
    scaled,
    with_locked,
)
from screwkit.finite.spanning_forest import forest_of


def hat(screw: Array) -> Array:
    matrix = np.zeros((4, 4))
    x, y, z = screw[:3]
    matrix[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    matrix[:3, 3] = screw[3:]
    return matrix


def random_screws(count: int, random: np.random.Generator) -> Array:
    screws = random.standard_normal((count, 6))
    screws[:, :3] /= np.linalg.norm(screws[:, :3], axis=1, keepdims=True)
    screws[::3, :3] = 0
    screws[::3, 3:] /= np.linalg.norm(screws[::3, 3:], axis=1, keepdims=True)
    return screws


def mixed() -> PostureModel:
    """Two loops with every sort of joint, some passed backwards."""
    random = np.random.default_rng(5)
    screws = random_screws(8, random)
    return model(
        "base",
        "c",
        turn("a", "base", "a", (1, 2, 2), (1, 0, 1)),
        ball("s", "b", "a", (0, 2, 1)),
        PosedJoint("u", "c", "b", screws[1:3]),
        ball("t", "base", "c", (1, 1, -1)),
        slide("p", "d", "base", (0, 1, 1)),
        PosedJoint("h", "d", "c", screws[4:6]),
    )


def test_the_exponential_is_that_of_the_matrix() -> None:
    random = np.random.default_rng(1)
    screws, q = random_screws(12, random), random.uniform(-4, 4, 12)
    found = exponential(screws, q)
    for screw, angle, displacement in zip(screws, q, found, strict=True):
        assert displacement == pytest.approx(expm(angle * hat(screw)), abs=1e-12)
    assert found @ inverse(found) == pytest.approx(
        np.broadcast_to(np.eye(4), (12, 4, 4))
    )


def test_a_carried_screw_generates_the_conjugate_displacement() -> None:
    random = np.random.default_rng(2)
    screws, place = (
        random_screws(6, random),
        exponential(random_screws(6, random), np.full(6, 1.3)),
    )
    angles = np.full(6, 0.7)
    there = exponential(carried(place, screws), angles)
    assert there == pytest.approx(place @ exponential(screws, angles) @ inverse(place))


def test_the_jacobian_is_the_derivative_of_the_miss() -> None:
    linkage = mixed()
    forest = forest_of(linkage)
    stance = stance_of(linkage, forest, 3)
    random = np.random.default_rng(3)
    for _ in range(2):
        rates = random.standard_normal((3, len(linkage.labels)))
        ahead, behind = (moved(forest, stance, s * 1e-6 * rates) for s in (1, -1))
        slope = misses(ahead) - misses(behind)
        wanted = (loop_jacobian(forest, stance) @ rates[..., None])[..., 0]
        assert slope / 2e-6 == pytest.approx(wanted, abs=1e-8)
        stance = stance_of(rebased(linkage, 0.4 * rates[0]), forest, 3)


def test_the_platform_moves_by_its_jacobian() -> None:
    linkage = mixed()
    forest = forest_of(linkage)
    stance = stance_of(linkage, forest)
    q = np.random.default_rng(4).standard_normal((1, len(linkage.labels)))
    there = moved(forest, stance, q)
    on = moved(forest, there, 1e-6 * q)
    rate = (on.platform - there.platform)[0] @ inverse(there.platform)[0] / 1e-6
    twist = body_jacobian(forest, there, forest.platform[1])[0] @ q[0]
    assert rate == pytest.approx(hat(twist), abs=1e-5)


def test_two_motions_are_one() -> None:
    """Basing the posture anew changes nothing but the names of positions."""
    linkage = model(
        "base",
        "d",
        turn("a", "base", "b", (1, 2, 2), (1, 0, 1)),
        PosedJoint("u", "c", "b", random_screws(3, np.random.default_rng(6))[1:]),
        slide("p", "c", "d", (0, 1, 1)),
        turn("e", "d", "base", (2, -1, 0), (0, 0, 1)),
    )
    forest = forest_of(linkage)
    start = stance_of(linkage, forest)
    first, second = np.random.default_rng(7).standard_normal((2, 1, 5))
    there = moved(forest, moved(forest, start, first), second)
    direct = moved(forest, start, first + second)
    assert there.gaps == pytest.approx(direct.gaps)
    assert there.screws == pytest.approx(direct.screws)


def test_a_ball_joint_never_locks() -> None:
    linkage = model("base", "body", ball("s", "base", "body", (1, 2, 3)))
    forest = forest_of(linkage)
    locking = np.array([[0.0, np.pi / 2, 0.0]])
    there = moved(forest, stance_of(linkage, forest), locking)
    assert np.linalg.matrix_rank(there.screws[0]) == 3
    assert there.screws[0] == pytest.approx(linkage.screws)


def test_a_parallelogram_stays_closed() -> None:
    linkage = pins(2, [(0, 0), (1, 2), (4, 2), (3, 0)])
    forest = forest_of(linkage)
    for angle in (0.3, 2.0, -3.0):
        q = np.array([[angle, -angle, angle, -angle]])
        there = moved(forest, stance_of(linkage, forest), q)
        assert misses(there) == pytest.approx(np.zeros((1, 6)), abs=1e-14)


def test_the_length_of_a_mechanism_is_its_own() -> None:
    """It follows the scale, and not where along its axis a joint is drawn."""
    points = [(0.0, 0.0, 0.0), (3.0, 1.0, 0.0), (5.0, 0.0, 0.0)]
    length = characteristic_length(ring(1, [(Z, p) for p in points]).joints)[1]
    other = [(1e3 * x, 1e3 * y, 1e5 * x) for x, y, _ in points]
    large = characteristic_length(ring(1, [(Z, p) for p in other]).joints)[1]
    assert large == pytest.approx(1e3 * length)
    assert scaled(ring(1, [(Z, p) for p in other])).screws == pytest.approx(
        scaled(ring(1, [(Z, p) for p in points])).screws
    )


def test_locked_freedoms_are_gone() -> None:
    held = with_locked(mixed(), ["s:1", "a"])
    assert held.labels[:2] == ("s:0", "s:2")
    assert len(held.screws) == len(mixed().screws) - 2
