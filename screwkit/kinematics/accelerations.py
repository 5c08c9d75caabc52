"""Passive and cut joint accelerations from the actuated ones.

The loop equations differentiated once: J_c q̈ + J̇_c q̇ = 0.  A joint's twist changes
because the joints before it carry its axis along, so J̇_c q̇ is a sum of Lie brackets of
the columns already at hand; nothing is differenced.  The dot is missing in print.

References: [LongCaroKhalil2012] eq. (13), corrected.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.algebra.ring import Ring, S
from screwkit.conventions import DIRECTION, MOMENT, SCREW_DIMENSION
from screwkit.kinematics.loops import LoopMatrix
from screwkit.kinematics.rates import RateConstraints, applied
from screwkit.screw import vector


def lie_bracket(left: Sequence[S], right: Sequence[S]) -> tuple[S, ...]:
    """[left, right] of two twists (ω; v): the rate of ``right`` carried by ``left``.

    Both and the result are in one frame about its origin: (ω₁×ω₂; ω₁×v₂ + v₁×ω₂).
    """
    turn, shift = left[DIRECTION], left[MOMENT]
    direction, moment = right[DIRECTION], right[MOMENT]
    return (
        *vector.cross(turn, direction),
        *vector.add(vector.cross(turn, moment), vector.cross(shift, direction)),
    )


def velocity_products(
    matrix: LoopMatrix[S], rates: Mapping[str, S], ring: Ring[S]
) -> tuple[S, ...]:
    """J̇_c q̇ for rates that keep the loops closed, one entry a row of ``matrix``.

    In a loop with signed twists c₁ … c_n in the order of the walk it is
    Σ_{i<j} q̇_i q̇_j [c_i, c_j].  For closing rates, J_c q̇ = 0, neither the frame of a
    loop's rows, moving or not, nor the joint at which the walk starts matters.

    Args:
        matrix: J_c over any ring.
        rates: The rate of every joint, by name.
        ring: The ring of both.

    References: [LongCaroKhalil2012] eq. (13), corrected.
    """
    result: list[S] = []
    for number, loop in enumerate(matrix.loops):
        before: tuple[S, ...] = (ring.zero,) * SCREW_DIMENSION
        total = before
        for name, _ in loop:
            rate = rates[name]
            own = tuple(x * rate for x in matrix.column(number, name))
            change = lie_bracket(before, own)
            total = tuple(
                ring.normal(a + b) for a, b in zip(total, change, strict=True)
            )
            before = tuple(ring.normal(a + b) for a, b in zip(before, own, strict=True))
        result.extend(total)
    return tuple(result)


def accelerations(
    constraints: RateConstraints, active_rates: Array, active_accelerations: Array
) -> Array:
    """All joint accelerations from rates and accelerations of the actuated joints.

    Args:
        constraints: The loop equations at a posture batch, solved for the scheme.
        active_rates: q̇_a, shape batch + (a,), in the order of ``constraints.actuated``.
        active_accelerations: q̈_a, of the same shape.

    Returns:
        q̈, shape batch + (joints,), in the order of ``constraints.joints``; nan where
        ``constraints`` holds nan.

    References: [LongCaroKhalil2012] eq. (13), corrected.
    """
    rates = constraints.rates(np.asarray(active_rates, dtype=float))
    active = np.asarray(active_accelerations, dtype=float)
    by_joint = {
        name: rates[..., index] for index, name in enumerate(constraints.joints)
    }
    products = velocity_products(constraints.matrix, by_joint, BatchRing({}))
    change: Array = np.stack(np.broadcast_arrays(*products), axis=-1)
    kept = change[..., list(constraints.kept_rows)]
    own = change[..., list(constraints.cut_rows)]
    passive: Array = -applied(
        constraints.g_p_inverse, applied(constraints.g_a, active) + kept
    )
    cut = -applied(
        np.asarray(np.linalg.inv(constraints.g_c), dtype=float),
        applied(constraints.g_ac, active) + applied(constraints.g_pc, passive) + own,
    )
    return constraints.assembled(active, passive, cut)
