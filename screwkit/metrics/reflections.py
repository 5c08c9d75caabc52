"""Orthogonal elimination of many small matrices at once.

LAPACK takes its matrices one by one, which costs more than the arithmetic where they
are small.  Here each Householder reflection is applied to a whole batch.  Columns are
taken in a given order that is known to be regular; how small a pivot became is told.

References: [GolubVanLoan1996] §5.1-5.2.
"""

from __future__ import annotations

import numpy as np

from screwkit.algebra.batch import Array


def eliminated(matrices: Array, count: int) -> Array:
    """Reflect the first columns to upper triangular form, in place.

    Args:
        matrices: Shape (batch, m, n); overwritten.
        count: How many columns, at most m.

    Returns:
        For each matrix the smallest pivot over the largest, shape (batch,): near 0
        where the columns are dependent.
    """
    batch, rows, _ = matrices.shape
    least, largest = np.full(batch, np.inf), np.zeros(batch)
    for k in range(count):
        column = matrices[:, k:, k]
        if k == rows - 1:
            size = np.abs(column[:, 0])
        else:
            size = np.sqrt(np.einsum("bi,bi->b", column, column))
            first = column[:, 0]
            pivot = np.where(first > 0, -size, size)
            normal = column.copy()
            normal[:, 0] -= pivot
            square = np.einsum("bi,bi->b", normal, normal)
            scale = 2.0 / np.where(square > 0, square, 1.0)
            part = matrices[:, k:, k:]
            along = np.einsum("bi,bij->bj", normal, part) * scale[:, None]
            part -= normal[:, :, None] * along[:, None, :]
            matrices[:, k + 1 :, k] = 0.0
        least, largest = np.minimum(least, size), np.maximum(largest, size)
    return np.asarray(
        np.where(largest > 0, least / np.where(largest > 0, largest, 1), 0)
    )


def back_substituted(triangles: Array, right: Array) -> Array:
    """X with R X = right, for upper triangular R; inf or nan where R is singular.

    Args:
        triangles: Shape (batch, n, n).
        right: Shape (batch, n, m).
    """
    size = triangles.shape[1]
    found = np.empty_like(right)
    with np.errstate(divide="ignore", invalid="ignore"):
        for k in range(size - 1, -1, -1):
            row = right[:, k]
            if k + 1 < size:
                row = row - np.einsum(
                    "bi,bij->bj", triangles[:, k, k + 1 :], found[:, k + 1 :]
                )
            found[:, k] = row / triangles[:, k, k, None]
    return found


def row_space(matrices: Array, rank: int) -> tuple[Array, Array]:
    """Orthonormal bases of the row spaces, shape (batch, n, rank), and how regular.

    Args:
        matrices: Shape (batch, m, n), whose first ``rank`` rows are independent.
        rank: Of all of them.
    """
    batch, _, columns = matrices.shape
    turned = np.concatenate(
        [
            np.swapaxes(matrices[:, :rank], 1, 2),
            np.broadcast_to(np.eye(columns), (batch, columns, columns)),
        ],
        axis=2,
    )
    regular = eliminated(turned, rank)
    return np.swapaxes(turned[:, :rank, rank:], 1, 2), regular


def null_space(matrices: Array, rank: int) -> tuple[Array, Array]:
    """Orthonormal bases of the null spaces, and how regular; as `row_space`."""
    batch, _, columns = matrices.shape
    turned = np.concatenate(
        [
            np.swapaxes(matrices[:, :rank], 1, 2),
            np.broadcast_to(np.eye(columns), (batch, columns, columns)),
        ],
        axis=2,
    )
    regular = eliminated(turned, rank)
    return np.swapaxes(turned[:, rank:, rank:], 1, 2), regular


def squared_singular_values(matrices: Array, count: int) -> Array:
    """The largest ``count`` squared singular values, descending, shape (batch, count).

    One and two are found in closed form, the smaller from the determinant, so that it
    keeps its digits; more of them by LAPACK.
    """
    _, rows, columns = matrices.shape
    if columns > rows:
        matrices, rows, columns = np.swapaxes(matrices, 1, 2), columns, rows
    if count == 0:
        return np.zeros((len(matrices), 0))
    if columns == 1:
        return np.asarray(np.einsum("bij,bij->bj", matrices, matrices))
    if columns == 2 and count == 2:
        return _two(matrices)
    values = np.linalg.svd(matrices, compute_uv=False)
    return np.asarray(values[:, :count] ** 2)


def _two(matrices: Array) -> Array:
    a, b = matrices[:, :, 0], matrices[:, :, 1]
    aa = np.einsum("bi,bi->b", a, a)
    ab = np.einsum("bi,bi->b", a, b)
    with np.errstate(divide="ignore", invalid="ignore"):
        rest = b - np.where(aa > 0, ab / np.where(aa > 0, aa, 1.0), 0.0)[:, None] * a
        square = aa * np.einsum("bi,bi->b", rest, rest)
        bb = np.einsum("bi,bi->b", b, b)
        half = 0.5 * (aa + bb)
        large = half + np.hypot(0.5 * (aa - bb), ab)
        small = np.where(large > 0, square / np.where(large > 0, large, 1.0), 0.0)
    return np.stack([large, small], axis=1)
