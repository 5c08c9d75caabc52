"""The answer about distances: which symbols move the mechanism, what is left open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

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
from screwkit.metrics.singular_distance import chart_search, joint_search
from screwkit.metrics.symbol_motion import symbol_motion
from screwkit.progress import Progress, silent
from screwkit.results.distance import Distance, DistanceMeasure, SingularityDistance
from screwkit.results.singularities import Singularities


@dataclass(frozen=True)
class Asked:
    """The mechanism where distances begin.

    Attributes:
        mechanism: Its symbols at their values there.
        at: Values of joint variables that nothing ties.
        moved: Values of joint variables that loops tie: it is still to be moved there.
        length: That counts as one radian; None for the characteristic length.
    """

    mechanism: Mechanism
    at: Mapping[str, Expression]
    moved: Mapping[str, Expression]
    length: float | None


@dataclass(frozen=True)
class Moving:
    """Which symbols move the mechanism.

    Attributes:
        chart: None where none does.
        whole: Whether they describe all of its motion.
        remarks: What the answer has to say of them.
    """

    chart: MotionChart | None
    whole: bool
    remarks: tuple[str, ...] = ()


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
        said = f"{names} would change the mechanism, and keep{'' if several else 's'} "
        said += "their values" if several else "its value"
        return Moving(None, whole=False, remarks=(said,))
    if known.symbols == known.joints:
        return Moving(chart, whole=True)
    said = (
        f"{names} describe {known.symbols} of the {known.joints} dimensions of the "
        f"motion: what lies beside them is looked for by ranks"
    )
    return Moving(chart, whole=False, remarks=(said,))


def distance(
    asked: Asked,
    moving: Moving,
    loci: Singularities | None,
    limbs: Mapping[str, tuple[str, ...]],
    progress: Progress = silent,
) -> Distance:
    """Answer ``singularities --distance``.

    Args:
        asked: Where distances begin.
        moving: Of `moving_symbols`.
        loci: The exact singular loci; None where they are not known.
        limbs: Freedoms of the limbs that are serial chains, by name.
        progress: Told about each stage.

    Raises:
        UndecidedError: If the posture is not reached, or no joint moves.
    """
    mechanism = asked.mechanism
    kinds = _kinds_by_rank(mechanism, limbs) if loci is None else kinds_of(loci)
    chart, remarks = moving.chart, list(moving.remarks)
    found: list[SingularityDistance] = []
    if chart is not None and loci is not None:
        posture = Posture(mechanism, chart, asked.at)
        found += distances_to_components(posture, kinds, progress)
    elif chart is not None and moving.whole:
        search = chart_search(chart)
        found += [by_rank(search, kind) for kind in kinds]
    space: JointSpace | None = None
    if not moving.whole:
        model, begun = _model(asked)
        space = _joints(asked, chart, model)
        if begun:
            said = ", ".join(f"{name} = {value:.6g}" for name, value in begun.items())
            remarks.append(f"distances begin at {said}")
        if _contacts(mechanism):
            remarks.append("axes and normals of contacts stay with their parents")
        search = joint_search(space)
        for kind in kinds:
            progress(f"distance, {kind.limb or kind.kind}", "by ranks, in all joints")
            found.append(by_rank(search, kind, by_freedoms=True))
    if mechanism.actuated and not any(kind.kind == "actuation" for kind in kinds):
        remarks.append("the declared actuators hold the platform at no posture")
    if chart is not None and chart.bodies is not None:
        remarks.append("every body keeps the shape that it has at the posture")
    if chart is not None and loci is not None:
        lacking = [_called(k) for k in kinds if not k.complete]
        if lacking:
            remarks.append(
                f"lists not proved to be complete: {', '.join(lacking)}; there ranks "
                f"were searched as well"
            )
    never = [k for k in kinds if k.complete and not k.components and moving.whole]
    if chart is not None and never:
        said = ", ".join(map(_called, never))
        remarks.append(f"never singular, proved: {said}")
    return Distance(
        case=mechanism.name,
        title=mechanism.title,
        platform_name=mechanism.platform,
        variables=() if chart is None else chart.names,
        posture=() if chart is None else chart.start_values,
        freedoms=() if space is None else space.model.labels,
        measure=None if chart is None else _of_symbols(asked, chart),
        by_freedoms=None if space is None else _of_freedoms(asked, space, chart),
        singularities=tuple(found),
        remarks=tuple(remarks),
    )


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
