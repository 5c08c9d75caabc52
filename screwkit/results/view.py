"""What `view` answers: a mechanism at one posture as plain data for a picture.

Everything is in base coordinates, in file lengths; planar files lie in the plane z = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.manipulability import PostureNote
from screwkit.results.scene import Point, Scene
from screwkit.results.shown import Shown


@dataclass(frozen=True)
class FreedomShape:
    """One freedom of a joint where it stands.

    Attributes:
        joint: Name of the joint.
        label: ``joint``, or ``joint:k`` where the joint has several freedoms.
        kind: ``rotation``, ``translation`` or ``screw``.
        point: Of the axis; of a translation, where the joint is drawn.
        direction: A unit vector.
        pitch: Advance per radian; None for a translation.
        actuated: Whether a motor drives it.
    """

    joint: str
    label: str
    kind: str
    point: Point
    direction: Point
    pitch: float | None
    actuated: bool


@dataclass(frozen=True)
class JointNote:
    """What a joint is.

    Attributes:
        type: As in a file.
        words: How a sentence calls it.
        placed: Whether its place follows from the mechanism; sliding joints have none,
            and may be drawn anywhere.
    """

    name: str
    type: str
    words: str
    parent: str
    child: str
    placed: bool


@dataclass(frozen=True)
class PlacedScrew:
    """A twist or a wrench of the platform in numbers.

    Attributes:
        kind: ``rotation``, ``translation`` or ``screw`` of a twist, ``force``,
            ``couple`` or ``screw`` of a wrench.
        direction: A unit vector.
        point: The point of its axis that is nearest to the origin; None for a couple
            and for a translation.
        pitch: None for a couple and for a translation.
        description: In words and the reader's own names; may be empty.
    """

    kind: str
    direction: Point
    point: Point | None
    pitch: float | None
    description: str = ""


@dataclass(frozen=True, repr=False)
class View(Shown):
    """A mechanism with the screws of its platform.

    Attributes:
        links: All of them, also those that are drawn nowhere.
        base: The link at rest.
        platform: The link whose twists and constraint wrenches are given.
        scene: Bodies and joints.
        joints: All of them, in the order of the file.
        freedoms: Of all joints and contacts, in the order of the file.
        twists: A basis of the platform's twists, all joints free to move.
        wrenches: A basis of its constraint wrenches.
        posture: Where all this holds.
        given: Values from outside, ``name = text`` each.
        undecided: Why the screws of the platform are not known; else empty.
        file: Where the page was written; empty where nowhere.
    """

    case: str
    title: str
    links: tuple[str, ...]
    base: str
    platform: str
    scene: Scene
    joints: tuple[JointNote, ...]
    freedoms: tuple[FreedomShape, ...]
    twists: tuple[PlacedScrew, ...]
    wrenches: tuple[PlacedScrew, ...]
    posture: PostureNote
    given: tuple[str, ...] = ()
    undecided: str = ""
    file: str = ""
