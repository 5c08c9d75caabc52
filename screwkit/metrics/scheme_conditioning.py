"""How well schemes drive the platform: one number each, at many postures at once.

At a posture the motions of the mechanism are q̇ = J t + N c: t are coordinates of the
platform's twist (ω; v/L) in an orthonormal basis of the twists it can have, c those of
motions that leave it at rest.  A scheme reads some rows of this.  What idle motions
can add to its rates is projected out, as in the stationary values of the kinematic
index, and the index is the least singular value of what is left over the largest: the
inverse condition number.

References: [SalisburyCraig1982] (condition), [BicchiPrattichizzo] eq. (13).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array

CHUNK = 400_000
"""Entries of matrices at a time."""


@dataclass(frozen=True, eq=False)
class Driving:
    """Joint rates by the platform's twist, at many postures.

    Attributes:
        by_twist: J, shape (postures, freedoms, platform freedoms).
        idle: N, shape (postures, freedoms, mobility less platform freedoms).
    """

    by_twist: Array
    idle: Array


@dataclass(frozen=True, eq=False)
class Incidence:
    """Which freedoms are in which loop, and on the way to the platform.

    Attributes:
        loops: 1 or -1 by the direction in which a loop passes the freedom, 0 where it
            does not; shape (loops, freedoms).
        way: The same of a way from the base to the platform, shape (freedoms,).
    """

    loops: Array
    way: Array


def incidence(loops: Sequence[Sequence[int]], way: Sequence[int]) -> Incidence:
    """What closes and what carries the platform, from signs by freedom."""
    return Incidence(
        np.array(loops, dtype=float).reshape(len(loops), len(way)),
        np.array(way, dtype=float),
    )


def driving(
    twists: Array, incidence: Incidence, mobility: int, freedom: int
) -> Driving:
    """The motions of a mechanism and its platform.

    Args:
        twists: Without units, shape (postures, freedoms, 6).
        incidence: What closes and what carries the platform.
        mobility: Dimension of the motions, exact.
        freedom: Dimension of the platform's twists, exact.
    """
    postures, count = twists.shape[:2]
    if len(incidence.loops):
        signed = incidence.loops[None, :, None, :] * twists.swapaxes(1, 2)[:, None]
        _, _, right = np.linalg.svd(signed.reshape(postures, -1, count))
        motions = right[:, count - mobility :].swapaxes(1, 2)
    else:
        motions = np.broadcast_to(np.eye(count), (postures, count, count))
    moved = (twists * incidence.way[:, None]).swapaxes(1, 2) @ motions
    _, sizes, right = np.linalg.svd(moved)
    back = right.swapaxes(1, 2)
    with np.errstate(divide="ignore", invalid="ignore"):
        by_twist = motions @ (back[..., :freedom] / sizes[:, None, :freedom])
    return Driving(by_twist, motions @ back[..., freedom:])


def conditioning(
    motions: Driving, schemes: Sequence[Sequence[int]], idle_ranks: Sequence[int]
) -> Array:
    """The index of schemes at all postures, shape (schemes, postures), 0 to 1.

    Args:
        motions: What moves how.
        schemes: Positions of the actuated freedoms, the same number in each.
        idle_ranks: Of each scheme the dimension of the rates that idle motions can
            give its freedoms, exact.
    """
    postures, _, freedom = motions.by_twist.shape
    found = np.ones((len(schemes), postures))
    if not freedom or not schemes:
        return found
    order = np.asarray(schemes, dtype=int).reshape(len(schemes), -1)
    ranks = np.asarray(idle_ranks)
    step = max(1, CHUNK // (postures * max(1, order.shape[1]) * freedom))
    for rank in np.unique(ranks):
        own = np.flatnonzero(ranks == rank)
        for start in range(0, len(own), step):
            chosen = own[start : start + step]
            rows = motions.by_twist[:, order[chosen]]
            if rank:
                left, _, _ = np.linalg.svd(motions.idle[:, order[chosen]])
                added = left[..., :rank]
                rows = rows - added @ (added.swapaxes(-1, -2) @ rows)
            sizes = np.linalg.svd(rows, compute_uv=False)
            found[chosen] = (sizes[..., freedom - 1] / sizes[..., 0]).T
    return found


def median_and_worst(values: Array) -> list[tuple[float, float]]:
    """Of each row."""
    return [
        (float(middle), float(least))
        for middle, least in zip(
            np.median(values, axis=-1), values.min(axis=-1), strict=True
        )
    ]
