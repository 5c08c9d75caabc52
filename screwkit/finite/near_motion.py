"""Whether a structure that is proved rigid moves all but for the rounding of decimals.

Rounded coordinates of a linkage like Schatz's may keep its loop rank and open its loops
at second order, by very little.  The proof is right for the numbers as written; what
their author meant shows where the loops stay closed within the rounding over a long
way, much longer than any shaky structure yields.

References: [ConnellyWhiteley1996] on what second order proves.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.branch_search import start_directions
from screwkit.finite.chain_graph import chain_graph
from screwkit.finite.exponentials import stance_of
from screwkit.finite.held_spins import without_idle
from screwkit.finite.idle_freedoms import idle_motions
from screwkit.finite.idle_samples import idle_shares
from screwkit.finite.local_dimension import Kernel, steady, unit_rows
from screwkit.finite.loop_series import curve
from screwkit.finite.loop_split import split_at
from screwkit.finite.own_frame import in_own_frame
from screwkit.finite.posture_model import PostureModel, posture_model, scaled
from screwkit.finite.projection import projected
from screwkit.finite.spanning_forest import forest_of
from screwkit.finite.tangent_cone import second_order_directions
from screwkit.kinematics.network import Motion

ROUNDING: Final = 1e-6
"""Largest miss of loops that rounding may have opened: radians, and lengths over the
mechanism's own."""

STRIDE, STRIDES, WAY = 0.08, 10, 0.5
"""Length of a step, how many are taken, and how far they must lead: a structure that
yields to order k opens by about WAY^k."""

LARGEST: Final = 150
"""Freedoms beyond which samples take too long."""

EARLY: Final = 3
"""Orders at which rounding opens loops: what holds on to later ones is no accident."""

MANY: Final = 12
"""Directions at random, and as many on the second-order cone."""

STAGES: Final = ((3e-3, 25), (1e-5, 25))
"""Closing leaves weak equations out altogether: they are what rounding has opened."""


def near_motion(at: Motion) -> str:
    """Over what way loops stay closed within rounding; empty where over none.

    Args:
        at: The motion of a mechanism in numbers whose posture is proved to be isolated,
            apart from idle freedoms of bodies.
    """
    mechanism = at.network.mechanism
    if len(at.network.labels) > LARGEST:
        return ""
    try:
        model = posture_model(mechanism)
    except (UndecidedError, UnknownNameError):
        return ""
    idle = idle_motions(at, shares=idle_shares(model))
    held = [label for each in idle for label in each.held]
    blocks = (block for block in chain_graph(at, held).blocks() if block.mobility)
    if any(curve(block).order_of_failure(EARLY) is None for block in blocks):
        return ""
    own = in_own_frame(scaled(model)).model
    return _told(without_idle(own, idle), at.rank)


def _told(model: PostureModel, rank: int) -> str:
    forest, random = forest_of(model), np.random.default_rng(0)
    origin = stance_of(model, forest)
    split, _ = split_at(forest, origin, rank)
    kernel = Kernel(split, steady(split.right[0, :, rank:]))
    if not kernel.dimension:
        return ""
    headings = np.concatenate(
        [
            start_directions(forest, origin, kernel, MANY, random),
            second_order_directions(forest, origin, kernel, MANY, random),
        ]
    )
    count = len(headings)
    same = np.zeros(count, dtype=np.intp)
    stance, split = origin.take(same), split.take(same)
    ways, worst = np.zeros_like(headings), np.zeros(count)
    for _ in range(STRIDES):
        found = projected(forest, stance, STRIDE * headings, split, STAGES)
        length = np.linalg.norm(found.travelled, axis=1)
        onward = (length > 0.5 * STRIDE) & (length < 2 * STRIDE)
        onward &= found.largest < ROUNDING
        if not onward.any():
            return ""
        stance, split = found.stance.take(onward), split.take(np.flatnonzero(onward))
        headings = unit_rows(found.travelled[onward])
        ways = ways[onward] + found.travelled[onward]
        worst = np.maximum(worst[onward], found.largest[onward])
    far = np.linalg.norm(ways, axis=1) > WAY
    if not far.any():
        return ""
    return (
        f"up to the rounding of decimals it moves: on a way of {WAY} rad the loops "
        f"open by no more than {worst[far].min():.0e}; the answer is for the numbers "
        f"as written, exact ones decide what is meant"
    )
