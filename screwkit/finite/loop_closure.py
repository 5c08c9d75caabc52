"""Closed postures of any mechanism: assembled, moved to given values, followed.

Newton's method with truncation closes the loops; where the guess is far off, a
nonlinear least-squares search goes first.  Motions are followed in steps that are
halved where one fails or leaps to another assembly.  What does not close is reported
with the loop that misses most, never returned as if it were closed.

References: [AllgowerGeorg2003] on continuation, [MurrayLiSastry1994] §3.2.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import (
    Stance,
    inverse,
    loop_jacobian,
    misses,
    moved,
    rebased,
    stance_of,
)
from screwkit.finite.loop_split import Split, largest_miss
from screwkit.finite.posture_model import PostureModel, scaled
from screwkit.finite.projection import CLOSED, projected
from screwkit.finite.spanning_forest import Forest, forest_of

HALVINGS = 8
"""How often a step may be halved before a motion counts as stopped."""

STRIDE = 0.1
"""Largest change of a coordinate in one step along a motion."""

LEAP, LONGEST = 0.5, 0.3
"""By which part of a step closing may change it, and the largest change of a
coordinate in a step; what goes beyond has left the motion for another assembly."""

CUT = 1e-9
"""Relative size of singular values that count as zero."""


@dataclass(frozen=True, eq=False)
class ClosedMotion:
    """What came of closing loops; read `closed` before anything else.

    Attributes:
        closed: Whether the posture or the whole motion was reached.
        coordinates: Closed postures reached, shape (postures, freedoms), by the names
            of `PostureModel.labels`, in radians and file lengths from the model's
            posture; three angles about x, y and z for a ball joint.
        model: The mechanism at the last closed posture; the one given if there is none.
        angle, distance: By how much the furthest open loop misses where closing ended,
            in radians and file lengths.
        open_joint: The joint that closes that loop; empty where none is open.
        reached: Part of the motion that was made, 0 … 1.
    """

    closed: bool
    coordinates: Array
    model: PostureModel
    angle: float
    distance: float
    open_joint: str
    reached: float

    @property
    def reason(self) -> str:
        """In words why the loops are not closed; empty where they are."""
        if self.closed:
            return ""
        if not self.open_joint:
            what = "every further step leaps to another assembly"
        else:
            what = (
                f"the loop that joint {self.open_joint!r} closes stays open by "
                f"{self.angle:.2g} rad and {self.distance:.2g}"
            )
        part = f"after {self.reached:.0%} of the motion " if self.reached else ""
        return part + what


@dataclass(frozen=True, eq=False)
class _Scene:
    """A scaled model with its forest, and which freedoms closing may change."""

    model: PostureModel
    forest: Forest
    units: Array
    given: PostureModel

    def holding(self, fixed: Collection[int]) -> Forest:
        """The forest with some freedoms out of reach of Newton's method."""
        free = np.ones(len(self.units))
        free[list(fixed)] = 0.0
        return replace(self.forest, ways=self.forest.ways * free)


@dataclass(frozen=True, eq=False)
class _State:
    """One posture and the coordinates summed up to it."""

    stance: Stance
    sums: Array


def assembled(
    model: PostureModel,
    guess: Array | None = None,
    *,
    fixed: Sequence[str] = (),
) -> ClosedMotion:
    """A closed posture near a guess.

    Args:
        model: At any closed posture.
        guess: Coordinates of all freedoms, shape (freedoms,); 0 if absent.
        fixed: Freedoms that keep the values of the guess.

    Raises:
        UnknownNameError: If ``fixed`` names no freedom.
    """
    scene = _scene(model, fixed)
    sums = np.zeros(len(scene.units)) if guess is None else np.asarray(guess, float)
    sums = sums / scene.units
    forest = scene.holding([model.index(label) for label in fixed])
    origin = stance_of(scene.model, forest)
    state = _State(moved(forest, origin, sums[None]), sums)
    close = _closed(forest, state)
    if not _is_closed(close):
        searched = _closed(forest, _searched(forest, state))
        if largest_miss(searched.stance)[0] < largest_miss(close.stance)[0]:
            close = searched
    return _report(scene, [close], close, float(_is_closed(close)))


