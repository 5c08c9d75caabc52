"""Several arms with one object: the ellipsoids of the system and of each arm.

The absolute velocity and external force ellipsoids are those of the kinematic and force
indices.  Internal forces are measured by what they are at the object point,
|h_r|² = ½ Σ |h'_i|² over the contacts (`metrics.arms`), so that for two rigid grasps
everything is as in the paper, and any mix of contacts has the same definition.

References: [ChiacchioEtAl1990] eqs. (26), (28), (30), (35)-(37).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.grasping.exact_grasp import Ranks
from screwkit.metrics.indices import (
    FloatGrasp,
    Index,
    Indices,
    Weights,
    both_indices,
    internal_index,
)


@dataclass(frozen=True)
class ArmPart:
    """Which part of a grasp is one arm.

    Attributes:
        rows: Numbers of the rows of its contacts.
        actuated, passive: Numbers of its columns of J_a and of J_p.
        ranks: Of that part alone, where they are known exactly.
    """

    name: str
    rows: tuple[int, ...]
    actuated: tuple[int, ...]
    passive: tuple[int, ...]
    ranks: Ranks | None = None


@dataclass(frozen=True)
class AxesOf:
    """An ellipsoid: lengths descending, directions as rows, and infinite axes."""

    lengths: Array
    directions: Array
    infinite: int = 0


@dataclass(frozen=True)
class Shared:
    """The ellipsoids of a system of arms, and each arm's own.

    Attributes:
        arms: Absolute velocity and external force of each arm as if it were alone.
        shares: Of each arm along the axes of the absolute velocity, shape (arms, k);
            empty where arms do not combine in parallel.
    """

    absolute: AxesOf
    external: AxesOf
    relative: AxesOf
    internal: AxesOf
    arms: tuple[tuple[AxesOf, AxesOf], ...]
    shares: Array


def cooperation(
    grasp: FloatGrasp,
    weights: Weights,
    whole: Indices,
    contacts: Sequence[Sequence[int]],
    arms: Sequence[ArmPart],
    *,
    combined: bool,
) -> Shared:
    """The ellipsoids of arms that hold one object.

    Args:
        grasp: At a posture, without closures inside limbs.
        weights: Of the whole.
        whole: Its indices.
        contacts: Numbers of the rows of each contact.
        arms: The parts.
        combined: Whether they combine in parallel; then each has a share.
    """
    metric = np.zeros((len(grasp.g.T), len(grasp.g.T)))
    for rows in contacts:
        acting = grasp.g[:, list(rows)]
        weighted = acting if weights.wrench is None else weights.wrench @ acting
        metric[np.ix_(rows, rows)] = 0.5 * acting.T @ weighted
    inside = internal_index(whole.statics, grasp, replace(weights, forces=metric))
    singles = [_single(grasp, weights, arm) for arm in arms]
    internal, relative = _inside(inside, grasp, contacts)
    return Shared(
        _axes(whole.kinematic),
        _axes(whole.force),
        relative,
        internal,
        tuple((_axes(motion), _axes(force)) for motion, force in singles),
        _shares(whole.kinematic, [motion for motion, _ in singles])
        if combined
        else np.zeros((0, 0)),
    )


def _axes(index: Index) -> AxesOf:
    return AxesOf(np.sqrt(index.finite), index.task)


def _single(grasp: FloatGrasp, weights: Weights, arm: ArmPart) -> tuple[Index, Index]:
    """The kinematic and the force index of one arm."""
    rows, moving = list(arm.rows), list(arm.actuated)

    def part(weight: Array | None) -> Array | None:
        return None if weight is None else weight[np.ix_(moving, moving)]

    own = FloatGrasp(
        grasp.ja[np.ix_(rows, moving)],
        grasp.jp[np.ix_(rows, list(arm.passive))],
        grasp.gt[rows],
        arm.ranks,
    )
    return both_indices(
        own,
        replace(
            weights,
            rates=part(weights.rates),
            torques=part(weights.torques),
            forces=None,
        ),
    )


def _inside(
    inside: Index, grasp: FloatGrasp, contacts: Sequence[Sequence[int]]
) -> tuple[AxesOf, AxesOf]:
    """Internal force and relative velocity: the same axes, inverse lengths.

    Directions are the wrenches of the first contact where there are two, and of all
    contacts, one after the other, where there are more.
    """
    rows = [rows for rows in contacts if rows]
    chosen = rows[:1] if len(rows) == 2 else rows
    acting = [inside.task[:, list(one)] @ grasp.g[:, list(one)].T for one in chosen]
    size = grasp.gt.shape[1]
    wrenches = np.concatenate(acting, axis=1) if acting else np.zeros((0, size))
    lengths = np.linalg.norm(wrenches, axis=1, keepdims=True)
    wrenches = wrenches / np.where(lengths > 0, lengths, 1.0)
    angular = 1 if size == 3 else 3
    parted = wrenches.reshape(len(wrenches), wrenches.shape[1] // size, size)
    swapped = np.concatenate([parted[..., -angular:], parted[..., :-angular]], axis=-1)
    twists = swapped.reshape(wrenches.shape)
    semi = np.sqrt(inside.finite)
    return (
        AxesOf(semi, wrenches, inside.infinite),
        AxesOf(1.0 / semi[::-1], twists[::-1]),
    )


def _shares(whole: Index, singles: Sequence[Index]) -> Array:
    """dᵀ A_i d over dᵀ (Σ A) d, A the inverse of an arm's J~ J~ᵀ, along each axis d."""
    if not len(whole.finite):
        return np.zeros((0, 0))
    basis = np.linalg.qr(whole.task.T)[0]
    parts = [np.linalg.inv(basis.T @ one.shape @ basis) for one in singles]
    axes = whole.task @ basis
    along = np.array([np.einsum("ij,jk,ik->i", axes, part, axes) for part in parts])
    return np.asarray(along / along.sum(axis=0))
