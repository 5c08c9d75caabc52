"""Functions of many points at once with their derivatives.

Where no derivative is known it is a central difference; then the points of all
differences are evaluated together, so that a batch costs little more than one point.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeAlias, TypeVar

import numpy as np

from screwkit.algebra.batch import Array

Batched: TypeAlias = Callable[[Array], Array]
"""From points, shape (batch, n), to values, shape (batch, k)."""

NUDGE = 1e-6
"""Step of a difference; angles and lengths over the characteristic one are near 1."""

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Smooth:
    """A function and its derivative.

    Attributes:
        values: Shape (batch, n) to (batch, k).
        both: The same, and the derivative of shape (batch, k, n).
    """

    values: Batched
    both: Callable[[Array], tuple[Array, Array]]

    def slopes(self, points: Array) -> Array:
        """The derivative, shape (batch, k, n)."""
        return self.both(points)[1]

    def around(self, centres: Array, copies: int = 1) -> Smooth:
        """Itself: it is written the same everywhere; see `Conditions`."""
        return self


class Conditions(Protocol):
    """Equations that may be written otherwise near every point."""

    def around(self, centres: Array, copies: int = 1) -> Smooth:
        """The equations as they are written near given points.

        Args:
            centres: Shape (batch, n).
            copies: How many points are then evaluated for each centre, one after
                another.
        """
        ...


@dataclass(frozen=True)
class Together:
    """Several conditions at once."""

    parts: tuple[Conditions, ...]

    def around(self, centres: Array, copies: int = 1) -> Smooth:
        """All of them side by side."""
        own = [part.around(centres, copies) for part in self.parts]

        def both(points: Array) -> tuple[Array, Array]:
            values, change = zip(*(f.both(points) for f in own), strict=True)
            return np.concatenate(values, axis=1), np.concatenate(change, axis=1)

        return Smooth(
            lambda points: np.concatenate([f.values(points) for f in own], axis=1), both
        )


def several(parts: Sequence[Conditions]) -> Conditions:
    """One condition, or several together."""
    return parts[0] if len(parts) == 1 else Together(tuple(parts))


def values_and_slopes(function: Batched, points: Array) -> tuple[Array, Array]:
    """Values, and derivatives by central differences, in one call.

    Args:
        function: From shape (batch, n) to any shape (batch, …).
        points: Shape (batch, n).

    Returns:
        Shapes (batch, …) and (batch, …, n).
    """
    batch, n = points.shape
    nudge = NUDGE * np.eye(n)
    ahead = (points[:, None] + nudge).reshape(-1, n)
    behind = (points[:, None] - nudge).reshape(-1, n)
    values = function(np.concatenate([points, ahead, behind]))
    forward, backward = np.split(values[batch:], 2)
    change = (forward - backward).reshape(batch, n, *values.shape[1:]) / (2 * NUDGE)
    return values[:batch], np.moveaxis(change, 1, -1)


def slopes(function: Batched, points: Array) -> Array:
    """Derivatives by central differences; see `values_and_slopes`."""
    return values_and_slopes(function, points)[1]


def by_differences(function: Batched) -> Smooth:
    """A function whose derivative is not known."""
    return Smooth(function, lambda points: values_and_slopes(function, points))


def scaled(function: Smooth, sizes: Array) -> Smooth:
    """A function with its values divided by sizes, shape (k,)."""

    def both(points: Array) -> tuple[Array, Array]:
        values, change = function.both(points)
        return values / sizes, change / sizes[:, None]

    return Smooth(lambda points: function.values(points) / sizes, both)


class Remembered(Generic[T]):
    """A costly function of points that is often asked about the same ones again."""

    def __init__(self, function: Callable[[Array], T]) -> None:
        self._function = function
        self._last: tuple[Array, T] | None = None

    def __call__(self, points: Array) -> T:
        """Its value, shape (batch, n) in."""
        if self._last is None or not np.array_equal(self._last[0], points):
            self._last = points.copy(), self._function(points)
        return self._last[1]
