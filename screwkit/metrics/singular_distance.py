"""The nearest singular postures on a mechanism's own motion, searched in numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

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
from screwkit.metrics.motion_chart import MotionChart, unit_rows
from screwkit.metrics.nearest_point import Batched, restored, slopes
from screwkit.metrics.nearest_search import (
    Found,
    Space,
    nearest,
    nearest_connected,
    on_motion,
    starts_of,
)
from screwkit.metrics.rank_conditions import ScrewField, fallen, rank_at

FEWER = 9
"""Starts where matrices of many freedoms are bordered at every step."""

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


class Search:
    """Looks for singular postures around one posture.

    Attributes:
        space: Where.
        starts: Postures on the motion from which it looks, that posture first.
    """

    def __init__(
        self,
        space: Space,
        field: ScrewField,
        model_at: Callable[[Array], PostureModel],
        units: Array,
        starts: Sequence[Array],
    ) -> None:
        self.space, self.starts = space, list(starts)
        self._field, self._model_at, self._units = field, model_at, units

    def on(
        self, equations: Batched, counts: Callable[[PostureModel], bool]
    ) -> Nearest | None:
        """The nearest posture where equations hold.

        Args:
            equations: What vanishes.
            counts: Whether a posture where they do is singular.
        """
        scale = _scale(equations, self.starts)
        own: Batched = lambda points: equations(points) / scale  # noqa: E731
        here = np.abs(own(self.space.start[None])).max(initial=0.0)
        if here < NOTHING:
            found = [Found(self.space.start, 0.0, connected=True)]
        else:
            found = nearest(self.space, lambda start: own, self.starts)
        kept = [
            one
            for one in found
            if self._counts(one.point, counts)
            or self._counts_beside(one.point, own, counts)
        ]
        return self._shown(nearest_connected(self.space, kept))

    def _counts(self, point: Array, counts: Callable[[PostureModel], bool]) -> bool:
        """Whether a posture counts; none does where an axis has no direction."""
        try:
            with np.errstate(all="ignore"):
                model = self._model_at(point)
        except UndecidedError:
            return False
        return counts(model)

    def _counts_beside(
        self, point: Array, equations: Batched, counts: Callable[[PostureModel], bool]
    ) -> bool:
        """Whether postures with these equations count that are next to one.

        Where another singularity meets a component, the rank may be what it is in
        general, and yet be less beside it.
        """
        random = np.random.default_rng(2)
        together = on_motion(self.space, equations)
        for _ in range(BESIDE):
            step = random.normal(size=len(point))
            beside = restored(together, point + STEP * step / np.linalg.norm(step))
            if beside is not None and self._counts(beside, counts):
                return True
        return False

    def everywhere(self, counts: Callable[[PostureModel], bool]) -> bool:
        """Whether all postures that were started from count."""
        others = self.starts[1:] or self.starts
        return all(self._counts(point, counts) for point in others)

    def where_limb_falls(
        self, labels: Sequence[str], counts: Callable[[PostureModel], bool]
    ) -> tuple[int, Nearest | None]:
        """The rank of a limb in general, and the nearest posture where it is less."""
        return self._where_falls(self._field.of_limb(labels), counts)

    def where_loops_fall(
        self, locked: Sequence[str], counts: Callable[[PostureModel], bool]
    ) -> tuple[int, Nearest | None]:
        """The same of J_c, without the columns of locked freedoms.

        Args:
            locked: Freedoms.
            counts: Whether a posture where the rank is less is what is asked for.
        """
        return self._where_falls(self._field.of_loops(locked), counts)

    def _where_falls(
        self, matrix: Batched, counts: Callable[[PostureModel], bool]
    ) -> tuple[int, Nearest | None]:
        rank = rank_at(matrix, self.starts)
        if not rank:
            return 0, None
        if rank_at(matrix, self.starts[:1]) < rank:
            here = self._shown(Found(self.space.start, 0.0, connected=True))
            if here is not None and counts(here.model):
                return rank, here
        found = nearest(
            self.space, lambda start: fallen(matrix, rank, start), self.starts
        )
        return rank, self._shown(self._connected(found, counts))

    def _connected(
        self, found: Sequence[Found], counts: Callable[[PostureModel], bool]
    ) -> Found | None:
        kept = [one for one in found if counts(self._model_at(one.point))]
        return nearest_connected(self.space, kept)

    def _shown(self, found: Found | None) -> Nearest | None:
        if found is None:
            return None
        values = tuple(float(x) for x in found.point * self._units)
        model = self._model_at(found.point)
        return Nearest(found.distance, values, found.connected, model)


def _scale(equations: Batched, starts: Sequence[Array]) -> Array:
    """The usual size of each equation's slope, so that a miss is a distance."""
    with np.errstate(all="ignore"):
        sizes = np.linalg.norm(slopes(equations, np.array(starts)), axis=2)
    sizes = np.where(np.isfinite(sizes), sizes, np.nan)
    exist = np.isfinite(sizes).any(axis=0)
    middle = np.nanmedian(np.where(exist, sizes, 1.0), axis=0)
    return np.asarray(np.where(middle > 0, middle, 1.0))


def chart_search(chart: MotionChart) -> Search:
    """The search in the symbols of a file."""
    names, mechanism = chart.names, chart.mechanism
    space = Space(chart.start, chart.away, chart.kept, chart.bodies is not None)

    def model_at(point: Array) -> PostureModel:
        values = point * chart.units
        return posture_model(mechanism, dict(zip(names, values.tolist(), strict=True)))

    first = model_at(chart.start)

    def screws(points: Array) -> Array:
        rows = unit_rows(mechanism, chart.values(points), chart.length)
        return np.stack([rows[label] for label in first.labels], axis=1)

    field = ScrewField(first.labels, screws, forest_of(first))
    starts = starts_of(space)
    with np.errstate(all="ignore"):
        exist = np.isfinite(screws(np.array(starts))).all(axis=(1, 2))
    starts = [starts[i] for i in np.flatnonzero(exist)]
    return Search(space, field, model_at, chart.units, starts)


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


def joint_search(space: JointSpace) -> Search:
    """The search in the coordinates of all joints."""
    count = len(space.model.labels)
    around = Space(np.zeros(count), space.away, space.kept, tied=True)
    slides = np.linalg.norm(space.model.screws[:, :3], axis=1) < 0.5
    units = np.where(slides, space.length, 1.0)
    field = ScrewField(space.model.labels, space.screws, space.forest)
    return Search(around, field, space.model_at, units, starts_of(around, FEWER))


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
