"""Manipulability indices of a grasp at one posture, in floating point.

Weights become changes of coordinates, after which every index is a ratio of two plain
sums of squares.  What is infinite, zero or indeterminate is a matter of ranks and
counted exactly; only the finite values are numbers, squared singular values of the map
that is left.

References: [BicchiPrattichizzo] eqs. (6)-(24) in their corrected form.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.grasping.exact_grasp import Ranks
from screwkit.metrics.spans import Split, split, without


@dataclass(frozen=True)
class Weights:
    """Positive definite matrices; None stands for the identity.

    Attributes:
        twist: W_u, of the object's twist.
        rates: W_q, of the actuated rates.
        wrench: W_w, of the wrench on the object.
        torques: W_τ, of the actuated torques.
        forces: W_f, of the components of the contact forces on the object.
    """

    twist: Array | None = None
    rates: Array | None = None
    wrench: Array | None = None
    torques: Array | None = None
    forces: Array | None = None


@dataclass(frozen=True)
class FloatGrasp:
    """J_a, J_p and Gᵀ at a posture, in unit directions.

    Attributes:
        ja: Shape (rows, actuated).
        jp: Shape (rows, passive).
        gt: Shape (rows, d), its columns those of a twist (ω; v).
        ranks: Where they are known exactly.
        held: How many rows, the first ones, are of contacts with the object; the others
            are of closures inside limbs.  None: all.
    """

    ja: Array
    jp: Array
    gt: Array
    ranks: Ranks | None = None
    held: int | None = None

    @property
    def g(self) -> Array:
        """The grasp matrix: wrenches (f; m) of the components of contact forces."""
        size = self.gt.shape[-1]
        order = [*range(size // 2, size), *range(size // 2)]
        if size == 3:
            order = [1, 2, 0]
        return np.asarray(self.gt[..., order].swapaxes(-1, -2))


@dataclass(frozen=True)
class Index:
    """One index: its values and where they are taken.

    Attributes:
        finite: In descending order.
        infinite, zero: How many are.
        task: For each finite value the object's twist or wrench, a row of unit length.
        joint: For each finite value the actuated rates or torques, a row of unit
            length; of the internal index, the contact forces.
        infinite_task: Directions in which the value is infinite, as rows.
        zero_joint: Actuated directions that the object does not feel, as rows.
        shape: Σ tᵢtᵢᵀ of the images of the unit ball of rates or torques; its axes are
            those of the ellipsoid, in the coordinates of the task.
    """

    finite: Array
    infinite: int
    zero: int
    task: Array
    joint: Array
    infinite_task: Array = field(default_factory=lambda: np.zeros((0, 0)))
    zero_joint: Array = field(default_factory=lambda: np.zeros((0, 0)))
    shape: Array = field(default_factory=lambda: np.zeros((0, 0)))


@dataclass(frozen=True)
class Indices:
    """All indices of a posture.

    Attributes:
        kinematic: (13), with dim I infinite and dim R zero values counted as in (8).
        force: (24).
        active: (20): those of (24), and zeros for internal torques.
        passive: (21): those of (24), and infinite ones for structural wrenches.
        internal: (22), (23).
        structural: Wrenches that are balanced without torque, as rows.
        gap: Of the least certain rank; inf where nothing is small.
        least: Smallest relative size of a singular value that counts.
        statics: What contact forces do, for `internal_index`.
    """

    kinematic: Index
    force: Index
    active: Index
    passive: Index
    internal: Index
    structural: Array
    gap: float
    least: float
    statics: Statics


def indices(grasp: FloatGrasp, weights: Weights) -> Indices:
    """All indices of a grasp.

    Args:
        grasp: At one posture.
        weights: Of sizes that fit.

    Raises:
        numpy.linalg.LinAlgError: If a weight is not positive definite.
    """
    passive = _passive(grasp)
    kinematic, spans = _kinematic(grasp, weights, passive)
    statics = Statics.of(grasp, weights, passive)
    force = _force(statics)
    h, s = statics.torque_span.shape[1], statics.wrench_span.shape[1]
    structural = _unit_rows(statics.from_wrench @ statics.wrench_span)
    inner = _unit_rows(statics.from_torque @ statics.torque_span)
    width = grasp.gt.shape[1]
    return Indices(
        kinematic,
        force,
        _with(force, zero=h, zero_joint=inner),
        _with(force, infinite=s, infinite_task=structural),
        internal_index(statics, grasp, weights),
        structural if s else np.zeros((0, width)),
        min(statics.gap, *(span.gap for span in spans)),
        min(span.least for span in spans),
        statics,
    )


def both_indices(grasp: FloatGrasp, weights: Weights) -> tuple[Index, Index]:
    """The kinematic and the force index alone.

    Arguments and errors are those of `indices`.
    """
    passive = _passive(grasp)
    kinematic, _ = _kinematic(grasp, weights, passive)
    return kinematic, _force(Statics.of(grasp, weights, passive))


def internal_index(statics: Statics, grasp: FloatGrasp, weights: Weights) -> Index:
    """The internal-force index with another weight of contact forces.

    Contact forces against torques, both in balance on the object.  Loads of loops
    inside limbs are no contact forces: which joint closes such a loop is no property of
    the mechanism.  Torques that cause nothing else have the value zero.

    Args:
        statics: Of `indices`, with the same weights but for that one.
        grasp: At the same posture.
        weights: With the other weight of contact forces.

    Raises:
        numpy.linalg.LinAlgError: If it is not positive definite.
    """
    ranks = grasp.ranks
    unseen = 0 if ranks is None else ranks.inner_torques
    silent, inner = statics.silent, statics.inner
    loose = silent.shape[1] if ranks is None else ranks.contact_indeterminacy
    to_forces = _root(weights.forces)
    held = statics.forces[: grasp.held]
    count = inner.shape[1] - silent.shape[1]
    apart = split(without(inner, silent), count).column_space
    known = split(_through(to_forces, held @ silent), loose).column_space
    y = without(_through(to_forces, held @ apart), known)
    back = _back(to_forces, len(held))
    scales, joint, task = _stationary(statics.torques @ apart, y)
    seen = count - unseen
    inside = statics.torques @ apart @ split(y, seen).null_space
    return Index(
        finite=scales[:seen] ** 2,
        infinite=loose,
        zero=unseen,
        task=_unit_rows(back @ task[:, :seen]),
        joint=_unit_rows(statics.from_torque @ joint[:, :seen]),
        infinite_task=_unit_rows(back @ known),
        zero_joint=_unit_rows(statics.from_torque @ inside),
    )


def _passive(grasp: FloatGrasp) -> Split:
    return split(grasp.jp, None if grasp.ranks is None else grasp.ranks.p)


def _kinematic(
    grasp: FloatGrasp, weights: Weights, passive: Split
) -> tuple[Index, tuple[Split, ...]]:
    """Object against actuators, both as short as they can be chosen."""
    ranks = grasp.ranks
    feeling = passive.left_null_space.T
    to_rates, to_twist = _root(weights.rates), _root(weights.twist)
    from_rates = _back(to_rates, grasp.ja.shape[1])
    from_twist = _back(to_twist, grasp.gt.shape[1])
    a = feeling @ grasp.ja @ from_rates
    b = feeling @ grasp.gt @ from_twist
    driven = split(a, None if ranks is None else ranks.ap - ranks.p)
    moved = split(b, None if ranks is None else ranks.po - ranks.p)
    x = a @ driven.row_space
    y = b @ moved.row_space
    both = split(
        np.concatenate([x, -y], axis=1), None if ranks is None else ranks.apo - ranks.p
    )
    x, y = np.split(both.null_space, [x.shape[1]])
    scales, joint, task = _stationary(x, y)
    joint, task = driven.row_space @ joint, moved.row_space @ task
    images = from_twist @ task * scales
    return (
        Index(
            finite=scales**2,
            infinite=moved.null_space.shape[1],
            zero=driven.null_space.shape[1],
            task=_unit_rows(from_twist @ task),
            joint=_unit_rows(from_rates @ joint),
            infinite_task=_unit_rows(from_twist @ moved.null_space),
            zero_joint=_unit_rows(from_rates @ driven.null_space),
            shape=images @ images.T,
        ),
        (passive, driven, moved, both),
    )


def _stationary(x: Array, y: Array) -> tuple[Array, Array, Array]:
    """Stationary ratios |y w|/|x w|, descending, with the unit vectors x w and y w.

    ``x`` has full column rank; where ``y`` has not, the last ratios are zero.
    """
    k = x.shape[1]
    if not k:
        return np.zeros(0), np.zeros((x.shape[0], 0)), np.zeros((y.shape[0], 0))
    q, r = np.linalg.qr(x)
    u, values, vt = np.linalg.svd(np.linalg.solve(r.T, y.T).T, full_matrices=False)
    return values, q @ vt.T, u


@dataclass(frozen=True)
class Statics:
    """Contact forces φ that passive joints do not feel, and what they do.

    Attributes:
        forces: Orthonormal basis of K = ker J_pᵀ, one column each.
        torques, wrenches: What a force of that basis does, in weighted coordinates.
        torque_span: Orthonormal basis of the torques of forces that leave the object
            in balance, weighted.
        wrench_span: Of the wrenches of forces without torque, weighted.
        quiet: Forces (in the basis) that have no torque.
        inner: That leave the object in balance.
        silent: That do both.
        others: Orthonormal complement of the first two together.
        from_torque, from_wrench: Back from weighted coordinates.
    """

    forces: Array
    torques: Array
    wrenches: Array
    torque_span: Array
    wrench_span: Array
    quiet: Array
    inner: Array
    silent: Array
    others: Array
    from_torque: Array
    from_wrench: Array
    gap: float

    @classmethod
    def of(cls, grasp: FloatGrasp, weights: Weights, passive: Split) -> Statics:
        """At the posture of a grasp, whose passive joints are split."""
        ranks = grasp.ranks
        forces = passive.left_null_space
        to_torque, to_wrench = _root(weights.torques), _root(weights.wrench)
        torques = -_through(to_torque, grasp.ja.T @ forces)
        wrenches = _through(to_wrench, grasp.g @ forces)
        one = split(torques, None if ranks is None else ranks.ap - ranks.p)
        two = split(wrenches, None if ranks is None else ranks.po - ranks.p)
        both = split(
            np.concatenate([torques, wrenches]),
            None if ranks is None else ranks.apo - ranks.p,
        )
        quiet, inner = one.null_space, two.null_space
        silent = both.null_space
        inside = inner.shape[1] - silent.shape[1]
        structural = quiet.shape[1] - silent.shape[1]
        torque = split(torques @ inner, inside)
        wrench = split(wrenches @ quiet, structural)
        span = np.concatenate([quiet, inner], axis=1)
        total = split(span, inside + structural + silent.shape[1])
        return cls(
            forces,
            torques,
            wrenches,
            torque.column_space,
            wrench.column_space,
            quiet,
            inner,
            silent,
            total.left_null_space,
            _back(to_torque, grasp.ja.shape[1]),
            _back(to_wrench, grasp.gt.shape[1]),
            min(passive.gap, one.gap, two.gap, both.gap),
        )


def _force(statics: Statics) -> Index:
    """Wrench against torque, least over S above and over H below."""
    x = without(statics.torques @ statics.others, statics.torque_span)
    y = without(statics.wrenches @ statics.others, statics.wrench_span)
    scales, joint, task = _stationary(x, y)
    images = statics.from_wrench @ task * scales
    return Index(
        finite=scales**2,
        infinite=0,
        zero=0,
        task=_unit_rows(statics.from_wrench @ task),
        joint=_unit_rows(statics.from_torque @ joint),
        shape=images @ images.T,
    )


def _with(
    index: Index,
    infinite: int = 0,
    zero: int = 0,
    infinite_task: Array | None = None,
    zero_joint: Array | None = None,
) -> Index:
    """The same finite values with infinite and zero ones beside them."""
    return Index(
        index.finite,
        infinite,
        zero,
        index.task,
        index.joint,
        index.infinite_task if infinite_task is None else infinite_task,
        index.zero_joint if zero_joint is None else zero_joint,
        index.shape,
    )


def _root(weight: Array | None) -> Array | None:
    """Upper triangle C with CᵀC = W."""
    return None if weight is None else np.asarray(np.linalg.cholesky(weight).T)


def _through(root: Array | None, columns: Array) -> Array:
    return columns if root is None else np.asarray(root @ columns)


def _back(root: Array | None, size: int) -> Array:
    """From weighted coordinates to plain ones."""
    return np.eye(size) if root is None else np.asarray(np.linalg.inv(root))


def _unit_rows(columns: Array) -> Array:
    """Columns as rows of unit length, the largest entry positive."""
    rows = np.array(columns.T)
    if not rows.size:
        return rows
    sizes = np.sqrt((rows * rows).sum(axis=1, keepdims=True))
    units = rows / np.where(sizes > 0.0, sizes, 1.0)
    large = np.abs(units)
    units[large < 1e-15] = 0.0
    first = (large > large.max(axis=1, keepdims=True) * (1 - 1e-9)).argmax(axis=1)
    return np.asarray(units * np.sign(units[np.arange(len(units)), first])[:, None])
