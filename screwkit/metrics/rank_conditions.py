"""Where ranks fall, as smooth equations: limbs, loops, and loops with locked joints.

A matrix is bordered with the singular vectors that its rank leaves out, and one pair
more.  Where the bordered matrix can be inverted, the block of the inverse that faces
the border vanishes exactly where the rank has fallen.

References: [Govaerts2000] ch. 3 (bordered matrices), [LongCaroKhalil2012] §5.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.spanning_forest import Forest
from screwkit.metrics.nearest_point import Batched
from screwkit.metrics.spans import split


@dataclass(frozen=True, eq=False)
class ScrewField:
    """The screws of all freedoms at points, and the loops they close.

    Attributes:
        labels: The freedoms, in the order of the forest.
        screws: Of points of shape (batch, n): shape (batch, freedoms, 6), lengths over
            the characteristic one.
        forest: Of the mechanism.
    """

    labels: tuple[str, ...]
    screws: Batched
    forest: Forest

    def of_limb(self, labels: Sequence[str]) -> Batched:
        """Twists of a limb, shape (batch, 6, freedoms)."""
        chosen = [self.labels.index(label) for label in labels]
        return lambda points: np.swapaxes(self.screws(points)[:, chosen], -1, -2)

    def of_loops(self, locked: Collection[str] = ()) -> Batched:
        """J_c without the columns of locked freedoms."""
        kept = [i for i, label in enumerate(self.labels) if label not in locked]
        signs = self.forest.loop_signs[:, kept]

        def matrix(points: Array) -> Array:
            screws = self.screws(points)[:, kept]
            columns = screws[:, None] * signs[..., None]
            batch, loops, freedoms, _ = columns.shape
            turned = np.swapaxes(columns, -1, -2)
            return np.asarray(turned.reshape(batch, 6 * loops, freedoms))

        return matrix


def rank_at(matrix: Batched, points: Sequence[Array]) -> int:
    """The largest rank among points: the rank in general."""
    matrices = matrix(np.array(points))
    exist = np.isfinite(matrices).all(axis=(1, 2))
    return max((split(one).rank for one in matrices[exist]), default=0)


def fallen(matrix: Batched, rank: int, start: Array) -> Batched:
    """What vanishes where the rank is less, written with borders from a start.

    Args:
        matrix: Of points, shape (batch, rows, columns).
        rank: In general; 1 or more.
        start: Where the borders come from, shape (n,).

    Returns:
        From points to (rows − rank + 1)·(columns − rank + 1) numbers, nan where the
        border does not fit.
    """
    here = matrix(start[None])[0]
    if not np.isfinite(here).all():
        return lambda points: np.full((len(points), 1), np.nan)
    left, _, right = np.linalg.svd(here)
    outside, over = left[:, rank - 1 :], right[rank - 1 :]
    rows, columns = len(left), len(right)
    size = rows + over.shape[0]
    whole = np.zeros((size, size))
    whole[:rows, columns:] = outside
    whole[rows:, :columns] = over
    facing = np.zeros((size, over.shape[0]))
    facing[rows:] = np.eye(over.shape[0])

    def equations(points: Array) -> Array:
        batch = len(points)
        bordered = np.broadcast_to(whole, (batch, size, size)).copy()
        bordered[:, :rows, :columns] = matrix(points)
        exist = np.isfinite(bordered).all(axis=(1, 2))
        bordered[~exist] = np.eye(size)
        try:
            found = np.linalg.solve(bordered, facing)[:, columns:]
        except np.linalg.LinAlgError:
            return np.full((batch, outside.shape[1] * over.shape[0]), np.nan)
        found[~exist] = np.nan
        return np.asarray(found.reshape(batch, -1))

    return equations
