"""Arms that hold one object rigidly: absolute and relative, external and internal.

The formulation of [ChiacchioEtAl1990] in corrected form, for any number of arms: W adds
the arms' wrenches up on the object, V spans the wrenches that cancel there.  For more
than two arms, which the paper leaves open, an internal force is a set of wrenches h'_i
at the object point with Σ h'_i = 0, and its size is |h_r|² = ½ Σ |h'_i|², which for two
arms is that of the paper, h'_1 = −h'_2 = h_r; no arm is preferred to another.

Coordinates here are those of the paper, linear first: (v; ω) and (f; n); in the plane
(v_x, v_y, ω) and (f_x, f_y, n).

References: [ChiacchioEtAl1990] eqs. (4)-(39), Appendices A and B, corrected.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array


@dataclass(frozen=True)
class Arm:
    """One arm at a posture.

    Attributes:
        jacobian: J_i of its end point p_i, shape (m, n_i), of full row rank; m is 3 in
            the plane and 6 in space.
        offset: r_ia = p_a − p_i, from the end point to the object point.
    """

    jacobian: Array
    offset: Array

    @property
    def lever(self) -> Array:
        """R_ia with f × r_ia = −R_ia f, shape (1, 2) or (3, 3)."""
        if len(self.offset) == 2:
            x, y = self.offset
            return np.array([[-y, x]])
        x, y, z = self.offset
        return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])

    @property
    def to_object(self) -> Array:
        """W_i = [I 0; −R_ia I]: a wrench at p_i as one at p_a."""
        size, linear = self.jacobian.shape[0], self.lever.shape[1]
        matrix = np.eye(size)
        matrix[linear:, :linear] = -self.lever
        return matrix

    @property
    def at_object(self) -> Array:
        """J~_i = W_i^{-T} J_i: the Jacobian of the object point, (31)."""
        return np.asarray(np.linalg.solve(self.to_object.T, self.jacobian))


def external_matrix(arms: Sequence[Arm]) -> Array:
    """W = [W_1 … W_k]: h_a = W f, and ż = Wᵀ ẏ_a; (5), (4), (11)."""
    return np.concatenate([arm.to_object for arm in arms], axis=1)


def internal_matrix(arms: Sequence[Arm]) -> Array:
    """V, whose columns span ker W: f = V h_r, and ẏ_r = Vᵀ ż; (7), (6), (12).

    For two arms it is that of the paper; for more its columns are orthonormal in
    ½ Σ |h'_i|², so that the ellipsoids do not depend on the choice.
    """
    if len(arms) == 2:
        shares = np.array([[1.0], [-1.0]])
    else:
        shares = np.sqrt(2.0) * _contrasts(len(arms))
    return np.concatenate(
        [
            np.kron(share, np.linalg.inv(arm.to_object))
            for arm, share in zip(arms, shares, strict=True)
        ]
    )


def _contrasts(count: int) -> Array:
    """Orthonormal basis of the vectors whose entries add up to 0, as columns."""
    matrix = np.zeros((count, max(count - 1, 0)))
    for k in range(count - 1):
        matrix[: k + 1, k] = 1.0
        matrix[k + 1, k] = -(k + 1.0)
        matrix[:, k] /= np.sqrt((k + 1.0) * (k + 2.0))
    return matrix


def extended_jacobian(arms: Sequence[Arm]) -> Array:
    """J_12 = diag(J_1, …, J_k), (21)."""
    rows = sum(arm.jacobian.shape[0] for arm in arms)
    columns = sum(arm.jacobian.shape[1] for arm in arms)
    matrix = np.zeros((rows, columns))
    row = column = 0
    for arm in arms:
        m, n = arm.jacobian.shape
        matrix[row : row + m, column : column + n] = arm.jacobian
        row, column = row + m, column + n
    return matrix


def absolute_jacobian(arms: Sequence[Arm]) -> Array:
    """J_a, whose transposed pseudo-inverse is W J_12^{T+}; (24)."""
    inverse = external_matrix(arms) @ np.linalg.pinv(extended_jacobian(arms)).T
    return np.asarray(np.linalg.pinv(inverse).T)


def relative_jacobian(arms: Sequence[Arm]) -> Array:
    """J_r = Vᵀ J_12, (33)."""
    return np.asarray(internal_matrix(arms).T @ extended_jacobian(arms))


def in_parallel(arms: Sequence[Arm]) -> Array:
    """J_a J_aᵀ from the single arms, as impedances side by side; (30)."""
    total = sum(np.linalg.inv(arm.at_object @ arm.at_object.T) for arm in arms)
    return np.asarray(np.linalg.inv(total))


def in_series(arms: Sequence[Arm]) -> Array:
    """J_r J_rᵀ from the single arms, as impedances one after the other; (37).

    For two arms J^_1 J^_1ᵀ + J^_2 J^_2ᵀ; J^_i is the Jacobian of the object point.
    """
    if len(arms) == 2:
        return np.asarray(sum(arm.at_object @ arm.at_object.T for arm in arms))
    shares = np.sqrt(2.0) * _contrasts(len(arms))
    return np.asarray(
        sum(
            np.kron(np.outer(share, share), arm.at_object @ arm.at_object.T)
            for arm, share in zip(arms, shares, strict=True)
        )
    )


def shares(arms: Sequence[Arm]) -> tuple[Array, Array]:
    """What part of the whole each arm has along the axes of the absolute ellipsoid.

    Of the squared torque that balances an external force along an axis d, and equally
    of the squared rates of a motion along it, arm i has the part
    dᵀ(J~_i J~_iᵀ)⁻¹d / dᵀ(J_a J_aᵀ)⁻¹d.

    Returns:
        The axes as columns, longest first, and shape (arms, m), columns that add to 1.
    """
    parts = [np.linalg.inv(arm.at_object @ arm.at_object.T) for arm in arms]
    values, axes = np.linalg.eigh(np.asarray(sum(parts)))
    along = np.array([np.einsum("ji,jk,ki->i", axes, part, axes) for part in parts])
    return axes, along / values
