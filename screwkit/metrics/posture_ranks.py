"""Ranks at one posture by singular values: of a limb, of loops, with joints locked."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from math import isfinite

from screwkit.finite.posture_model import PostureModel, scaled
from screwkit.finite.posture_numbers import CLEAR, numbers_at
from screwkit.metrics.spans import split

DOUBTFUL = 1e-7
"""Relative size down to which a singular value that counts may be rounding as well."""


@dataclass(frozen=True)
class PostureRank:
    """A rank counted at one posture.

    Attributes:
        rank: Of the limb's twists, of J_c, or of all wrenches on the platform.
        platform_freedom: Dimension of the platform's twists; with locked joints where
            some are.
        gap: Ratio of the least singular value that counts to the next; None where all
            count.
        clear: Whether that ratio leaves no doubt.
    """

    rank: int
    platform_freedom: int
    gap: float | None
    clear: bool


def limb_rank(model: PostureModel, labels: Collection[str]) -> PostureRank:
    """Of the twists of some freedoms."""
    own = scaled(model)
    rows = own.screws[[own.index(label) for label in labels]]
    known = split(rows)
    free = numbers_at(model)
    clear = known.gap >= CLEAR and known.least > DOUBTFUL
    gap = known.gap if isfinite(known.gap) else None
    return PostureRank(known.rank, free.twist_dimension, gap, clear)


def loop_rank(model: PostureModel) -> PostureRank:
    """Of the loop constraints."""
    known = numbers_at(model)
    gap = known.gap if isfinite(known.gap) else None
    return PostureRank(known.loop_rank, known.twist_dimension, gap, known.clear)


def locked_rank(
    model: PostureModel, locked: Collection[str], size: int = 6
) -> PostureRank:
    """Of the wrenches on the platform while freedoms are locked.

    Args:
        model: At a closed posture.
        locked: Freedoms.
        size: Dimension of all wrenches: 6, or 3 of a planar file.
    """
    known = numbers_at(model, locked)
    freedom = known.twist_dimension
    gap = known.gap if isfinite(known.gap) else None
    return PostureRank(size - freedom, freedom, gap, known.clear)
