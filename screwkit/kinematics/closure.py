"""Closed motion of a grasp: move the actuated joints, keep every grasp frame.

The grasp is defined at a start posture, which therefore is closed.  From there Newton's
method with the loop constraint matrix as its exact Jacobian finds the passive joints
that keep every limb's end where it was, seen from the end of the first limb.  A step
that fails is reported, never returned as if it were closed.

References: [LongCaroKhalil2012] eqs. (1)-(3), (7).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.kinematics.grasp import matrices
from screwkit.kinematics.loops import (
    LimbPath,
    Posture,
    Step,
    end_link,
    limb_paths,
    loop_matrix,
    ring_at,
    stacked,
    unknown_joint,
)
from screwkit.kinematics.placement import placed_links
from screwkit.mechanism.model import Mechanism

TOLERANCE = 1e-12
"""Largest residual of a closed posture: radians, and lengths of the file."""

CUT_OFF = 1e-9
"""Relative size of the singular values that a Newton step leaves out."""

LONGEST_STEP = 0.5
"""Largest change of a joint in one Newton step, and in one step along a motion."""

HALVINGS = 8
"""How often a step along a motion may be halved before it counts as failed."""


@dataclass(frozen=True)
class Closure:
    """What came of closing the loops; read `closed` before `posture`.

    Attributes:
        posture: Values of all joint variables of the limbs, shape batch (for a motion:
            one entry a point of the path); nan where a motion was not continued.
        closed: Whether every posture of the batch is closed to the tolerance.
        residual: Shape batch; the largest angle or distance by which the end of a limb
            misses its place in the grasp, inf where nothing was found.
        iterations: Newton steps taken, the last one a polish.
    """

    posture: Mapping[str, Array]
    closed: bool
    residual: Array
    iterations: int


@dataclass(frozen=True)
class _Grasp:
    """The limbs, the displacements that a motion keeps, what may move, and bounds."""

    mechanism: Mechanism
    paths: tuple[tuple[Step, ...], ...]
    constants: Posture
    passive: tuple[str, ...]
    tolerance: float
    iterations: int
    kept: tuple[tuple[Array, Array], ...] = ()

    @property
    def variables(self) -> dict[str, str]:
        """The variable of each joint of the limbs."""
        names = [name for path in self.paths for name, _ in path]
        return {name: self.mechanism.joint(name).variables[0] for name in names}

    @property
    def free(self) -> tuple[str, ...]:
        """The variables of the passive joints."""
        return tuple(self.variables[name] for name in self.passive)

    def ends(self, posture: Posture) -> tuple[tuple[Array, Array], ...]:
        """The end of each limb but the first, seen from the end of the first."""
        ring = ring_at(self.mechanism, {**self.constants, **posture})
        first, *others = (end_link(self.mechanism, path) for path in self.paths)
        placed = placed_links(self.mechanism, ring, first)
        missing = [link for link in others if link not in placed]
        if missing:
            raise UndecidedError(
                f"the table does not connect {missing[0]!r} with {first!r}"
            )
        return tuple(matrices(placed[link]) for link in others)

    def miss(self, posture: Posture) -> tuple[Array, Array]:
        """By what the ends miss: a twist each, batch + (6·loops,), and its size."""
        errors, sizes = [], []
        for (turn, shift), (kept_turn, kept_shift) in zip(
            self.ends(posture), self.kept, strict=True
        ):
            excess = turn @ np.swapaxes(kept_turn, -1, -2)
            turned, angle = _rotation_vector(excess)
            velocity = shift - (excess @ kept_shift[..., None])[..., 0]
            errors += [turned, velocity]
            sizes += [angle, np.linalg.norm(shift - kept_shift, axis=-1)]
        size = np.max(np.stack(np.broadcast_arrays(*sizes)), axis=0)
        batch = size.shape
        wide = [np.broadcast_to(e, (*batch, 3)) for e in errors]
        return np.concatenate(wide, axis=-1), size

    def jacobian(self, posture: Posture) -> Array:
        """The passive columns of J_c in the frame of the first limb's end."""
        ring = ring_at(self.mechanism, {**self.constants, **posture})
        origin = end_link(self.mechanism, self.paths[0])
        matrix = loop_matrix(
            self.mechanism, ring, self.paths, frames=[origin] * (len(self.paths) - 1)
        )
        columns = [matrix.joints.index(name) for name in self.passive]
        return stacked(matrix.entries)[..., columns]


