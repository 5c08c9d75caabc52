"""Closing loops for a person: assemble, move to given values, follow a motion."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import isfinite, nan

import numpy as np

from screwkit.errors import UnfitValueError
from screwkit.finite.driven_motion import followed, moved_to
from screwkit.finite.loop_closure import ClosedMotion, assembled
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.finite.table_search import closed_posture
from screwkit.kinematics.network import Network
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Mechanism
from screwkit.results.motion import MotionPath


def assemble(
    network: Network, guess: Mapping[str, float], fixed: Collection[str] = ()
) -> MotionPath:
    """A closed posture near a guess.

    Args:
        network: The mechanism, its symbols at the values of the file.
        guess: Values of freedoms by label, from the posture of the file; others 0.
        fixed: Freedoms that keep the value of the guess.

    Raises:
        UnknownNameError: If a label is no freedom, or a symbol has no value.
        UnfitValueError: If a value is no finite number.
    """
    mechanism, model, start = _model(network)
    coordinates = np.zeros(len(model.labels))
    for label, value in _numbers(guess).items():
        index = model.index(label)
        coordinates[index] = value - start.get(label, 0.0)
    found = assembled(model, coordinates, fixed=tuple(fixed))
    return _path(mechanism, model, start, found)


def move(network: Network, to: Mapping[str, float]) -> MotionPath:
    """Move freedoms to given values from the posture of the file.

    Args:
        network: The mechanism, its symbols at the values of the file.
        to: Values of freedoms by label; the loops take the others along.

    Raises:
        UnknownNameError: If a label is no freedom, or a symbol has no value.
        UnfitValueError: If a value is no finite number.
    """
    mechanism, model, start = _model(network)
    targets = {
        label: value - start.get(label, 0.0) for label, value in _numbers(to).items()
    }
    return _path(mechanism, model, start, moved_to(model, targets))


def follow(
    network: Network, heading: Mapping[str, float], steps: int, stride: float
) -> MotionPath:
    """Follow a motion along the branch that begins with given rates.

    Args:
        network: The mechanism, its symbols at the values of the file.
        heading: Rates of some freedoms by label.
        steps: How many.
        stride: Largest change of a freedom in a step.

    Raises:
        UnknownNameError: If a label is no freedom, or a symbol has no value.
        UnfitValueError: If a value is no finite number.
        ValueError: If the loops allow none of the rates.
    """
    mechanism, model, start = _model(network)
    _numbers({"stride": stride})
    if stride <= 0 or steps < 0:
        raise UnfitValueError(
            f"{steps} steps of {stride:g} are no motion: steps from 0, each longer "
            f"than 0, are expected"
        )
    found = followed(model, _numbers(heading), steps, stride)
    return _path(mechanism, model, start, found)


def _numbers(values: Mapping[str, float]) -> dict[str, float]:
    """The values as finite numbers."""
    found = {}
    for label, value in values.items():
        try:
            found[label] = float(value)
        except (TypeError, ValueError, OverflowError):
            found[label] = nan
        if not isfinite(found[label]):
            raise UnfitValueError(
                f"{label} = {value!r} is no finite number; radians or lengths of the "
                f"file are expected"
            )
    return found


def _model(network: Network) -> tuple[Mechanism, PostureModel, dict[str, float]]:
    """The model at its posture, and the values that its freedoms have there."""
    mechanism = network.mechanism
    mechanism = with_values(mechanism, declared_values(mechanism))
    if mechanism.geometry != "mdh":
        return mechanism, posture_model(mechanism), {}
    values = dict.fromkeys(mechanism.joint_variables, 0.0)
    if network.tied:
        values = dict(closed_posture(mechanism).values)
    start = {}
    for joint in mechanism.joints:
        labels = freedom_labels(joint, mechanism.space)
        for label, name in zip(labels, joint.variables, strict=False):
            start[label] = values[name]
    return mechanism, posture_model(mechanism, values), start


def _path(
    mechanism: Mechanism,
    model: PostureModel,
    start: Mapping[str, float],
    found: ClosedMotion,
) -> MotionPath:

    def spelled(label: str, value: float) -> str:
        return f"{label} = {value + start.get(label, 0.0):.6g}"

    offsets = np.array([start.get(label, 0.0) for label in model.labels])
    postures = found.coordinates + offsets if len(found.coordinates) else []
    return MotionPath(
        mechanism.name,
        model.labels,
        tuple(tuple(float(x) for x in posture) for posture in postures),
        found.closed,
        float(found.reached),
        found.reason_in(spelled),
    )
