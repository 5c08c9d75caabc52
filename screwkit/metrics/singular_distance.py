"""The nearest singular postures on a mechanism's own motion, searched in numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression
from screwkit.errors import UndecidedError
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.finite.spanning_forest import forest_of
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.joint_space import JointSpace
from screwkit.metrics.limited import LimitedScrews, Limits, no_limits
from screwkit.metrics.motion_chart import MotionChart
from screwkit.metrics.nearest_point import restored
from screwkit.metrics.nearest_search import Outcome, Sample, nearest
from screwkit.metrics.rank_conditions import (
    DifferencedScrews,
    FallenRank,
    ScrewField,
    ScrewMatrices,
    rank_at,
)
from screwkit.metrics.smooth import (
    Batched,
    Conditions,
    Smooth,
    by_differences,
    scaled,
    several,
)
from screwkit.metrics.ways_on_motion import Space

SPARSE = 8
"""Every so many of the postures is looked at where all are asked about."""

BESIDE = 4
STEP = 1e-2
"""How many postures are looked at beside one, and how far from it."""

NOTHING = 1e-10
"""Largest value of scaled equations that a posture on a component leaves."""


@dataclass(frozen=True, eq=False)
class Nearest:
    """A singular posture that was found.

    Attributes:
        values: Of the coordinates of the search, in radians and file lengths.
        model: The mechanism there.
    """

    distance: float
    values: tuple[float, ...]
    connected: bool
    model: PostureModel


@dataclass(frozen=True, eq=False)
class Looked:
    """What came of a search.

    Attributes:
        nearest: None where no posture was found.
        starts: From how many postures it began; 1 where the posture itself is one.
        met: How many of them led to that distance.
        rank: Of the matrix concerned in general; 0 where equations were met.
    """

    nearest: Nearest | None
    starts: int
    met: int
    rank: int = 0


class Search:
    """Looks for singular postures around one posture.

    Attributes:
        space: Where, in coordinates that keep to the limits.
        postures: Some on the motion, that posture first, shape (count, n).
    """

    def __init__(
        self,
        space: Space,
        field: ScrewField,
        model_at: Callable[[Array], PostureModel],
        units: Array,
        limits: Limits,
    ) -> None:
        own = limits.coordinates(space.start)
        self.space = Space(
            own, limits.of(space.away), limits.of(space.kept), space.tied
        )
        screws = LimitedScrews(field.screws, limits)
        self._field = ScrewField(field.labels, screws, field.forest)
        self._model_at, self._units, self._limits = model_at, units, limits
        self._sample = Sample(self.space)
        self._others: list[Array] = []
        self.postures = self._existing(self._sample.all())

    def _existing(self, points: Array) -> Array:
        with np.errstate(all="ignore"):
            screws = self._field.screws.values(points)
        return points[np.isfinite(screws).all(axis=(1, 2))]

    def on(self, equations: Batched, counts: Callable[[PostureModel], bool]) -> Looked:
        """The nearest posture where equations hold.

        Args:
            equations: What vanishes, of points of the coordinates without limits.
            counts: Whether a posture where they do is singular.
        """
        plain = self._limits.of(by_differences(equations))
        own = scaled(plain, _scale(plain, self.postures))
        here = np.abs(own.values(self.space.start[None])).max(initial=0.0)
        if here < NOTHING and self._counts_near(self.space.start, own, counts):
            return self._here()
        return self._looked(own, lambda x: self._counts_near(x, own, counts))

    def _counts(self, point: Array, counts: Callable[[PostureModel], bool]) -> bool:
        """Whether a posture counts; none does where an axis has no direction."""
        try:
            with np.errstate(all="ignore"):
                model = self._model_at(self._limits.within(point))
        except UndecidedError:
            return False
        return counts(model)

    def _counts_near(
        self, point: Array, equations: Smooth, counts: Callable[[PostureModel], bool]
    ) -> bool:
        """Whether a posture counts, or postures with these equations next to it.

        Where another singularity meets a component, the rank may be what it is in
        general, and yet be less beside it.
        """
        if self._counts(point, counts):
            return True
        random = np.random.default_rng(2)
        steps = random.normal(size=(BESIDE, len(point)))
        steps *= STEP / np.linalg.norm(steps, axis=1, keepdims=True)
        beside = restored(self._on_motion(equations), point + steps)
        exist = np.isfinite(beside).all(axis=1)
        return any(self._counts(one, counts) for one in beside[exist])

    def _on_motion(self, equations: Conditions) -> Conditions:
        parts = [self.space.kept, equations] if self.space.tied else [equations]
        return several(parts)

    def everywhere(self, counts: Callable[[PostureModel], bool]) -> bool:
        """Whether all of some postures on the motion count."""
        others = self.postures[1:][::SPARSE]
        if not len(others):
            others = self.postures
        return all(self._counts(point, counts) for point in others)

    def where_limb_falls(
        self, labels: Sequence[str], counts: Callable[[PostureModel], bool]
    ) -> Looked:
        """The rank of a limb in general, and the nearest posture where it is less."""
        return self._where_falls(self._field.of_limb(labels), counts)

    def where_loops_fall(
        self, locked: Sequence[str], counts: Callable[[PostureModel], bool]
    ) -> Looked:
        """The same of J_c, without the columns of locked freedoms.

        Args:
            locked: Freedoms.
            counts: Whether a posture where the rank is less is what is asked for.
        """
        return self._where_falls(self._field.of_loops(locked), counts)

    def _where_falls(
        self, matrices: ScrewMatrices, counts: Callable[[PostureModel], bool]
    ) -> Looked:
        rank = rank_at(matrices, self.postures)
        if not rank:
            return Looked(None, len(self.postures), 0)
        start = self.space.start
        fallen = rank_at(matrices, start[None]) < rank
        if fallen and self._counts(start, counts):
            return replace(self._here(), rank=rank)
        found = self._looked(
            FallenRank(matrices, rank), lambda point: self._counts(point, counts)
        )
        return replace(found, rank=rank)

    def _here(self) -> Looked:
        return Looked(self._shown(self.space.start, 0.0, connected=True), 1, 1)

    def _looked(
        self, conditions: Conditions, counts: Callable[[Array], bool]
    ) -> Looked:
        found: Outcome = nearest(self._sample, conditions, counts, self._others)
        if found.nearest is None:
            return Looked(None, found.starts, 0)
        point, distance = found.nearest.point, found.nearest.distance
        # What is singular in one way is often near to what is in another.
        self._others.append(point)
        shown = self._shown(point, distance, connected=found.nearest.connected)
        return Looked(shown, found.starts, found.met)

    def _shown(self, point: Array, distance: float, *, connected: bool) -> Nearest:
        own = self._limits.within(point)
        values = tuple(float(x) for x in own * self._units)
        return Nearest(distance, values, connected, self._model_at(own))


def _scale(equations: Smooth, points: Array) -> Array:
    """The usual size of each equation's slope, so that a miss is a distance."""
    with np.errstate(all="ignore"):
        sizes = np.linalg.norm(equations.slopes(points), axis=2)
    sizes = np.where(np.isfinite(sizes), sizes, np.nan)
    exist = np.isfinite(sizes).any(axis=0)
    middle = np.nanmedian(np.where(exist, sizes, 1.0), axis=0)
    return np.asarray(np.where(middle > 0, middle, 1.0))


