"""How many dimensions of closed postures there are around a posture.

The kernel of the loop Jacobian is only an upper bound.  Where the equations that the
rank leaves over hold at random points of the manifold that the others define, the
bound is met and the posture is regular: the bifurcation equations of Lyapunov and
Schmidt vanish.  Elsewhere the dimension is counted from the spread of closed postures
near by, at two scales that must agree.

References: [Mueller2016], [GolubitskySchaeffer1985] §I.3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import Stance
from screwkit.finite.loop_split import CUT, Split, reduced, refined
from screwkit.finite.projection import Projected, projected, projected_at_rank
from screwkit.finite.spanning_forest import Forest

EXACT_CUT = (1e-11, 1e-7)
"""At a file's posture, which is exact: zero below, not zero above, unclear between."""

SCALES = ((3e-3, 1e-3), (2e-2, 8e-3))
"""Pairs of distances at which neighbours are looked for; the second where the first
does not agree, because closing is slow where equations repeat themselves."""

TANGENT = 3e-3
"""How far neighbours are that tell a tangent space."""

DOUBT = 3e-7
"""Largest relative singular value that rounding makes of zero: x² = 0 within 1e-15
leaves x and the slope at 3e-8, roots of higher order less."""

EARLY = 0.7
"""Part of the longest image that one must have to come first; far from what symmetric
mechanisms make equal."""

SPREAD = 0.08
"""Part of the distance that neighbours must spread for a dimension to count."""


@dataclass(frozen=True, eq=False)
class Kernel:
    """Rank and kernel of J_c at one posture.

    Attributes:
        split: The equations parted at that rank, a batch of one.
        basis: Orthonormal, shape (freedoms, dimension).
        dropped: The largest singular value that was taken for zero, relative to what
            they are compared with.
    """

    split: Split
    basis: Array
    dropped: float = 0.0

    @property
    def rank(self) -> int:
        """Of J_c."""
        return self.split.rank

    @property
    def dimension(self) -> int:
        """Of the kernel: the instantaneous mobility."""
        return int(self.basis.shape[1])

    def anywhere(self, count: int, random: np.random.Generator) -> Array:
        """Random vectors of the kernel, shape (count, freedoms).

        The same ones in whatever basis: rounding alone turns those of singular vectors.
        """
        vectors = random.standard_normal((count, len(self.basis)))
        return np.asarray(vectors @ self.basis @ self.basis.T)

    @property
    def is_clear(self) -> bool:
        """Whether no singular value lies between zero and what counts."""
        return self.dropped <= DOUBT


def kernels(
    forest: Forest, stance: Stance, split: Split, cut: float = CUT
) -> tuple[Kernel, ...]:
    """The kernel at every posture of a stance.

    Args:
        forest: Of the mechanism.
        stance: Closed postures.
        split: At a rank that all of them have, or more.
        cut: Relative size of singular values that count as zero.
    """
    parts = reduced(forest, stance, split)
    found = []
    for number in range(len(stance)):
        own, dropped = refined(parts, number, cut)
        here = stance.take(np.array([number]))
        found.append(Kernel(own, reduced(forest, here, own).tangents[0], dropped))
    return tuple(found)


def steady(basis: Array) -> Array:
    """A basis of the same space that does not depend on the one given.

    Images of the unit vectors under the projection, in their order where they are not
    much shorter than the longest, made orthonormal.

    Args:
        basis: Orthonormal columns, shape (freedoms, dimension).
    """
    images, found = basis @ basis.T, np.zeros_like(basis)
    for column in range(basis.shape[1]):
        sizes = np.linalg.norm(images, axis=0)
        first = int(np.argmax(sizes > EARLY * sizes.max()))
        found[:, column] = images[:, first] / sizes[first]
        own = found[:, [column]]
        images = images - own @ (own.T @ images)
    return found


def unclear_rank(values: Array) -> str:
    """Why the rank of an exact posture is not clear in floating point; else empty."""
    if not len(values) or values[0] == 0:
        return ""
    low, high = EXACT_CUT
    between = [v for v in values / values[0] if low < v < high]
    if not between:
        return ""
    return (
        f"a singular value of the loop equations is {between[0]:.1e} of the largest: "
        f"neither zero nor not, as with rounded numbers in a file"
    )


