"""Orthogonal elimination of many small matrices at once.

LAPACK takes its matrices one by one, which costs more than the arithmetic where they
are small.  Here each Householder reflection is applied to a whole batch, which is the
last axis, so that every operation runs along memory.  Columns are taken in a given
order that is known to be regular; how small a pivot became is told.

References: [GolubVanLoan1996] §5.1-5.2.
"""

from __future__ import annotations

import numpy as np

from screwkit.algebra.batch import Array


def eliminated(matrices: Array, count: int) -> Array:
    """Reflect the first columns to upper triangular form, in place.

    Args:
        matrices: Shape (m, n, batch); overwritten.
        count: How many columns, at most m.

    Returns:
        For each matrix the smallest pivot over the largest, shape (batch,): near 0
        where the columns are dependent.
    """
    rows, _, batch = matrices.shape
    least, largest = np.full(batch, np.inf), np.zeros(batch)
    for k in range(count):
        if k == rows - 1:
            size = np.abs(matrices[k, k])
        else:
            normal = matrices[k:, k].copy()
            square = np.einsum("ib,ib->b", normal, normal)
            size = np.sqrt(square)
            first = normal[0]
            pivot = np.copysign(size, -first)
            scale = square + np.abs(first) * size  # half of |normal - pivot|²
            normal[0] -= pivot
            np.divide(1.0, scale, out=scale, where=scale > 0)
            part = matrices[k:, k + 1 :]
            along = np.einsum("ib,ijb->jb", normal, part)
            along *= scale
            for i, height in enumerate(normal):
                part[i] -= height * along
            matrices[k, k] = pivot
            matrices[k + 1 :, k] = 0.0
        np.minimum(least, size, out=least)
        np.maximum(largest, size, out=largest)
    np.divide(least, largest, out=least, where=largest > 0)
    return least


def back_substituted(triangles: Array, right: Array) -> Array:
    """X with R X = right, for upper triangular R; inf or nan where R is singular.

    Args:
        triangles: Shape (n, n, batch).
        right: Shape (n, m, batch).
    """
    found = np.empty_like(right)
    with np.errstate(divide="ignore", invalid="ignore"):
        for k in range(len(triangles) - 1, -1, -1):
            row = right[k].copy()
            for j in range(k + 1, len(triangles)):
                row -= triangles[k, j] * found[j]
            np.divide(row, triangles[k, k], out=found[k])
    return found


def row_and_null_space(matrices: Array, rank: int) -> tuple[Array, Array, Array]:
    """Orthonormal bases of row and null spaces, and how regular each matrix is.

    Args:
        matrices: Shape (m, n, batch), whose first ``rank`` rows are independent.
        rank: Of all of them.

    Returns:
        Shapes (n, rank, batch), (n, n − rank, batch) and (batch,).
    """
    _, columns, batch = matrices.shape
    turned = np.empty((columns, rank + columns, batch))
    turned[:, :rank] = np.swapaxes(matrices[:rank], 0, 1)
    turned[:, rank:] = np.eye(columns)[:, :, None]
    regular = eliminated(turned, rank)
    basis = np.swapaxes(turned[:, rank:], 0, 1)
    return basis[:, :rank], basis[:, rank:], regular


def product(left: Array, right: Array) -> Array:
    """Matrix products over the batch."""
    return np.asarray(np.einsum("ijb,jkb->ikb", left, right))


def squared_singular_values(matrices: Array, count: int) -> Array:
    """The largest ``count`` squared singular values, descending, shape (batch, count).

    One and two are found in closed form, the smaller from the determinant, so that it
    keeps its digits; more of them by LAPACK.
    """
    rows, columns, batch = matrices.shape
    if columns > rows:
        matrices, columns = np.swapaxes(matrices, 0, 1), rows
    if count == 0:
        return np.zeros((batch, 0))
    if columns == 1:
        return np.asarray(np.einsum("ijb,ijb->bj", matrices, matrices))
    if columns == 2 and count == 2:
        return _two(matrices[:, 0], matrices[:, 1])
    values = np.linalg.svd(np.moveaxis(matrices, -1, 0), compute_uv=False)
    return np.asarray(values[:, :count] ** 2)


def _two(a: Array, b: Array) -> Array:
    aa, bb = np.einsum("ib,ib->b", a, a), np.einsum("ib,ib->b", b, b)
    ab = np.einsum("ib,ib->b", a, b)
    ratio = np.zeros_like(aa)
    np.divide(ab, aa, out=ratio, where=aa > 0)
    rest = b - ratio * a
    square = aa * np.einsum("ib,ib->b", rest, rest)
    large = 0.5 * (aa + bb) + np.hypot(0.5 * (aa - bb), ab)
    small = np.zeros_like(large)
    np.divide(square, large, out=small, where=large > 0)
    return np.stack([large, small], axis=1)
