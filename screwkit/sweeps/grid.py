"""Grids: which symbols are varied, from where to where, in how many steps.

``alpha=-pi:pi:181`` takes 181 values from −π to π, both ends included.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.names import left_or_meant
from screwkit.algebra.ranges import end_of_range
from screwkit.errors import ExpressionError, UnfitValueError, UnknownNameError
from screwkit.mechanism.model import Parameter

LARGEST = 100_000_000
"""Points of a grid beyond which it is refused."""


@dataclass(frozen=True)
class Axis:
    """One symbol and its values, from ``start`` to ``stop`` in ``count`` steps."""

    name: str
    start: float
    stop: float
    count: int

    @property
    def values(self) -> Array:
        """The values, shape (count,)."""
        return np.linspace(self.start, self.stop, self.count)


@dataclass(frozen=True)
class Grid:
    """All combinations of the values of some axes; the last axis runs fastest."""

    axes: tuple[Axis, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Steps along each axis."""
        return tuple(axis.count for axis in self.axes)

    @property
    def size(self) -> int:
        """Points."""
        return int(np.prod(self.shape, dtype=np.int64)) if self.axes else 0

    def points(self, start: int, stop: int) -> dict[str, Array]:
        """Values by name at some of the points, in order."""
        places = np.unravel_index(np.arange(start, stop), self.shape)
        return {
            axis.name: axis.values[place]
            for axis, place in zip(self.axes, places, strict=True)
        }


def axis_of(text: str, known: Sequence[str], given: Collection[str] = ()) -> Axis:
    """An axis as it is written, ``name=start:stop:count``.

    Args:
        text: The range.
        known: Symbols of the mechanism.
        given: Those that had a value put in their place.

    Raises:
        UnknownNameError: If the name is no symbol of the mechanism.
        ExpressionError: If the rest is no range.
    """
    name, sign, rest = text.partition("=")
    name = name.strip()
    parts = rest.split(":")
    if not sign or len(parts) != 3:
        raise ExpressionError(f"{text!r} is no range; write NAME=START:STOP:COUNT")
    if name not in known:
        hint = left_or_meant(name, known, given)
        raise UnknownNameError(f"no symbol {name!r} to vary{hint}")
    start, stop = (end_of_range(part, text) for part in parts[:2])
    count = parts[2].strip()
    if not (count.isascii() and count.isdigit() and 0 < int(count[:12]) <= LARGEST):
        raise ExpressionError(
            f"{count!r} is no number of steps from 1 to {LARGEST}, in {text!r}"
        )
    return Axis(name, start, stop, int(count))


def refuse_unfit(
    axes: Sequence[Axis], parameters: Sequence[Parameter], *, zero: bool
) -> None:
    """Ranges hold what the file demands of a symbol, as single values do.

    Args:
        axes: The ranges.
        parameters: The symbols.
        zero: Whether zero may be the end of a range of positive numbers.

    Raises:
        UnfitValueError: If a symbol is declared positive, and its range is not.
    """
    positive = {parameter.name for parameter in parameters if parameter.positive}
    for axis in axes:
        least = min(axis.start, axis.stop)
        if axis.name in positive and (least < 0 or (least == 0 and not zero)):
            raise UnfitValueError(
                f"{axis.name!r} is declared positive, but its range has {least:g}"
            )


def grid_of(axes: Sequence[Axis]) -> Grid:
    """A grid of axes with different names.

    Raises:
        ExpressionError: If a name stands twice, or the grid is too large.
    """
    names = [axis.name for axis in axes]
    for name in names:
        if names.count(name) > 1:
            raise ExpressionError(f"{name!r} is varied twice")
    grid = Grid(tuple(axes))
    size = 1
    for axis in axes:
        size *= axis.count
    if size > LARGEST:
        raise ExpressionError(f"{size:.2g} points are more than {LARGEST:.0g}")
    return grid
