"""Singular postures found by numbers alone, to be compared with an exact locus.

A matrix M(q) has dependent rows where n M(q) = 0 has a unit solution.  Newton steps of
least length, from random starts, solve for q and n together.  So that the large
families do not attract every start, postures on chosen families are forbidden by one
more equation, u · f = 1, with f a random combination of the family's equations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from loci.numeric import Array, Posture, value


class LastOnes:
    """What was computed at the last few points."""

    def __init__(self) -> None:
        self._known: dict[bytes, tuple[Array, list[Array]]] = {}

    def at(
        self, x: Array, computed: Callable[[Array], tuple[Array, list[Array]]]
    ) -> tuple[Array, list[Array]]:
        key = x.tobytes()
        if key not in self._known:
            if len(self._known) > 4:
                self._known.clear()
            self._known[key] = computed(x)
        return self._known[key]


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

    def there(x: Array) -> tuple[Array, list[Array]]:
        posture = {**constants, **dict(zip(variables, map(float, x), strict=True))}
        families = [np.array([value(e, posture) for e in own]) for own in avoid]
        return matrix(posture), families

    # A step's slopes move one unknown at a time; most leave the posture where it is.
    met = LastOnes()
    for _ in range(starts):
        mixes = [source.normal(size=len(family)) for family in avoid]

        def residuals(x: Array, mixes: list[Array] = mixes) -> Array:
            at, met_families = met.at(x[:count], there)
            null = x[count : count + at.shape[0]]
            shields = x[count + at.shape[0] :]
            off = [
                u * float(mix @ family) - 1
                for u, mix, family in zip(shields, mixes, met_families, strict=True)
            ]
            return np.concatenate([null @ at, [null @ null - 1], off])

        height = matrix({**constants, **dict.fromkeys(variables, 0.5)}).shape[0]
        start = np.concatenate(
            [
                source.uniform(-np.pi, np.pi, count),
                source.normal(size=height),
                source.normal(size=len(avoid)),
            ]
        )
        found = solved(residuals, start)
        if found is not None and np.all(np.abs(found[count + height :]) < 1e3):
            yield {
                **constants,
                **dict(zip(variables, map(float, found), strict=False)),
            }


def solved(
    residuals: Callable[[Array], Array], start: Array, steps: int = 40
) -> Array | None:
    """A zero near ``start`` by Newton steps of least length; None if none is met."""
    x = start
    for _ in range(steps):
        here = residuals(x)
        if np.max(np.abs(here)) < 1e-12:
            return x
        slopes = np.empty((len(here), len(x)))
        for i in range(len(x)):
            moved = x.copy()
            moved[i] += 1e-7
            slopes[:, i] = (residuals(moved) - here) / 1e-7
        step = np.linalg.lstsq(slopes, -here, rcond=1e-9)[0]
        length = float(np.linalg.norm(step))
        x = x + step * min(1.0, 1.0 / length)
    return x if np.max(np.abs(residuals(x))) < 1e-11 else None


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
        found = solved(residuals, start)
        if found is not None:
            return {**constants, **dict(zip(variables, map(float, found), strict=True))}
    raise AssertionError(f"no real posture found where {list(equations)} vanish")
