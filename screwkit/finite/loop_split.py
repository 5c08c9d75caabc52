"""Loop equations parted into those that a rank solves and those it leaves over.

In suitable bases the loop Jacobian is [[A, B], [C, D]] with A regular, of the size of
the rank at one posture.  Around there the first equations can be solved for the first
coordinates, and S = D − C A⁻¹ B is all that remains to be asked of the others: the
reduction of Lyapunov and Schmidt.  S is small even where the mechanism is large.

References: [GolubitskySchaeffer1985] §I.3, [Mueller2016].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import Stance, loop_jacobian, misses
from screwkit.finite.spanning_forest import Forest

CUT = 1e-5
"""Relative size below which a singular value at a corrected posture counts as zero."""


CONDITION = 1e3
"""Long chains are worse conditioned than this by nature, not by a singularity."""


@dataclass(frozen=True, eq=False)
class Split:
    """Orthogonal bases of loop equations and of coordinates, for every posture.

    Attributes:
        left: Combinations of the equations, shape (batch, rows, rows).
        right: Combinations of the coordinates, shape (batch, freedoms, freedoms).
        rank: How many of both come first.
        size: What singular values are compared with, shape (batch,): the largest of
            J_c, or `CONDITION` times the smallest that counts if that is less.
    """

    left: Array
    right: Array
    rank: int
    size: Array

    def take(self, chosen: Sequence[int] | NDArray[np.intp]) -> Split:
        """Of some postures, or of some several times."""
        index = np.asarray(chosen, dtype=np.intp)
        return Split(self.left[index], self.right[index], self.rank, self.size[index])


@dataclass(frozen=True, eq=False)
class Reduced:
    """J_c in the bases of a split, with A inverted.

    Attributes:
        split: The bases.
        solver: A⁻¹, shape (batch, rank, rank).
        beside: B, shape (batch, rank, freedoms − rank).
        below: C, shape (batch, rows − rank, rank).
        rest: S = D − C A⁻¹ B, shape (batch, rows − rank, freedoms − rank).
    """

    split: Split
    solver: Array
    beside: Array
    below: Array
    rest: Array

    @property
    def strain(self) -> Array:
        """How near A is to losing rank, shape (batch,)."""
        sizes = np.linalg.norm(self.solver, axis=(-2, -1))
        return np.asarray(sizes * self.split.size)

    @cached_property
    def tangents(self) -> Array:
        """Orthonormal coordinates that A leaves free, (batch, freedoms, f − rank)."""
        rank, right = self.split.rank, self.split.right
        free = right[..., rank:] - right[..., :rank] @ (self.solver @ self.beside)
        return np.linalg.qr(free)[0]

    def take(self, chosen: NDArray[np.bool_]) -> Reduced:
        """Of some postures."""
        return Reduced(
            self.split.take(np.flatnonzero(chosen)),
            self.solver[chosen],
            self.beside[chosen],
            self.below[chosen],
            self.rest[chosen],
        )

    def step_at_rank(self, missing: Array) -> Array:
        """The change that meets the first equations with the first coordinates."""
        rank, split = self.split.rank, self.split
        first = np.swapaxes(split.left[..., :rank], -1, -2) @ missing[..., None]
        return -(split.right[..., :rank] @ (self.solver @ first))[..., 0]

    def step(self, missing: Array, cut: float) -> Array:
        """The change that meets all equations; weak ones, below the cut, left out."""
        rank, split = self.split.rank, self.split
        parts = np.swapaxes(split.left, -1, -2) @ missing[..., None]
        solved = self.solver @ parts[..., :rank, :]
        left = parts[..., rank:, :] - self.below @ solved
        free = -_truncated_solution(self.rest, left, cut * split.size)
        bound = -solved - self.solver @ (self.beside @ free)
        change = split.right @ np.concatenate([bound, free], axis=-2)
        return np.asarray(change[..., 0])


def split_at(
    forest: Forest, stance: Stance, rank: int | None = None, cut: float = CUT
) -> tuple[Split, Array]:
    """The bases of singular vectors, with all singular values.

    Args:
        forest: Of the mechanism.
        stance: Postures of one rank.
        rank: Of J_c; that of the first posture, by the cut-off, if absent.
        cut: Relative size of singular values that count as zero.
    """
    matrices = loop_jacobian(forest, stance)
    batch, rows, freedoms = matrices.shape
    if not rows or not freedoms:
        left = np.broadcast_to(np.eye(rows), (batch, rows, rows))
        right = np.broadcast_to(np.eye(freedoms), (batch, freedoms, freedoms))
        return Split(left, right, 0, np.ones(batch)), np.zeros((batch, 0))
    left, values, right = np.linalg.svd(matrices)
    if rank is None:
        rank = int((values[0] > cut * values[0, :1]).sum())
    least = values[:, rank - 1] if rank else values[:, 0]
    size = np.maximum(np.minimum(values[:, 0], CONDITION * least), 1e-300)
    return Split(left, np.swapaxes(right, -1, -2), rank, size), values


def reduced(forest: Forest, stance: Stance, split: Split) -> Reduced:
    """J_c at every posture in the bases of a split."""
    rank = split.rank
    whole = np.swapaxes(split.left, -1, -2) @ loop_jacobian(forest, stance)
    whole = whole @ split.right
    solver = _inverse(whole[:, :rank, :rank])
    beside, below = whole[:, :rank, rank:], whole[:, rank:, :rank]
    rest = whole[:, rank:, rank:] - below @ (solver @ beside)
    return Reduced(split, solver, beside, below, rest)


def turned(forest: Forest, stance: Stance, split: Split) -> Split:
    """Bases of the same rank that fit where the postures are now.

    One step of orthogonal iteration in place of singular vectors, which cost much more
    and are not needed: A only has to be regular.
    """
    matrices, rank = loop_jacobian(forest, stance), split.rank
    rows = np.swapaxes(matrices, -1, -2) @ split.left[..., :rank]
    right = np.linalg.qr(rows, mode="complete")[0]
    columns = matrices @ right[..., :rank]
    left = np.linalg.qr(columns, mode="complete")[0]
    return Split(left, right, rank, split.size)


def refined(parts: Reduced, number: int, cut: float = CUT) -> tuple[Split, float]:
    """The bases at one posture, with all equations in front that hold its rank.

    And the largest singular value that was left out, relative to the split's size.
    """
    split = parts.split.take([number])
    rest = parts.rest[number]
    if not rest.size:
        return split, 0.0
    turned, values, directions = np.linalg.svd(rest)
    more = int((values > cut * split.size[0]).sum())
    left, right, rank = split.left.copy(), split.right.copy(), split.rank
    left[0, :, rank:] = left[0, :, rank:] @ turned
    right[0, :, rank:] = right[0, :, rank:] @ directions.T
    dropped = float(max(values[more:], default=0.0) / split.size[0])
    return Split(left, right, rank + more, split.size), dropped


def stacked_splits(splits: Sequence[Split]) -> Split:
    """Splits of one rank as one batch."""
    return Split(
        np.concatenate([split.left for split in splits]),
        np.concatenate([split.right for split in splits]),
        splits[0].rank,
        np.concatenate([split.size for split in splits]),
    )


def largest_miss(stance: Stance) -> Array:
    """In radians, and in lengths of the mechanism's own, shape (batch,)."""
    return np.asarray(np.abs(misses(stance)).max(axis=-1, initial=0.0))


def _inverse(matrices: Array) -> Array:
    try:
        return np.asarray(np.linalg.inv(matrices))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrices, rcond=1e-12))


def _truncated_solution(matrices: Array, wanted: Array, cut: Array) -> Array:
    if not matrices.size:
        return np.zeros((len(matrices), matrices.shape[2], 1))
    left, values, right = np.linalg.svd(matrices, full_matrices=False)
    kept = values > cut[:, None]
    reciprocal = np.where(kept, 1.0 / np.where(kept, values, 1.0), 0.0)
    parts = (np.swapaxes(left, -1, -2) @ wanted) * reciprocal[..., None]
    return np.asarray(np.swapaxes(right, -1, -2) @ parts)