def close_grasp(
    mechanism: Mechanism,
    limbs: Sequence[LimbPath],
    start: Posture,
    actuated: Mapping[str, Array | float],
    *,
    guess: Posture | None = None,
    tolerance: float = TOLERANCE,
    iterations: int = 40,
) -> Closure:
    """The postures of a grasp at given values of the actuated joints.

    Args:
        mechanism: An ``mdh`` mechanism.
        limbs: Moving joints of each limb from base to platform.
        start: One posture, by joint variable; it defines the grasp.
        actuated: The values wanted, one array over the batch by joint *name*; all other
            joints of the limbs are free.
        guess: Values of the free variables to begin with; those of ``start`` if absent.
        tolerance: Largest residual of a closed posture, in radians and lengths.
        iterations: Bound on the Newton steps.

    Returns:
        The postures with what they miss.  Far from ``start`` Newton's method may fail
        or find another branch; `closed_motion` follows one.

    Raises:
        UnknownNameError: If a joint is not in the limbs, or a value is missing.
        UndecidedError: If the mechanism is not one that can be placed.
    """
    bounds = (tolerance, iterations)
    grasp = _defined(mechanism, limbs, start, actuated, bounds)
    return _closed(grasp, start, actuated, guess or start)


def closed_motion(
    mechanism: Mechanism,
    limbs: Sequence[LimbPath],
    start: Posture,
    path: Mapping[str, Array],
    *,
    tolerance: float = TOLERANCE,
    iterations: int = 20,
) -> Closure:
    """Follow a path of the actuated joints from the start posture, point by point.

    A step is halved when it does not close or moves a free joint further than
    `LONGEST_STEP`; when halving does not help the motion ends there and the rest of it
    is nan with an infinite residual.

    Args:
        mechanism: An ``mdh`` mechanism.
        limbs: Moving joints of each limb from base to platform.
        start: One posture, by joint variable; it defines the grasp.
        path: Values along the path, shape (points,), by joint *name*.
        tolerance: Largest residual of a closed posture, in radians and lengths.
        iterations: Bound on the Newton steps of one step of the motion.

    Returns:
        One posture a point of the path, without the start.

    Raises:
        UnknownNameError: If a joint is not in the limbs, or a value is missing.
        UndecidedError: If the mechanism is not one that can be placed.
    """
    bounds = (tolerance, iterations)
    grasp = _defined(mechanism, limbs, start, path, bounds)
    values = {n: np.asarray(v, dtype=float) for n, v in path.items()}
    points = len(next(iter(values.values()))) if values else 0
    variables = grasp.variables.values()
    found = {variable: np.full(points, np.nan) for variable in variables}
    residual = np.full(points, np.inf)
    here = {v: np.asarray(start[v], dtype=float) for v in variables}
    taken = 0
    for point in range(points):
        target = {n: v[point] for n, v in values.items()}
        step = _advanced(grasp, here, target)
        taken += step.iterations
        if not step.closed:
            break
        here = dict(step.posture)
        residual[point] = step.residual
        for variable, value in here.items():
            found[variable][point] = value
    return Closure(found, bool((residual <= tolerance).all()), residual, taken)


