"""A mechanism where it stands, with the screws of its platform, ready to be drawn.

At an exact posture the screws are those of `screws` there, in numbers; at a posture
that a motion led to they are the principal screws of systems found by singular values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Final

from screwkit.algebra.batch import BatchRing
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression
from screwkit.algebra.parse import parse
from screwkit.analyses.grasp_posture import GraspPosture, grasp_posture
from screwkit.analyses.screws import screws
from screwkit.errors import UndecidedError
from screwkit.finite.posture_model import posture_model
from screwkit.finite.posture_numbers import numbers_at, platform_screws
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.network import Network
from screwkit.mechanism.joints import CATALOGUE
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.freedom_shapes import (
    freedoms_of,
    placed_screw,
    principal_shapes,
)
from screwkit.metrics.scenes import whole_scene
from screwkit.progress import Progress, silent
from screwkit.results.manipulability import PostureNote
from screwkit.results.screws import IdentifiedScrew
from screwkit.results.view import JointNote, PlacedScrew, View

_PLANAR: Final = {"twist": (2, 3, 4), "wrench": (0, 1, 5)}
"""Which of six coordinates a planar file writes."""


def view(
    network: Network, wanted: Mapping[str, Expression], progress: Progress = silent
) -> View:
    """Answer ``view``.

    Args:
        network: Of the mechanism; a number for each of its symbols.
        wanted: Values of joint variables that loops tie together.
        progress: Told about each stage.

    Raises:
        UndecidedError: If a symbol has no value, or the posture is not reached.
    """
    progress("view", "posture")
    posture = grasp_posture(network, wanted, None, "a picture needs numbers")
    mechanism = network.mechanism
    numbers = posture.mechanism
    if posture.all_actuated:
        numbers = replace(
            numbers, joints=tuple(replace(j, actuated=()) for j in numbers.joints)
        )
    scene = whole_scene(numbers, posture.matrices)
    progress("view", "screws of the platform")
    found = _platform(posture, scene.size)
    variables = posture.variables
    return View(
        case=mechanism.name,
        title=mechanism.title,
        links=mechanism.links,
        base=mechanism.base,
        platform=mechanism.platform,
        scene=scene,
        joints=_notes(mechanism, {shape.name for shape in scene.joints}),
        freedoms=freedoms_of(numbers, posture.matrices, scene),
        twists=found.twists,
        wrenches=found.wrenches,
        posture=PostureNote(
            tuple(variables), tuple(variables.values()), found.exact, found.gap
        ),
        undecided=found.undecided,
    )


def _notes(mechanism: Mechanism, drawn: set[str]) -> tuple[JointNote, ...]:
    return tuple(
        JointNote(
            joint.name,
            joint.type.value,
            CATALOGUE[joint.type].words,
            joint.parent,
            joint.child,
            joint.name in drawn,
        )
        for joint in mechanism.joints
    )


@dataclass(frozen=True)
class _Found:
    """The platform's screws, on what they rest, and why there are none."""

    twists: tuple[PlacedScrew, ...] = ()
    wrenches: tuple[PlacedScrew, ...] = ()
    exact: bool = True
    gap: float | None = None
    undecided: str = ""


def _platform(posture: GraspPosture, size: float) -> _Found:
    if posture.arrival is None:
        try:
            return _exact(posture.mechanism)
        except UndecidedError:
            model = posture_model(posture.mechanism)
    else:
        model = posture.arrival.found.model
    here = numbers_at(model)
    gap = here.gap if isfinite(here.gap) else None
    if not here.clear:
        why = "the ranks are unclear here: singular values are small, but not zero"
        return _Found(exact=False, gap=gap, undecided=why)
    planar = posture.mechanism.space == "planar"
    twists, wrenches = platform_screws(model, planar=planar)
    return _Found(
        principal_shapes(twists, size, ("rotation", "translation")),
        principal_shapes(wrenches, size, ("force", "couple")),
        exact=False,
        gap=gap,
    )


def _exact(mechanism: Mechanism) -> _Found:
    """What `screws` says of a mechanism without symbols.

    Raises:
        UndecidedError: If it does not say all of it.
    """
    answer = screws(Assembly(mechanism)).platform
    return _Found(
        tuple(_in_numbers(screw, "twist") for screw in answer.twists),
        tuple(_in_numbers(screw, "wrench") for screw in answer.wrenches),
    )


def _in_numbers(screw: IdentifiedScrew, what: str) -> PlacedScrew:
    if not screw.coordinates:
        raise UndecidedError("a screw of the platform is too long to be written")
    ring = BatchRing({})
    values = [float(evaluate(parse(text, ()), ring)) for text in screw.coordinates]
    return placed_screw(_six(values, what), screw.kind, screw.description)


def _six(values: Sequence[float], what: str) -> Sequence[float]:
    if len(values) == 6:
        return values
    six = [0.0] * 6
    for place, value in zip(_PLANAR[what], values, strict=True):
        six[place] = value
    return six
