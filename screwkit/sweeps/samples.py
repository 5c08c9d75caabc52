"""Low-discrepancy samples of ranges: points that fill a box evenly, always the same.

References: [Sobol1967].
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.sweeps.grid import Axis


@dataclass(frozen=True)
class Samples:
    """Sobol points of the box of some ranges.

    Attributes:
        axes: Ranges; their counts mean nothing.
        size: How many points.
    """

    axes: tuple[Axis, ...]
    size: int

    @property
    def shape(self) -> tuple[int, ...]:
        """One axis of points."""
        return (self.size,)

    @cached_property
    def _unit(self) -> Array:
        from scipy.stats import qmc  # noqa: PLC0415 -- costly to load

        power = max(self.size - 1, 1).bit_length()
        points = qmc.Sobol(len(self.axes), scramble=False).random_base2(power)
        return np.asarray(points[: self.size])

    def __getstate__(self) -> dict[str, object]:
        """Without the points, which are drawn again where they are needed."""
        return {"axes": self.axes, "size": self.size}

    def points(self, start: int, stop: int) -> dict[str, Array]:
        """Values by name at some of the points."""
        part = self._unit[start:stop]
        return {
            axis.name: axis.start + (axis.stop - axis.start) * part[:, k]
            for k, axis in enumerate(self.axes)
        }
