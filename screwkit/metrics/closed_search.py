"""Real solutions of equations in joint variables, looked for by Newton's steps.

Closing equations are more than their unknowns and depend on each other, so the steps
are those of least squares; all starts go side by side.  What is found is a posture to
look at, no proof.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression

STARTS = 200
"""Random postures from which steps lead."""

_STEPS = 60
_LONGEST = 0.5  # of one step; angles are radians
_SHIFT = 1e-7  # of a variable, for differences
_CLOSED = 1e-10  # of the residual, against what equations are at random postures
_BACK = 1e-6  # of singular values that no step inverts, against the largest


def numbers_of(values: Mapping[str, Expression]) -> dict[str, float]:
    """Constant expressions as floats."""
    ring = BatchRing({})
    return {name: float(evaluate(x, ring)) for name, x in values.items()}


def real_solution(
    equations: Sequence[Expression],
    unknowns: Mapping[str, float],
    given: Mapping[str, float],
) -> dict[str, float] | None:
    """Values at which equations vanish; None where no start led to any.

    Args:
        equations: Of which all have to vanish.
        unknowns: What may vary, and how far from 0 starts are drawn: pi for angles.
        given: Values of all other symbols.

    Returns:
        Angles are taken to (-pi, pi] by whoever knows which are angles.
    """
    names = tuple(unknowns)
    reach = np.array([unknowns[name] for name in names])
    source = np.random.default_rng(1)
    at = source.uniform(-1, 1, (STARTS, len(names))) * reach

    def residuals(x: Array) -> Array:
        ring = BatchRing({**given, **dict(zip(names, x.T, strict=True))})
        values = [np.broadcast_to(evaluate(e, ring), len(x)) for e in equations]
        return np.stack(values, axis=-1)

    scale = np.median(np.abs(residuals(at)), axis=0)
    scale[scale == 0] = 1.0
    for _ in range(_STEPS):
        here = residuals(at) / scale
        slopes = np.stack(
            [
                (residuals(at + _SHIFT * row) / scale - here) / _SHIFT
                for row in np.eye(len(names))
            ],
            axis=-1,
        )
        back = np.linalg.pinv(slopes, rcond=_BACK)
        step = -(back @ here[..., None])[..., 0]
        length = np.linalg.norm(step, axis=-1, keepdims=True)
        at = at + step * np.minimum(1, _LONGEST / np.maximum(length, 1e-300))
    miss = np.max(np.abs(residuals(at) / scale), axis=-1)
    best = int(np.argmin(np.where(np.isfinite(miss), miss, np.inf)))
    if not miss[best] < _CLOSED:
        return None
    return {name: float(x) for name, x in zip(names, at[best], strict=True)}
