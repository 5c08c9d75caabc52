"""Tables that close loops: values of the variables at which every row agrees.

Where joints of an ``mdh`` table place a link that others have placed already, the
variables are tied together, and most values of them describe no posture at all.

References: [KhalilKleinfinger1986].
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.errors import UndecidedError
from screwkit.kinematics.grasp import matrices
from screwkit.kinematics.loops import ring_at, unknown_joint
from screwkit.kinematics.placement import (
    parent_from_joint,
    placed_links,
    table_joints,
)
from screwkit.mechanism.model import Mechanism

OPEN = 1e-9
"""What a table may miss where it places a link twice: radians and lengths."""

NEWTON_STEPS = 6
"""Steps that polish what the search has found."""


def table_misses(mechanism: Mechanism, ring: BatchRing) -> Mapping[str, Array]:
    """By what each joint misses the link that other joints have placed already.

    Returns:
        Differences of rotation matrix and shift by joint, batch + (12,); 0 for the
        joints by which the links were placed.
    """
    placed = placed_links(mechanism, ring, mechanism.base)
    found = {}
    for joint in table_joints(mechanism):
        if joint.mdh is None or not {joint.parent, joint.child} <= placed.keys():
            continue
        step = parent_from_joint(joint, joint.mdh, ring)
        turn, shift = matrices(placed[joint.parent].then(step, ring))
        there, where = matrices(placed[joint.child])
        parts = (turn - there).reshape(*turn.shape[:-2], 9), shift - where
        batch = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
        wide = [np.broadcast_to(p, (*batch, p.shape[-1])) for p in parts]
        found[joint.name] = np.concatenate(wide, axis=-1)
    return found


def require_closed(mechanism: Mechanism, ring: BatchRing) -> None:
    """Refuse a posture at which the table contradicts itself.

    Raises:
        UndecidedError: With the joint that misses most.
    """
    sizes = {name: np.abs(miss) for name, miss in table_misses(mechanism, ring).items()}
    worst = max(sizes, key=lambda name: float(sizes[name].max()), default="")
    if worst and float(sizes[worst].max()) > OPEN:
        raise UndecidedError(
            f"the values leave the loop at joint {worst!r} open by "
            f"{sizes[worst][:9].max():.2g} rad and {sizes[worst][9:].max():.2g}"
        )


def close_table(
    mechanism: Mechanism, guess: Mapping[str, float], fixed: Collection[str] = ()
) -> dict[str, float]:
    """Values near a guess at which all rows of a table agree.

    Args:
        mechanism: An ``mdh`` mechanism.
        guess: A value of every joint variable, in radians and file lengths.
        fixed: Variables that keep the value of the guess.

    Raises:
        UndecidedError: If no such values were found near the guess.
        UnknownNameError: If a variable has no value.
        KeyError: If ``fixed`` names no variable.
    """
    from scipy.optimize import least_squares  # noqa: PLC0415

    variables = mechanism.joint_variables
    for name in fixed:
        if name not in variables:
            raise KeyError(unknown_joint(name, variables))
    free = [name for name in variables if name not in fixed and name in guess]

    def miss(values: Array) -> Array:
        changed = {name: values[..., i] for i, name in enumerate(free)}
        ring = ring_at(mechanism, {**guess, **changed})
        parts = list(table_misses(mechanism, ring).values())
        batch = values.shape[:-1]
        wide = [np.broadcast_to(part, (*batch, 12)) for part in parts]
        return np.concatenate([np.zeros((*batch, 1)), *wide], axis=-1)

    def slope(values: Array) -> Array:
        nudge = 1e-6 * np.eye(len(free))
        return np.asarray((miss(values + nudge) - miss(values - nudge)).T / 2e-6)

    values = np.array([float(guess[name]) for name in free])
    if free:
        values = least_squares(miss, values, slope).x
        for _ in range(NEWTON_STEPS):
            values = values - np.linalg.pinv(slope(values), rcond=1e-6) @ miss(values)
    closed = {**guess, **{n: float(v) for n, v in zip(free, values, strict=True)}}
    require_closed(mechanism, ring_at(mechanism, closed))
    return closed
