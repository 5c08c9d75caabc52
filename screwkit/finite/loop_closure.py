"""Closed postures of any mechanism, and what came of closing its loops.

Newton's method with truncation closes the loops; where the guess is far off, a
nonlinear least-squares search goes first.  What does not close is reported with the
loop that misses most, never returned as if it were closed.

References: [MurrayLiSastry1994] §3.2.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.branch_steps import whole_split
from screwkit.finite.exponentials import (
    Stance,
    inverse,
    misses,
    moved,
    rebased,
    stance_of,
)
from screwkit.finite.loop_split import largest_miss
from screwkit.finite.posture_model import PostureModel, scaled
from screwkit.finite.projection import CLOSED, projected
from screwkit.finite.spanning_forest import Forest, forest_of

Stop: TypeAlias = Literal["", "turns", "held", "branches"]
"""Why a motion ended where its loops are closed: it turns back, it is held, or branches
meet and none goes on."""


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
        stop: Why it ended before its end, at closed loops; else empty.
        driven: Labels of the freedoms that were to be moved.
    """

    closed: bool
    coordinates: Array
    model: PostureModel
    angle: float
    distance: float
    open_joint: str
    reached: float
    stop: Stop = ""
    driven: tuple[str, ...] = ()

    @property
    def reason(self) -> str:
        """In words why the motion was not made; empty where it was."""
        return self.reason_in("{} = {:.6g}".format)

    def reason_in(self, spelled: Callable[[str, float], str]) -> str:
        """The reason, with values of freedoms as a reader counts them.

        Args:
            spelled: Writes a freedom, by its label, at a coordinate.
        """
        if self.closed:
            return ""
        percent = min(int(100 * self.reached), 99)
        part = f"after {percent}% of the motion " if percent else ""
        if self.stop:
            return part + self._stopped(spelled)
        return part + (
            f"the loop that joint {self.open_joint!r} closes stays open by "
            f"{self.angle:.2g} rad and {self.distance:.2g}"
        )

    def _stopped(self, spelled: Callable[[str, float], str]) -> str:
        last = self.coordinates[-1]
        values = [last[self.model.labels.index(label)] for label in self.driven]
        at = ", ".join(map(spelled, self.driven, values))
        match self.stop:
            case "turns":
                return f"the mechanism turns back at {at}: a dead point"
            case "held":
                return (
                    f"the loops hold the mechanism at {at}: no motion in the direction "
                    f"asked for begins there"
                )
            case _:
                return (
                    f"branches meet at {at}, and none goes on in the direction asked "
                    f"for"
                )


@dataclass(frozen=True, eq=False)
class Scene:
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
class State:
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
    scene = scene_of(model, fixed)
    sums = np.zeros(len(scene.units)) if guess is None else np.asarray(guess, float)
    sums = sums / scene.units
    forest = scene.holding([model.index(label) for label in fixed])
    origin = stance_of(scene.model, forest)
    state = State(moved(forest, origin, sums[None]), sums)
    close = _closed(forest, state)
    if not is_closed(close):
        searched = _closed(forest, _searched(forest, state))
        if largest_miss(searched.stance)[0] < largest_miss(close.stance)[0]:
            close = searched
    return report(scene, [close], close, float(is_closed(close)))


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
    scene = scene_of(model, fixed)
    forest = scene.holding([model.index(label) for label in fixed])
    count, sums = len(guesses), np.asarray(guesses, float) / scene.units
    start = stance_of(scene.model, forest).take(np.zeros(count, dtype=np.intp))
    stance = moved(forest, start, sums)
    whole = whole_split(forest, np.eye(sums.shape[1]))
    whole = whole.take(np.zeros(count, dtype=np.intp))
    found = projected(forest, stance, np.zeros_like(sums), whole)
    states = [
        State(
            found.stance.take(np.array([number])),
            sums[number] + found.travelled[number],
        )
        for number in np.flatnonzero(found.closed)
    ]
    return [report(scene, [state], state, 1.0) for state in states]


def scene_of(model: PostureModel, driven: Collection[str] = ()) -> Scene:
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
    return Scene(own, forest, np.where(slides, model.length, 1.0), model)


def _closed(forest: Forest, state: State) -> State:
    still = np.zeros_like(state.sums)[None]
    every = np.eye(len(state.sums))
    found = projected(forest, state.stance, still, whole_split(forest, every))
    return State(found.stance, state.sums + found.travelled[0])


def _searched(forest: Forest, state: State) -> State:
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
    return State(moved(forest, state.stance, step[None]), state.sums + step)


def report(
    scene: Scene,
    postures: Sequence[State],
    last: State,
    reached: float,
    stop: Stop = "",
    driven: Collection[str] = (),
) -> ClosedMotion:
    """In file lengths; postures that are not closed are left out.

    Args:
        scene: What was moved.
        postures: On the way.
        last: Where closing ended.
        reached: Part of the motion that was made.
        stop: Why it ended at closed loops.
        driven: Labels of what was to be moved.
    """
    length = scene.given.length
    kept = [state for state in postures if is_closed(state)]
    gaps = misses(last.stance)[0].reshape(-1, 2, 3)
    sizes = np.linalg.norm(gaps, axis=-1)
    closed = reached == 1.0 and is_closed(last)
    worst = int(sizes.max(axis=1).argmax()) if len(sizes) else 0
    angle, distance = sizes[worst] * (1.0, length) if len(sizes) else (0.0, 0.0)
    rows = [_coordinates(scene, state) for state in kept]
    return ClosedMotion(
        closed=closed,
        coordinates=np.array(rows).reshape(len(rows), len(scene.units)),
        model=rebased(scene.given, rows[-1]) if rows else scene.given,
        angle=float(angle),
        distance=float(distance),
        open_joint="" if is_closed(last) else scene.forest.closing_joints[worst],
        reached=reached,
        stop=stop,
        driven=tuple(driven),
    )


def is_closed(state: State) -> bool:
    """Whether all loops are, as far as floating point can tell."""
    return bool(largest_miss(state.stance)[0] <= CLOSED)


def _coordinates(scene: Scene, state: State) -> Array:
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
