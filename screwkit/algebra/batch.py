"""numpy arrays as a ring: any number of postures at once.

Every symbol is an array over the same batch; adding and multiplying broadcasts.  The
same kinematics that derives a condition here evaluates it a million times.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Final

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.expression import Expression
from screwkit.algebra.floats import half_turns
from screwkit.algebra.ring import Known
from screwkit.errors import UnknownNameError

Array = NDArray[np.float64]


class BatchRing:
    """Floats of one posture or of many.

    Attributes:
        values: An array for every symbol, all of one broadcastable shape.
        plain: See `Ring`.
        known: See `Ring`.
    """

    plain: Final = True

    def __init__(self, values: Mapping[str, Array | float]) -> None:
        self.values = {name: np.asarray(v, dtype=float) for name, v in values.items()}
        self._pairs: dict[str, tuple[Array, Array]] = {}
        # Those of many postures would fill the memory.
        single = all(not value.ndim for value in self.values.values())
        self.known: Known[Array] | None = {} if single else None

    @property
    def zero(self) -> Array:
        """0."""
        return np.asarray(0.0)

    @property
    def one(self) -> Array:
        """1."""
        return np.asarray(1.0)

    def rational(self, value: Fraction) -> Array:
        """The nearest float."""
        return np.asarray(float(value))

    def symbol(self, name: str) -> Array:
        """The values given for a symbol.

        Raises:
            UnknownNameError: If none were given.
        """
        if name == "pi":
            return np.asarray(math.pi)
        if name not in self.values:
            raise UnknownNameError(f"no value for {name!r}")
        return self.values[name]

    def cosine_sine(self, angle: str) -> tuple[Array, Array]:
        """Numpy's cos and sin, computed once per angle."""
        if angle not in self._pairs:
            value = self.symbol(angle)
            self._pairs[angle] = (np.cos(value), np.sin(value))
        return self._pairs[angle]

    def half_turns(self, count: Fraction) -> tuple[Array, Array]:
        """Exact at multiples of π/2, so that orthogonal axes stay orthogonal."""
        cosine, sine = half_turns(count)
        return np.asarray(cosine), np.asarray(sine)

    def radians(self, value: Fraction) -> tuple[Array, Array]:
        """Cos and sin of a constant."""
        return np.cos(np.asarray(float(value))), np.sin(np.asarray(float(value)))

    def square_root(self, radicand: Expression, value: Array) -> Array:
        """Numpy's square root; nan where the radicand is negative."""
        with np.errstate(invalid="ignore"):
            return np.asarray(np.sqrt(value))

    def inverse(self, divisor: Expression, value: Array) -> Array:
        """1/value; inf where it vanishes."""
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / value)

    def normal(self, value: Array) -> Array:
        """Floats have no normal form."""
        return value

    def is_zero(self, value: Array) -> bool:
        """Whether every entry is exactly 0: structural zeros only, no tolerance."""
        return bool(np.all(value == 0.0) if np.ndim(value) else value == 0.0)
