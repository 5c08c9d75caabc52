"""Directions in which loops stay closed to second order: the second-order cone.

With the equations that hold their rank solved away, a direction x of the kernel leaves
the others open by a quadratic form in x.  Where these forms vanish a motion may leave
the posture; random directions meet such a cone seldom or never, so it is solved for.

References: [Mueller2016] on the kinematic tangent cone, [ConnellyWhiteley1996]; the
projections to and fro are those of [BauschkeBorwein1996].
"""

from __future__ import annotations

from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import Stance, misses
from screwkit.finite.local_dimension import Kernel, unit_rows
from screwkit.finite.projection import projected_at_rank
from screwkit.finite.spanning_forest import Forest

STEP: Final = 0.01
"""How far the forms are looked at, in coordinates."""

LARGEST: Final = 24
"""Dimension of a kernel up to which the cone is solved for."""

TRIED, ROUNDS, STEPS = 200, 100, 30
"""Random directions that are turned, how often, and the corrections of each."""

ON_CONE: Final = 1e-3
"""Largest value of the forms on the cone, where they reach 1 elsewhere."""

NOISE: Final = 1e-4
"""Relative size of a form that counts as none."""

ALIKE: Final = 0.98
"""Cosine between directions that count as one."""


def second_order_directions(
    forest: Forest,
    origin: Stance,
    kernel: Kernel,
    most: int,
    random: np.random.Generator,
) -> Array:
    """Unit vectors of the kernel on the cone, shape (up to ``most``, freedoms).

    Args:
        forest: Of the mechanism, scaled.
        origin: One closed posture.
        kernel: Of that posture.
        most: Directions wanted at most; they are as different as they come.
        random: Chooses where they are looked for.
    """
    size = kernel.dimension
    nothing = np.zeros((0, len(kernel.basis)))
    if not 1 < size <= LARGEST:
        return nothing
    forms = _independent(quadratic_forms(forest, origin, kernel))
    if not len(forms):
        return nothing
    found = _zeros(forms, _turned(forms, _starts(size, random)))
    kept: list[Array] = []
    for direction in found:
        if all(abs(float(direction @ other)) < ALIKE for other in kept):
            kept.append(direction)
        if len(kept) == most:
            break
    return np.array(kept) @ kernel.basis.T if kept else nothing


def quadratic_forms(forest: Forest, origin: Stance, kernel: Kernel) -> Array:
    """By what the loops fail to second order, shape (equations left over, m, m)."""
    size = kernel.dimension
    pairs = [(i, j) for i in range(size) for j in range(i, size)]
    inside = np.zeros((len(pairs), size))
    for number, (i, j) in enumerate(pairs):
        inside[number, [i, j]] = 1.0
    both = np.concatenate([inside, -inside])
    same = np.zeros(len(both), dtype=np.intp)
    split = kernel.split.take(same)
    steps = STEP * both @ kernel.basis.T
    near = projected_at_rank(forest, origin.take(same), steps, split).stance
    left = kernel.split.left[0, :, kernel.rank :]
    missing = misses(near) @ left
    # A step back beside each step forth: odd orders cancel.
    values = (missing[: len(pairs)] + missing[len(pairs) :]) / (2 * STEP**2)
    forms = np.zeros((values.shape[1], size, size))
    for (i, j), value in zip(pairs, values, strict=True):
        if i == j:
            forms[:, i, i] = value
    for (i, j), value in zip(pairs, values, strict=True):
        if i != j:
            mixed = 0.5 * (value - forms[:, i, i] - forms[:, j, j])
            forms[:, i, j] = forms[:, j, i] = mixed
    return forms


def _independent(forms: Array) -> Array:
    """As few forms with the same zeros, the largest of size one."""
    flat = forms.reshape(len(forms), -1)
    _, sizes, rows = np.linalg.svd(flat, full_matrices=False)
    if not len(sizes) or sizes[0] == 0:
        return forms[:0]
    kept = sizes > NOISE * sizes[0]
    scaled = (sizes / sizes[0])[:, None] * rows
    return np.asarray(scaled[kept].reshape(-1, *forms.shape[1:]))


def _starts(size: int, random: np.random.Generator) -> Array:
    """Random directions, half of them with some coordinates zero."""
    starts = random.standard_normal((TRIED, size))
    sparse = random.random((TRIED, size)) < 0.5
    sparse[::2] = True
    sparse[~sparse.any(axis=1)] = True
    return unit_rows(starts * sparse)


def _turned(forms: Array, x: Array) -> Array:
    """Directions nearer to the cone, by projections to and fro.

    A zero x of all forms is a matrix X = x xᵀ of rank one at right angles to them: X
    is moved to that space, and then to the nearest square.  From most starts this
    finds the cone, where descent ends beside it.
    """
    size = x.shape[1]
    across = np.linalg.qr(forms.reshape(len(forms), -1).T)[0]
    for _ in range(ROUNDS):
        squares = (x[:, :, None] * x[:, None, :]).reshape(len(x), -1)
        squares = squares - (squares @ across) @ across.T
        x = np.linalg.eigh(squares.reshape(-1, size, size))[1][:, :, -1]
    return np.asarray(x)


def _zeros(forms: Array, starts: Array) -> Array:
    """Unit vectors on which all forms vanish: Levenberg–Marquardt on the sphere."""
    x = starts
    damping = np.full(len(x), 1e-2)
    values = np.einsum("kij,bi,bj->bk", forms, x, x)
    size = np.linalg.norm(values, axis=1)
    for _ in range(STEPS):
        slope = 2 * np.einsum("kij,bj->bki", forms, x)
        normal = np.swapaxes(slope, 1, 2) @ slope
        normal += damping[:, None, None] * np.eye(x.shape[1])
        downhill = np.einsum("bki,bk->bi", slope, values)
        trial = unit_rows(x - np.linalg.solve(normal, downhill[..., None])[..., 0])
        after = np.einsum("kij,bi,bj->bk", forms, trial, trial)
        smaller = np.linalg.norm(after, axis=1) < size
        x = np.where(smaller[:, None], trial, x)
        values = np.where(smaller[:, None], after, values)
        size = np.linalg.norm(values, axis=1)
        damping = np.where(smaller, damping / 5, damping * 5).clip(1e-15, 1e6)
    return np.asarray(x[size < ON_CONE])
