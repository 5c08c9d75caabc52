"""Walks along one branch of closed postures: what the platform does there.

A walk keeps to its branch: where branches meet, a step may land on another one, with
another rank, another motion type or a tangent space that has turned by a large angle,
and such a step is taken back.

References: [Mueller2016], [AllgowerGeorg2003] on predictors and correctors.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import Stance, body_jacobian, loop_jacobian
from screwkit.finite.local_dimension import Kernel
from screwkit.finite.loop_split import (
    CUT,
    Reduced,
    Split,
    reduced,
    stacked_splits,
    turned,
)
from screwkit.finite.projection import projected, projected_at_rank
from screwkit.finite.spanning_forest import Forest

STEPS = 40
STEP = 0.1
"""Largest change of a coordinate in one step of a walk."""

STRAINED = 1e3
"""How near the equations in front may come to losing rank before others are chosen."""

TURNED = 0.8
"""Smallest cosine between tangent spaces at the two ends of a step."""

VISIBLE = 1e-6
"""Relative size of a platform twist that counts."""


@dataclass(frozen=True, eq=False)
class Walk:
    """What a walk along a branch has met.

    Attributes:
        displacements: Of the platform, from the model's posture, shape (steps + 1,
            walkers, 4, 4).
        ranks: All ranks met, ascending.
        taken: How many steps each walker could take, shape (walkers,).
    """

    displacements: Array
    ranks: tuple[int, ...]
    taken: NDArray[np.intp]


def walk(
    forest: Forest,
    begin: Stance,
    kernels: Sequence[Kernel],
    dimension: int,
    random: np.random.Generator,
) -> Walk:
    """Follow one branch from several of its postures at once.

    Args:
        forest: Of the mechanism, scaled.
        begin: Postures of the branch, all of one rank.
        kernels: At each of them.
        dimension: Of the branch; below that of the kernels where rank never tells.
        random: Chooses directions.
    """
    stance = begin
    parts = reduced(forest, begin, stacked_splits([k.split for k in kernels]))
    types = twist_systems(forest, stance, parts.tangents)
    is_reduced = dimension == parts.tangents.shape[-1]
    heading = np.zeros(begin.screws.shape[:2])
    length = np.full(len(begin), STEP)
    seen, ranks = [stance.platform], {parts.split.rank}
    taken = np.zeros(len(begin), dtype=np.intp)
    for _ in range(STEPS):
        ahead = _ahead(parts.tangents, heading, dimension, random)
        ahead *= (length / np.abs(ahead).max(axis=1))[:, None]
        if is_reduced:
            found = projected_at_rank(forest, stance, ahead, parts.split, 1e-11)
        else:
            found = projected(forest, stance, ahead, parts.split)
        way, asked = (np.linalg.norm(x, axis=1) for x in (found.travelled, ahead))
        good = found.closed & (way > 0.2 * asked) & (way < 3 * asked)
        landed = stance.put(good, found.stance.take(good))
        there, own = _parts(forest, landed, parts.split)
        ranks |= {int(rank) for rank in own}
        good &= own == parts.split.rank
        good &= _same_branch(parts.tangents, there.tangents)
        good &= (twist_systems(forest, landed, there.tangents) == types).all(axis=1)
        stance = stance.put(good, landed.take(good))
        if good.all():
            parts = there
        else:
            parts = reduced(forest, stance, _chosen(good, there.split, parts.split))
        heading[good] = found.travelled[good] / way[good, None]
        heading[~good] = 0.0
        length = np.where(good, STEP, np.maximum(length / 2, STEP / 64))
        seen.append(stance.platform)
        taken += good
    return Walk(np.stack(seen), tuple(sorted(ranks)), taken)


def twist_systems(
    forest: Forest, stance: Stance, tangents: Array, visible: float = VISIBLE
) -> NDArray[np.intp]:
    """Dimension of the platform's twists and of its rotations, shape (batch, 2).

    A platform that nothing connects with the base moves in all six ways.
    """
    connected, node = forest.platform
    if not connected:
        return np.tile(np.array([6, 3], dtype=np.intp), (len(stance), 1))
    return body_systems(forest, stance, tangents, node, visible)


def body_systems(
    forest: Forest, stance: Stance, tangents: Array, node: int, visible: float = VISIBLE
) -> NDArray[np.intp]:
    """Dimension of a body's twists and of its rotations, shape (batch, 2)."""
    twists = body_jacobian(forest, stance, node) @ tangents
    counts = [
        (np.linalg.svd(rows, compute_uv=False) > visible).sum(axis=1)
        for rows in (twists, twists[:, :3])
    ]
    return np.stack(counts, axis=1)


def _ahead(
    tangents: Array, heading: Array, dimension: int, random: np.random.Generator
) -> Array:
    """On in the direction of the last step, with a turn where there is room."""
    fresh, _ = _inside(tangents, random.standard_normal(heading.shape))
    kept, shares = _inside(tangents, heading)
    share = 0.5 if dimension > 1 else 0.0
    return np.where(shares > 0.5, kept + share * fresh, fresh)


def _inside(bases: Array, vectors: Array) -> tuple[Array, Array]:
    """Unit vectors of the tangent spaces along others, and how long those are there."""
    inside = (bases @ (np.swapaxes(bases, -1, -2) @ vectors[..., None]))[..., 0]
    size = np.linalg.norm(inside, axis=1, keepdims=True)
    return inside / np.maximum(size, 1e-300), size


def _parts(
    forest: Forest, stance: Stance, split: Split
) -> tuple[Reduced, NDArray[np.intp]]:
    """The equations where the walkers are, in new bases if need be, and the ranks."""
    parts = reduced(forest, stance, split)
    ranks = np.full(len(stance), split.rank)
    if parts.rest.size:
        values = np.linalg.svd(parts.rest, compute_uv=False)
        ranks += (values > 10 * CUT * split.size[:, None]).sum(axis=1)
    strained = np.flatnonzero(parts.strain > STRAINED)
    if len(strained):
        left, right = split.left.copy(), split.right.copy()
        fresh = turned(forest, stance.take(strained), split.take(strained))
        left[strained], right[strained] = fresh.left, fresh.right
        split = Split(left, right, split.rank, split.size)
        parts = reduced(forest, stance, split)
    for number in np.flatnonzero(parts.strain > 1 / CUT):
        matrix = loop_jacobian(forest, stance.take(np.array([number])))[0]
        values = np.linalg.svd(matrix, compute_uv=False)
        ranks[number] = (values > CUT * split.size[number]).sum()
    return parts, ranks


def _same_branch(before: Array, behind: Array) -> NDArray[np.bool_]:
    cosines = np.linalg.svd(np.swapaxes(before, -1, -2) @ behind, compute_uv=False)
    return np.asarray(cosines.min(axis=-1) > TURNED)


def _chosen(good: NDArray[np.bool_], there: Split, here: Split) -> Split:
    pick = good[:, None, None]
    return Split(
        np.where(pick, there.left, here.left),
        np.where(pick, there.right, here.right),
        here.rank,
        np.where(good, there.size, here.size),
    )
