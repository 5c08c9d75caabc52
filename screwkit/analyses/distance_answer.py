"""The answer about distances: which symbols move the mechanism, what is left open."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitute
from screwkit.algebra.names import limb_called
from screwkit.analyses.distance import (
    Kind,
    Posture,
    by_rank,
    distances_to_components,
    kinds_of,
)
from screwkit.analyses.distance_limits import Asked, Moving, limits_around
from screwkit.errors import UndecidedError
from screwkit.finite.moved_posture import arrival_at, departure
from screwkit.finite.posture_model import PostureModel
from screwkit.finite.table_search import closed_posture
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.graph import independent_loops
from screwkit.mechanism.joints import CATALOGUE, RIGID
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.joint_space import JointSpace, joint_space, pose_origin
from screwkit.metrics.motion_chart import MotionChart, motion_chart
from screwkit.metrics.singular_distance import Search, chart_search, joint_search
from screwkit.metrics.symbol_motion import symbol_motion
from screwkit.progress import Progress, silent
from screwkit.results.distance import (
    Distance,
    DistanceMeasure,
    SingularityDistance,
    Within,
)
from screwkit.results.singularities import Singularities


def moving_symbols(asked: Asked) -> Moving:
    """The symbols of a file that move the mechanism.

    Raises:
        UndecidedError: If a symbol has no value, or nothing moves.
    """
    mechanism = asked.mechanism
    _need_values(mechanism)
    if asked.moved or why_tied(mechanism):
        return Moving(None, whole=False)
    values = {name: _number(value, mechanism) for name, value in asked.at.items()}
    try:
        chart = motion_chart(mechanism, values, asked.length)
    except UndecidedError as error:
        return Moving(None, whole=False, remarks=(str(error),))
    if mechanism.geometry != "posture":
        return Moving(chart, whole=True)
    known = symbol_motion(chart, chart.start)
    names = ", ".join(chart.names)
    if not known.by_joints or not known.symbols:
        several = len(chart.names) > 1
        said = (
            f"the symbol{'s' if several else ''} {names} would change the mechanism, "
        )
        said += f"and keep{'' if several else 's'} "
        said += "their values" if several else "its value"
        return Moving(None, whole=False, remarks=(said,))
    if known.symbols == known.joints:
        return Moving(chart, whole=True)
    said = (
        f"the symbols {names} describe {known.symbols} of the {known.joints} "
        f"dimensions of the motion: what lies beside them is looked for by ranks"
    )
    return Moving(chart, whole=False, remarks=(said,))


def distance(
    asked: Asked,
    moving: Moving,
    loci: Singularities | None,
    limbs: Mapping[str, tuple[str, ...]],
    progress: Progress = silent,
    finished: Callable[[str, Distance], None] = lambda name, part: None,
) -> Distance:
    """Answer ``singularities --distance``.

    Args:
        asked: Where distances begin.
        moving: Of `moving_symbols`.
        loci: The exact singular loci; None where they are not known.
        limbs: Freedoms of the limbs that are serial chains, by name.
        progress: Told about each stage.
        finished: Given the answer so far after each singularity.

    Raises:
        UndecidedError: If the posture is not reached, or no joint moves.
        ExpressionError: If the posture lies outside the limits.
    """
    mechanism = asked.mechanism
    kinds = _kinds_by_rank(mechanism, limbs) if loci is None else kinds_of(loci)
    chart, remarks = moving.chart, list(moving.remarks)
    ways: list[Iterator[SingularityDistance]] = []
    expected: list[str] = []
    if chart is not None and (loci is not None or moving.whole):
        limits = limits_around(asked.within, chart.names, chart.start, chart.units)
        if loci is not None:
            posture = Posture(mechanism, chart, asked.at)
            ways.append(distances_to_components(posture, kinds, limits, progress))
            expected += [name for kind in kinds for name in _components(kind)]
        else:
            ways.append(_by_ranks(lambda: chart_search(chart, limits), kinds, progress))
            expected += map(_called, kinds)
    space: JointSpace | None = None
    if not moving.whole:
        model, begun = _model(asked)
        space = _joints(asked, chart, model)
        own = limits_around(
            {} if chart is not None else asked.within,
            model.labels,
            space.start,
            space.units,
        )
        if begun:
            said = ", ".join(f"{name} = {value:.6g}" for name, value in begun.items())
            remarks.append(f"distances begin at {said}")
        if _contacts(mechanism):
            remarks.append("axes and normals of contacts stay with their parents")
        joints = partial(joint_search, space, own)
        ways.append(_by_ranks(joints, kinds, progress, by_freedoms=True))
        expected += [f"{_called(kind)} (in all joints)" for kind in kinds]
    remarks += _remarks(asked, moving, kinds, loci)
    whole = Distance(
        case=mechanism.name,
        title=mechanism.title,
        platform_name=mechanism.platform,
        variables=() if chart is None else chart.names,
        posture=() if chart is None else chart.start_values,
        freedoms=() if space is None else space.model.labels,
        measure=None if chart is None else _of_symbols(asked, chart),
        by_freedoms=None if space is None else _of_freedoms(asked, space, chart),
        singularities=(),
        remarks=tuple(remarks),
        within=tuple(Within(name, *ends) for name, ends in asked.within.items()),
    )
    for entry in chain.from_iterable(ways):
        found = (*whole.singularities, entry)
        left = tuple(expected[len(found) :])
        whole = replace(whole, singularities=found, unfinished=left)
        if left:
            finished("distance", whole)
    return whole


def _components(kind: Kind) -> Iterator[str]:
    """What `distances_to_components` looks at, in its order."""
    for number, _ in kind.components:
        yield f"{_called(kind)} {number}"
    if not kind.complete:
        yield f"{_called(kind)} (by its rank)"


def _by_ranks(
    begin: Callable[[], Search],
    kinds: Sequence[Kind],
    progress: Progress,
    *,
    by_freedoms: bool = False,
) -> Iterator[SingularityDistance]:
    search = begin()
    where = "by ranks, in all joints" if by_freedoms else "by its rank"
    for kind in kinds:
        progress(f"distance, {kind.limb or kind.kind}", where)
        yield by_rank(search, kind, by_freedoms=by_freedoms)


def _remarks(
    asked: Asked, moving: Moving, kinds: Sequence[Kind], loci: Singularities | None
) -> Iterator[str]:
    """What the answer leaves out, and what is never singular."""
    chart = moving.chart
    if asked.mechanism.actuated and not any(k.kind == "actuation" for k in kinds):
        yield "the declared actuators hold the platform at no posture"
    if chart is None:
        return
    if chart.bodies is not None:
        yield "every body keeps the shape that it has at the posture"
    lacking = [_called(k) for k in kinds if not k.complete]
    if loci is not None and lacking:
        yield (
            f"lists not proved to be complete: {', '.join(lacking)}; there ranks "
            f"were searched as well"
        )
    never = [k for k in kinds if k.complete and not k.components and moving.whole]
    if never:
        yield f"never singular, proved: {', '.join(map(_called, never))}"


def _called(kind: Kind) -> str:
    return limb_called(kind.limb) if kind.limb else kind.kind


def _need_values(mechanism: Mechanism) -> None:
    if not mechanism.joints:
        raise UndecidedError("no joint moves: there is no way to a singularity")
    missing = [p.name for p in mechanism.parameters if p.value is None]
    if missing:
        raise UndecidedError(
            f"a distance is a number at a posture, and {', '.join(missing)} "
            f"{'has' if len(missing) == 1 else 'have'} no value: --set {missing[0]}=…"
        )


def _kinds_by_rank(
    mechanism: Mechanism, limbs: Mapping[str, tuple[str, ...]]
) -> tuple[Kind, ...]:
    """What has a rank where no locus is known."""
    found = [
        Kind("limb", name, labels, 0, complete=False, components=())
        for name, labels in limbs.items()
    ]
    if independent_loops(mechanism):
        found.append(Kind("constraint", "", (), 0, complete=False, components=()))
    if mechanism.actuated:
        locked = mechanism.actuated
        found.append(Kind("actuation", "", locked, 0, complete=False, components=()))
    return tuple(found)


def _number(value: Expression, mechanism: Mechanism) -> float:
    found = closed_value(substitute(value, declared_values(mechanism)))
    if found is None:
        raise UndecidedError("a value of the posture is no real number")
    return found


def _joints(asked: Asked, chart: MotionChart | None, model: PostureModel) -> JointSpace:
    """The coordinates of all joints, measured as the chart is where that is a pose."""
    contacts = _contacts(asked.mechanism)
    if chart is None:
        values = declared_values(asked.mechanism)
        numbers = with_values(asked.mechanism, values)
        origin = None if asked.moved else pose_origin(numbers, model)
        return joint_space(model, asked.length, origin, contacts)
    posed = chart.posed == frozenset(chart.names)
    origin = chart.origin if posed else None
    return joint_space(model, chart.length, origin, contacts)


def _contacts(mechanism: Mechanism) -> list[str]:
    """Contacts with freedoms: in a finite motion their axes stay with their parents."""
    return [
        joint.name
        for joint in mechanism.joints
        if CATALOGUE[joint.type].contact and joint.type not in RIGID
    ]


def _model(asked: Asked) -> tuple[PostureModel, Mapping[str, float]]:
    """The mechanism at the posture, and its joint variables where loops tie them.

    They are left out at the posture of a file that needs no search.

    Raises:
        UndecidedError: If it is not reached.
    """
    values = declared_values(asked.mechanism)
    numbers = with_values(asked.mechanism, values)
    start: Mapping[str, float] = {}
    if numbers.geometry == "mdh" and why_tied(numbers):
        start = closed_posture(numbers).values
    if not asked.moved:
        return departure(numbers, start)[0], start
    wanted = {name: substitute(value, values) for name, value in asked.moved.items()}
    there = arrival_at(numbers, wanted, start or None)
    if there.reason:
        raise UndecidedError(f"the posture asked for was not reached: {there.reason}")
    return there.found.model, there.values


def _of_symbols(asked: Asked, chart: MotionChart) -> DistanceMeasure:
    plain = [name for name in chart.names if name not in chart.posed]
    lengths = tuple(name for name in plain if name not in chart.angles)
    counts = lengths or chart.shifted
    return DistanceMeasure(
        platform=bool(chart.posed),
        angles=tuple(name for name in plain if name in chart.angles),
        lengths=lengths,
        pose=tuple(name for name in chart.names if name in chart.posed),
        length=chart.length if counts else None,
        given=asked.length is not None,
        unit=asked.mechanism.units,
    )


def _of_freedoms(
    asked: Asked, space: JointSpace, chart: MotionChart | None
) -> DistanceMeasure:
    by_pose = space.platform is not None
    turning = space.turning
    labels: Sequence[str] = () if by_pose else space.model.labels
    lengths = tuple(label for label in labels if label not in turning)
    return DistanceMeasure(
        platform=by_pose,
        angles=tuple(label for label in labels if label in turning),
        lengths=lengths,
        pose=chart.names if by_pose and chart is not None else (),
        length=space.length if lengths or by_pose else None,
        given=asked.length is not None,
        unit=asked.mechanism.units,
    )


def standing_at(
    mechanism: Mechanism, values: Mapping[str, Expression]
) -> tuple[Mechanism, dict[str, Expression]]:
    """The mechanism with values of a posture, and those of joint variables beside.

    Args:
        mechanism: As its file declares it.
        values: Of its symbols and of joint variables.
    """
    names = {p.name for p in mechanism.parameters}
    parameters = tuple(
        replace(p, value=values.get(p.name, p.value)) for p in mechanism.parameters
    )
    joints = {name: value for name, value in values.items() if name not in names}
    return replace(mechanism, parameters=parameters), joints
