"""The grasp: where one limb's end is, seen from another's, by six parameters.

Two frames fixed on links that hold one rigid object keep their relative displacement;
it is written as rot_z(γ) trans_z(b) rot_x(α) trans_x(d) rot_z(θ) trans_z(r), computed
from a posture and back.  Every displacement has two such sextuples, and infinitely
many where sin α = 0, of which one is chosen by convention.

References: [LongCaroKhalil2012] eqs. (1), (2); [KhalilKleinfinger1986].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.errors import UndecidedError
from screwkit.kinematics.loops import (
    LimbPath,
    Posture,
    end_link,
    limb_paths,
    ring_at,
    stacked,
)
from screwkit.kinematics.placement import placed_links
from screwkit.mechanism.model import Mechanism
from screwkit.screw.displacement import Displacement, screw_about

DEGENERATE = 1e-8
"""Up to this |sin α| the axes z of the two frames count as parallel.

Taking them as parallel misses by |sin α|; not doing so loses 1e-16/|sin α| of the
translation in b ± r.  The two are equal here.
"""


@dataclass(frozen=True)
class GraspFrame:
    """Six parameters of a displacement; arrays over a batch, or floats.

    The displacement is rot_z(gamma) trans_z(b) rot_x(alpha) trans_x(d) rot_z(theta)
    trans_z(r): angles in radians, lengths in the units of the mechanism.

    References: [LongCaroKhalil2012] eq. (2).
    """

    gamma: Array | float
    b: Array | float
    alpha: Array | float
    d: Array | float
    theta: Array | float
    r: Array | float

    def displacement(self) -> Displacement[Array]:
        """The displacement that the six parameters describe; entries over the batch."""
        ring = BatchRing({})
        first = screw_about(2, _pair(self.gamma), np.asarray(self.b), ring)
        second = screw_about(0, _pair(self.alpha), np.asarray(self.d), ring)
        last = screw_about(2, _pair(self.theta), np.asarray(self.r), ring)
        return first.then(second, ring).then(last, ring)

    def other_solution(self) -> GraspFrame:
        """The same displacement on the other branch; angles in (−π, π]."""
        return GraspFrame(
            gamma=_half_turn(self.gamma),
            b=self.b,
            alpha=-np.asarray(self.alpha),
            d=-np.asarray(self.d),
            theta=_half_turn(self.theta),
            r=self.r,
        )


def grasp_frame(
    rotation: Array,
    translation: Array,
    branch: int = 1,
    *,
    degenerate: float = DEGENERATE,
) -> GraspFrame:
    """Six parameters of displacements x ↦ rotation·x + translation.

    On branch +1 sin α ≥ 0, on branch −1 sin α ≤ 0.  Where sin α = 0 only γ ± θ and
    b ± r are determined; there r = 0 and d ≥ 0 on both branches, and γ is the direction
    of the translation (0 where that is along z).  The displacement is met to rounding
    where sin α is zero or not small, and to 1e-8 at worst in between (`DEGENERATE`).

    Args:
        rotation: Shape batch + (3, 3).
        translation: Shape batch + (3,).
        branch: +1 or −1.
        degenerate: The |sin α| up to which the degenerate rule is taken.

    Returns:
        Arrays of shape batch; angles in (−π, π].

    Raises:
        ValueError: If ``branch`` is not ±1 or the shapes do not fit.

    References: [LongCaroKhalil2012] eqs. (1), (2).
    """
    if branch not in (1, -1):
        raise ValueError("the branch is 1 or -1")
    turn, p = np.asarray(rotation, dtype=float), np.asarray(translation, dtype=float)
    if turn.shape[-2:] != (3, 3) or p.shape[-1:] != (3,):
        raise ValueError("rotation has shape batch + (3, 3), translation batch + (3,)")
    batch = np.broadcast_shapes(turn.shape[:-2], p.shape[:-1])
    turn = np.broadcast_to(turn, (*batch, 3, 3))
    p = np.broadcast_to(p, (*batch, 3))
    x, y, z = p[..., 0], p[..., 1], p[..., 2]
    size = np.hypot(turn[..., 0, 2], turn[..., 1, 2])
    parallel = size <= degenerate
    sine = np.where(parallel, 0.0, branch * size)
    alpha = _angle(sine, turn[..., 2, 2])
    gamma = np.where(
        parallel,
        _angle(y, x),
        _angle(branch * turn[..., 0, 2], -branch * turn[..., 1, 2]),
    )
    c, s = np.cos(gamma), np.sin(gamma)
    facing = np.where(turn[..., 2, 2] < 0, -1.0, 1.0)  # cos α where sin α = 0
    theta = np.where(
        parallel,
        _angle(
            facing * (c * turn[..., 1, 0] - s * turn[..., 0, 0]),
            c * turn[..., 0, 0] + s * turn[..., 1, 0],
        ),
        _angle(branch * turn[..., 2, 0], branch * turn[..., 2, 1]),
    )
    r = np.where(parallel, 0.0, (x * s - y * c) / np.where(parallel, 1.0, sine))
    d = np.where(parallel, np.hypot(x, y), x * c + y * s)
    b = z - r * turn[..., 2, 2]
    return GraspFrame(gamma, b, alpha, d, theta, r)


def grasp_displacement(
    mechanism: Mechanism,
    posture: Posture,
    limbs: Sequence[LimbPath],
    *,
    of: int = 1,
    seen_from: int = 0,
) -> tuple[Array, Array]:
    """Where the end of one limb is, seen from the end of another.

    Args:
        mechanism: An ``mdh`` mechanism.
        posture: Values by joint variable, broadcasting over one batch.
        limbs: Moving joints of each limb from base to platform.
        of: Position in ``limbs`` of the limb whose end is described.
        seen_from: Position of the limb in whose end frame it is described.

    Returns:
        Rotation, shape batch + (3, 3), and translation, shape batch + (3,).

    Raises:
        UnknownNameError: If a joint or a value is missing.
        UndecidedError: If the table does not connect the two ends.
    """
    paths = limb_paths(mechanism, limbs)
    origin, target = (end_link(mechanism, paths[i]) for i in (seen_from, of))
    placed = placed_links(mechanism, ring_at(mechanism, posture), origin)
    if target not in placed:
        raise UndecidedError(f"the table does not connect {target!r} with {origin!r}")
    return matrices(placed[target])


def grasp_of(
    mechanism: Mechanism,
    posture: Posture,
    limbs: Sequence[LimbPath],
    *,
    of: int = 1,
    seen_from: int = 0,
    branch: int = 1,
) -> GraspFrame:
    """Six parameters of the grasp at a posture: ⁵T₁₁ = (⁰T₅)⁻¹ ⁰T₁₀ of the paper.

    Arguments and errors are those of `grasp_displacement` and `grasp_frame`.

    References: [LongCaroKhalil2012] eqs. (1), (2), Table 1 row 11.
    """
    rotation, translation = grasp_displacement(
        mechanism, posture, limbs, of=of, seen_from=seen_from
    )
    return grasp_frame(rotation, translation, branch)


def matrices(displacement: Displacement[Array]) -> tuple[Array, Array]:
    """A displacement as arrays of shapes batch + (3, 3) and batch + (3,)."""
    columns = [
        (*row, shift)
        for row, shift in zip(
            displacement.rotation, displacement.translation, strict=True
        )
    ]
    whole = stacked(columns)
    return whole[..., :3], whole[..., 3]


def _pair(angle: Array | float) -> tuple[Array, Array]:
    return np.asarray(np.cos(angle)), np.asarray(np.sin(angle))


def _angle(sine: Array, cosine: Array) -> Array:
    """``arctan2`` in (−π, π]: a negative zero is no reason for −π."""
    return np.asarray(np.arctan2(np.asarray(sine) + 0.0, np.asarray(cosine) + 0.0))


def _half_turn(angle: Array | float) -> Array:
    turned = np.asarray(angle) + np.pi
    return np.asarray(np.where(turned > np.pi, turned - 2 * np.pi, turned))
