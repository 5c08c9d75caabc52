"""Small matrices of residues: products and forms."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

from flint import nmod_mat

from screwkit.algebra.modular import residue_matrix

Rows: TypeAlias = list[list[int]]
"""A matrix of residues; bases have a vector in each row."""


def chosen_columns(matrix: Any, places: Sequence[int], prime: int) -> Any:
    """Some columns of a matrix in FLINT's form, by their numbers."""
    selector = nmod_mat(matrix.ncols(), len(places), prime)
    for column, place in enumerate(places):
        selector[place, column] = 1
    return matrix * selector


def first_rows(matrix: Any, count: int, prime: int) -> Any:
    """The first rows of a matrix in FLINT's form."""
    selector = nmod_mat(count, matrix.nrows(), prime)
    for row in range(count):
        selector[row, row] = 1
    return selector * matrix


def null_rows(matrix: Any, prime: int) -> Any:
    """Basis of the vectors that a matrix annihilates, one in each row."""
    kernel, nullity = matrix.nullspace()
    return first_rows(kernel.transpose(), int(nullity), prime)


def product(left: Rows, right: Rows, prime: int) -> Rows:
    """Left times right."""
    if not left or not right:
        return [[] for _ in left]
    one = residue_matrix(left, len(left[0]), prime)
    other = residue_matrix(right, len(right[0]), prime)
    found = one * other
    width = len(right[0])
    return [[int(found[i, j]) for j in range(width)] for i in range(len(left))]


def gram(vectors: Rows, metric: Rows, prime: int) -> Rows:
    """All products of the vectors in a metric."""
    turned = [list(column) for column in zip(*vectors, strict=True)]
    return product(product(vectors, metric, prime), turned, prime)


def identity(size: int) -> Rows:
    """The unit matrix."""
    return [[int(i == j) for j in range(size)] for i in range(size)]
