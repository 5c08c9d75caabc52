"""The identities of [Chiacchio] on random arms, two and more, planar and spatial."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from screwkit.metrics.arms import (
    Arm,
    absolute_jacobian,
    extended_jacobian,
    external_matrix,
    in_parallel,
    in_series,
    internal_matrix,
    relative_jacobian,
    shares,
)

Array = NDArray[np.float64]
SPACES = [(3, 2), (6, 3)]
COUNTS = [2, 3, 4]


def arms_of(size: int, linear: int, count: int, seed: int = 0) -> list[Arm]:
    """Arms with up to two joints more than needed, and levers that are not zero."""
    source = np.random.default_rng(seed)
    return [
        Arm(source.normal(size=(size, size + i % 3)), source.normal(size=linear))
        for i in range(count)
    ]


def near(one: Array, other: Array) -> bool:
    return bool(np.allclose(one, other, rtol=1e-9, atol=1e-9))


@pytest.mark.parametrize(("size", "linear"), SPACES)
@pytest.mark.parametrize("count", COUNTS)
def test_internal_forces_do_not_move_the_object(
    size: int, linear: int, count: int
) -> None:
    """W V = 0, and V spans all of ker W: (7)."""
    arms = arms_of(size, linear, count)
    external, internal = external_matrix(arms), internal_matrix(arms)
    assert near(external @ internal, np.zeros((size, size * (count - 1))))
    assert np.linalg.matrix_rank(internal) == size * (count - 1)


@pytest.mark.parametrize(("size", "linear"), SPACES)
@pytest.mark.parametrize("count", COUNTS)
def test_arms_combine_in_parallel_and_in_series(
    size: int, linear: int, count: int
) -> None:
    """(30) and (37); J_a and J_r act in directions that exclude each other."""
    arms = arms_of(size, linear, count, 1)
    absolute, relative = absolute_jacobian(arms), relative_jacobian(arms)
    assert near(absolute @ absolute.T, in_parallel(arms))
    assert near(relative @ relative.T, in_series(arms))
    assert near(
        np.linalg.pinv(absolute).T @ relative.T, np.zeros((size, len(relative)))
    )


@pytest.mark.parametrize(("size", "linear"), SPACES)
def test_two_arms_have_the_internal_forces_of_the_paper(size: int, linear: int) -> None:
    """V = [W_1⁻¹; −W_2⁻¹], with R_ia written out."""
    arms = arms_of(size, linear, 2, 2)
    written = np.zeros((2 * size, size))
    for number, (arm, sign) in enumerate(zip(arms, (1, -1), strict=True)):
        back = np.eye(size)
        if linear == 2:
            back[2, :2] = [-arm.offset[1], arm.offset[0]]
        else:
            x, y, z = arm.offset
            back[3:, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        written[number * size : (number + 1) * size] = sign * back
    assert near(internal_matrix(arms), written)


@pytest.mark.parametrize(("size", "linear"), SPACES)
@pytest.mark.parametrize("count", COUNTS)
def test_shares_add_up_to_one(size: int, linear: int, count: int) -> None:
    axes, parts = shares(arms_of(size, linear, count, 3))
    assert near(parts.sum(axis=0), np.ones(size))
    assert (parts >= 0).all()
    assert near(axes.T @ axes, np.eye(size))


@pytest.mark.parametrize("count", COUNTS)
def test_one_share_is_what_the_arm_spends(count: int) -> None:
    """Of the rates of least norm that move the object along an axis, by lstsq."""
    arms = arms_of(6, 3, count, 4)
    axes, parts = shares(arms)
    whole = extended_jacobian(arms)
    for axis in range(6):
        ends = external_matrix(arms).T @ axes[:, axis]
        rates = np.linalg.lstsq(whole, ends, rcond=None)[0]
        start, spent = 0, []
        for arm in arms:
            stop = start + arm.jacobian.shape[1]
            spent.append(float(rates[start:stop] @ rates[start:stop]))
            start = stop
        assert near(np.array(spent) / sum(spent), parts[:, axis])


def test_more_arms_stretch_nothing_when_one_is_split() -> None:
    """Ellipsoids of relative motion depend on the arms and not on their order."""
    arms = arms_of(3, 2, 4, 5)
    reordered = [arms[2], arms[0], arms[3], arms[1]]
    one, other = (np.linalg.eigvalsh(in_series(some)) for some in (arms, reordered))
    assert np.allclose(one, other, rtol=1e-9, atol=1e-9)
