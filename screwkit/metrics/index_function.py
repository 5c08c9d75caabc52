"""Indices as functions of arrays: thousands of postures or designs at once.

What is exact is decided once: the ranks, which joints to eliminate, how many values
are finite.  Then numpy does the same steps for all postures together.  A posture at
which a pivot nearly vanishes is taken out and looked at by singular values; there,
values that are infinite or lost are reported as inf and 0.

References: [BicchiPrattichizzo] eqs. (13), (24), §IV-D (duality).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.errors import ExpressionError
from screwkit.grasping.exact_grasp import exact_grasps
from screwkit.grasping.matrices import GraspMatrices, grasp_matrices
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.elimination_plan import Group, Plan, mixing, plan_of
from screwkit.metrics.float_grasp import float_weights, of_matrices
from screwkit.metrics.float_ranks import float_ranks
from screwkit.metrics.indices import FloatGrasp, Weights, indices
from screwkit.metrics.reflections import (
    back_substituted,
    eliminated,
    product,
    row_and_null_space,
    squared_singular_values,
)

Kind: TypeAlias = Literal["kinematic", "force"]

SMALL = 1e-9
"""Pivots and semi-axes below this part of the largest are looked at singly."""

CHUNK = 8192
"""Postures at a time."""


@dataclass(frozen=True)
class IndexFunction:
    """The finite values of an index over symbols and joint variables.

    Attributes:
        mechanism: Symbols that are not varied have their numbers.
        kind: ``kinematic`` (13) or ``force`` (24).
        plan: What holds at a generic posture.
    """

    mechanism: Mechanism
    kind: Kind
    plan: Plan

    @property
    def count(self) -> int:
        """Finite values at a generic posture."""
        return self.plan.coordinated

    def __call__(self, values: Mapping[str, Array | float]) -> Array:
        """The values at postures.

        Args:
            values: Of symbols and joint variables by name, broadcasting over one batch;
                others have those of the file, joint variables 0.

        Returns:
            Shape batch + (count,), descending; inf and 0 where a posture is singular.

        Raises:
            UnknownNameError: If a symbol has no value.
            ExpressionError: If a weight is not positive definite somewhere.
        """
        arrays = {name: np.asarray(v, dtype=float) for name, v in values.items()}
        batch = np.broadcast_shapes(*(v.shape for v in arrays.values()))
        flat = {
            name: np.broadcast_to(v, batch).reshape(-1) for name, v in arrays.items()
        }
        size = int(np.prod(batch))
        found = np.empty((size, self.count))
        for start in range(0, size, CHUNK):
            part = slice(start, start + CHUNK)
            found[part] = self._chunk({name: v[part] for name, v in flat.items()})
        return found.reshape(*batch, self.count)

    def padded(self, grasp: FloatGrasp, weights: Weights) -> Array:
        """The values at one posture by singular values, padded with inf and 0.

        As many as at a generic posture; more only where the generic ranks are those of
        a posture that is itself singular.
        """
        if not all(np.isfinite(part).all() for part in (grasp.ja, grasp.jp, grasp.gt)):
            return np.full(self.count, np.nan)
        ranks, _, _ = float_ranks(grasp)
        found = indices(replace(grasp, ranks=ranks), weights)
        generic = self.plan.ranks
        finite, more = found.kinematic.finite, ranks.indeterminacy
        more -= generic.indeterminacy
        if self.kind == "force":
            finite, more = found.force.finite, ranks.structural - generic.structural
        values = [*[np.inf] * max(more, 0), *finite]
        return np.array([*values, *[0.0] * (self.count - len(values))])

    def _chunk(self, values: Mapping[str, Array]) -> Array:
        size = max((len(v) for v in values.values()), default=1)
        matrices = self._matrices(values)
        weights = float_weights(self.mechanism, None, values)
        found, regular = _values(matrices, size, self._roots(weights), self.plan)
        np.minimum(regular, _evenness(found), out=regular)
        if self.kind == "force":
            with np.errstate(divide="ignore"):
                found = 1.0 / found[:, ::-1]
        singular = np.flatnonzero(~(regular > SMALL))
        if len(singular):
            whole = of_matrices(matrices, None)
            for number in singular:
                own = _at(whole, int(number)), _weights_at(weights, int(number))
                found[number] = self.padded(*own)[: self.count]
        return found

    def _matrices(self, values: Mapping[str, Array]) -> GraspMatrices[Array]:
        known: dict[str, Array | float] = {}
        if self.mechanism.geometry != "posture":
            known = dict.fromkeys(self.mechanism.joint_variables, 0.0)
        known.update(values)
        return grasp_matrices(self.mechanism, ring_at(self.mechanism, known))

    def _roots(self, weights: Weights) -> tuple[Array | None, Array | None]:
        """By what rates and twists are divided: roots of the weights, inverted."""
        try:
            if self.kind == "kinematic":
                return _inverse_root(weights.rates), _inverse_root(weights.twist)
            # By duality the force index is the reciprocal with the inverse weights.
            wrench, torques = weights.wrench, _inverse(weights.torques)
            if wrench is not None:
                order = [2, 0, 1] if wrench.shape[-1] == 3 else [3, 4, 5, 0, 1, 2]
                wrench = wrench[..., order, :][..., order]
            return _inverse_root(torques), _inverse_root(_inverse(wrench))
        except np.linalg.LinAlgError:
            raise ExpressionError(
                "a weight is not positive definite at some of these values"
            ) from None


def index_function(mechanism: Mechanism, kind: Kind = "kinematic") -> IndexFunction:
    """The finite values of an index as a function of what the mechanism leaves free.

    Args:
        mechanism: Its scheme decides what is actuated.
        kind: Which index.

    Raises:
        UndecidedError: If there is no exact point.
    """
    (grasp,) = exact_grasps(mechanism, (1,))
    return IndexFunction(mechanism, kind, plan_of(grasp))


def _values(
    matrices: GraspMatrices[Array],
    size: int,
    roots: tuple[Array | None, Array | None],
    plan: Plan,
) -> tuple[Array, Array]:
    """Squared semi-axes of T in u' = T q', and how regular every posture is."""
    actuated, regular = len(matrices.actuated), np.ones(size)
    left = []
    for group in plan.groups:
        count = len(group.passive)
        own = _rows(matrices, group, size)
        np.minimum(regular, eliminated(own, count), out=regular)
        left.append(own[count:, count:])
    width = actuated + matrices.twist_size
    whole = np.concatenate([np.zeros((0, width, size)), *left])
    a, b = (
        _weighted(whole[:, :actuated], roots[0]),
        _weighted(whole[:, actuated:], roots[1]),
    )
    moved = plan.moved
    if moved < min(b.shape[:2]):
        mix = mixing(len(b))
        a, b = np.tensordot(mix, a, 1), np.tensordot(mix, b, 1)
    if moved < b.shape[1]:
        along, _, how = row_and_null_space(b, moved)
        np.minimum(regular, how, out=regular)
        b = product(b, along)
    both = np.concatenate([b, a], axis=1)
    np.minimum(regular, eliminated(both, moved), out=regular)
    top, bottom = both[:moved, moved:], both[moved:, moved:]
    tied = plan.both - moved
    if tied:
        mixed = np.tensordot(mixing(len(bottom)), bottom, 1)
        _, allowed, how = row_and_null_space(mixed, tied)
        np.minimum(regular, how, out=regular)
        top = product(top, allowed)
    image = back_substituted(both[:moved, :moved], top)
    bad = ~np.isfinite(image).all(axis=(0, 1))
    image[:, :, bad], regular[bad] = 0.0, 0.0
    return squared_singular_values(image, plan.coordinated), regular


def _rows(matrices: GraspMatrices[Array], group: Group, size: int) -> Array:
    """The rows of a group: passive columns, actuated ones per unit axis, the object's.

    Rows keep the length of their directions, which scales an equation and no more.
    """
    split = len(matrices.actuated)
    width = len(group.passive) + split + matrices.twist_size
    whole = np.zeros((len(group.rows), width, size))
    lengths = {k: _length(matrices.strokes[k]) for k in group.actuated}
    for own, row in zip(whole, group.rows, strict=True):
        for place, column in enumerate(group.passive):
            own[place] = matrices.j[row][split + column]
        for column in group.actuated:
            own[len(group.passive) + column] = matrices.j[row][column] / lengths[column]
        for place, entry in enumerate(matrices.gt[row], len(group.passive) + split):
            own[place] = entry
    return whole


def _length(square: Array) -> Array:
    return np.sqrt(np.asarray(square))


def _evenness(values: Array) -> Array:
    """Of each posture, the smallest semi-axis over the largest; 0 where all are 0."""
    if not values.shape[1]:
        return np.ones(len(values))
    least, largest = np.sqrt(values[:, -1]), np.sqrt(values[:, 0])
    return np.divide(least, largest, out=np.zeros_like(least), where=largest > 0)


def _at(grasp: FloatGrasp, number: int) -> FloatGrasp:
    """One posture of a batch."""
    ja, jp, gt = (
        part[number] if part.ndim > 2 else part
        for part in (grasp.ja, grasp.jp, grasp.gt)
    )
    return FloatGrasp(ja, jp, gt)


def _weights_at(weights: Weights, number: int) -> Weights:
    """Its weights."""
    twist, rates, wrench, torques = (
        part[number] if part is not None and part.ndim > 2 else part
        for part in (weights.twist, weights.rates, weights.wrench, weights.torques)
    )
    return Weights(twist, rates, wrench, torques)


def _weighted(columns: Array, root: Array | None) -> Array:
    if root is None:
        return columns
    if root.ndim > 2:
        return np.asarray(np.einsum("ijb,bjk->ikb", columns, root))
    return np.asarray(np.einsum("ijb,jk->ikb", columns, root))


def _inverse(weight: Array | None) -> Array | None:
    return None if weight is None else np.asarray(np.linalg.inv(weight))


def _inverse_root(weight: Array | None) -> Array | None:
    """C⁻¹ for CᵀC = W."""
    if weight is None:
        return None
    lower = np.linalg.cholesky(weight)
    return np.asarray(np.linalg.inv(lower.swapaxes(-1, -2)))
