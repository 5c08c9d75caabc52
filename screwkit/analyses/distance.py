"""How far is it to a singularity: the nearest posture of each kind along the motion.

Components of the exact loci are met in the symbols of the file: exactly where they are
planes in free angles, else by a search.  Where symbols do not describe the whole
motion, or a list is not complete, ranks themselves are searched as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.expression import ZERO, Expression
from screwkit.algebra.expression_building import substitute
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.analyses.exact_distance import (
    angle_of_turn,
    exact_nearest,
    planes_of,
)
from screwkit.errors import UndecidedError
from screwkit.finite.posture_model import PostureModel
from screwkit.kinematics.values import declared_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.limited import Limits
from screwkit.metrics.motion_chart import MotionChart
from screwkit.metrics.posture_ranks import (
    PostureRank,
    limb_rank,
    locked_rank,
    loop_rank,
)
from screwkit.metrics.singular_distance import (
    Looked,
    Nearest,
    Search,
    chart_search,
    equations_on,
    nearest_at,
)
from screwkit.progress import Progress, silent
from screwkit.results.distance import NearestPosture, SingularityDistance
from screwkit.results.singularities import Component, Singularities

NONE: Final = "none found on the motion"
UNCLEAR: Final = "in floating point the rank there is not clear"
BESIDE: Final = (
    "right there another singularity keeps the rank up; it is less beside that posture"
)


@dataclass(frozen=True)
class Kind:
    """One kind of singularity, with what its rank is.

    Attributes:
        kind: As in `SingularityDistance`, with ``limb``.
        labels: Freedoms of the limb, or those that are locked.
        generic_rank: Of the matrix, in general.
        complete: Whether its components are proved to be all.
        components: With their numbers.
    """

    kind: str
    limb: str
    labels: tuple[str, ...]
    generic_rank: int
    complete: bool
    components: tuple[tuple[int, Component], ...]

    def rank_of(self, model: PostureModel) -> PostureRank:
        """The rank at a posture."""
        if self.kind == "limb":
            return limb_rank(model, self.labels)
        if self.kind == "constraint":
            return loop_rank(model)
        return locked_rank(model, self.labels)

    def falls(self, known: PostureRank) -> bool:
        """Whether a posture is singular, or may be as far as its numbers tell."""
        if self.kind == "actuation":
            return known.platform_freedom > 0 or not known.clear
        return known.rank < self.generic_rank or not known.clear


def kinds_of(answer: Singularities) -> tuple[Kind, ...]:
    """Every kind of an answer, its components numbered as the answer shows them."""
    start = 1
    found: list[Kind] = []

    def numbered(components: Sequence[Component]) -> tuple[tuple[int, Component], ...]:
        nonlocal start
        order = sorted(range(len(components)), key=lambda i: components[i].codimension)
        taken = tuple((start + n, components[i]) for n, i in enumerate(order))
        start += len(taken)
        return taken

    found += [
        Kind(
            "limb",
            limb.limb,
            limb.joints,
            limb.generic_rank,
            limb.complete,
            numbered(limb.components),
        )
        for limb in answer.limb
    ]
    loops = answer.constraint
    if len(answer.limb) > 1:
        found.append(
            Kind(
                "constraint",
                "",
                (),
                loops.generic_rank,
                loops.complete,
                numbered(loops.components),
            )
        )
    locked = answer.actuation
    if locked is not None and locked.admissible:
        found.append(
            Kind(
                "actuation",
                "",
                locked.actuated,
                locked.generic_rank,
                locked.complete,
                numbered(locked.components),
            )
        )
    return tuple(found)


@dataclass(frozen=True)
class Posture:
    """Where distances begin.

    Attributes:
        mechanism: With its symbols.
        chart: What moves it.
        at: Values that were asked for, in the symbols of the file.
    """

    mechanism: Mechanism
    chart: MotionChart
    at: Mapping[str, Expression]

    @property
    def dimensions(self) -> dict[str, Expression]:
        """Values of the symbols that stay."""
        known = declared_values(self.mechanism)
        return {n: v for n, v in known.items() if n not in self.chart.names}

    def start(self) -> dict[str, Expression]:
        """The symbols that move, as closed expressions."""
        written = {**declared_values(self.mechanism)}
        known = {
            name: self.at.get(name, written.get(name, ZERO))
            for name in self.chart.names
        }
        values = {**written, **known}
        return {name: substitute(value, values) for name, value in known.items()}

    @cached_property
    def free_angles(self) -> frozenset[str]:
        """Angles that nothing ties, and whose change is what is measured."""
        chart, pose = self.chart, self.mechanism.pose
        if chart.bodies is not None:
            return frozenset()
        turning = angle_of_turn(pose, chart.names) if pose else frozenset[str]()
        return chart.angles - chart.posed | chart.angles & turning


def distances_to_components(
    posture: Posture,
    kinds: Sequence[Kind],
    limits: Limits,
    progress: Progress = silent,
) -> Iterator[SingularityDistance]:
    """To every component of every kind, and to what incomplete lists may lack.

    Args:
        posture: Where distances begin.
        kinds: With their components.
        limits: Of the coordinates of the chart.
        progress: Told about each stage.
    """
    search: Search | None = None
    for kind in kinds:
        name = f"limb {kind.limb}" if kind.limb else kind.kind
        for number, component in kind.components:
            progress(f"distance, {name}", f"component {number}")
            exact = _exact(posture, limits, kind, number, component)
            if exact is not None:
                yield exact
                continue
            search = search or chart_search(posture.chart, limits)
            yield _searched(posture, search, kind, number, component)
        if not kind.complete:
            progress(f"distance, {name}", "by its rank")
            search = search or chart_search(posture.chart, limits)
            yield by_rank(search, kind)


def _exact(
    posture: Posture, limits: Limits, kind: Kind, number: int, component: Component
) -> SingularityDistance | None:
    dimensions = posture.dimensions
    planes = planes_of(component, posture.free_angles, dimensions)
    found = planes and exact_nearest(planes, posture.start(), dimensions)
    if not found:
        return None
    values = {n: closed_value(v) or 0.0 for n, v in posture.start().items()}
    try:
        there = nearest_at(posture.chart, {**values, **found.values}, found.distance)
    except UndecidedError:  # An axis has no direction right there.
        return None
    if not limits.admit(there.values, posture.chart.units):
        return None
    known = kind.rank_of(there.model)
    return _told(kind, number, component, there, known, 0, exact=found.text)


def _searched(
    posture: Posture, search: Search, kind: Kind, number: int, component: Component
) -> SingularityDistance:
    names = [p.name for p in posture.mechanism.parameters]
    names += posture.mechanism.joint_variables
    equations = [
        parse(text, names, limits=RESULT_LIMITS) for text in component.equations
    ]
    function = equations_on(posture.chart, posture.mechanism, equations)
    looked = search.on(function, lambda model: kind.falls(kind.rank_of(model)))
    return _answered(kind, number, component, looked)


def by_rank(
    search: Search, kind: Kind, *, by_freedoms: bool = False
) -> SingularityDistance:
    """The nearest posture of a kind wherever its rank falls.

    Args:
        search: In the symbols of the file, or in the coordinates of all joints.
        kind: What is asked.
        by_freedoms: Which of the two.
    """

    def counts(model: PostureModel) -> bool:
        known = kind.rank_of(model)
        if kind.kind == "actuation":
            return known.platform_freedom > 0
        return known.clear

    if kind.kind == "actuation" and search.everywhere(counts):
        reason = "with the actuated joints locked the platform moves at every posture"
        return SingularityDistance(
            kind.kind, kind.limb, None, None, 6, None, 1, by_freedoms, reason
        )
    look: Callable[..., Looked] = search.where_loops_fall
    if kind.kind == "limb":
        look = search.where_limb_falls
    looked = look(kind.labels, counts)
    generic = 6 if kind.kind == "actuation" else looked.rank
    own = replace(kind, generic_rank=generic)
    return replace(_answered(own, None, None, looked), by_freedoms=by_freedoms)


def _answered(
    kind: Kind, number: int | None, component: Component | None, looked: Looked
) -> SingularityDistance:
    """A search with what the rank is where it ended."""
    found = looked.nearest
    if found is not None:
        known = kind.rank_of(found.model)
        answer = _told(kind, number, component, found, known, looked.starts)
        return replace(answer, met=looked.met)
    return SingularityDistance(
        kind.kind,
        kind.limb,
        number,
        component,
        kind.generic_rank,
        None,
        looked.starts,
        reason=NONE,
    )


def _told(
    kind: Kind,
    number: int | None,
    component: Component | None,
    found: Nearest,
    known: PostureRank,
    starts: int,
    exact: str = "",
) -> SingularityDistance:
    reason = "" if known.clear else UNCLEAR
    if component is not None and not kind.falls(known):
        reason = BESIDE
    return SingularityDistance(
        kind.kind,
        kind.limb,
        number,
        component,
        kind.generic_rank,
        NearestPosture(
            found.distance,
            exact,
            found.values,
            found.connected,
            known.rank,
            known.platform_freedom,
            known.gap,
        ),
        starts,
        reason=reason,
    )
