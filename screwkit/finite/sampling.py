"""Finite motion sampled at the numbers of a file, or near them where it has symbols."""

from __future__ import annotations

import random

from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.finite_motion import FiniteMotion
from screwkit.finite.idle_freedoms import IdleMotion, idle_motions
from screwkit.finite.idle_samples import finite_motion_with_idle, idle_shares
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.kinematics.loops import ring_at
from screwkit.kinematics.network import Motion
from screwkit.mechanism.model import Mechanism

LARGEST = 150
"""Freedoms beyond which samples take too long."""

SPREAD = 0.2
"""How far from the values of the file a generic posture is looked for, relatively."""


def sampled_motion(at: Motion, *, generic: bool = False) -> FiniteMotion:
    """The finite motions around the posture of a file.

    Args:
        at: The motion of a mechanism whose loops are closed at the posture.
        generic: Take random values for its symbols, near those of the file where it
            gives them.
    """
    network = at.network
    mechanism = network.mechanism
    if len(network.labels) > LARGEST:
        return _open(f"{len(network.labels)} freedoms are too many to sample")
    try:
        values = _spread(mechanism) if generic else {}
        if mechanism.geometry == "mdh" and not network.tied:
            values |= _anywhere(mechanism)
        model = posture_model(mechanism, values)
        return finite_motion_with_idle(model, _idle(at, model))
    except UnknownNameError:
        return _open("symbols without values leave no posture to sample at")
    except UndecidedError as error:
        return _open(str(error))


def _idle(at: Motion, model: PostureModel) -> tuple[IdleMotion, ...]:
    """Idle motions to hold; none where whole postures on the motion will be wanted."""
    mechanism = at.network.mechanism
    if at.network.tied:
        return ()
    ends = mechanism.base, mechanism.platform
    return idle_motions(at, ends, idle_shares(model))


def _open(reason: str) -> FiniteMotion:
    return FiniteMotion("undecided", (), (), reason)


def _anywhere(mechanism: Mechanism) -> dict[str, float]:
    """Random values of the joint variables that a table leaves free."""
    source = random.Random(2)
    return {
        name: source.uniform(-2.0, 2.0)
        for joint in sorted(mechanism.joints, key=lambda joint: joint.name)
        for index, name in enumerate(joint.variables)
        if not joint.held or joint.held[index] is None
    }


def _spread(mechanism: Mechanism) -> dict[str, float]:
    """A value for every symbol, random around that of the file."""
    source = random.Random(1)
    known = ring_at(mechanism, {}).values
    values = {}
    for parameter in sorted(mechanism.parameters, key=lambda known: known.name):
        value = float(known.get(parameter.name, source.uniform(0.5, 1.5)))
        shift = SPREAD * source.uniform(-1.0, 1.0) * (abs(value) or 1.0)
        values[parameter.name] = value + shift
    return values
