"""One number for a posture: what an index is condensed to.

An index has several stationary values; a map needs one number.  ``misfit`` is the cost
by which [BicchiPrattichizzo] compare designs, (λ_max − 1)² + (λ_min − 1)².

References: [BicchiPrattichizzo] §V-B, [Yoshikawa1985] (product), [SalisburyCraig1982]
(condition).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array

Measure = Callable[[Array], Array]


def _condition(values: Array) -> Array:
    """The largest semi-axis over the smallest."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.sqrt(values[..., 0] / values[..., -1])
    return np.asarray(np.where(np.isinf(values[..., 0]), np.inf, ratio))


def _product(values: Array) -> Array:
    """The product of the semi-axes: a volume."""
    return np.asarray(np.sqrt(np.prod(values, axis=-1)))


def _misfit(values: Array) -> Array:
    return np.asarray((values[..., 0] - 1.0) ** 2 + (values[..., -1] - 1.0) ** 2)


MEASURES: Final[Mapping[str, Measure]] = {
    "min": lambda values: np.asarray(values[..., -1]),
    "max": lambda values: np.asarray(values[..., 0]),
    "condition": _condition,
    "product": _product,
    "misfit": _misfit,
}
"""From the values of an index, descending along the last axis, to one number."""
