"""Numbers of a posture as plain data: indices, ellipsoids, arms.

The border between arrays and results: what comes out holds floats and tuples only.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.errors import ExpressionError
from screwkit.grasping.exact_grasp import Ranks
from screwkit.grasping.matrices import GraspMatrices
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.cooperation import ArmPart, AxesOf, cooperation
from screwkit.metrics.float_grasp import float_weights, of_matrices
from screwkit.metrics.float_ranks import float_ranks
from screwkit.metrics.indices import FloatGrasp, Index, Indices, Weights, indices
from screwkit.metrics.spans import split, tidied
from screwkit.results.manipulability import (
    ArmEllipsoids,
    Cooperative,
    Ellipsoid,
    IndexValues,
)

ROUNDED = 1e-13
"""Entries of unit vectors below this are written as 0."""


@dataclass(frozen=True)
class ArmJoints:
    """One arm by its names.

    Attributes:
        contacts: Its holds on the object.
        freedoms: Its joints' freedoms.
        ranks: Of that part alone; None where they are not known exactly.
    """

    name: str
    contacts: tuple[str, ...]
    freedoms: tuple[str, ...]
    ranks: Ranks | None = None


@dataclass(frozen=True)
class PostureAnswers:
    """Everything at one posture that is a number.

    Attributes:
        translation, rotation: Of the velocities of the reference point, and of the
            angular velocities, for unit rates.
        forces: Of the forces on the platform, for unit torques.
        ranks: Those used: exact, or counted.
        alone: Motions of the object with all joints locked but contacts, where ranks
            were counted.
        gamma: Dimensions of the seven blocks where ranks were counted; else empty.
        gap: Of the least certain rank; None where all are exact.
        least: Smallest of the singular values that count over the largest.
    """

    kinematic: IndexValues
    force: IndexValues
    active: IndexValues
    passive: IndexValues
    internal: IndexValues
    translation: Ellipsoid
    rotation: Ellipsoid
    forces: Ellipsoid
    cooperative: Cooperative | None
    ranks: Ranks
    alone: int | None
    gamma: tuple[int, ...]
    gap: float | None
    least: float


def posture_answers(
    mechanism: Mechanism,
    matrices: GraspMatrices[Array],
    ranks: Ranks | None,
    arms: Sequence[ArmJoints] = (),
    rule: str = "",
) -> PostureAnswers:
    """All indices, and the ellipsoids of several arms.

    Args:
        mechanism: For its weights; symbols with values.
        matrices: At the posture.
        ranks: Where they are known exactly.
        arms: Two or more that hold the object; none asks for no ellipsoids of arms.
        rule: Why they do not combine in parallel and in series; empty where they do.
    """
    grasp = of_matrices(matrices, ranks)
    weights = float_weights(mechanism, matrices, {})
    counted: tuple[int, ...] = ()
    gap = None
    if ranks is None:
        ranks, counted, gap = float_ranks(grasp)
        grasp = replace(grasp, ranks=ranks)
    try:
        found = indices(grasp, weights)
    except np.linalg.LinAlgError:
        raise ExpressionError(
            "a weight is not positive definite at these values"
        ) from None
    size = matrices.twist_size
    angular = 1 if size == 3 else 3
    shape = found.kinematic.shape
    return PostureAnswers(
        index_values(found.kinematic),
        index_values(found.force),
        index_values(found.active),
        index_values(found.passive),
        index_values(found.internal),
        _ball_image(shape[angular:, angular:], shape),
        _ball_image(shape[:angular, :angular], shape),
        _ball_image(
            found.force.shape[: size - angular, : size - angular], found.force.shape
        ),
        _cooperative(grasp, weights, found, matrices, arms, rule) if arms else None,
        ranks,
        _alone(grasp, matrices) if counted else None,
        counted,
        None if gap is None else float(min(gap, 1e300)),
        found.least,
    )


def _alone(grasp: FloatGrasp, matrices: GraspMatrices[Array]) -> int:
    """Dimension of what the object can do with all joints locked but contacts."""
    slipping = grasp.jp[:, _places(matrices.slipping, matrices.passive)]
    both = np.concatenate([slipping, -grasp.gt], axis=1)
    return int(grasp.gt.shape[1]) - (split(both).rank - split(slipping).rank)


def index_values(index: Index) -> IndexValues:
    """An index as plain data."""
    return IndexValues(
        tuple(float(x) for x in index.finite),
        index.infinite,
        index.zero,
        _rows(index.task),
        _rows(index.joint),
        _rows(tidied(index.infinite_task)) if index.infinite else (),
        _rows(tidied(index.zero_joint)) if index.zero else (),
    )


def _rows(matrix: Array) -> tuple[tuple[float, ...], ...]:
    return tuple(
        tuple(0.0 if abs(x) < ROUNDED else x for x in row) for row in matrix.tolist()
    )


def _ball_image(shape: Array, whole: Array | None = None) -> Ellipsoid:
    """The ellipsoid with that shape matrix, axes of rounding size left out.

    Args:
        shape: Of coordinates of one kind.
        whole: Of all coordinates; what is small beside it is rounding too.
    """
    if not shape.size:
        return Ellipsoid()
    values, vectors = np.linalg.eigh(shape)
    order = np.argsort(values)[::-1]
    largest = max(float(values.max(initial=0.0)), 0.0)
    least = 1e-12 * largest
    if whole is not None:
        least = max(least, ROUNDED**2 * float(np.abs(np.diag(whole)).max()))
    kept = [i for i in order if values[i] > least]
    axes = AxesOf(np.sqrt(values[kept]), vectors[:, kept].T)
    return ellipsoid(axes)


def ellipsoid(axes: AxesOf, linear: slice = slice(0)) -> Ellipsoid:
    """An ellipsoid as plain data; each direction with its largest entry positive.

    Args:
        axes: Its axes.
        linear: Which coordinates of a direction are those of a velocity or a force.
    """
    turned = axes.directions
    if turned.size:
        largest = np.abs(turned).argmax(axis=1)
        back = turned[np.arange(len(turned)), largest] < 0
        turned = np.where(back[:, None], -turned, turned)
    lengths = tuple(axes.lengths.tolist())
    vectors = (axes.lengths[:, None] * axes.directions)[:, linear]
    part = _ball_image(vectors.T @ vectors) if vectors.size else Ellipsoid()
    return Ellipsoid(
        lengths,
        _rows(turned),
        axes.infinite,
        tuple(
            tuple(length * x for x in direction)
            for length, direction in zip(part.semi_axes, part.directions, strict=True)
        ),
    )


def _cooperative(
    grasp: FloatGrasp,
    weights: Weights,
    whole: Indices,
    matrices: GraspMatrices[Array],
    arms: Sequence[ArmJoints],
    rule: str,
) -> Cooperative:
    contacts = [
        [i for i, row in enumerate(matrices.rows) if row.hold.joint == hold.joint]
        for hold in matrices.holds.contacts
    ]
    parts = [
        ArmPart(
            arm.name,
            tuple(
                i
                for i, row in enumerate(matrices.rows)
                if row.hold.joint in arm.contacts
            ),
            _places(arm.freedoms, matrices.actuated),
            _places(arm.freedoms, matrices.passive),
            arm.ranks,
        )
        for arm in arms
    ]
    shared = cooperation(grasp, weights, whole, contacts, parts, combined=not rule)
    angular = 1 if matrices.twist_size == 3 else 3
    moving, acting = slice(angular, None), slice(0, matrices.twist_size - angular)
    pair = len(contacts) == 2  # then relative quantities are those of one twist
    return Cooperative(
        ellipsoid(shared.absolute, moving),
        ellipsoid(shared.external, acting),
        ellipsoid(shared.relative, moving if pair else slice(0)),
        ellipsoid(shared.internal, acting if pair else slice(0)),
        tuple(
            ArmEllipsoids(
                arm.name,
                arm.freedoms,
                ellipsoid(velocity, moving),
                ellipsoid(force, acting),
                tuple(float(x) for x in shared.shares[number])
                if shared.shares.size
                else (),
            )
            for number, (arm, (velocity, force)) in enumerate(
                zip(arms, shared.arms, strict=True)
            )
        ),
        rule,
    )


def _places(chosen: Sequence[str], among: Sequence[str]) -> tuple[int, ...]:
    return tuple(i for i, label in enumerate(among) if label in chosen)
