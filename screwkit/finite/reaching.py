"""Joint values that bring bodies to given places: every configuration that is found.

A body held in a place is one more loop: from the base by translations of known length
to a point of it, or by translations of any length and a known rotation to the body.
What closes the loops of the mechanism then solves its inverse kinematics as well.

References: [ChiacchioEtAl1990] section 4, [MurrayLiSastry1994] §3.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.loop_closure import ClosedMotion, assemblies
from screwkit.finite.posture_model import PosedJoint, PostureModel
from screwkit.finite.posture_numbers import numbers_at

STARTS = 200
"""Random postures from which configurations are looked for, beside the given one."""

APART = 1e-6
"""Least distance of two configurations, in radians and parts of the length."""


@dataclass(frozen=True)
class Placed:
    """Where a body is wanted, counted from the posture of the model.

    Attributes:
        point: A point of it, in base coordinates at the posture of the model.
        shift: The displacement of that point; None leaves it free.
        turn: Rotation vector of the body in base axes; None leaves it free.
    """

    link: str
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    shift: tuple[float, float, float] | None = None
    turn: tuple[float, float, float] | None = None


@dataclass(frozen=True)
class Reached:
    """Configurations with every body in its place.

    Attributes:
        configurations: Of the freedoms of the model, the nearest to its posture first.
        spare: Freedoms among those told apart by which each could still move; where
            there are some, each configuration is one of infinitely many.
        starts: From how many postures they were looked for.
    """

    configurations: tuple[ClosedMotion, ...]
    spare: int
    starts: int


def reached(
    model: PostureModel,
    places: Sequence[Placed],
    told_apart: Sequence[str] = (),
    starts: int = STARTS,
) -> Reached:
    """Look for all configurations from random postures.

    Args:
        model: At a closed posture.
        places: Of the bodies.
        told_apart: Freedoms whose values tell configurations apart; all by default.
        starts: Random postures to start from.

    Raises:
        UnknownNameError: If ``told_apart`` names no freedom.
    """
    whole, values = _with_places(model, places)
    labels = whole.labels
    fixed = tuple(values)
    guesses = _guesses(model, starts)
    extra = np.zeros((len(guesses), len(labels) - guesses.shape[1]))
    guesses = np.concatenate([guesses, extra], axis=1)
    for label, value in values.items():
        guesses[:, labels.index(label)] = value
    chosen = [model.index(label) for label in told_apart or model.labels]
    count = len(model.labels)
    kept: list[tuple[Array, Array, ClosedMotion]] = []
    spare = 0
    for found in assemblies(whole, guesses, fixed):
        own = _turned_least(model, found.coordinates[-1, :count])
        mark = _mark(model, own)[:, chosen]
        if any(np.abs(mark - other).max(initial=0.0) < APART for _, other, _ in kept):
            continue
        spare = max(spare, _spare(found.model, fixed, told_apart or model.labels))
        kept.append((own, mark, found))
        if spare:
            break
    kept.sort(key=lambda entry: float(np.linalg.norm(_scaled(model, entry[0]))))
    configurations = (_of_model(model, entry[0]) for entry in kept)
    return Reached(tuple(c for c in configurations if c), spare, len(guesses))


def _with_places(
    model: PostureModel, places: Sequence[Placed]
) -> tuple[PostureModel, dict[str, float]]:
    """The model with a chain to every place, and the values the chains keep."""
    links, joints = list(model.links), list(model.joints)
    slides = np.concatenate([np.zeros((3, 3)), np.eye(3)], axis=1)
    values: dict[str, float] = {}
    for number, place in enumerate(places):
        if place.shift is not None:
            between, name = f"\0point {number}", f"\0shift {number}"
            turns = np.concatenate(
                [np.eye(3), np.cross(place.point, np.eye(3))], axis=1
            )
            links.append(between)
            joints += [
                PosedJoint(name, model.base, between, slides),
                PosedJoint(f"\0ball {number}", between, place.link, turns, ball=True),
            ]
            values |= {f"{name}:{k}": place.shift[k] for k in range(3)}
        if place.turn is not None:
            between, name = f"\0body {number}", f"\0turn {number}"
            angle = float(np.linalg.norm(place.turn))
            links.append(between)
            joints.append(PosedJoint(f"\0slide {number}", model.base, between, slides))
            axis = np.zeros((0, 6))
            if angle:
                axis = np.array([[*(np.array(place.turn) / angle), 0.0, 0.0, 0.0]])
                values[name] = angle
            joints.append(PosedJoint(name, between, place.link, axis))
    return replace(model, links=tuple(links), joints=tuple(joints)), values


def _guesses(model: PostureModel, starts: int) -> Array:
    """The posture of the model, and random ones: any angle, lengths about its own."""
    random = np.random.default_rng(0)
    own = np.zeros((starts + 1, len(model.labels)))
    own[1:] = random.uniform(-np.pi, np.pi, (starts, len(model.labels)))
    slides = np.logical_not(_turning(model))
    own[:, slides] *= model.length / np.pi
    return own


def _turning(model: PostureModel) -> Array:
    """Which freedoms turn at all."""
    return np.asarray(np.linalg.norm(model.screws[:, :3], axis=1) > 0.5)


def _whole_turns(model: PostureModel) -> Array:
    """Which freedoms are where they were after a turn: rotations without pitch."""
    screws = model.screws
    pitch = np.abs(np.sum(screws[:, :3] * screws[:, 3:], axis=1))
    return np.asarray(_turning(model) & (pitch < 1e-12 * model.length))


def _turned_least(model: PostureModel, values: Array) -> Array:
    """Angles within half a turn."""
    within = np.remainder(values + np.pi, 2 * np.pi) - np.pi
    return np.where(_whole_turns(model), within, values)


def _scaled(model: PostureModel, values: Array) -> Array:
    return np.where(_turning(model), values, values / model.length)


def _mark(model: PostureModel, values: Array) -> Array:
    """Two numbers for every freedom, continuous where angles jump; shape (2, n)."""
    whole = _whole_turns(model)
    plain = _scaled(model, values)
    first = np.where(whole, np.cos(values), plain)
    return np.array([first, np.where(whole, np.sin(values), 0.0)])


def _spare(model: PostureModel, fixed: Sequence[str], told: Sequence[str]) -> int:
    """How many of some freedoms can move while others are held."""
    here = numbers_at(model, fixed).mobility
    return here - numbers_at(model, (*fixed, *told)).mobility


def _of_model(model: PostureModel, values: Array) -> ClosedMotion | None:
    """The same posture without the chains to the places."""
    found = assemblies(model, values[None])
    return found[0] if found else None
