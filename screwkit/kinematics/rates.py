"""Passive and cut joint rates from the actuated ones.

Each loop is cut at a passive joint and its six equations are written in that joint's
frame, where the cut rate enters one equation alone; the other five tie passive to
actuated rates.  The cut joint must be passive: a scheme that actuates the usual one is
cut elsewhere.

References: [LongCaroKhalil2012] eqs. (8)-(12).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.conventions import MOMENT, SCREW_DIMENSION
from screwkit.errors import ScrewkitError, UnknownNameError
from screwkit.kinematics.loops import (
    LimbPath,
    LoopMatrix,
    Posture,
    Step,
    limb_paths,
    loop_matrix,
    ring_at,
    stacked,
    unknown_joint,
)
from screwkit.mechanism.model import JointType, Mechanism

RECIPROCAL_CONDITION = 1e-10
"""Below this ratio of least to largest singular value, G_p counts as singular."""

INCONSISTENT = 1e-8
"""Above this relative residual, equations beyond the square ones contradict."""


class InadmissibleSchemeError(ScrewkitError):
    """The actuated joints cannot determine the others at any posture."""


class SingularPostureError(ScrewkitError):
    """At some postures the actuated joints do not determine the others.

    Attributes:
        postures: Positions in the flattened batch.
    """

    def __init__(self, message: str, postures: tuple[int, ...]) -> None:
        self.postures = postures
        super().__init__(message)


@dataclass(frozen=True)
class RateConstraints:
    """The loop equations sorted by actuated, passive and cut rates, and solved.

    With e equations free of the cut rates, a actuated, p passive and c cut joints::

        [ G_a   G_p   0  ]
        [ G_ac  G_pc  G_c]  (q̇_a; q̇_p; q̇_c) = 0

    Rows of a loop are written in the frame of its cut joint, in the order (ω; v), or
    in the base frame where the loop is not cut.

    Attributes:
        matrix: J_c with entries over the batch.
        actuated, passive, cut: Joint names, in the order of the columns of the blocks.
        g_a: Shape batch + (e, a).
        g_p: Shape batch + (e, p).
        g_ac, g_pc, g_c: Shapes batch + (c, a), (c, p), (c, c).
        g: q̇_p = G q̇_a, shape batch + (p, a); eq. (11).
        g_p_inverse: Left inverse of ``g_p``, shape batch + (p, e).
        kept_rows, cut_rows: The rows of ``matrix`` in the two block rows.

    References: [LongCaroKhalil2012] eqs. (8)-(12).
    """

    matrix: LoopMatrix[Array]
    actuated: tuple[str, ...]
    passive: tuple[str, ...]
    cut: tuple[str, ...]
    g_a: Array
    g_p: Array
    g_ac: Array
    g_pc: Array
    g_c: Array
    g: Array
    g_p_inverse: Array
    kept_rows: tuple[int, ...]
    cut_rows: tuple[int, ...]

    @property
    def joints(self) -> tuple[str, ...]:
        """All moving joints, in the order of the columns of J_c."""
        return self.matrix.joints

    @property
    def g_cut(self) -> Array:
        """q̇_c = g_cut q̇_a, shape batch + (c, a); eq. (12)."""
        return -np.linalg.inv(self.g_c) @ (self.g_ac + self.g_pc @ self.g)

    def passive_rates(self, active: Array) -> Array:
        """q̇_p, shape batch + (p,), from q̇_a, shape batch + (a,); eq. (10)."""
        return applied(self.g, active)

    def cut_rates(self, active: Array) -> Array:
        """q̇_c, shape batch + (c,), from q̇_a, shape batch + (a,); eq. (12)."""
        return applied(self.g_cut, active)

    def rates(self, active: Array) -> Array:
        """All joint rates, shape batch + (joints,), in the order of `joints`."""
        return self.assembled(
            active, self.passive_rates(active), self.cut_rates(active)
        )

    def assembled(self, active: Array, passive: Array, cut: Array) -> Array:
        """Values of the three groups, last axis, in the order of `joints`."""
        groups = [np.asarray(active, dtype=float), passive, cut]
        batch = np.broadcast_shapes(*(group.shape[:-1] for group in groups))
        together = np.concatenate(
            [np.broadcast_to(g, (*batch, g.shape[-1])) for g in groups], axis=-1
        )
        order = (*self.actuated, *self.passive, *self.cut)
        return together[..., [order.index(joint) for joint in self.joints]]


def rate_constraints(
    mechanism: Mechanism,
    posture: Posture,
    limbs: Sequence[LimbPath],
    actuated: Sequence[str],
    *,
    cuts: Sequence[str] | None = None,
    singular: Literal["raise", "nan"] = "raise",
) -> RateConstraints:
    """Sort and solve the loop equations for one actuation scheme.

    Args:
        mechanism: An ``mdh`` mechanism.
        posture: Values by joint variable, broadcasting over one batch.
        limbs: Moving joints of each limb from base to platform.
        actuated: Joint names; the order is that of q̇_a.
        cuts: One passive joint in every limb but one; none at all solves the six
            equations of every loop together.  Chosen by `chosen_cuts` where absent.
        singular: ``nan`` fills G where the scheme fails instead of raising.

    Raises:
        UnknownNameError: If a name is no joint of the limbs, or a value is missing.
        InadmissibleSchemeError: If the scheme fails by counting.
        SingularPostureError: If it fails at a posture of the batch: the passive columns
            are dependent, or redundant equations contradict each other.

    References: [LongCaroKhalil2012] eqs. (8)-(12).
    """
    paths = limb_paths(mechanism, limbs)
    names = [name for path in paths for name, _ in path]
    for name in (*actuated, *(cuts or ())):
        if name not in names:
            raise UnknownNameError(unknown_joint(name, names))
    if len(set(actuated)) < len(actuated):
        raise ValueError("an actuated joint is listed twice")
    reference, cut = chosen_cuts(paths, actuated, cuts)
    frames = tuple(mechanism.joint(name).child for name in cut)
    matrix = loop_matrix(
        mechanism,
        ring_at(mechanism, posture),
        limbs,
        reference=reference,
        frames=frames or None,
    )
    passive = tuple(n for n in names if n not in actuated and n not in cut)
    cut_rows = tuple(
        SCREW_DIMENSION * loop + _own_component(mechanism, name)
        for loop, name in enumerate(cut)
    )
    kept = tuple(i for i in range(len(matrix.rows)) if i not in cut_rows)
    if len(passive) > len(kept):
        raise InadmissibleSchemeError(
            f"{len(passive) + len(cut)} joints are passive and {len(matrix.rows)} loop "
            f"equations cannot determine them; actuate more joints"
        )
    whole = stacked(matrix.entries)

    def block(rows: Sequence[int], joints: Sequence[str]) -> Array:
        columns = [names.index(joint) for joint in joints]
        return whole[..., list(rows), :][..., columns]

    g_a, g_p = block(kept, actuated), block(kept, passive)
    inverse, g = _solved(g_a, g_p, singular)
    return RateConstraints(
        matrix=matrix,
        actuated=tuple(actuated),
        passive=passive,
        cut=cut,
        g_a=g_a,
        g_p=g_p,
        g_ac=block(cut_rows, actuated),
        g_pc=block(cut_rows, passive),
        g_c=block(cut_rows, cut),
        g=g,
        g_p_inverse=inverse,
        kept_rows=kept,
        cut_rows=cut_rows,
    )


def applied(matrix: Array, vector: Array) -> Array:
    """Matrix times column, both over a batch: (…, n, m) and (…, m) give (…, n)."""
    return np.asarray((matrix @ np.asarray(vector, dtype=float)[..., None])[..., 0])


def chosen_cuts(
    paths: Sequence[Sequence[Step]],
    actuated: Sequence[str],
    cuts: Sequence[str] | None = None,
) -> tuple[int, tuple[str, ...]]:
    """The reference limb, and the cut joint of every other limb in order.

    The reference is the limb that has no passive joint, else the first; each other limb
    is cut at its last passive joint.

    Raises:
        InadmissibleSchemeError: If two limbs have no passive joint, or a wanted cut is
            actuated.
        ValueError: If wanted cuts are not in all limbs but one.
    """
    if cuts is not None:
        return _wanted_cuts(paths, actuated, cuts)
    last = [
        next((n for n, _ in reversed(path) if n not in actuated), None)
        for path in paths
    ]
    stiff = [i for i, name in enumerate(last) if name is None]
    if len(stiff) > 1:
        raise InadmissibleSchemeError(
            f"limbs {', '.join(str(i + 1) for i in stiff)} have no passive joint: "
            f"their loop ties actuated joints to each other; actuate fewer of them"
        )
    reference = stiff[0] if stiff else 0
    chosen = (n for i, n in enumerate(last) if i != reference)
    return reference, tuple(name for name in chosen if name is not None)


def _wanted_cuts(
    paths: Sequence[Sequence[Step]], actuated: Sequence[str], cuts: Sequence[str]
) -> tuple[int, tuple[str, ...]]:
    if not cuts:
        return 0, ()
    for name in cuts:
        if name in actuated:
            raise InadmissibleSchemeError(
                f"joint {name!r} is actuated and cannot be cut; cut a passive joint"
            )
    limbs = {i: n for i, path in enumerate(paths) for n, _ in path if n in cuts}
    if len(limbs) != len(cuts) or len(cuts) != len(paths) - 1:
        raise ValueError("cut one joint in every limb but one")
    reference = next(i for i in range(len(paths)) if i not in limbs)
    return reference, tuple(limbs[i] for i in sorted(limbs))


def _own_component(mechanism: Mechanism, name: str) -> int:
    """The component that a joint's twist has in its own frame: ωz or vz."""
    prismatic = mechanism.joint(name).type is JointType.PRISMATIC
    return (MOMENT.start if prismatic else 0) + 2


