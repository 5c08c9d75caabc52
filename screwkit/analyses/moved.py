"""The answer to `mobility` where it rests on a posture found in floating point.

Two questions lead there: a mechanism with closed loops is asked for at values of its
joint variables, or the table of a file ties them together and is not closed at 0.
"""

from __future__ import annotations

from collections.abc import Mapping

from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitute
from screwkit.analyses.full_cycle import cycle_of
from screwkit.analyses.platform import finite_types
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.moved_posture import moved_posture
from screwkit.finite.posture_model import posture_model
from screwkit.finite.posture_numbers import numbers_at
from screwkit.finite.table_search import TableClosure, closed_posture
from screwkit.kinematics.network import Network
from screwkit.kinematics.values import declared_values, with_values
from screwkit.results.mobility import (
    Actuation,
    AtPosture,
    Counts,
    Mobility,
    Platform,
    Topology,
    Working,
)
from screwkit.results.partition import Partition


def at_posture(
    network: Network,
    wanted: Mapping[str, Expression],
    start: Mapping[str, float] | None = None,
) -> AtPosture:
    """Move the mechanism, and count there.

    Args:
        network: The mechanism; its symbols take the values of the file.
        wanted: Values by joint variable.
        start: A closed posture of a table that is not closed at 0.

    Raises:
        UnknownNameError: If a symbol has no value.
    """
    mechanism = network.mechanism
    values = declared_values(mechanism)
    known = {name: substitute(value, values) for name, value in wanted.items()}
    found = moved_posture(with_values(mechanism, values), known, start)
    size = len(network.rows) * len(network.loops)
    locked = found.locked
    return AtPosture(
        closed=found.closed,
        reason=found.reason,
        variables=tuple(found.values),
        values=tuple(found.values.values()),
        loop_rank=found.free.loop_rank,
        redundant_constraints=size - found.free.loop_rank,
        instantaneous_mobility=found.free.mobility,
        motion_type=found.free.motion_type,
        couples=found.free.couples,
        remaining_mobility=None if locked is None else locked.mobility,
        remaining_platform_freedom=None if locked is None else locked.twist_dimension,
        gap=found.gap,
    )


def table_mobility(network: Network, closure: TableClosure) -> Mobility:
    """The answer for a table that ties joint variables together, in floating point.

    Args:
        network: An ``mdh`` mechanism whose posture at 0 is not closed.
        closure: A closed posture of it.
    """
    mechanism = network.mechanism
    mechanism = with_values(mechanism, declared_values(mechanism))
    model = posture_model(mechanism, closure.values)
    here, size = numbers_at(model), len(network.rows)
    actuated = mechanism.actuated
    locked = numbers_at(model, actuated) if actuated else None
    freedoms, loops = len(network.labels), len(network.loops)
    grubler = freedoms - size * loops
    cycle = cycle_of(network, finite_motion(model))
    twists, turning = here.twist_dimension, here.rotations
    about = Platform(
        twists,
        twists - turning,
        turning,
        here.motion_type,
        6 - twists,
        here.couples,
        (),
    )
    at = ", ".join(f"{name} = {value:.6g}" for name, value in closure.values.items())
    return Mobility(
        case=mechanism.name,
        title=mechanism.title,
        topology=Topology(
            len(mechanism.links),
            len(mechanism.joints),
            freedoms,
            loops,
            len(network.components),
        ),
        counts=Counts(grubler, None, here.mobility, None, None),
        workings=(
            Working("Grübler–Kutzbach", f"{freedoms} - {size}*{loops}", grubler),
            Working(
                "Moroskine",
                f"{freedoms} - rank Jc = {freedoms} - {here.loop_rank}",
                here.mobility,
                "rank by singular values at a closed posture",
            ),
        ),
        loop_rank=here.loop_rank,
        redundant_constraints=size * loops - here.loop_rank,
        instantaneous_mobility=here.mobility,
        full_cycle=cycle,
        platform=finite_types(about, cycle, None),
        actuation=None
        if locked is None
        else Actuation(actuated, locked.mobility, locked.twist_dimension),
        partition=Partition(here.mobility, twists, here.mobility - twists, 0),
        platform_name=mechanism.platform,
        unnamed=(
            f"{network.tied}; the table is not closed at 0, and ranks were taken by "
            f"singular values at the closed posture {at}, so nothing is named exactly"
        ),
        generic=False,
    )


def closed_table(network: Network) -> TableClosure | None:
    """A closed posture of a table that ties joint variables; None where 0 is one.

    Raises:
        UndecidedError: If none was found, or a symbol has no value.
    """
    mechanism = network.mechanism
    if mechanism.geometry != "mdh" or not network.tied:
        return None
    mechanism = with_values(mechanism, declared_values(mechanism))
    try:
        found = closed_posture(mechanism)
    except UnknownNameError as error:
        raise UndecidedError(
            f"{network.tied}; a closed posture is needed, and {error} (--set gives one)"
        ) from None
    if not found.closed:
        raise UndecidedError(found.refusal)
    return None if found.at_zero else found
