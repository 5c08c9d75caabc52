"""How movable is it: the counts side by side, and why they differ.

Ranks are exact and generic over the free symbols.  In a mechanism that grasps its
object wherever the limbs are, every posture is closed; the loop constraint matrix has
constant rank around a generic one, so the instantaneous mobility is the finite one.

References: [LongCaroKhalil2012] §4, [Gogu2007], [BicchiMelchiorri] §8.
"""

from __future__ import annotations

from collections import Counter
from itertools import combinations

from screwkit.analyses.motion_type import motion_cases
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.subspaces import PlatformSystem, dimension
from screwkit.mechanism.graph import components
from screwkit.results.mobility import (
    Actuation,
    Counts,
    FullCycle,
    Mobility,
    Partition,
    Platform,
    SpecialValues,
    Topology,
    Working,
)


def mobility(assembly: Assembly) -> Mobility:
    """Answer ``mobility``: generic, and again at the values of the file."""
    freedoms = _freedoms(assembly)
    loops = assembly.loops
    rank = assembly.loop_rank
    platform = _platform(assembly, with_cases=True)
    counts, workings = _counts(assembly)
    movable = freedoms - rank
    return Mobility(
        case=assembly.mechanism.name,
        title=assembly.mechanism.title,
        topology=Topology(
            len(assembly.mechanism.links),
            len(assembly.mechanism.joints),
            freedoms,
            loops,
            len(components(assembly.mechanism)),
        ),
        counts=counts,
        workings=workings,
        loop_rank=rank,
        redundant_constraints=6 * loops - rank,
        instantaneous_mobility=movable,
        full_cycle=_full_cycle(assembly),
        platform=platform,
        actuation=_actuation(assembly),
        partition=Partition(
            movable,
            platform.twist_dimension,
            movable - platform.twist_dimension,
            0,
        ),
        at_values=_special(assembly),
        platform_name=assembly.mechanism.platform,
    )


def _freedoms(assembly: Assembly) -> int:
    return len(assembly.joints) + len(assembly.free_joints)


def platform_system(assembly: Assembly, locked: tuple[str, ...] = ()) -> PlatformSystem:
    """The platform at a random exact posture, with some joints locked."""
    systems = []
    for twists, prime in assembly.random_postures:
        limbs = [
            [[int(x) for x in twists[j]] for j in limb.joints if j not in locked]
            for limb in assembly.limbs
        ]
        systems.append(PlatformSystem.held_by(limbs, prime))
    return min(systems, key=lambda system: system.freedom)


def _platform(assembly: Assembly, *, with_cases: bool) -> Platform:
    system = platform_system(assembly)
    return Platform(
        twist_dimension=system.freedom,
        translations=system.translations,
        rotations=system.freedom - system.translations,
        motion_type=system.motion_type,
        wrench_dimension=6 - system.freedom,
        couples=system.couples,
        finite_motion_types=(system.motion_type,),
        cases=motion_cases(assembly, system.motion_type) if with_cases else (),
    )


def _full_cycle(assembly: Assembly) -> FullCycle:
    movable = _freedoms(assembly) - assembly.loop_rank
    if assembly.loop_rank == 6 * assembly.loops:
        reason = (
            "all joint variables are free and every posture is closed; the closure "
            "equations are independent, so the motion is finite"
        )
    else:
        reason = (
            "all joint variables are free and every posture is closed; the rank of the "
            "closure equations is the same at all postures around a generic one, so "
            "the motion is finite"
        )
    return FullCycle("proved", (movable,), reason)


def _actuation(assembly: Assembly) -> Actuation | None:
    actuated = assembly.mechanism.actuated
    if not actuated:
        return None
    locked = tuple(joint for joint in assembly.joints if joint in actuated)
    passive = [joint for joint in assembly.joints if joint not in locked]
    free = [joint for joint in assembly.free_joints if joint not in actuated]
    remaining = len(passive) - assembly.loop_rank_of(passive) + len(free)
    return Actuation(actuated, remaining, platform_system(assembly, locked).freedom)


def _special(assembly: Assembly) -> SpecialValues | None:
    at_values = assembly.at_values
    if at_values is None:
        return None
    rank = at_values.loop_rank
    platform = _platform(at_values, with_cases=False)
    movable = _freedoms(at_values) - rank
    generic = _platform(assembly, with_cases=False)
    differences = []
    for name, before, after in (
        ("loop rank", assembly.loop_rank, rank),
        ("motion type", generic.motion_type, platform.motion_type),
        ("couples", generic.couples, platform.couples),
    ):
        if before != after:
            differences.append(
                f"{name} {after} at the values of the file, not {before}"
            )
    return SpecialValues(
        loop_rank=rank,
        redundant_constraints=6 * at_values.loops - rank,
        instantaneous_mobility=movable,
        platform=platform,
        actuation=_actuation(at_values),
        full_cycle=_full_cycle(at_values),
        differences=tuple(differences),
    )


