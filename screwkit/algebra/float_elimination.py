"""Gaussian elimination of a few rows in floats, by the largest entry."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence


def shortest_step(
    jacobian: Sequence[Sequence[float]], residuals: Sequence[float]
) -> list[float] | None:
    """The least x with J x = r, by (J Jᵀ) y = r."""
    square = [[math.fsum(map(_times, a, b)) for b in jacobian] for a in jacobian]
    for i, row in enumerate(square):
        row[i] += 1e-14
    solved = _eliminated(square, residuals)
    if solved is None:
        return None
    columns = zip(*jacobian, strict=True)
    return [math.fsum(map(_times, column, solved)) for column in columns]


def _times(a: float, b: float) -> float:
    return a * b


def _eliminated(
    matrix: Sequence[Sequence[float]], right: Sequence[float]
) -> list[float] | None:
    rows = [[*row, r] for row, r in zip(matrix, right, strict=True)]
    for k in range(len(rows)):
        best = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        if not rows[k][k]:
            return None
        for i in range(len(rows)):
            if i != k and rows[i][k]:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [
                    a - factor * b for a, b in zip(rows[i], rows[k], strict=True)
                ]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


def pivots(jacobian: Sequence[Sequence[float]]) -> list[int] | None:
    """Columns that make the matrix square and well conditioned, by full pivoting."""
    rows = [list(row) for row in jacobian]
    chosen: list[int] = []
    while rows:
        size, r, c = max(_sized(rows))
        if size < 1e-7:
            return None
        chosen.append(c)
        pivot = rows.pop(r)
        rows = [
            [a - row[c] / pivot[c] * b for a, b in zip(row, pivot, strict=True)]
            for row in rows
        ]
    return chosen


def _sized(rows: Sequence[Sequence[float]]) -> Iterator[tuple[float, int, int]]:
    for r, row in enumerate(rows):
        for c, value in enumerate(row):
            yield abs(value), r, c
