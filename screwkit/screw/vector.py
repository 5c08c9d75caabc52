"""3-vectors and rotations over any ring."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from screwkit.algebra.ring import Ring, S

Vector: TypeAlias = tuple[S, S, S]
Rotation: TypeAlias = tuple[Vector[S], Vector[S], Vector[S]]  # rows


def dot(a: Sequence[S], b: Sequence[S]) -> S:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Sequence[S], b: Sequence[S]) -> Vector[S]:
    """Vector product."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def add(a: Sequence[S], b: Sequence[S]) -> Vector[S]:
    """Sum."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def subtract(a: Sequence[S], b: Sequence[S]) -> Vector[S]:
    """Difference a − b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def normal(ring: Ring[S], a: Sequence[S]) -> Vector[S]:
    """Each coordinate in normal form."""
    if ring.plain:
        return a[0], a[1], a[2]
    return ring.normal(a[0]), ring.normal(a[1]), ring.normal(a[2])


def rotate(rotation: Rotation[S], a: Sequence[S]) -> Vector[S]:
    """Matrix times column."""
    return dot(rotation[0], a), dot(rotation[1], a), dot(rotation[2], a)


def column(rotation: Rotation[S], index: int) -> Vector[S]:
    """A column of the matrix."""
    return rotation[0][index], rotation[1][index], rotation[2][index]


def transpose(rotation: Rotation[S]) -> Rotation[S]:
    """Inverse of a rotation."""
    return column(rotation, 0), column(rotation, 1), column(rotation, 2)


def compose(ring: Ring[S], left: Rotation[S], right: Rotation[S]) -> Rotation[S]:
    """Matrix product, in normal form."""
    columns = [normal(ring, rotate(left, column(right, i))) for i in range(3)]
    return transpose((columns[0], columns[1], columns[2]))


def unit_moments(ring: Ring[S], a: Sequence[S]) -> Rotation[S]:
    """The products a × e with the unit vectors, in normal form if ``a`` is."""
    x, y, z = a
    return (ring.zero, z, -y), (-z, ring.zero, x), (y, -x, ring.zero)


def scaled(factor: S, a: Sequence[S]) -> Vector[S]:
    """A multiple."""
    return factor * a[0], factor * a[1], factor * a[2]
