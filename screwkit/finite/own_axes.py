"""Axes of ball joints that are directions of the mechanism, not of the file's frame.

A ball turns about any axes through its centre.  Arguments that hold or tie some of its
freedoms depend on which are taken, so that these come from the other joints: the
direction that most of them share comes first.  The same mechanism in another frame is
then proved by the same arguments.

References: [Herve1999].
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from screwkit.kinematics.network import Motion, motion
from screwkit.mechanism.model import JointType

Vector = Sequence[int]
Screw = Sequence[int]

_ASKEW = ((31, 17, 11), (-19, 37, 13), (7, -23, 41))
"""Coordinates of three directions askew to those of a triad and to each other."""

_UNITS = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def in_own_axes(at: Motion, *, askew: bool = False) -> Motion:
    """The same motion, its ball joints with freedoms about axes of the mechanism.

    Args:
        at: At an exact posture.  Balls with locked freedoms stay as they are.
        askew: Take combinations that are parallel to no axis of another joint, lest
            freedoms be tied to these.
    """
    balls = [
        labels
        for labels in _balls(at)
        if not at.locked & set(labels) and _is_upright(at, labels)
    ]
    prime = at.posture.prime
    triad = _triad(_directions(at), prime) if balls else []
    if not triad:
        return at
    if askew:
        triad = [
            [
                sum(k * x for k, x in zip(row, column, strict=True)) % prime
                for column in zip(*triad, strict=True)
            ]
            for row in _ASKEW
        ]
    twists = dict(at.posture.twists)
    for labels in balls:
        screws = [at.posture.twists[label] for label in labels]
        for label, axis in zip(labels, triad, strict=True):
            twists[label] = tuple(
                sum(x * screw[k] for x, screw in zip(axis, screws, strict=True)) % prime
                for k in range(6)
            )
    return motion(at.network, replace(at.posture, twists=twists), at.locked)


def _balls(at: Motion) -> Iterator[tuple[str, ...]]:
    """The freedoms of every ball joint, by the names of joints."""
    for joint in sorted(at.network.mechanism.joints, key=lambda joint: joint.name):
        if joint.type is JointType.SPHERICAL:
            yield at.network.labels_of[joint.name]


def _is_upright(at: Motion, labels: Sequence[str]) -> bool:
    """Whether a ball's freedoms turn about the axes of the base frame."""
    turns = [tuple(at.posture.twists.get(label, ())[:3]) for label in labels]
    return turns == list(_UNITS)


def _directions(at: Motion) -> list[Vector]:
    """Of axes, those that most joints share first, and of lines between balls."""
    twists, prime = at.posture.twists, at.posture.prime
    balls = list(_balls(at))
    in_balls = {label for labels in balls for label in labels}
    shared: list[list[Vector]] = []
    for joint in sorted(at.network.mechanism.joints, key=lambda joint: joint.name):
        for label in at.network.labels_of[joint.name]:
            screw = twists.get(label, ())
            if (
                not any(screw)
                or label in in_balls
                or label in at.network.contact_labels
            ):
                continue
            own = screw[:3] if any(screw[:3]) else screw[3:]
            alike = next((g for g in shared if _parallel(g[0], own, prime)), None)
            if alike is None:
                shared.append([own])
            else:
                alike.append(own)
    found = [group[0] for group in sorted(shared, key=len, reverse=True)]
    centres = [_centre([twists[x] for x in b]) for b in balls if _is_upright(at, b)]
    if centres:
        first, *others = centres
        found += [
            [(x - y) % prime for x, y in zip(other, first, strict=True)]
            for other in others
        ]
    return [direction for direction in found if any(direction)]


def _centre(ball: Sequence[Screw]) -> Vector:
    """Of three screws (ω; c×ω) about x, y and z."""
    about_x, about_y = ball[0], ball[1]
    return (about_y[5], -about_x[5], about_x[4])


def _triad(directions: Sequence[Vector], prime: int) -> list[Vector]:
    """The first direction and two at right angles to it, the second fixing these."""
    if not directions:
        return []
    first = directions[0]
    others = (*directions[1:], *_UNITS)
    second = next(d for d in others if not _parallel(first, d, prime))
    normal = _cross(first, second, prime)
    across = _cross(normal, first, prime)
    triad = [first, across, normal]
    square = sum(x * x for x in first) * sum(x * x for x in normal) % prime
    return triad if square else []


def _parallel(one: Vector, other: Vector, prime: int) -> bool:
    return not any(_cross(one, other, prime))


def _cross(a: Vector, b: Vector, prime: int) -> Vector:
    return (
        (a[1] * b[2] - a[2] * b[1]) % prime,
        (a[2] * b[0] - a[0] * b[2]) % prime,
        (a[0] * b[1] - a[1] * b[0]) % prime,
    )
