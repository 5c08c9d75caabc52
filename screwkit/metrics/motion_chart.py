"""The mechanism's own motion, written in the symbols of its file, and a measure on it.

What a file declares under ``variables``, and joint variables that no loop ties, move
the mechanism; dimensions stay.  In a ``posture`` file the same symbols could also
change a body: then the equations of `rigid_bodies` say which values are motions.

Far is measured from one posture: the platform's pose by the angle of one rotation and
the shift of its origin, every other symbol by its change; lengths over one length.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import symbols_of
from screwkit.errors import UndecidedError
from screwkit.finite.exponentials import rotation_vectors
from screwkit.kinematics.loops import ring_at
from screwkit.kinematics.placement import joint_twists
from screwkit.kinematics.values import with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.nearest_point import CUT
from screwkit.metrics.posture_samples import posture_sample, posture_symbols
from screwkit.metrics.rigid_bodies import RigidBodies, Rows, rigid_bodies
from screwkit.metrics.smooth import Remembered, slopes

SAMPLES = 64
"""Postures from which the characteristic length is taken."""


@dataclass(frozen=True, eq=False)
class MotionChart:
    """Symbols that move a mechanism, and how far.

    Attributes:
        mechanism: Whose dimensions have their numbers.
        names: The symbols that move it.
        start_values: Their values where distances begin, in radians and file lengths.
        start: The same as a point, shape (n,): angles, and lengths over ``length``.
        units: What a coordinate is multiplied with to be a value of the file.
        angles: Which symbols are angles.
        posed: Those that enter the pose of the platform; measured by the pose.
        length: That counts as one radian, in file lengths.
        bodies: Whose insides must stay; None where no symbol can change them.
        inside: Their values that symbols can change, at the start, by place in the
            list; empty where ``bodies`` is None.
    """

    mechanism: Mechanism
    names: tuple[str, ...]
    start_values: tuple[float, ...]
    start: Array
    units: Array
    angles: frozenset[str]
    posed: frozenset[str]
    length: float
    bodies: RigidBodies | None = None
    inside: Mapping[int, float] = field(default_factory=dict)

    def values(self, points: Array) -> dict[str, Array]:
        """The symbols at points of shape (batch, n), in radians and file lengths."""
        return {
            name: points[..., i] * self.units[i] for i, name in enumerate(self.names)
        }

    @property
    def shifted(self) -> bool:
        """Whether symbols of the pose shift the platform."""
        return bool(_of_pose(self.mechanism)[1] & frozenset(self.names))

    @property
    def origin(self) -> Array:
        """Of the platform's frame where distances begin, shape (3,)."""
        return np.asarray(self._pose(self.start[None])[1][0])

    def away(self, points: Array) -> Array:
        """What the distance is the norm of, shape (batch, k)."""
        others = [i for i, name in enumerate(self.names) if name not in self.posed]
        change = (points - self.start)[:, others]
        if not self.posed:
            return change
        turn, shift = self._pose(points)
        first, origin = self._pose(self.start[None])
        turned = rotation_vectors(turn @ np.swapaxes(first, -1, -2))
        return np.concatenate([turned, (shift - origin) / self.length, change], axis=-1)

    def kept(self, points: Array) -> Array:
        """By what bodies differ from those at the start, shape (batch, k)."""
        if self.bodies is None:
            return np.zeros((len(points), 0))
        now = self.bodies.values(self.rows(points))
        before = np.array([*self.inside.values()])
        return np.asarray(now[:, list(self.inside)] - before)

    @cached_property
    def rows(self) -> Remembered[Rows]:
        """Unit twists of all freedoms at points, lengths over ``length``."""
        return Remembered(
            lambda points: unit_rows(self.mechanism, self.values(points), self.length)
        )

    def _pose(self, points: Array) -> tuple[Array, Array]:
        pose = self.mechanism.pose
        if pose is None:
            raise ValueError("a mechanism without a pose has no posed symbols")
        ring = ring_at(self.mechanism, dict(self.values(points)))

        def column(expressions: tuple[Expression, ...]) -> Array:
            parts = [evaluate(x, ring) for x in expressions]
            return np.stack([np.broadcast_to(x, len(points)) for x in parts], axis=-1)

        rows = [column(row) for row in pose.rotation]
        return np.stack(rows, axis=-2), column(pose.translation)