def assemblies(
    model: PostureModel, guesses: Array, fixed: Sequence[str] = ()
) -> list[ClosedMotion]:
    """The closed postures near many guesses, in their order, where there are any.

    Args:
        model: At any posture.
        guesses: Coordinates of all freedoms, shape (guesses, freedoms).
        fixed: Freedoms that keep the values of the guesses.

    Raises:
        UnknownNameError: If ``fixed`` names no freedom.
    """
    scene = _scene(model, fixed)
    forest = scene.holding([model.index(label) for label in fixed])
    count, sums = len(guesses), np.asarray(guesses, float) / scene.units
    start = stance_of(scene.model, forest).take(np.zeros(count, dtype=np.intp))
    stance = moved(forest, start, sums)
    whole = _whole(forest).take(np.zeros(count, dtype=np.intp))
    found = projected(forest, stance, np.zeros_like(sums), whole)
    states = [
        _State(
            found.stance.take(np.array([number])),
            sums[number] + found.travelled[number],
        )
        for number in np.flatnonzero(found.closed)
    ]
    return [_report(scene, [state], state, 1.0) for state in states]


def moved_to(model: PostureModel, targets: Mapping[str, float]) -> ClosedMotion:
    """Move some freedoms to given values; the loops take the others along.

    Args:
        model: At a closed posture, where all coordinates are 0.
        targets: Values by freedom, in radians and file lengths.

    Returns:
        The postures on the way, the start first.

    Raises:
        UnknownNameError: If a target is no freedom.
    """
    scene = _scene(model, targets)
    chosen = [model.index(label) for label in targets]
    ends = np.array([float(value) for value in targets.values()]) / scene.units[chosen]
    forest = scene.holding(chosen)
    state = _State(stance_of(scene.model, forest), np.zeros(len(scene.units)))
    steps = max(1, int(np.ceil(np.abs(ends).max(initial=0.0) / STRIDE)))
    postures, attempt, share, stride = [state], state, 0.0, 1.0 / steps
    while share < 1.0:
        part = min(stride, 1.0 - share)
        attempt, good = _advanced(forest, scene.forest, state, chosen, part * ends)
        if good:
            state, share = attempt, share + part
            if 1.0 - share < 1e-12:
                share = 1.0
            stride = min(2 * stride, 1.0 / steps)
            postures.append(state)
        elif stride * steps * 2**HALVINGS <= 1:
            break
        else:
            stride /= 2
    return _report(scene, postures, state if share == 1.0 else attempt, share)


def followed(
    model: PostureModel,
    heading: Mapping[str, float],
    steps: int = 40,
    stride: float = STRIDE,
) -> ClosedMotion:
    """Follow a motion from a closed posture along the branch it is on.

    Where the mechanism has several freedoms, the motion keeps its direction as well as
    the loops allow.

    Args:
        model: At a closed posture.
        heading: Rates of some freedoms that the motion is to begin with; it begins with
            the rates nearest to them that the loops allow.
        steps: How many steps to take.
        stride: Largest change of a coordinate in a step.

    Raises:
        UnknownNameError: If ``heading`` names no freedom.
        ValueError: If the loops allow none of the rates.
    """
    scene = _scene(model)
    forest = scene.forest
    wanted = np.zeros(len(scene.units))
    for label, rate in heading.items():
        wanted[model.index(label)] = rate
    wanted /= scene.units
    state = _State(stance_of(scene.model, forest), np.zeros(len(scene.units)))
    tangent = _tangent(forest, state, wanted)
    if np.linalg.norm(tangent) <= CUT * np.linalg.norm(wanted):
        raise ValueError("the loops allow none of the rates asked for")
    postures, attempt, taken = [state], state, 0
    for _ in range(steps):
        tangent = tangent / np.abs(tangent).max()
        length, good = stride, False
        for _ in range(HALVINGS + 1):
            attempt, good = _stepped(forest, state, length * tangent)
            if good:
                break
            length /= 2
        if not good:
            break
        onward = _tangent(forest, attempt, attempt.sums - state.sums)
        if np.linalg.norm(onward) <= CUT:
            break
        state, tangent, taken = attempt, onward, taken + 1
        postures.append(state)
    return _report(scene, postures, state if good else attempt, taken / max(steps, 1))


def _scene(model: PostureModel, driven: Collection[str] = ()) -> _Scene:
    """Ball joints with a driven freedom keep their axes, which then are coordinates."""
    plain = tuple(
        replace(joint, ball=joint.ball and not set(joint.labels) & set(driven))
        for joint in model.joints
    )
    own = scaled(replace(model, joints=plain))
    forest = forest_of(own)
    nodes = [forest.nodes[link] for link in own.links]
    forest = replace(forest, tracked=np.array(nodes, dtype=np.intp))
    slides = np.linalg.norm(own.screws[:, :3], axis=1) < 0.5
    return _Scene(own, forest, np.where(slides, model.length, 1.0), model)


def _closed(forest: Forest, state: _State) -> _State:
    still = np.zeros_like(state.sums)[None]
    found = projected(forest, state.stance, still, _whole(forest))
    return _State(found.stance, state.sums + found.travelled[0])


