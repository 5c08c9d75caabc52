"""Limits of coordinates, kept by a change of coordinates.

A coordinate between two limits is the middle plus half the range times a sine: every
value of the new coordinate is within, and the limits themselves are reached, so that a
nearest point at a limit is found like any other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.metrics.rank_conditions import Screws
from screwkit.metrics.smooth import Smooth

ROUNDING = 1e-9
"""By how much a coordinate may be beyond a limit that was met."""


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

    def first_outside(self, point: Array) -> int | None:
        """Which coordinate of a point is the first not within, but for rounding."""
        outside = (point < self.low - ROUNDING) | (point > self.high + ROUNDING)
        return int(np.argmax(outside)) if outside.any() else None

    def admit(self, values: Sequence[float], units: Array) -> bool:
        """Whether values of the file lie within.

        Args:
            values: In radians and file lengths.
            units: What a coordinate is multiplied with to be such a value.
        """
        return self.first_outside(np.array(values) / units) is None

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


def limits_on(
    within: Mapping[str, tuple[float, float]], names: Sequence[str], units: Array
) -> Limits:
    """Limits of coordinates.

    Args:
        within: Of some of them, in radians and file lengths.
        names: Of all.
        units: What a coordinate is multiplied with to be such a value.
    """
    limits = no_limits(len(names))
    for i, name in enumerate(names):
        if name in within:
            limits.low[i], limits.high[i] = np.array(within[name]) / units[i]
    return limits


def no_limits(count: int) -> Limits:
    """So many coordinates that may have any value."""
    return Limits(np.full(count, -np.inf), np.full(count, np.inf))
