"""Pictures before they are drawn: a scene, ellipses at a point, and what they are.

The pictures follow those of the literature: for two arms or more one panel each for
external force, absolute velocity, internal force and relative velocity, with the
ellipses of the single arms beside that of the system; otherwise velocity and force.

References: [ChiacchioEtAl1990] Figs. 2, 3; [BicchiPrattichizzo] Figs. 5-7.
"""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.algebra.names import limb_called
from screwkit.reports.decimals import decimal
from screwkit.results.manipulability import (
    Cooperative,
    Ellipsoid,
    Manipulability,
)
from screwkit.results.scene import Point, Scene

DISTINCT = 3
"""Arms up to which each has an ellipse of its own."""

SHARE = 0.32
"""The longest semi-axis of a panel, in parts of the size of the mechanism."""


@dataclass(frozen=True)
class EllipseShape:
    """An ellipse or ellipsoid.

    Attributes:
        centre: Where it is drawn.
        axes: Semi-axes as vectors, in lengths of the picture.
        role: ``system``, or ``arm 0``, ``arm 1``, …
        label: What it is called.
    """

    centre: Point
    axes: tuple[Point, ...]
    role: str
    label: str


@dataclass(frozen=True)
class Panel:
    """One picture.

    Attributes:
        title: What the ellipses are.
        scale: By how much they are scaled, in words.
    """

    title: str
    scene: Scene
    ellipses: tuple[EllipseShape, ...]
    scale: str


def panels_of(answer: Manipulability) -> tuple[Panel, ...]:
    """The pictures of an answer; none where its mechanism is too large to draw."""
    scene = answer.scene
    if scene is None:
        return ()
    cooperative = answer.cooperative
    if isinstance(cooperative, Cooperative):
        made = _of_arms(cooperative, scene)
        if made:
            return made
    both = (
        ("velocity for unit rates", answer.translation, "velocity"),
        ("force for unit torques", answer.forces, "force"),
    )
    return tuple(
        _panel(title, scene, [("system", "", vectors_of(own))], what)
        for title, own, what in both
    )


def _of_arms(cooperative: Cooperative, scene: Scene) -> tuple[Panel, ...]:
    arms = cooperative.arms
    velocities = [
        (f"arm {k}", limb_called(arm.name), arm.absolute_velocity.linear)
        for k, arm in enumerate(arms)
    ]
    forces = [
        (f"arm {k}", limb_called(arm.name), arm.external_force.linear)
        for k, arm in enumerate(arms)
    ]
    found = []
    for title, own, others, what in (
        ("external force", cooperative.external_force, forces, "force"),
        ("absolute velocity", cooperative.absolute_velocity, velocities, "velocity"),
        ("internal force", cooperative.internal_force, forces, "force"),
        ("relative velocity", cooperative.relative_velocity, velocities, "velocity"),
    ):
        if own.linear:
            shown = others if len(arms) <= DISTINCT else []
            ellipses = [*shown, ("system", "system", own.linear)]
            found.append(_panel(title, scene, ellipses, what))
    return tuple(found)


def vectors_of(ellipsoid: Ellipsoid) -> tuple[tuple[float, ...], ...]:
    """The semi-axes as vectors."""
    return tuple(
        tuple(length * x for x in direction)
        for length, direction in zip(
            ellipsoid.semi_axes, ellipsoid.directions, strict=True
        )
    )


def _panel(
    title: str,
    scene: Scene,
    ellipses: list[tuple[str, str, tuple[tuple[float, ...], ...]]],
    what: str,
) -> Panel:
    lengths = [sum(x * x for x in v) ** 0.5 for _, _, own in ellipses for v in own]
    longest = max(lengths, default=0.0)
    factor = SHARE * scene.size / longest if longest else 1.0
    shapes = tuple(
        EllipseShape(
            scene.reference_point,
            tuple(_spatial([factor * x for x in v]) for v in own),
            role,
            label,
        )
        for role, label, own in ellipses
        if own
    )
    scale = f"longest semi-axis {decimal(longest, 3)}" if longest else f"no {what}"
    return Panel(title, scene, shapes, scale)


def _spatial(vector: list[float]) -> Point:
    x, y, *rest = vector
    return x, y, rest[0] if rest else 0.0
