"""Samples of a mechanism whose idle freedoms are held, told of the whole mechanism.

The idle motion of a body between two joints is a factor of the closed postures
(`idle_freedoms`).  Held, it leaves the samples as few dimensions as the motion of the
rest has, and none of them is lost on rods that spin; then it is counted again.

References: [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from screwkit.finite.finite_branches import FiniteBranch
from screwkit.finite.finite_motion import FiniteMotion, finite_motion
from screwkit.finite.idle_freedoms import IdleMotion
from screwkit.finite.posture_model import PosedJoint, PostureModel
from screwkit.finite.posture_numbers import numbers_at
from screwkit.finite.spanning_forest import forest_of

ZERO = 1e-9
"""Relative size of a singular value that counts as zero; only good choices depend on
it, no answer does."""


def idle_shares(model: PostureModel) -> dict[str, float]:
    """How much each freedom takes part in idle motions of bodies with two joints.

    Freedoms with large shares are those to hold: then what is left of their joint is
    far from the idle motion, as the axes at right angles to a rod are from its spin.
    """
    joints_at: dict[str, list[PosedJoint]] = {}
    for joint in model.joints:
        for link in {joint.parent, joint.child}:
            joints_at.setdefault(link, []).append(joint)
    shares: dict[str, float] = {}
    for joints in joints_at.values():
        if len(joints) != 2:
            continue
        labels = [label for joint in joints for label in joint.labels]
        for label, share in zip(labels, _shares(joints), strict=True):
            shares[label] = max(share, shares.get(label, 0.0))
    return shares


def _shares(joints: Sequence[PosedJoint]) -> list[float]:
    """Sizes of the coordinates of the screws that two joints have in common."""
    screws = np.concatenate([joint.screws for joint in joints])
    if not len(screws):
        return []
    _, values, right = np.linalg.svd(screws.T)
    rank = int((values > ZERO * values[0]).sum())
    return [float(size) for size in np.linalg.norm(right[rank:], axis=0)]


def finite_motion_with_idle(
    model: PostureModel, idle: Sequence[IdleMotion]
) -> FiniteMotion:
    """The finite mobilities around a closed posture, idle motions held meanwhile.

    Args:
        model: At the posture.
        idle: Of bodies other than base and platform.

    Raises:
        UnknownNameError: If ``idle`` names no freedom.
    """
    found = finite_motion(model, idle=idle)
    count = sum(len(each.held) for each in idle)
    if not count or not found.mobility:
        return found
    branches = tuple(_freed(branch, count) for branch in found.branches)
    return replace(
        found,
        mobility=tuple(mobility + count for mobility in found.mobility),
        branches=branches or (_only_idle(model, count),),
        reason=f"apart from the idle freedom of bodies between two joints ({count}), "
        f"{found.reason}",
    )


def _freed(branch: FiniteBranch, count: int) -> FiniteBranch:
    return replace(
        branch,
        mobility=branch.mobility + count,
        instantaneous_mobility=branch.instantaneous_mobility + count,
    )


def _only_idle(model: PostureModel, count: int) -> FiniteBranch:
    """The branch on which nothing but idle motions is left: all else rests."""
    here, forest = numbers_at(model), forest_of(model)
    loose = not forest.platform[0]
    return FiniteBranch(
        mobility=count,
        instantaneous_mobility=here.mobility,
        loop_rank=here.loop_rank,
        redundant_constraints=6 * len(forest.closing_joints) - here.loop_rank,
        twist_dimension=6 if loose else here.twist_dimension,
        motion_type="3T3R" if loose else here.motion_type,
        finite_type="3T3R" if loose else "0T0R",
        couples=0 if loose else here.couples,
        motion="" if loose else "at rest",
        starts=1,
    )