def unit_rows(
    mechanism: Mechanism, values: Mapping[str, Array | float], length: float
) -> dict[str, Array]:
    """Unit twists about the base origin by freedom, lengths over ``length``."""
    ring = ring_at(mechanism, values)
    batch = np.broadcast_shapes(*(np.shape(v) for v in values.values())) or (1,)
    found = {}
    for label, twist in joint_twists(mechanism, ring, mechanism.base).items():
        row = np.empty((*batch, 6))
        for i, coordinate in enumerate(twist.coordinates):
            row[..., i] = coordinate
        turns = bool(np.any(row[..., :3]))
        half = row[..., :3] if turns else row[..., 3:]
        with np.errstate(divide="ignore", invalid="ignore"):
            row /= np.sqrt(np.einsum("...i,...i->...", half, half))[..., None]
        found[label] = row / ([1, 1, 1, length, length, length] if turns else 1.0)
    return found


def motion_chart(
    mechanism: Mechanism,
    values: Mapping[str, float],
    length: float | None = None,
) -> MotionChart:
    """The chart of a mechanism whose loops tie no symbols.

    Args:
        mechanism: Its dimensions have values.
        values: Of symbols where distances begin; the values of the file, and 0 of joint
            variables, by default.
        length: That counts as one radian; the characteristic length where None.

    Raises:
        UndecidedError: If a dimension has no value, nothing moves, or the file leaves
            open which symbols move the mechanism and which change it.
    """
    names = posture_symbols(mechanism)
    if not names:
        raise UndecidedError("no symbol of the file moves the mechanism")
    sample = posture_sample(mechanism, SAMPLES, {}, length)
    angles = frozenset(r.symbol for r in sample.ranges if r.angle)
    dimensions = {
        p.name: p.value
        for p in mechanism.parameters
        if p.name not in names and p.value is not None
    }
    numbers = with_values(mechanism, dimensions)
    turns, slides = _of_pose(numbers)
    pure = frozenset(names) & turns
    units = [1.0 if n in angles or n in pure else sample.length for n in names]
    started = ring_at(numbers, {n: values.get(n, 0.0) for n in _unset(numbers, values)})
    begun = tuple(float(started.values[name]) for name in names)
    plain = MotionChart(
        mechanism=numbers,
        names=names,
        start_values=begun,
        start=np.array(begun) / np.array(units),
        units=np.array(units),
        angles=angles,
        posed=frozenset(names) & (turns | slides),
        length=sample.length,
    )
    if numbers.geometry != "posture":
        return plain
    return _with_bodies(plain)


def _unset(mechanism: Mechanism, values: Mapping[str, float]) -> list[str]:
    """Symbols whose value the file does not say, or another replaces."""
    written = [p.name for p in mechanism.parameters if p.value is not None]
    return [
        name
        for name in posture_symbols(mechanism)
        if name in values or name not in written
    ]


def _of_pose(mechanism: Mechanism) -> tuple[frozenset[str], frozenset[str]]:
    """The symbols in the rotation and in the shift of the platform."""
    if mechanism.pose is None:
        return frozenset(), frozenset()
    turns = [symbols_of(x) for row in mechanism.pose.rotation for x in row]
    slides = [symbols_of(x) for x in mechanism.pose.translation]
    return frozenset().union(*turns), frozenset().union(*slides)


def _with_bodies(chart: MotionChart) -> MotionChart:
    """The chart with the equations of its bodies, where symbols can change these."""
    rows = unit_rows(chart.mechanism, chart.values(chart.start[None]), chart.length)
    bodies = rigid_bodies(chart.mechanism, rows)
    if bodies is None:
        raise UndecidedError(
            "contacts and planar joints do not say what stays in the bodies they touch"
        )
    before = bodies.values(rows)[0]
    tied = replace(chart, bodies=bodies, inside=dict(enumerate(before.tolist())))
    random = np.random.default_rng(1).uniform(-0.2, 0.2, (4, len(chart.names)))
    places = np.concatenate([chart.start[None], chart.start + random])
    change = np.abs(slopes(tied.kept, places))
    exist = np.isfinite(change).all(axis=(1, 2))
    varies = np.flatnonzero(change[exist].max(axis=(0, 2), initial=0.0) > CUT)
    inside = {int(i): float(before[i]) for i in varies}
    return replace(tied, inside=inside) if inside else chart
