"""Where ranks fall, as smooth equations: limbs, loops, and loops with locked joints.

A matrix is bordered with the singular vectors that its rank leaves out, and one pair
more, as they are at a point nearby.  Where the bordered matrix can be inverted, the
block of the inverse that faces the border vanishes exactly where the rank has fallen.

References: [Govaerts2000] ch. 3 (bordered matrices), [LongCaroKhalil2012] §5.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.spanning_forest import Forest, Indices
from screwkit.metrics.smooth import Batched, Smooth, slopes
from screwkit.metrics.spans import split

NEARLY = 1e-4
"""Singular values below this part of the largest, or of 1, vanish together."""


class Matrices(Protocol):
    """Matrices at points, and how fast they change between two vectors."""

    def values(self, points: Array) -> Array:
        """From shape (batch, n) to (batch, rows, columns)."""
        ...

    def rates(self, points: Array, left: Array, right: Array) -> Array:
        """The slopes of Lᵀ M R for fixed L and R at every point.

        Args:
            points: Shape (batch, n).
            left: L, shape (batch, rows, a).
            right: R, shape (batch, columns, b).

        Returns:
            Shape (batch, a, b, n).
        """
        ...


class Screws(Protocol):
    """The screws of all freedoms at points, and how fast they change."""

    def values(self, points: Array) -> Array:
        """From shape (batch, n) to (batch, freedoms, 6), lengths over one length."""
        ...

    def rates(self, points: Array, forms: Array) -> Array:
        """The slopes of Σ φ_j(s_j) for fixed linear forms φ_j.

        Args:
            points: Shape (batch, n).
            forms: Shape (batch, count, freedoms, 6).

        Returns:
            Shape (batch, count, n).
        """
        ...


@dataclass(frozen=True, eq=False)
class DifferencedScrews:
    """Screws whose derivative is not known."""

    values: Batched

    def rates(self, points: Array, forms: Array) -> Array:
        """By central differences; see `Screws`."""
        return np.asarray(
            np.einsum("bcfx,bfxn->bcn", forms, slopes(self.values, points))
        )


@dataclass(frozen=True, eq=False)
class ScrewMatrices:
    """Screws as columns, one block of six rows below the other.

    Attributes:
        screws: Of all freedoms.
        signs: With which factor each freedom stands in each block, shape
            (blocks, freedoms).
        kept: Which freedoms are columns.
    """

    screws: Screws
    signs: Array
    kept: tuple[int, ...]

    def values(self, points: Array) -> Array:
        """Shape (batch, 6·blocks, columns)."""
        screws = self.screws.values(points)[:, self.kept]
        columns = screws[:, None] * self.signs[:, self.kept, None]
        batch, blocks, freedoms, _ = columns.shape
        return np.swapaxes(columns, -1, -2).reshape(batch, 6 * blocks, freedoms)

    def rates(self, points: Array, left: Array, right: Array) -> Array:
        """See `Matrices`."""
        batch, _, a = left.shape
        blocks, freedoms = self.signs.shape
        b = right.shape[2]
        whole = np.zeros((batch, freedoms, b))
        whole[:, self.kept] = right
        rows = left.reshape(batch, blocks, 6, a)
        facing = np.einsum("kf,bkxa->bafx", self.signs, rows)
        forms = facing[:, :, None] * np.moveaxis(whole, 2, 1)[:, None, :, :, None]
        found = self.screws.rates(points, forms.reshape(batch, a * b, freedoms, 6))
        return found.reshape(batch, a, b, -1)


@dataclass(frozen=True, eq=False)
class ScrewField:
    """The screws of all freedoms at points, and the loops they close.

    Attributes:
        labels: The freedoms, in the order of the forest.
        screws: Of all freedoms.
        forest: Of the mechanism.
    """

    labels: tuple[str, ...]
    screws: Screws
    forest: Forest

    def of_limb(self, labels: Sequence[str]) -> ScrewMatrices:
        """Twists of a limb, shape (batch, 6, freedoms)."""
        chosen = tuple(self.labels.index(label) for label in labels)
        return ScrewMatrices(self.screws, np.ones((1, len(self.labels))), chosen)

    def of_loops(self, locked: Collection[str] = ()) -> ScrewMatrices:
        """J_c without the columns of locked freedoms."""
        kept = tuple(i for i, x in enumerate(self.labels) if x not in locked)
        return ScrewMatrices(self.screws, self.forest.loop_signs, kept)


def rank_at(matrices: Matrices, points: Array) -> int:
    """The largest rank among points: the rank in general."""
    found = matrices.values(points)
    exist = np.isfinite(found).all(axis=(1, 2))
    return max((split(one).rank for one in found[exist]), default=0)


@dataclass(frozen=True, eq=False)
class FallenRank:
    """What vanishes where the rank of a matrix is less than in general.

    Attributes:
        matrices: At points.
        rank: In general; 1 or more.
    """

    matrices: Matrices
    rank: int

    def around(self, centres: Array, copies: int = 1) -> Smooth:
        """The facing blocks, bordered as at the centres.

        Where several singular values nearly vanish at a centre, the rank falls by as
        many at once, and so many more pairs of vectors border the matrix.  A block is
        nan where the border does not fit.
        """
        here = self.matrices.values(centres)
        known = np.asarray(np.isfinite(here).all(axis=(1, 2)))
        left, sizes, right = np.linalg.svd(np.where(known[:, None, None], here, 0.0))
        right = np.swapaxes(right, 1, 2)
        small = sizes[:, : self.rank] < NEARLY * np.maximum(1.0, sizes[:, :1])
        less = np.clip(small.sum(axis=1), 1, self.rank)
        less[~known] = 1
        groups = []
        for count in np.unique(less):
            rows = np.flatnonzero(less == count)
            kept = self.rank - int(count)
            border = _Border(
                *(
                    np.repeat(vectors[rows][:, :, kept:], copies, axis=0)
                    for vectors in (left, right)
                )
            )
            own = (copies * rows[:, None] + np.arange(copies)).reshape(-1)
            groups.append((own, border))
        both = partial(self._both, groups)
        return Smooth(lambda points: both(points, slopes=False)[0], both)

    def _both(
        self,
        groups: Sequence[tuple[Indices, _Border]],
        points: Array,
        *,
        slopes: bool = True,
    ) -> tuple[Array, Array]:
        """Blocks of all groups side by side, padded by equations that always hold."""
        batch, n = points.shape
        width = max((border.size for _, border in groups), default=0)
        values = np.zeros((batch, width))
        rates = np.zeros((batch, width if slopes else 0, n))
        for own, border in groups:
            chosen = points if len(own) == batch else points[own]
            facing, right, left = border.solved(self.matrices.values(chosen))
            values[own, : border.size] = facing
            if slopes:
                change = self.matrices.rates(chosen, left, right)
                rates[own, : border.size] = -change.reshape(len(own), -1, n)
        return values, rates


@dataclass(frozen=True, eq=False)
class _Border:
    """Columns and rows beside matrices.

    Attributes:
        outside: Shape (batch, rows, a).
        over: Shape (batch, columns, b).
    """

    outside: Array
    over: Array

    @property
    def size(self) -> int:
        """Of the facing block: a·b."""
        return int(self.outside.shape[2] * self.over.shape[2])

    def solved(self, matrices: Array) -> tuple[Array, Array, Array]:
        """The facing block, and the solutions to its right and to its left.

        Returns:
            Shapes (batch, a·b), (batch, columns, b) and (batch, rows, a).
        """
        batch, rows, columns = matrices.shape
        a, b = self.outside.shape[2], self.over.shape[2]
        whole = np.zeros((batch, rows + b, columns + a))
        whole[:, :rows, :columns] = matrices
        whole[:, :rows, columns:] = self.outside
        whole[:, rows:, :columns] = np.swapaxes(self.over, 1, 2)
        exist = np.isfinite(matrices).all(axis=(1, 2))
        whole[~exist] = np.eye(rows + b)
        exist &= np.linalg.slogdet(whole)[0] != 0
        whole[~exist] = np.eye(rows + b)
        inverse = np.linalg.inv(whole)
        inverse[~exist] = np.nan
        facing = inverse[:, columns:, rows:]
        left = np.swapaxes(inverse[:, columns:, :rows], 1, 2)
        return facing.reshape(batch, -1), inverse[:, :columns, rows:], left
