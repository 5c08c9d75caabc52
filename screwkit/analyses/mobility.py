"""How movable is it: the counts side by side, why they differ, and what is free.

Ranks are exact and generic over the free symbols, and again at the values of the file.
Where loops tie joint variables together the posture of the file is taken, and finite
motion around it is looked at (`analyses.full_cycle`).

References: [LongCaroKhalil2012] §4, [Gogu2007], [BicchiMelchiorri] §8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from screwkit.analyses.counts import counts
from screwkit.analyses.full_cycle import full_cycle
from screwkit.analyses.naming import Named, named
from screwkit.analyses.on_the_motion import OnTheMotion, on_the_motion
from screwkit.analyses.partition import GraspPair, gamma_of, generic_blocks
from screwkit.analyses.platform import finite_types, platform
from screwkit.finite.finite_motion import FiniteMotion
from screwkit.kinematics.network import Motion, Network, motion
from screwkit.mechanism.graph import holding_joints
from screwkit.progress import Progress, silent
from screwkit.results.mobility import (
    Actuation,
    Connectivity,
    FullCycle,
    Mobility,
    MotionCase,
    Platform,
    SpecialValues,
    Topology,
)
from screwkit.results.partition import Partition

TABLE = 60
"""Bodies up to which the table of connectivity is made."""

_ON_THE_MOTION = (
    "the posture of the file is special; redundant constraints and freedoms are named "
    "for that posture, below"
)

_NOT_REACHED = "finite motion was not looked at yet"
_NOT_NAMED = "what each freedom and redundant constraint is was not looked at yet"

BLOCKS_UP_TO = 60
"""Joint freedoms up to which the partition is worked out block by block."""


@dataclass(frozen=True)
class _Start:
    """What ranks alone tell."""

    at: Motion
    platform: Platform
    actuation: Actuation | None


@dataclass(frozen=True)
class _Answer:
    """The part of the answer that is given twice: in general and at values."""

    start: _Start
    full_cycle: FullCycle
    sample: FiniteMotion | None

    @property
    def at(self) -> Motion:
        """Where ranks were taken."""
        return self.start.at

    @property
    def platform(self) -> Platform:
        """How its platform moves."""
        return self.start.platform

    @property
    def actuation(self) -> Actuation | None:
        """What the declared scheme leaves."""
        return self.start.actuation


def mobility(
    network: Network,
    cases: Callable[[str], tuple[MotionCase, ...]] | None = None,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
) -> Mobility:
    """Answer ``mobility``: generic, and again at the values of the file.

    Args:
        network: The mechanism.
        cases: Where the motion type changes, given the generic one; None where that is
            not asked for.
        progress: Told about each stage.
        finished: Given what ranks alone tell, before finite motion is looked at; not
            where loops tie joint variables: on the motion ranks may be others.
    """
    progress("mobility", f"{len(network.labels)} freedoms, {len(network.loops)} loops")
    start = _start(network)
    early = None
    if not network.tied:
        open_yet = _Answer(start, FullCycle("undecided", (), _NOT_REACHED), None)
        early = _whole(network, open_yet, Named(unnamed=_NOT_NAMED), None)
        finished("mobility", early)
    special = None
    if network.at_values is not None:
        special = _answer(_start(network.at_values), progress)
    answer = _answer(start, progress, special)
    about = answer.platform
    moving = on_the_motion(network, answer.full_cycle, about, answer.sample, TABLE)
    progress("mobility", "names of constraints and freedoms")
    names = there = named(*_in_numbers(answer, special))
    if moving is not None:
        names = Named(unnamed=_ON_THE_MOTION)
    if early is None:
        whole = _whole(network, answer, names, moving)
    else:
        whole = replace(
            early,
            full_cycle=answer.full_cycle,
            platform=about,
            redundancies=names.redundancies,
            remaining_freedoms=names.remaining_freedoms,
            unnamed=names.unnamed,
        )
    if cases is not None:
        about = _with_cases(whole.platform, cases(whole.platform.motion_type))
        whole = replace(whole, platform=about)
    if special is None and moving is None:
        return whole
    apart = _special(whole, special or answer)
    if moving is not None:
        apart = replace(
            apart,
            redundancies=there.redundancies,
            remaining_freedoms=there.remaining_freedoms,
        )
    return replace(whole, at_values=apart)


def _whole(
    network: Network, answer: _Answer, names: Named, moving: OnTheMotion | None
) -> Mobility:
    """The generic answer: at the posture, or on the motion where that is another."""
    mechanism = network.mechanism
    at, rank = answer.at, answer.at.rank
    about, scheme = answer.platform, answer.actuation
    partition, table = _partition(at), connectivity(at)
    if moving is None:
        side_by_side, workings = counts(at, rank)
        partition = _with_blocks(partition, network)
    else:
        rank, about, scheme = moving.loop_rank, moving.platform, moving.actuation
        partition, table = moving.partition, moving.connectivity
        side_by_side, workings = counts(at, rank, on_motion=True)
    return Mobility(
        case=mechanism.name,
        title=mechanism.title,
        topology=Topology(
            len(mechanism.links),
            len(mechanism.joints),
            len(network.labels),
            len(network.loops),
            len(network.components),
        ),
        counts=side_by_side,
        workings=workings,
        loop_rank=rank,
        redundant_constraints=len(network.rows) * len(network.loops) - rank,
        instantaneous_mobility=len(network.labels) - rank,
        full_cycle=answer.full_cycle,
        platform=about,
        actuation=scheme,
        partition=partition,
        platform_name=mechanism.platform,
        redundancies=names.redundancies,
        remaining_freedoms=names.remaining_freedoms,
        unnamed=names.unnamed,
        connectivity=table,
        loose_bodies=tuple(x for group in network.components[1:] for x in group),
        generic=network.has_symbols,
        on_motion=moving is not None,
    )


def _start(network: Network) -> _Start:
    at = network.motion
    return _Start(at, platform(at), actuation(at))


def _answer(
    start: _Start, progress: Progress, special: _Answer | None = None
) -> _Answer:
    at, about = start.at, start.platform
    progress("mobility", "finite motion")
    known = None
    if special is not None and special.at.rank == at.rank:
        known = special.full_cycle
    cycle, sample = full_cycle(at.network, at, about.motion_type, known)
    if sample is None and special is not None:
        sample = special.sample
    about = finite_types(about, cycle, at.mobility)
    return _Answer(replace(start, platform=about), cycle, sample)


def _in_numbers(answer: _Answer, special: _Answer | None) -> tuple[Network, Motion]:
    """Where names have coordinates: at the values, unless these are special."""
    chosen = answer
    if special is not None and special.at.rank == answer.at.rank:
        chosen = special
    return chosen.at.network, chosen.at


def _with_cases(about: Platform, cases: tuple[MotionCase, ...]) -> Platform:
    return replace(about, cases=cases)


def actuation(at: Motion) -> Actuation | None:
    """What stays movable with the declared scheme locked; None without one."""
    actuated = at.network.mechanism.actuated
    if not actuated:
        return None
    held = motion(at.network, at.posture, actuated)
    return Actuation(actuated, held.mobility, len(held.platform_twists))


def _partition(at: Motion) -> Partition:
    """Mobility, connectivity, what moves without the platform, and the reverse."""
    network = at.network
    connectivity = len(at.platform_twists)
    driven = [label for label in network.labels if label not in network.contact_labels]
    slipping = motion(network, at.posture, driven)
    base, end = network.mechanism.base, network.mechanism.platform
    if not network.connected(base, end):
        return Partition(at.mobility, connectivity, at.mobility, connectivity)
    return Partition(
        at.mobility,
        connectivity,
        at.mobility - connectivity,
        len(slipping.platform_twists),
    )


def _with_blocks(partition: Partition, network: Network) -> Partition:
    """With the seven blocks, where a scheme tells actuated joints from passive ones."""
    mechanism = network.mechanism
    small = len(network.labels) <= BLOCKS_UP_TO
    if not (mechanism.actuated and small and holding_joints(mechanism)):
        return partition
    generic = GraspPair.of(mechanism)
    blocks, symbolic = generic_blocks(network, generic)
    return replace(
        partition,
        gamma=gamma_of(generic.blocks[0]),
        blocks=blocks,
        symbolic=symbolic,
    )


def connectivity(at: Motion) -> Connectivity | None:
    """The freedom of every body relative to every other; None for many bodies."""
    links = at.network.mechanism.links
    if len(links) > TABLE:
        return None
    table = [[0] * len(links) for _ in links]
    for i, one in enumerate(links):
        for j, other in enumerate(links[:i]):
            table[i][j] = table[j][i] = len(at.twists_of(one, other))
    return Connectivity(links, tuple(tuple(row) for row in table))


def _special(whole: Mobility, special: _Answer) -> SpecialValues:
    """The answer at the values, beside the generic one given first."""
    at, network = special.at, special.at.network
    size = len(network.rows)
    otherwise = "on the motion" if whole.on_motion else "in general"
    differences = []
    for name, before, after in (
        ("the loop rank is", whole.loop_rank, at.rank),
        ("the mobility is", whole.instantaneous_mobility, at.mobility),
        (
            "the motion type is",
            whole.platform.motion_type,
            special.platform.motion_type,
        ),
        ("the couples are", whole.platform.couples, special.platform.couples),
        (
            "the freedom left with the actuators locked is",
            whole.actuation and whole.actuation.remaining_platform_freedom,
            special.actuation and special.actuation.remaining_platform_freedom,
        ),
    ):
        if before != after:
            differences.append(f"{name} {after}, {otherwise} {before}")
    if not whole.on_motion:
        differences += _finite_differences(whole, special)
    return SpecialValues(
        loop_rank=at.rank,
        redundant_constraints=size * len(network.loops) - at.rank,
        instantaneous_mobility=at.mobility,
        platform=special.platform,
        actuation=special.actuation,
        full_cycle=special.full_cycle,
        differences=tuple(differences),
    )


def _finite_differences(whole: Mobility, special: _Answer) -> list[str]:
    """What finite motion differs in, where both are known."""
    differences = []
    before, after = whole.full_cycle.mobility, special.full_cycle.mobility
    if before and after and before != after:
        here, otherwise = (" or ".join(map(str, each)) for each in (after, before))
        differences.append(f"the finite mobility is {here}, in general {otherwise}")
    elif after == (0,) and special.at.mobility and not whole.instantaneous_mobility:
        differences.append("the structure is shaky, in general rigid")
    types = whole.platform.finite_motion_types, special.platform.finite_motion_types
    if all(types) and types[0] != types[1]:
        otherwise, here = (" or ".join(each) for each in types)
        differences.append(f"the finite motion type is {here}, in general {otherwise}")
    return differences