def _solved(
    g_a: Array, g_p: Array, singular: Literal["raise", "nan"]
) -> tuple[Array, Array]:
    """The left inverse of G_p, and G = −G_p⁻¹ G_a."""
    finite = np.asarray(
        np.isfinite(g_p).all(axis=(-2, -1)) & np.isfinite(g_a).all(axis=(-2, -1))
    )
    safe = np.where(finite[..., None, None], g_p, 0.0)
    u, values, vt = np.linalg.svd(safe, full_matrices=False)
    least, largest = values[..., -1:], values[..., :1]
    well = np.asarray((least > RECIPROCAL_CONDITION * largest).all(axis=-1))
    regular = finite & well  # without passive joints nothing can be dependent
    values = np.where(regular[..., None], values, 1.0)
    inverse = np.swapaxes(vt, -1, -2) / values[..., None, :] @ np.swapaxes(u, -1, -2)
    g = -inverse @ np.where(finite[..., None, None], g_a, 0.0)
    left = np.abs(g_a + g_p @ g).max(axis=(-2, -1), initial=0.0)
    size = np.abs(g_a).max(axis=(-2, -1), initial=1.0)
    consistent = ~regular | (left <= INCONSISTENT * size)
    failed = ~(regular & consistent)
    if failed.any() and singular == "raise":
        where = tuple(int(i) for i in np.flatnonzero(failed))
        cause = (
            "the passive columns are dependent"
            if (~regular).any()
            else "the loop equations contradict each other: actuate fewer joints"
        )
        raise SingularPostureError(
            f"{len(where)} of {failed.size} postures, first at position {where[0]}: "
            f"{cause}; ask for singular='nan' to go on without them",
            where,
        )
    g[failed], inverse[failed] = np.nan, np.nan
    return inverse, g