def chart_search(chart: MotionChart, limits: Limits | None = None) -> Search:
    """The search in the symbols of a file.

    Args:
        chart: Of the mechanism.
        limits: Of its coordinates.
    """
    names, mechanism = chart.names, chart.mechanism
    space = Space(
        chart.start,
        by_differences(chart.away),
        by_differences(chart.kept),
        chart.bodies is not None,
    )

    def model_at(point: Array) -> PostureModel:
        values = point * chart.units
        return posture_model(mechanism, dict(zip(names, values.tolist(), strict=True)))

    first = model_at(chart.start)

    def screws(points: Array) -> Array:
        rows = chart.rows(points)
        return np.stack([rows[label] for label in first.labels], axis=1)

    field = ScrewField(first.labels, DifferencedScrews(screws), forest_of(first))
    free = no_limits(len(names))
    return Search(space, field, model_at, chart.units, limits or free)


def nearest_at(
    chart: MotionChart, values: Mapping[str, float], distance: float
) -> Nearest:
    """A posture that is known already, with the mechanism there."""
    return Nearest(
        distance,
        tuple(float(values[name]) for name in chart.names),
        True,
        posture_model(chart.mechanism, values),
    )


def joint_search(space: JointSpace, limits: Limits | None = None) -> Search:
    """The search in the coordinates of all joints.

    Args:
        space: Where.
        limits: Of the coordinates, which count from the posture.
    """
    count = len(space.model.labels)
    around = Space(space.start, space.away, space.kept, tied=True)
    field = ScrewField(space.model.labels, space.screws, space.forest)
    return Search(
        around, field, space.model_at, space.units, limits or no_limits(count)
    )


def equations_on(
    chart: MotionChart, mechanism: Mechanism, equations: Sequence[Expression]
) -> Batched:
    """Equations in the symbols of a file as a function of points of its chart.

    Args:
        chart: Of the mechanism.
        mechanism: With the symbols of its dimensions, at their values.
        equations: What vanishes.
    """

    def values(points: Array) -> Array:
        known: Mapping[str, Array] = chart.values(points)
        ring = ring_at(mechanism, known)
        found = [evaluate(x, ring) for x in equations]
        return np.stack([np.broadcast_to(x, len(points)) for x in found], axis=-1)

    return values
