"""Limits of coordinates, kept by a change of coordinates.

A coordinate between two limits is the middle plus half the range times a sine: every
value of the new coordinate is within, and the limits themselves are reached, so that a
nearest point at a limit is found like any other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.metrics.rank_conditions import Screws
from screwkit.metrics.smooth import Smooth


@dataclass(frozen=True, eq=False)
class Limits:
    """Where coordinates stay.

    Attributes:
        low: Shape (n,); −∞ where there is no limit.
        high: Shape (n,); ∞ in the same places.
    """

    low: Array
    high: Array

    @property
    def _limited(self) -> Array:
        return np.asarray(np.isfinite(self.low))

    def _middle_and_half(self) -> tuple[Array, Array]:
        low, high = (np.where(self._limited, x, 0.0) for x in (self.low, self.high))
        return (low + high) / 2, (high - low) / 2

    def within(self, points: Array) -> Array:
        """The coordinates at points of the new ones, shape (…, n)."""
        middle, half = self._middle_and_half()
        return np.where(self._limited, middle + half * np.sin(points), points)

    def rates(self, points: Array) -> Array:
        """How fast each changes with the new one, shape (…, n)."""
        _, half = self._middle_and_half()
        return np.where(self._limited, half * np.cos(points), 1.0)

    def coordinates(self, point: Array) -> Array:
        """The new coordinates of a point within, shape (n,)."""
        middle, half = self._middle_and_half()
        safe = np.where(half > 0, half, 1.0)
        sine = np.clip((point - middle) / safe, -1.0, 1.0)
        return np.where(self._limited, np.arcsin(sine), point)

    def admits(self, point: Array, slack: float = 1e-9) -> bool:
        """Whether a point lies within, but for rounding."""
        return bool(((point >= self.low - slack) & (point <= self.high + slack)).all())

    def of(self, function: Smooth) -> Smooth:
        """A function of the coordinates as one of the new ones."""
        if not self._limited.any():
            return function

        def both(points: Array) -> tuple[Array, Array]:
            values, change = function.both(self.within(points))
            return values, change * self.rates(points)[:, None]

        return Smooth(lambda points: function.values(self.within(points)), both)


@dataclass(frozen=True, eq=False)
class LimitedScrews:
    """Screws at points of the new coordinates."""

    screws: Screws
    limits: Limits

    def values(self, points: Array) -> Array:
        """See `Screws`."""
        return self.screws.values(self.limits.within(points))

    def rates(self, points: Array, forms: Array) -> Array:
        """See `Screws`."""
        inner = self.screws.rates(self.limits.within(points), forms)
        return np.asarray(inner * self.limits.rates(points)[:, None])


def no_limits(count: int) -> Limits:
    """So many coordinates that may have any value."""
    return Limits(np.full(count, -np.inf), np.full(count, np.inf))
