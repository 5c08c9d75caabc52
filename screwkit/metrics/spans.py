"""Subspaces in floating point, of a dimension that is known beforehand.

A rank is an exact number found elsewhere; here it says how many singular vectors
count.  Only where a posture itself is known in floating point alone is the rank a
count of singular values, and then the gap goes with it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array

ZERO = 1e-9
"""Relative size below which a singular value of a float posture counts as zero."""


@dataclass(frozen=True)
class Split:
    """A matrix by its singular vectors.

    Attributes:
        row_space: Orthonormal basis of the row space, one column each.
        null_space: Of the null space.
        column_space: Of the column space.
        left_null_space: Of the null space of the transpose.
        rank: How many singular values count.
        gap: Smallest ratio of one that counts to one that does not; inf without one.
        least: Smallest of those that count over the largest; 1 without one.
    """

    row_space: Array
    null_space: Array
    column_space: Array
    left_null_space: Array
    rank: int
    gap: float
    least: float = 1.0


def split(matrix: Array, rank: int | None = None) -> Split:
    """The four subspaces of a matrix.

    Args:
        matrix: Shape (m, n), either may be 0.
        rank: Where it is known; counted otherwise.
    """
    m, n = matrix.shape
    if not matrix.size:
        return Split(
            np.zeros((n, 0)), np.eye(n), np.zeros((m, 0)), np.eye(m), 0, np.inf
        )
    u, values, vt = np.linalg.svd(matrix)
    if rank is None:
        largest = max(float(values[0]), 1e-300)
        rank = int((values > ZERO * largest).sum())
    v = vt.T
    gap = np.inf
    if 0 < rank < len(values):
        gap = float(values[rank - 1] / max(values[rank], 1e-300))
    least = float(values[rank - 1] / values[0]) if rank else 1.0
    return Split(v[:, :rank], v[:, rank:], u[:, :rank], u[:, rank:], rank, gap, least)


def without(vectors: Array, subspace: Array) -> Array:
    """Columns less their parts in a subspace given by an orthonormal basis."""
    return np.asarray(vectors - subspace @ (subspace.T @ vectors))


def tidied(rows: Array) -> Array:
    """Another basis of the span of independent rows, with as many zeros as pivots give.

    Reduced echelon form with the largest pivots, each row then of unit length.
    """
    left = np.array(rows, dtype=float)
    for number in range(len(left)):
        below = np.abs(left[number:])
        row, column = divmod(int(np.argmax(below)), below.shape[1])
        left[[number, number + row]] = left[[number + row, number]]
        left[number] /= left[number, column]
        for other in range(len(left)):
            if other != number:
                left[other] -= left[other, column] * left[number]
    left[np.abs(left) < 1e-13] = 0.0
    return np.asarray(left / np.linalg.norm(left, axis=1, keepdims=True))
