"""A mechanism as it stands, ready to be drawn: plain data in base coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Point: TypeAlias = tuple[float, float, float]
JointLook: TypeAlias = Literal["turns", "slides", "ball", "contact", "rigid"]


@dataclass(frozen=True)
class BodyShape:
    """A body by the points where its joints are.

    Attributes:
        points: In the order of its joints.
        role: ``base``, ``platform`` or ``link``.
    """

    name: str
    points: tuple[Point, ...]
    role: str


@dataclass(frozen=True)
class JointShape:
    """A joint or contact where it stands.

    Attributes:
        look: How it is drawn.
        point: Of its axis, or its centre.
        direction: Of its axis or normal, a unit vector; zero where it has none.
        actuated: Whether a motor drives one of its freedoms.
    """

    name: str
    look: JointLook
    point: Point
    direction: Point
    actuated: bool


@dataclass(frozen=True)
class Scene:
    """A mechanism at one posture.

    Attributes:
        planar: Whether everything lies in the xy plane.
        reference_point: Where ellipsoids are drawn.
        size: Largest extent of the points.
        unit: What a length is.
    """

    bodies: tuple[BodyShape, ...]
    joints: tuple[JointShape, ...]
    planar: bool
    reference_point: Point
    size: float
    unit: str = ""
