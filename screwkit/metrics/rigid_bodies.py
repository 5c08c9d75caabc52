"""What keeps its value when a mechanism moves: the inside of every body.

In a ``posture`` file the symbols place axes and points; they move the mechanism only as
far as every body stays congruent to itself.  A body is known by the axes, points and
directions that its joints fix in it, and these by their products: of two directions, of
three, of two lines, of the way from one to the other with every direction.

References: [MurrayLiSastry1994] §2.1 (rigid displacements keep these).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import TypeAlias

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import cross
from screwkit.mechanism.joints import CATALOGUE, RIGID, freedom_labels
from screwkit.mechanism.model import Joint, JointType, Mechanism

PARALLEL = 1e-9
"""Sine of the angle of two directions that count as parallel."""

Rows: TypeAlias = Mapping[str, Array]
"""Unit twists (ω; v) by freedom, shape (batch, 6), lengths over the characteristic."""

_POINTS = (JointType.SPHERICAL, JointType.HARD_FINGER)
_AXES = (JointType.REVOLUTE, JointType.HELICAL, JointType.CYLINDRICAL)


@dataclass
class _Body:
    """What joints fix in a body, by labels of their freedoms.

    Attributes:
        lines: Axes.
        slides: Directions of translation.
        points: Centres, by the freedoms of the ball or universal joint.
    """

    lines: list[str] = field(default_factory=list)
    slides: list[str] = field(default_factory=list)
    points: list[tuple[str, ...]] = field(default_factory=list)


@dataclass(frozen=True)
class RigidBodies:
    """The bodies of a mechanism, and which of their axes are parallel.

    Attributes:
        bodies: Links, those joined rigidly as one, and the crosses of universal joints.
        parallel: Pairs of axes that are parallel, and so stay.
    """

    bodies: tuple[_Body, ...]
    parallel: frozenset[tuple[str, str]]

    @property
    def lines(self) -> frozenset[str]:
        """All axes."""
        return frozenset(label for body in self.bodies for label in body.lines)

    def values(self, rows: Rows) -> Array:
        """What must stay, shape (batch, count)."""
        feet = {x: cross(rows[x][:, :3], rows[x][:, 3:]) for x in self.lines}
        labels = {point for body in self.bodies for point in body.points}
        centres = {point: centre(rows, point) for point in labels}
        found = [x for body in self.bodies for x in self._of(body, rows, feet, centres)]
        batch = len(next(iter(rows.values()))) if rows else 1
        if not found:
            return np.zeros((batch, 0))
        values = np.empty((batch, len(found)))
        for i, value in enumerate(found):
            values[:, i] = value
        return values

    def _of(
        self,
        body: _Body,
        rows: Rows,
        feet: Rows,
        centres: Mapping[tuple[str, ...], Array],
    ) -> Iterator[Array]:
        along = {label: rows[label][:, :3] for label in body.lines}
        ways = [*along.values(), *(rows[label][:, 3:] for label in body.slides)]
        yield from (_dot(one, two) for one, two in combinations(ways, 2))
        yield from (_dot(a, cross(b, c)) for a, b, c in combinations(ways[:4], 3))
        for one, two in combinations(body.lines, 2):
            if (one, two) in self.parallel:
                yield from _told(feet[two] - feet[one], ways)
            else:
                yield _dot(along[one], rows[two][:, 3:]) + _dot(
                    along[two], rows[one][:, 3:]
                )
        points = [centres[labels] for labels in body.points]
        for here, there in combinations(points, 2):
            yield from _told(there - here, ways)
        arms = [there - points[0] for there in points[1:4]]
        if len(arms) == 3:
            yield _dot(arms[0], cross(arms[1], arms[2]))
        for point in points:
            for label in body.lines:
                axis = along[label]
                away = point - feet[label]
                away = away - axis * _dot(axis, away)[:, None]
                yield from _told(away, ways)


def _told(way: Array, directions: list[Array]) -> Iterator[Array]:
    """A way by its length and by what it is along each direction."""
    yield _dot(way, way)
    yield from (_dot(way, one) for one in directions)


def _dot(one: Array, two: Array) -> Array:
    return np.asarray(np.einsum("...i,...i->...", one, two))


def centre(rows: Rows, labels: Sequence[str]) -> Array:
    """Where the axes of a ball or universal joint meet, shape (batch, 3)."""
    along = np.stack([rows[x][:, :3] for x in labels], axis=1)
    moments = np.stack([rows[x][:, 3:] for x in labels], axis=1)
    across = np.eye(3) - along[..., :, None] * along[..., None, :]
    feet = cross(along, moments).sum(axis=1)
    one, two, three = np.moveaxis(across.sum(axis=1), 1, 0)
    # By Cramer's rule: the matrices are symmetric and far from singular.
    crossed = [cross(two, three), cross(three, one), cross(one, two)]
    inverse = np.stack(crossed, axis=1)
    size = _dot(one, inverse[:, 0])
    return np.asarray((inverse @ feet[..., None])[..., 0] / size[:, None])


def rigid_bodies(mechanism: Mechanism, rows: Rows) -> RigidBodies | None:
    """The bodies of a ``posture`` file.

    Args:
        mechanism: Any.
        rows: Unit twists at the posture of the file.

    Returns:
        None where a contact or a planar joint leaves open what it fixes in a body.
    """
    bodies: dict[str, _Body] = {}
    together = _joined(mechanism)
    for joint in mechanism.joints:
        if joint.type in RIGID:
            continue
        ends = [bodies.setdefault(together[x], _Body()) for x in _ends(joint)]
        labels = freedom_labels(joint, mechanism.space)
        if joint.type is JointType.UNIVERSAL:
            cross = bodies.setdefault(f"\0{joint.name}", _Body())
            for label, link in zip(labels, ends, strict=True):
                link.lines.append(label)
                link.points.append(labels)
                cross.lines.append(label)
        elif joint.type in _POINTS and len(labels) == 3:
            for link in ends:
                link.points.append(labels)
        elif joint.type in _AXES or (joint.type in _POINTS and len(labels) == 1):
            for link in ends:
                link.lines.append(labels[0])
        elif joint.type is JointType.PRISMATIC:
            for link in ends:
                link.slides.append(labels[0])
        elif CATALOGUE[joint.type].contact or joint.type is JointType.PLANAR:
            return None
    lines = [body.lines for body in bodies.values()]
    pairs = {pair for body in lines for pair in combinations(body, 2)}
    return RigidBodies(
        tuple(bodies.values()),
        frozenset(pair for pair in pairs if _parallel(rows, *pair)),
    )


def _ends(joint: Joint) -> tuple[str, str]:
    return joint.parent, joint.child


def _parallel(rows: Rows, one: str, two: str) -> bool:
    return bool(np.linalg.norm(np.cross(rows[one][0, :3], rows[two][0, :3])) < PARALLEL)


def _joined(mechanism: Mechanism) -> dict[str, str]:
    """One link for all that rigid joints make one body."""
    found = {link: link for link in mechanism.links}
    for joint in mechanism.joints:
        if joint.type in RIGID:
            kept, lost = found[joint.parent], found[joint.child]
            found = {x: kept if body == lost else body for x, body in found.items()}
    return found