def around(
    forest: Forest,
    stance: Stance,
    kernel: Kernel,
    distances: Array,
    random: np.random.Generator,
) -> Projected:
    """Neighbours of one posture on the manifold of its own rank.

    Args:
        forest: Of the mechanism.
        stance: One posture.
        kernel: Of that posture.
        distances: How far each neighbour is, shape (neighbours,).
        random: Chooses the directions.

    Returns:
        The neighbours; all of them are closed if and only if the posture is regular,
        unless a step went too far.
    """
    count = len(distances)
    steps = distances[:, None] * unit_rows(kernel.anywhere(count, random))
    same = np.zeros(count, dtype=np.intp)
    return projected_at_rank(forest, stance.take(same), steps, kernel.split.take(same))


def is_regular(
    forest: Forest, stance: Stance, kernel: Kernel, random: np.random.Generator
) -> bool:
    """Whether closed postures fill all dimensions of the kernel at a posture."""
    return regular_neighbours(forest, stance, kernel, random) is not None


def regular_neighbours(
    forest: Forest, stance: Stance, kernel: Kernel, random: np.random.Generator
) -> Stance | None:
    """Neighbours of a posture, if closed ones fill all dimensions of its kernel.

    Returns:
        Postures on the one branch through this one, itself where nothing moves; None
        where it is not regular.
    """
    if not kernel.dimension:
        return stance
    near = around(forest, stance, kernel, np.array([0.03, 0.03, 0.01]), random)
    return near.stance if near.closed.all() else None


def singular_dimension(
    forest: Forest, stance: Stance, kernel: Kernel, random: np.random.Generator
) -> int | None:
    """The dimension around a posture that is not regular.

    Returns:
        None where the scales do not agree, or see the whole kernel: then branches meet
        here and their dimensions add up.
    """
    for pair in SCALES:
        first, second = (spread(forest, stance, kernel, h, random) for h in pair)
        if first is not None and first == second and first < kernel.dimension:
            return first
    return None


def tangents_of(
    forest: Forest,
    stance: Stance,
    kernel: Kernel,
    dimension: int,
    random: np.random.Generator,
) -> Array | None:
    """The tangent space of the closed postures around one where rank does not tell it.

    From the spread of neighbours, and then from closed postures forth and back along
    each of its directions.

    Returns:
        Orthonormal, shape (freedoms, dimension); None where neighbours do not close.
    """
    near = _neighbours(forest, stance, kernel, TANGENT, random)
    closed = near.travelled[near.closed]
    if len(closed) < dimension:
        return None
    rough = np.linalg.svd(closed, full_matrices=False)[2][:dimension]
    steps = TANGENT * np.concatenate([rough, -rough])
    same = np.zeros(len(steps), dtype=np.intp)
    found = projected(forest, stance.take(same), steps, kernel.split.take(same))
    if not found.closed.all():
        return None
    forth, back = found.travelled[:dimension], found.travelled[dimension:]
    left, sizes, _ = np.linalg.svd(((forth - back) / (2 * TANGENT)).T)
    if sizes[-1] < 0.5:
        return None
    return np.asarray(left[:, :dimension])


def spread(
    forest: Forest,
    stance: Stance,
    kernel: Kernel,
    distance: float,
    random: np.random.Generator,
) -> int | None:
    """In how many dimensions closed neighbours at a distance spread out.

    By the principal components of 2m + 8 neighbours, m the dimension of the kernel.

    Returns:
        None where too few neighbours could be closed.
    """
    found = _neighbours(forest, stance, kernel, distance, random)
    if found.closed.sum() <= kernel.dimension + 2:
        return None
    offsets = found.travelled[found.closed] / distance
    values = np.linalg.svd(offsets, compute_uv=False) / np.sqrt(len(offsets))
    return int((values > SPREAD).sum())


def _neighbours(
    forest: Forest,
    stance: Stance,
    kernel: Kernel,
    distance: float,
    random: np.random.Generator,
) -> Projected:
    """2m + 8 postures around one, m the dimension of its kernel."""
    count = 2 * kernel.dimension + 8
    inside = kernel.anywhere(count, random)
    steps = unit_rows(inside) + 0.1 * unit_rows(random.standard_normal(inside.shape))
    same = np.zeros(count, dtype=np.intp)
    split = kernel.split.take(same)
    return projected(forest, stance.take(same), distance * steps, split)


def unit_rows(vectors: Array) -> Array:
    """Every row divided by its length."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))
