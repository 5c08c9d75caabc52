"""From a view to what is drawn of it.

As in print: bodies are lines and outlines through their joints, the platform is blue;
joints are filled where a motor drives them and open where they are passive.  A revolute
joint is a cylinder about its axis, a helical one has a thread, a cylindrical one a rod,
a prismatic one is a bar, a universal one a cross of two cylinders, a spherical one a
ball, a planar one a plate; a contact is a blue dot with its normal.

References: [BicchiPrattichizzo] Fig. 2 (filled and open joints).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Final

from screwkit.reports.decimals import decimal
from screwkit.reports.figures import BLACK, BLUE, GREY, ORANGE, PLATFORM
from screwkit.reports.outlines import around
from screwkit.reports.view_strokes import (
    Ball,
    Group,
    Head,
    Item,
    Label,
    Mark,
    Stroke,
    across,
    along,
    turn,
)
from screwkit.results.scene import BodyShape, JointShape, Point, Scene
from screwkit.results.view import FreedomShape, JointNote, PlacedScrew, View

TWISTS: Final = "#009E73"
WRENCHES: Final = "#C0392B"
_BODIES: Final = {
    "base": (GREY, "#E4E4E4", 3.0),
    "platform": (BLUE, PLATFORM, 3.0),
    "link": (BLACK, "#F3F3F3", 2.0),
}
_HALF, _RADIUS = 0.04, 0.018
_LINE, _ARROW = 0.75, 0.3
"""Half the length of an axis, and the length of a free vector, in parts of the size."""


def items_of(view: View) -> tuple[Item, ...]:
    """Everything that the picture shows."""
    return (*_frame(view.scene), *_bodies(view), *_joints(view), *_screws(view))


def screw_names(screws: Sequence[PlacedScrew], letter: str) -> tuple[str, ...]:
    """What the twists or the wrenches are called in the picture."""
    return tuple(
        f"{letter}{number} {screw.kind}" for number, screw in enumerate(screws, 1)
    )


def middle_of(scene: Scene) -> Point:
    """The middle of all joints."""
    points = [p for body in scene.bodies for p in body.points] or [(0.0, 0.0, 0.0)]
    x, y, z = ((min(c) + max(c)) / 2 for c in zip(*points, strict=True))
    return x, y, z


def _frame(scene: Scene) -> Iterator[Item]:
    origin: Point = (0.0, 0.0, 0.0)
    length = 0.15 * scene.size
    axes: list[Point] = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    for name, axis in zip("xy" if scene.planar else "xyz", axes, strict=False):
        end = along(origin, length, axis)
        yield Stroke("frame", (origin, end), ORANGE, 1.4)
        yield Head("frame", end, axis, ORANGE)
        yield Label("frame", end, name, ORANGE)


def _bodies(view: View) -> Iterator[Item]:
    shapes = {body.name: body for body in view.scene.bodies}
    for link in view.links:
        body = shapes.get(link)
        role = _role(view, link)
        colour, fill, width = _BODIES[role]
        points = list(dict.fromkeys(body.points)) if body else []
        if len(points) > 2:
            outline = tuple(around(points))
            yield Stroke("links", outline, colour, width, fill, closed=True)
        elif points:
            yield Stroke("links", tuple(points), colour, width)
        yield Label("link names", _centre(body), link, colour)


def _role(view: View, link: str) -> str:
    """A platform that is the base is at rest."""
    if link == view.base:
        return "base"
    return "platform" if link == view.platform else "link"


def _centre(body: BodyShape | None) -> Point:
    """The middle of a body's joints; the origin where it has none."""
    if body is None:
        return (0.0, 0.0, 0.0)
    points = list(dict.fromkeys(body.points))
    x, y, z = (sum(c) / len(points) for c in zip(*points, strict=True))
    return x, y, z


def _joints(view: View) -> Iterator[Item]:
    own: dict[str, list[FreedomShape]] = {}
    for freedom in view.freedoms:
        own.setdefault(freedom.joint, []).append(freedom)
    notes = {note.name: note for note in view.joints}
    for shape in view.scene.joints:
        freedoms = own.get(shape.name, [])
        yield from _joint(notes[shape.name], shape, freedoms, view.scene.size)
    for names, point in _together(view.scene):
        yield Label("joint names", point, ", ".join(names), GREY)


def _together(scene: Scene) -> Iterator[tuple[list[str], Point]]:
    """Joints that stand at one point, as far as a picture shows, have one label."""
    grid = 1e-6 * scene.size
    found: dict[tuple[int, ...], list[JointShape]] = {}
    for shape in scene.joints:
        place = tuple(round(value / grid) for value in shape.point)
        found.setdefault(place, []).append(shape)
    for shapes in found.values():
        yield [shape.name for shape in shapes], shapes[0].point


