"""What members with two joints transmit: forces along bars, couples of spherical links.

A member that two passive joints alone connect with the rest is in equilibrium under two
wrenches that are each reciprocal to one joint, so under one that is reciprocal to both.
In a planar linkage that is a force through both hinges, or through a hinge and normal
to a slide; between two ball joints the same; in a spherical linkage a couple normal to
both axes, beside forces through the centre.

References: [Hunt1978] §1, for instant centres; [LongCaroKhalil2012] (26).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.named_screws import JOIN, LINE, NORMAL, NamedScrew
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Joint, Mechanism
from screwkit.screw.vector import Vector, cross, dot, subtract

_MOST = 24  # members


@dataclass(frozen=True)
class _Hinge:
    """A passive joint of one freedom, or a ball joint.

    Attributes:
        way: Direction of its axis or slide.
        place: A point of its axis, the centre of a ball joint; None of a slide.
    """

    joint: str
    way: Vector[Polynomial]
    place: Vector[Polynomial] | None
    ball: bool


def member_wrenches(
    mechanism: Mechanism, framed: FramedTwists, locked: Collection[str] = ()
) -> tuple[NamedScrew, ...]:
    """The wrench of every member with two joints, where it is one that has a name.

    Args:
        mechanism: Any mechanism.
        framed: The twists of its joints; those that are missing are taken as absent.
        locked: Freedoms that are held; what they connect is one member.
    """
    pairs = _pairs(mechanism, framed, locked)
    hinges = {j: _hinge(framed, mechanism, j) for pair in pairs for j in pair}
    names = {j.name: _point_name(j, mechanism) for j in mechanism.joints}
    normal = _normal_of_plane(framed)
    found: dict[frozenset[str], NamedScrew] = {}
    for pair in pairs:
        one, other = (hinges[j] for j in pair)
        if one is None or other is None or frozenset(pair) in found:
            continue
        screw = _wrench(framed, one, other, normal, names)
        if screw is not None:
            found[frozenset(pair)] = screw
    return tuple(found.values())[:_MOST]


def _pairs(
    mechanism: Mechanism, framed: FramedTwists, locked: Collection[str]
) -> list[tuple[str, str]]:
    """The two joints of each member that has no more; the base and platform last."""
    body = {link: link for link in mechanism.links}
    joints_of: dict[str, list[str]] = {}
    free = []
    for joint in mechanism.joints:
        labels = freedom_labels(joint, mechanism.space)
        if all(label in locked for label in labels):
            one, other = body[joint.parent], body[joint.child]
            body = {k: one if v == other else v for k, v in body.items()}
        elif all(label in framed.joints for label in labels):
            free.append(joint)
    for joint in free:
        for link in (joint.parent, joint.child):
            joints_of.setdefault(body[link], []).append(joint.name)
    ends = {body[mechanism.base], body[mechanism.platform]}
    ordered = sorted(joints_of, key=lambda link: link in ends)
    return [
        (joints_of[link][0], joints_of[link][1])
        for link in ordered
        if len(set(joints_of[link])) == 2 == len(joints_of[link])
    ]


def _hinge(framed: FramedTwists, mechanism: Mechanism, name: str) -> _Hinge | None:
    joint = mechanism.joint(name)
    labels = freedom_labels(joint, mechanism.space)
    ball = name in dict(framed.balls) and len(labels) == 3
    if not ball and len(labels) != 1:
        return None
    column = framed.column(labels[0])
    place = framed.points[framed.joints.index(labels[0])]
    turn, slide = _vector(column[DIRECTION]), _vector(column[MOMENT])
    if all(x == 0 for x in turn):
        return _Hinge(name, slide, None, ball=False)
    ring = framed.ring
    power = ring.normal(dot(turn, slide))
    return None if power != 0 and not ball else _Hinge(name, turn, place, ball)


def _wrench(
    framed: FramedTwists,
    one: _Hinge,
    other: _Hinge,
    normal: Vector[Polynomial] | None,
    names: dict[str, str],
) -> NamedScrew | None:
    ring = framed.ring
    if one.place is None:
        one, other = other, one
    if one.place is None:
        return None
    if one.ball or other.ball:
        if not (one.ball and other.ball and other.place is not None):
            return None
        return _line(framed, one, subtract(other.place, one.place), names, other)
    if normal is not None:
        return _in_plane(framed, one, other, normal, names)
    if other.place is None:
        return None
    across = tuple(ring.normal(x) for x in cross(one.way, other.way))
    offset = subtract(other.place, one.place)
    if all(x == 0 for x in across) or ring.normal(dot(across, offset)) != 0:
        return None
    column = ring.without_divisors([*(ring.zero,) * 3, *across])
    name = f"{one.joint} and {other.joint}"
    limb = _limb(framed, one.joint)
    return NamedScrew(tuple(column), NORMAL, name, limb, free=True)


def _in_plane(
    framed: FramedTwists,
    one: _Hinge,
    other: _Hinge,
    normal: Vector[Polynomial],
    names: dict[str, str],
) -> NamedScrew:
    """In the plane through the origin of the frame that all axes are normal to."""
    assert one.place is not None
    if other.place is None:
        along = cross(normal, other.way)
    else:
        along = cross(normal, cross(subtract(other.place, one.place), normal))
    return _line(framed, one, along, names, other, normal)


def _line(
    framed: FramedTwists,
    one: _Hinge,
    along: Vector[Polynomial],
    names: dict[str, str],
    other: _Hinge,
    normal: Vector[Polynomial] | None = None,
) -> NamedScrew:
    """The force through a hinge along a direction, as (f; m)."""
    ring = framed.ring
    assert one.place is not None
    place, size = one.place, ring.one
    if normal is not None:
        place, size = cross(normal, cross(place, normal)), dot(normal, normal)
    force = [ring.normal(size * x) for x in along]
    moment = [ring.normal(x) for x in cross(place, along)]
    column = tuple(ring.without_divisors([*force, *moment]))
    written = names[one.joint], names[other.joint]
    noun, name = JOIN, f"through axes {one.joint} and {other.joint}"
    if other.place is None:
        name = f"through axis {one.joint} normal to slide {other.joint}"
    elif all(written):
        noun, name = LINE, " ".join(sorted(written))
    elif one.ball:
        name = f"through the centres of {one.joint} and {other.joint}"
    return NamedScrew(column, noun, name, _limb(framed, one.joint))


def _limb(framed: FramedTwists, joint: str) -> int:
    labels = dict(framed.balls).get(joint, (joint,))
    return framed.limb_of(labels[0])


def _point_name(joint: Joint, mechanism: Mechanism) -> str:
    """What the file calls the point at which a joint is; empty where it does not."""
    if joint.point is None:
        return ""
    named = (n for n, place in mechanism.points.items() if place == joint.point)
    return next(named, "")


def _normal_of_plane(framed: FramedTwists) -> Vector[Polynomial] | None:
    """The direction of all axes, if they are parallel for ever and slides normal."""
    ring: TrigonometricRing = framed.ring
    turns, slides = [], []
    for column in framed.columns:
        turn = _vector(column[DIRECTION])
        if any(x != 0 for x in turn):
            turns.append(turn)
            if ring.normal(dot(turn, _vector(column[MOMENT]))) != 0:
                return None
        else:
            slides.append(_vector(column[MOMENT]))
    if not turns:
        return None
    first = turns[0]
    if any(_any(ring, cross(first, t)) for t in turns[1:]):
        return None
    return None if any(_any(ring, [dot(first, s)]) for s in slides) else first


def _any(ring: TrigonometricRing, values: Sequence[Polynomial]) -> bool:
    return any(ring.normal(x) != 0 for x in values)


def _vector(values: Sequence[Polynomial]) -> Vector[Polynomial]:
    x, y, z = values
    return x, y, z
