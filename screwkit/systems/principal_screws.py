"""Principal screws of a system: the screws of extreme pitch, at right angles.

Pure moments come first.  Directions normal to all of them have a definite pitch, a
quadratic form in the direction whose eigenvectors carry the principal screws; along the
others any pitch occurs, and the screws of pitch zero are taken.  The result spans the
system and depends on neither the basis nor, but for screws that pure moments can shift,
the frame.

References: [Ball1900], [Hunt1978], ch. 12.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isinf
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from screwkit.conventions import DIRECTION, MOMENT, SCREW_DIMENSION

Array: TypeAlias = npt.NDArray[np.float64]
Point: TypeAlias = tuple[float, float, float]

NEGLIGIBLE = 1e-9  # of unit vectors, after lengths are scaled to the system's own


@dataclass(frozen=True)
class ExactScrew:
    """A screw in the grammar; the direction is no unit vector.

    Attributes:
        point: None for a pure moment, as is the pitch.
    """

    direction: tuple[str, ...]
    point: tuple[str, ...] | None = None
    pitch: str | None = None


@dataclass(frozen=True)
class PrincipalScrew:
    """One of the mutually perpendicular screws that span a system.

    Attributes:
        direction: Unit vector, its first entry that is not zero positive.
        point: The point of the axis that is nearest to the origin; None for a pure
            moment (a translation; a couple).
        pitch: Length for each radian; infinite for a pure moment.
        exact: The same in the grammar, where it is known.
    """

    direction: Point
    point: Point | None
    pitch: float
    exact: ExactScrew | None = None

    @property
    def coordinates(self) -> tuple[float, ...]:
        """The screw as (direction; moment)."""
        direction = np.array(self.direction)
        if self.point is None or isinf(self.pitch):
            return 0.0, 0.0, 0.0, *self.direction
        moment = np.cross(self.point, direction) + self.pitch * direction
        return *self.direction, *map(float, moment)


def principal_screws(
    screws: Sequence[Sequence[float]] | Array,
) -> tuple[PrincipalScrew, ...]:
    """The principal screws of the system that these span, as many as its dimension.

    First those of definite pitch, ascending; then those that pure moments make free,
    with pitch 0; then the pure moments.  Where pitches are equal, or nothing else
    singles directions out, those nearest to the coordinate axes are taken.

    Args:
        screws: Rows (direction; moment), any number; dependent ones do not matter.

    Raises:
        ValueError: If a row has not six finite entries.
    """
    rows = np.asarray(screws, dtype=float).reshape(-1, SCREW_DIMENSION)
    if not np.isfinite(rows).all():
        raise ValueError("a screw has six finite coordinates")
    length = float(np.abs(rows[:, MOMENT]).max(initial=0.0)) or 1.0
    turning, moments = _split(rows / np.repeat([1.0, length], 3))
    found = [
        *_settled(turning, moments),
        *(np.concatenate([np.zeros(3), u]) for u in _axes(moments)),
    ]
    return tuple(_screw(row * np.repeat([1.0, length], 3)) for row in found)


def _split(rows: Array) -> tuple[Array, Array]:
    """Screws with orthonormal directions, normal to the orthonormal pure moments."""
    _, sizes, basis = np.linalg.svd(rows, full_matrices=False)
    basis = basis[sizes > NEGLIGIBLE * sizes.max(initial=0.0)]
    if not len(basis):
        return np.zeros((0, 6)), np.zeros((0, 3))
    weights, sizes, _ = np.linalg.svd(basis[:, DIRECTION])
    count = int((sizes > NEGLIGIBLE).sum())
    mixed = weights.T @ basis
    moments = np.linalg.qr(mixed[count:, MOMENT].T)[0].T
    turning = mixed[:count] / sizes[:count, None]
    turning[:, MOMENT] -= turning[:, MOMENT] @ moments.T @ moments
    return turning, moments


def _settled(turning: Array, moments: Array) -> list[Array]:
    """Principal screws with a direction, those of definite pitch first."""
    left, sizes, right = np.linalg.svd(moments @ turning[:, DIRECTION].T)
    rank = int((sizes > NEGLIGIBLE).sum())
    free, pitched = right[:rank] @ turning, right[rank:] @ turning
    shifts = (left.T @ moments)[:rank] / sizes[:rank, None]
    pitched[:, MOMENT] -= _products(pitched, free) @ shifts
    free[:, MOMENT] -= _products(free, free) / 2 @ shifts
    settled = []
    if len(pitched):
        pitches, vectors = np.linalg.eigh(_products(pitched, pitched) / 2)
        scale = max(1.0, float(np.abs(pitches).max()))
        steps = np.flatnonzero(np.diff(pitches) > NEGLIGIBLE * scale) + 1
        for equal in np.split(vectors.T, steps):
            settled += _along_axes(equal @ pitched)
    return settled + _along_axes(free)


def _products(left: Array, right: Array) -> Array:
    """Reciprocal products of rows."""
    swapped = np.roll(right, SCREW_DIMENSION // 2, axis=1)
    return np.asarray(left @ swapped.T)


def _along_axes(screws: Array) -> list[Array]:
    """The same space of screws by orthonormal directions near the coordinate axes."""
    directions = screws[:, DIRECTION]
    return [axis @ directions.T @ screws for axis in _axes(directions)]


def _axes(vectors: Array) -> list[Array]:
    """Orthonormal basis of the span of orthonormal rows, which the span determines."""
    projector, axes = vectors.T @ vectors, []
    for _ in vectors:
        sizes = np.round(projector.diagonal(), 6)
        axis = projector[int(sizes.argmax())]
        axis = axis / np.linalg.norm(axis)
        axes.append(axis)
        projector = projector - np.outer(axis, axis)
    return axes


def _screw(row: Array) -> PrincipalScrew:
    turns = np.abs(row[DIRECTION]).max() > NEGLIGIBLE
    part = row[DIRECTION] if turns else row[MOMENT]
    size = float(np.linalg.norm(part))
    first = part[np.flatnonzero(np.abs(part) > NEGLIGIBLE * size)[0]]
    row = row / (size if first > 0 else -size)
    if not turns:
        return PrincipalScrew(_triple(row[MOMENT]), None, inf)
    direction, moment = row[DIRECTION], row[MOMENT]
    point = np.cross(direction, moment)
    return PrincipalScrew(_triple(direction), _triple(point), float(direction @ moment))


def _triple(values: Array) -> Point:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z
