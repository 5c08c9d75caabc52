"""Singular postures found by numbers alone, to be compared with an exact locus.

A matrix M(q) has dependent columns (or rows) where M(q) n = 0 has a unit solution.
Least squares from random starts solves for q and n together.  So that the large
families do not attract every start, postures on chosen families are forbidden by one
more equation, u · f = 1, with f a random combination of the family's equations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from scipy.optimize import least_squares

from loci.numeric import Array, Posture, value


def singular_postures(
    matrix: Callable[[Posture], Array],
    variables: Sequence[str],
    constants: Posture,
    avoid: Sequence[Sequence[str]] = (),
    starts: int = 40,
    seed: int = 0,
) -> Iterator[dict[str, float]]:
    """Postures where ``matrix`` has a left null vector, off the families ``avoid``.

    Args:
        matrix: Wide or square; give the transpose to find dependent columns.
        variables: What may be changed, all as angles or lengths near one.
        constants: Values of everything else.
        avoid: Families, each by its equations.
        starts: Number of random starts.
        seed: Of the random numbers.
    """
    source = np.random.default_rng(seed)
    count = len(variables)
    for _ in range(starts):
        mixes = [source.normal(size=len(family)) for family in avoid]

        def residuals(x: Array, mixes: list[Array] = mixes) -> Array:
            posture = {**constants, **dict(zip(variables, map(float, x), strict=False))}
            at = matrix(posture)
            null = x[count : count + at.shape[0]]
            shields = x[count + at.shape[0] :]
            off = [
                u * float(mix @ np.array([value(e, posture) for e in family])) - 1
                for u, mix, family in zip(shields, mixes, avoid, strict=True)
            ]
            return np.concatenate([null @ at, [null @ null - 1], off])

        height = matrix(
            {**constants, **dict.fromkeys(variables, 0.5)}
        ).shape[0]
        start = np.concatenate(
            [
                source.uniform(-np.pi, np.pi, count),
                source.normal(size=height),
                source.normal(size=len(avoid)),
            ]
        )
        found = least_squares(residuals, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        shields = found.x[count + height :]
        if found.cost < 1e-22 and np.all(np.abs(shields) < 1e4):
            yield {
                **constants,
                **dict(zip(variables, map(float, found.x), strict=False)),
            }


def posture_on(
    equations: Sequence[str],
    variables: Sequence[str],
    constants: Posture,
    seed: int = 0,
) -> dict[str, float]:
    """A random posture at which the equations vanish.

    Raises:
        AssertionError: If none is found in 50 random starts.
    """
    source = np.random.default_rng(seed)
    for _ in range(50):

        def residuals(x: Array) -> Array:
            posture = {**constants, **dict(zip(variables, map(float, x), strict=True))}
            return np.array([value(e, posture) for e in equations])

        start = source.uniform(-np.pi, np.pi, len(variables))
        found = least_squares(residuals, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if found.cost < 1e-26:
            return {**constants, **dict(zip(variables, map(float, found.x), strict=True))}
    raise AssertionError(f"no real posture found where {list(equations)} vanish")
