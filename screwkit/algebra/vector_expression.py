"""Vectors of expressions: sums, multiples and products, coordinate by coordinate.

Files name points and vectors and combine them (``B1 - A1``, ``cross(u, w)``); the
answer is again three expressions in normal form, so that nothing behind the reader
needs to know about names of vectors.
"""

from __future__ import annotations

from typing import TypeAlias

from screwkit.algebra.expression import ZERO, Expression
from screwkit.algebra.expression_building import add, multiply, negate, subtract

VectorExpression: TypeAlias = tuple[Expression, Expression, Expression]

ZERO_VECTOR: VectorExpression = (ZERO, ZERO, ZERO)


def add_vectors(*vectors: VectorExpression) -> VectorExpression:
    """The sum of ``vectors``."""
    return (
        add(*(vector[0] for vector in vectors)),
        add(*(vector[1] for vector in vectors)),
        add(*(vector[2] for vector in vectors)),
    )


def scale_vector(factor: Expression, vector: VectorExpression) -> VectorExpression:
    """``factor * vector``."""
    x, y, z = vector
    return multiply(factor, x), multiply(factor, y), multiply(factor, z)


def negate_vector(vector: VectorExpression) -> VectorExpression:
    """``-vector``."""
    x, y, z = vector
    return negate(x), negate(y), negate(z)


def cross(left: VectorExpression, right: VectorExpression) -> VectorExpression:
    """The vector product ``left × right``."""
    a, b, c = left
    x, y, z = right
    return (
        subtract(multiply(b, z), multiply(c, y)),
        subtract(multiply(c, x), multiply(a, z)),
        subtract(multiply(a, y), multiply(b, x)),
    )


def dot(left: VectorExpression, right: VectorExpression) -> Expression:
    """The scalar product ``left · right``."""
    return add(*(multiply(a, b) for a, b in zip(left, right, strict=True)))