def _whole(forest: Forest) -> Split:
    """No equations in front: all of them are asked at once."""
    rows, freedoms = 6 * len(forest.closing_joints), forest.ways.shape[1]
    size = np.array([max(1.0, float(np.abs(forest.loop_signs).sum()) ** 0.5)])
    return Split(np.eye(rows)[None], np.eye(freedoms)[None], 0, size)


def _searched(forest: Forest, state: _State) -> _State:
    """The posture nearest to closed that a least-squares search finds."""
    from scipy.optimize import least_squares  # noqa: PLC0415

    free = np.flatnonzero(np.abs(forest.ways).max(axis=0, initial=0.0) > 0)
    if not len(free) or not forest.closing_joints:
        return state

    def steps(values: Array) -> Array:
        step = np.zeros((*values.shape[:-1], len(state.sums)))
        step[..., free] = values
        return step

    def miss(values: Array) -> Array:
        return np.asarray(misses(moved(forest, state.stance, steps(values[None])))[0])

    def slope(values: Array) -> Array:
        nudge = 1e-6 * np.eye(len(free))
        both = steps(np.concatenate([values + nudge, values - nudge]))
        start = state.stance.take(np.zeros(len(both), dtype=np.intp))
        ahead, behind = np.split(misses(moved(forest, start, both)), 2)
        return np.asarray((ahead - behind).T / 2e-6)

    found = least_squares(miss, np.zeros(len(free)), slope, x_scale=1.0, max_nfev=200)
    step = steps(found.x)
    return _State(moved(forest, state.stance, step[None]), state.sums + step)


def _advanced(
    forest: Forest, whole: Forest, state: _State, chosen: Sequence[int], part: Array
) -> tuple[_State, bool]:
    """One step of chosen freedoms, the others foreseen by the loop equations."""
    step = np.zeros_like(state.sums)
    step[list(chosen)] = part
    caused = loop_jacobian(whole, state.stance)[0] @ step
    step -= np.linalg.pinv(loop_jacobian(forest, state.stance)[0], rcond=CUT) @ caused
    return _stepped(forest, state, step)


def _stepped(forest: Forest, state: _State, step: Array) -> tuple[_State, bool]:
    """One step, closed again, and whether it went where it was to go."""
    found = projected(forest, state.stance, step[None], _whole(forest))
    way, asked = np.abs(found.travelled[0] - step).max(), np.abs(step).max(initial=0.0)
    good = bool(found.closed[0]) and way <= LEAP * asked and asked <= LONGEST
    return _State(found.stance, state.sums + found.travelled[0]), good


def _tangent(forest: Forest, state: _State, wanted: Array) -> Array:
    """The part of given rates that the loops allow."""
    jacobian = loop_jacobian(forest, state.stance)[0]
    if not jacobian.size:
        return wanted
    return np.asarray(wanted - np.linalg.pinv(jacobian, rcond=CUT) @ jacobian @ wanted)


def _report(
    scene: _Scene, postures: Sequence[_State], last: _State, reached: float
) -> ClosedMotion:
    """In file lengths; postures that are not closed are left out."""
    length = scene.given.length
    kept = [state for state in postures if _is_closed(state)]
    gaps = misses(last.stance)[0].reshape(-1, 2, 3)
    sizes = np.linalg.norm(gaps, axis=-1)
    closed = reached == 1.0 and _is_closed(last)
    worst = int(sizes.max(axis=1).argmax()) if len(sizes) else 0
    angle, distance = sizes[worst] * (1.0, length) if len(sizes) else (0.0, 0.0)
    rows = [_coordinates(scene, state) for state in kept]
    return ClosedMotion(
        closed=closed,
        coordinates=np.array(rows).reshape(-1, len(scene.units)),
        model=rebased(scene.given, rows[-1]) if rows else scene.given,
        angle=float(angle),
        distance=float(distance),
        open_joint="" if _is_closed(last) else scene.forest.closing_joints[worst],
        reached=reached,
    )


def _is_closed(state: _State) -> bool:
    return bool(largest_miss(state.stance)[0] <= CLOSED)


def _coordinates(scene: _Scene, state: _State) -> Array:
    """Sums of steps, and the angles of ball joints from how their links have turned."""
    values = state.sums * scene.units
    links = dict(zip(scene.model.links, state.stance.bodies[0], strict=True))
    start = 0
    for joint in scene.model.joints:
        if joint.ball:
            turned = (inverse(links[joint.parent]) @ links[joint.child])[:3, :3]
            values[start] = np.arctan2(-turned[1, 2], turned[2, 2])
            values[start + 1] = np.arcsin(np.clip(turned[0, 2], -1.0, 1.0))
            values[start + 2] = np.arctan2(-turned[0, 1], turned[0, 0])
        start += len(joint.screws)
    return values