def _joint(
    note: JointNote, shape: JointShape, freedoms: list[FreedomShape], size: float
) -> Iterator[Item]:
    mark = _mark(shape.point, filled=shape.actuated)
    first = freedoms[0].direction if freedoms else (0.0, 0.0, 0.0)
    match note.type:
        case "revolute":
            yield from mark.cylinder(first, _HALF, _RADIUS)
        case "helical":
            yield from mark.cylinder(first, _HALF, _RADIUS)
            yield mark.line(*_thread(first))
        case "cylindrical":
            yield from mark.cylinder(first, _HALF, _RADIUS)
            yield mark.line(*_ends(first, 2 * _HALF), width=2.5)
        case "prismatic":
            yield from mark.box(first, 1.2 * _HALF, _RADIUS)
        case "universal":
            for freedom in freedoms:
                arm = _mark(shape.point, filled=freedom.actuated)
                yield from arm.cylinder(freedom.direction, _HALF, 0.6 * _RADIUS)
        case "spherical":
            yield Ball("joints", shape.point, 1.3 * _RADIUS, BLACK, mark.fill)
        case "planar":
            yield from mark.box(first, 0.2 * _RADIUS, _HALF)
        case "fixed" | "complete":
            for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
                yield mark.line(*_ends(axis, _RADIUS))
        case _:
            yield from _contact(note, shape, freedoms, size)


def _contact(
    note: JointNote, shape: JointShape, freedoms: list[FreedomShape], size: float
) -> Iterator[Item]:
    mark = Mark(shape.point, BLUE, BLUE)
    yield Ball("joints", shape.point, 0.6 * _RADIUS, BLUE, BLUE)
    if note.type == "plane" and any(shape.direction):
        yield from mark.box(shape.direction, 0.1 * _RADIUS, _HALF)
    if note.type in ("line", "line_friction") and freedoms:
        yield mark.line(*_ends(freedoms[0].direction, 2 * _HALF), width=3.0)
    if any(shape.direction):
        end = along(shape.point, 0.12 * size, shape.direction)
        yield Stroke("joints", (shape.point, end), BLUE, 1.4)
        yield Head("joints", end, shape.direction, BLUE)


def _mark(at: Point, *, filled: bool) -> Mark:
    return Mark(at, BLACK if filled else "#FFFFFF", GREY if filled else BLACK)


def _ends(axis: Point, half: float) -> tuple[Point, Point]:
    zero: Point = (0.0, 0.0, 0.0)
    return along(zero, -half, axis), along(zero, half, axis)


def _thread(axis: Point) -> tuple[Point, ...]:
    """Two turns of a right-handed helix around a unit axis."""
    one, two = across(axis)
    found = []
    for k in range(49):
        angle, radius = 4 * math.pi * k / 48, 1.35 * _RADIUS
        point = along((0.0, 0.0, 0.0), _HALF * (k / 24 - 1), axis)
        point = along(point, radius * math.cos(angle), one)
        found.append(along(point, radius * math.sin(angle), two))
    return tuple(found)


def _screws(view: View) -> Iterator[Item]:
    shapes = {body.name: body for body in view.scene.bodies}
    centre = _centre(shapes.get(view.platform))
    groups: tuple[tuple[Group, str, tuple[PlacedScrew, ...], str], ...] = (
        ("twists", "t", view.twists, TWISTS),
        ("wrenches", "w", view.wrenches, WRENCHES),
    )
    for group, letter, screws, colour in groups:
        for name, screw in zip(screw_names(screws, letter), screws, strict=True):
            text = f"{name}{_pitch(screw)}"
            if screw.point is None:
                yield from _free(group, screw, centre, view.scene.size, colour, text)
            else:
                yield from _bound(group, screw, view.scene, colour, text)


def _pitch(screw: PlacedScrew) -> str:
    return f", pitch {decimal(screw.pitch)}" if screw.pitch else ""


def _free(
    group: Group,
    screw: PlacedScrew,
    start: Point,
    size: float,
    colour: str,
    text: str,
) -> Iterator[Item]:
    """A couple or a translation: an arrow that may be drawn anywhere."""
    end = along(start, _ARROW * size, screw.direction)
    yield Stroke(group, (start, end), colour, 2.0)
    count = 2 if screw.kind == "couple" else 1
    yield Head(group, end, screw.direction, colour, count)
    yield Label(group, end, text, colour)


def _bound(
    group: Group, screw: PlacedScrew, scene: Scene, colour: str, text: str
) -> Iterator[Item]:
    """A screw with an axis; those of twists are dashed and show the sense of turning.

    The axis is drawn where it passes the mechanism.
    """
    foot = screw.point or (0.0, 0.0, 0.0)
    middle, size = middle_of(scene), scene.size
    step = sum(
        (m - f) * d for m, f, d in zip(middle, foot, screw.direction, strict=True)
    )
    near = along(foot, step, screw.direction)
    start, end = (along(near, s * _LINE * size, screw.direction) for s in (-1.0, 1.0))
    yield Stroke(group, (start, end), colour, 1.8, dashed=group == "twists")
    yield Head(group, end, screw.direction, colour)
    if group == "twists" or screw.kind == "screw":
        arc = turn(
            along(end, -0.08 * size, screw.direction), screw.direction, 0.03 * size
        )
        yield Stroke(group, arc, colour, 1.4)
        yield Head(group, arc[-1], _towards(arc[-2], arc[-1]), colour)
    yield Label(group, end, text, colour)


def _towards(start: Point, end: Point) -> Point:
    x, y, z = (e - s for s, e in zip(start, end, strict=True))
    size = math.sqrt(x * x + y * y + z * z) or 1.0
    return x / size, y / size, z / size