def _counts(assembly: Assembly) -> tuple[Counts, tuple[Working, ...]]:
    freedoms, loops, rank = _freedoms(assembly), assembly.loops, assembly.loop_rank
    movable = freedoms - rank
    grubler = freedoms - 6 * loops
    redundant = 6 * loops - rank
    remark = ""
    if redundant:
        remark = (
            f"{redundant} of the {6 * loops} closure equations follow from the others"
        )
    workings = [
        Working(
            "Grübler–Kutzbach",
            f"{freedoms} - 6*{loops}",
            grubler,
            remark,
            "LongCaroKhalil2012 (14), (15)",
        ),
        Working(
            "Moroskine",
            f"{freedoms} - rank Jc = {freedoms} - {rank}",
            movable,
            "",
            "LongCaroKhalil2012 (16)-(18)",
        ),
    ]
    gogu = None
    planar = _planar_or_spherical(assembly)
    if len(assembly.limbs) > 1:
        gogu, working = _gogu(assembly, movable)
        workings.append(working)
    screw, working = _screw(assembly)
    workings.append(working)
    counts = Counts(
        grubler, freedoms - 3 * loops if planar else None, movable, gogu, screw
    )
    return counts, tuple(workings)


def _gogu(assembly: Assembly, movable: int) -> tuple[int, Working]:
    """Gogu's count: bases of coordinates with the smallest common part."""
    twists, prime = assembly.random_postures[0]
    sizes, bases = [], []
    for limb in assembly.limbs:
        rows = [[int(x) for x in twists[j]] for j in limb.joints]
        size = dimension(rows, prime)
        sizes.append(size)
        bases.append(
            [
                frozenset(chosen)
                for chosen in combinations(range(6), size)
                if dimension([[row[i] for i in chosen] for row in rows], prime) == size
            ]
        )
    common: Counter[frozenset[int]] = Counter({frozenset(range(6)): 1})
    for limb_bases in bases:
        step: Counter[frozenset[int]] = Counter()
        for known, count in common.items():
            for basis in limb_bases:
                step[known & basis] += count
        common = step
    least = min(len(shared) for shared in common)
    histogram: Counter[int] = Counter()
    for shared, count in common.items():
        histogram[len(shared)] += count
    freedoms = _freedoms(assembly)
    value = freedoms - sum(sizes) + least
    exact = platform_system(assembly).freedom
    spaces = " ∩ ".join(f"E_{limb.name}" for limb in assembly.limbs)
    remark = f"{sum(histogram.values())} choices of coordinate bases: " + ", ".join(
        f"{n} share {size}" for size, n in sorted(histogram.items())
    )
    if least != exact:
        remark += f"; the spaces themselves share {exact}"
    formula = (
        f"{freedoms} - ({' + '.join(map(str, sizes))}) + dim({spaces}) = "
        f"{freedoms - sum(sizes)} + {least}"
    )
    if value != movable:
        remark += "; the count assumes spaces in general position"
    return value, Working(
        "Gogu", formula, value, remark, "LongCaroKhalil2012 (19)-(23)"
    )


def _screw(assembly: Assembly) -> tuple[int, Working]:
    """Freedoms of the platform, and what the limbs can do by themselves."""
    platform = platform_system(assembly)
    idle = sum(
        len(limb.joints) - assembly.generic_rank(limb.joints) for limb in assembly.limbs
    ) + len(assembly.free_joints)
    wrenches = " + ".join(f"W_{limb.name}" for limb in assembly.limbs) or "0"
    formula = f"6 - dim({wrenches}) = 6 - {6 - platform.freedom}"
    remark = ""
    if idle:
        formula += f" + {idle}"
        remark = f"{idle} freedoms move limbs or loose joints without the platform"
    value = platform.freedom + idle
    return value, Working("screws", formula, value, remark, "LongCaroKhalil2012 (32)")


def _planar_or_spherical(assembly: Assembly) -> bool:
    """Whether all joints together span a planar or a spherical system."""
    twists, prime = assembly.random_postures[0]
    rows = [[int(x) for x in twists[j]] for j in assembly.joints]
    if dimension(rows, prime) > 3 or not rows:
        return False
    turning = dimension([row[:3] for row in rows], prime)
    size = dimension(rows, prime)
    spherical = turning == size == 3
    planar = turning == 1 and size == 3
    return spherical or planar
