"""Ranks at a posture that is known in floating point alone.

Closed postures that a solver found have irrational coordinates; a rank is then a count
of singular values with a clear gap, and said to be unclear where there is none.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import (
    Stance,
    body_jacobian,
    loop_jacobian,
    stance_of,
)
from screwkit.finite.posture_model import (
    PostureModel,
    characteristic_length,
    scaled,
    with_locked,
)
from screwkit.finite.spanning_forest import Forest, forest_of

CLEAR = 1e3
"""Smallest ratio between singular values that count and those that do not."""

ZERO = 1e-8
"""Relative size below which a singular value counts as zero."""

DOUBTFUL = (1e-11, 1e-5)
"""Relative sizes of which floating point does not say whether they are zero."""


@dataclass(frozen=True)
class PostureNumbers:
    """What the loop equations say at one posture.

    Attributes:
        loop_rank: Of J_c.
        mobility: Freedoms less rank.
        twist_dimension: Of the platform's twist system.
        rotations: Rank of its directions.
        couples: Dimension of the pure couples among the reciprocal wrenches.
        gap: Smallest ratio met between what counts and what does not; inf where
            nothing is small, 1 where a singular value is of a doubtful size.
    """

    loop_rank: int
    mobility: int
    twist_dimension: int
    rotations: int
    couples: int
    gap: float

    @property
    def clear(self) -> bool:
        """Whether every rank has a margin."""
        return self.gap >= CLEAR

    @property
    def motion_type(self) -> str:
        """The platform's nTmR."""
        return f"{self.twist_dimension - self.rotations}T{self.rotations}R"


def numbers_at(model: PostureModel, locked: Collection[str] = ()) -> PostureNumbers:
    """The ranks at the posture of a model, with some freedoms locked.

    Args:
        model: At a closed posture.
        locked: Freedoms by their labels.

    Raises:
        UnknownNameError: If ``locked`` names no freedom.
    """
    own = scaled(with_locked(model, tuple(locked)))
    forest = forest_of(own)
    stance = stance_of(own, forest)
    matrix = loop_jacobian(forest, stance)[0]
    freedoms = len(own.screws)
    rank, kernel, gap = _split(matrix, freedoms)
    twists = _of_platform(own, forest, stance, kernel)
    dimension, first = _rank(twists)
    turning, second = _rank(_basis(twists, dimension)[:, :3])
    wrenches = _reciprocal(_basis(twists, dimension))
    forces, third = _rank(wrenches[:, :3])
    return PostureNumbers(
        rank,
        freedoms - rank,
        dimension,
        turning,
        len(wrenches) - forces,
        min(gap, first, second, third),
    )


def platform_screws(
    model: PostureModel, *, planar: bool = False
) -> tuple[Array, Array]:
    """The platform's twists and constraint wrenches at the posture of a model.

    Args:
        model: At a closed posture.
        planar: Leave out the wrenches that a planar file does not speak of.

    Returns:
        A basis of the twists (ω; v) and one of the wrenches (f; m) that do no work on
        any of them, shape (dimension, 6) each, about the base origin in file lengths.
    """
    own = scaled(model)
    forest = forest_of(own)
    stance = stance_of(own, forest)
    matrix = loop_jacobian(forest, stance)[0]
    kernel = _split(matrix, len(own.screws))[1]
    spanning = _of_platform(own, forest, stance, kernel)
    twists = _basis(spanning, _rank(spanning)[0])
    centre = characteristic_length(model.joints)[0]
    outside = np.eye(6)[[0, 1, 5] if planar else []]
    wrenches = _reciprocal(np.concatenate([twists, outside]))
    return (
        _at_origin(twists, centre, model.length),
        _at_origin(wrenches, centre, model.length),
    )


def _of_platform(
    model: PostureModel, forest: Forest, stance: Stance, kernel: Array
) -> Array:
    """Twists that span what the joint rates of a kernel do with the platform."""
    if model.platform == model.base:
        return np.zeros((0, 6))
    node = forest.nodes[model.platform]
    return np.asarray((body_jacobian(forest, stance, node)[0] @ kernel).T)


def _at_origin(screws: Array, centre: Array, length: float) -> Array:
    """Screws about a centre, measured by a length, about the origin in file lengths."""
    moments = length * screws[:, 3:] + np.cross(centre, screws[:, :3])
    return np.concatenate([screws[:, :3], moments], axis=1)


def connectivity_at(model: PostureModel) -> tuple[tuple[int, ...], ...] | None:
    """The freedom of every body relative to every other, in the order of the links.

    None where some bodies hang on nothing.
    """
    own = scaled(model)
    forest = forest_of(own)
    if len(forest.closing_joints) != len(own.joints) - len(own.links) + 1:
        return None
    stance = stance_of(own, forest)
    matrix = loop_jacobian(forest, stance)[0]
    _, kernel, _ = _split(matrix, len(own.screws))
    twists = [
        body_jacobian(forest, stance, forest.nodes[link])[0] @ kernel
        for link in own.links
    ]
    return tuple(
        tuple(0 if one is two else _rank(one - two)[0] for two in twists)
        for one in twists
    )


def _split(matrix: Array, freedoms: int) -> tuple[int, Array, float]:
    """Rank, orthonormal basis of the null space as columns, and the gap."""
    if not matrix.size:
        return 0, np.eye(freedoms), np.inf
    rank, gap = _rank(matrix)
    return rank, np.linalg.svd(matrix)[2][rank:].T, gap


def _rank(matrix: Array) -> tuple[int, float]:
    if not matrix.size:
        return 0, np.inf
    values = np.linalg.svd(matrix, compute_uv=False)
    largest = values[0] if values[0] > ZERO else 1.0
    counts = values > ZERO * largest
    rank = int(counts.sum())
    low, high = DOUBTFUL
    if np.any((values > low * largest) & (values < high * largest)):
        return rank, 1.0
    if rank == len(values) or not rank:
        return rank, np.inf
    return rank, float(values[rank - 1] / max(values[rank], 1e-300))


def _basis(rows: Array, rank: int) -> Array:
    if not rank:
        return np.zeros((0, 6))
    return np.asarray(np.linalg.svd(rows)[2][:rank])


def _reciprocal(twists: Array) -> Array:
    """Basis of the wrenches (f; m) that do no work."""
    if not len(twists):
        return np.eye(6)
    null = np.linalg.svd(twists)[2][len(twists) :]
    return np.asarray(null[:, [3, 4, 5, 0, 1, 2]])