def _defined(
    mechanism: Mechanism,
    limbs: Sequence[LimbPath],
    start: Posture,
    actuated: Mapping[str, Array | float],
    bounds: tuple[float, int],
) -> _Grasp:
    paths = limb_paths(mechanism, limbs)
    names = [name for path in paths for name, _ in path]
    for name in actuated:
        if name not in names:
            raise UnknownNameError(unknown_joint(name, names))
    passive = tuple(name for name in names if name not in actuated)
    grasp = _Grasp(mechanism, paths, start, passive, *bounds)
    return replace(grasp, kept=grasp.ends({}))


def _closed(
    grasp: _Grasp,
    start: Posture,
    actuated: Mapping[str, Array | float],
    guess: Posture,
) -> Closure:
    """Newton's method on the whole batch; ends one step after the tolerance is met."""
    variables, free = grasp.variables, grasp.free
    begin = {**start, **guess}
    batch = np.broadcast_shapes(
        *(np.shape(v) for v in actuated.values()),
        *(np.shape(begin[variable]) for variable in free),
    )
    fixed = {
        variables[n]: np.broadcast_to(np.asarray(v, dtype=float), batch)
        for n, v in actuated.items()
    }
    values = np.empty((*batch, len(free)))
    for index, variable in enumerate(free):
        values[..., index] = begin[variable]

    def posture(of: Array) -> dict[str, Array]:
        return {**fixed, **{v: of[..., i] for i, v in enumerate(free)}}

    miss, size = grasp.miss(posture(values))
    tolerance, taken, polished = grasp.tolerance, 0, False
    while taken < grasp.iterations and not polished:
        polished = bool((size <= tolerance).all())
        jacobian = grasp.jacobian(posture(values))
        jacobian = np.where(np.isfinite(jacobian), jacobian, 0.0)
        inverse = np.linalg.pinv(jacobian, rcond=CUT_OFF)
        change = (inverse @ miss[..., None])[..., 0]
        longest = np.abs(change).max(axis=-1, keepdims=True, initial=0.0)
        change *= LONGEST_STEP / np.maximum(longest, LONGEST_STEP)
        trial = values + change
        trial_miss, trial_size = grasp.miss(posture(trial))
        better = (trial_size < size) | (size > tolerance)
        values = np.where(better[..., None], trial, values)
        miss = np.where(better[..., None], trial_miss, miss)
        size = np.where(better, trial_size, size)
        taken += 1
    size = np.where(np.isfinite(size), size, np.inf)
    return Closure(posture(values), bool((size <= tolerance).all()), size, taken)


def _advanced(
    grasp: _Grasp,
    here: Mapping[str, Array],
    target: Mapping[str, Array],
    halvings: int = HALVINGS,
) -> Closure:
    """One step of a motion, halved where it fails or leaps."""
    step = _closed(grasp, here, target, here)
    leap = max((float(abs(step.posture[v] - here[v])) for v in grasp.free), default=0.0)
    step = replace(step, closed=step.closed and leap <= LONGEST_STEP)
    if step.closed or not halvings:
        return step
    half = {n: (here[grasp.variables[n]] + v) / 2 for n, v in target.items()}
    taken = step.iterations
    for goal in (half, target):
        step = _advanced(grasp, here, goal, halvings - 1)
        taken += step.iterations
        if not step.closed:
            break
        here = step.posture
    return replace(step, iterations=taken)


def _rotation_vector(rotation: Array) -> tuple[Array, Array]:
    """Axis times angle, batch + (3,), and the angle; the axis is 0 at half a turn."""
    axis = 0.5 * np.stack(
        [
            rotation[..., 2, 1] - rotation[..., 1, 2],
            rotation[..., 0, 2] - rotation[..., 2, 0],
            rotation[..., 1, 0] - rotation[..., 0, 1],
        ],
        axis=-1,
    )
    sine = np.linalg.norm(axis, axis=-1)
    cosine = 0.5 * (np.trace(rotation, axis1=-2, axis2=-1) - 1.0)
    angle = np.arctan2(sine, cosine)
    scale = np.where(sine > 1e-150, angle / np.maximum(sine, 1e-150), 1.0)
    return axis * scale[..., None], np.asarray(angle)
