"""Mobility by each of the usual counts, side by side, and why they differ.

The counts see less and less: the rank of the closure equations is the truth at the
posture, the numbers of joints and loops alone know nothing of geometry.

References: [LongCaroKhalil2012] §4, [Gogu2007].
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from screwkit.kinematics.network import Motion, independent_rows, motion
from screwkit.kinematics.subspaces import dimension, reciprocal
from screwkit.mechanism.graph import Limb
from screwkit.results.mobility import Counts, Working

MANY_BASES = 200_000
"""Choices of coordinate bases that Gogu's count still goes through."""


@dataclass(frozen=True)
class LimbSystem:
    """What one limb allows the platform, and itself.

    Attributes:
        twists: Basis of the platform's twists, the limb alone connecting it.
        freedoms: Number of joint freedoms.
        inner_rank: Rank of the closure equations of loops inside the limb.
        idle: Freedoms that leave the platform at rest.
    """

    limb: Limb
    twists: tuple[tuple[int, ...], ...]
    freedoms: int
    inner_rank: int
    idle: int


def limb_systems(at: Motion) -> tuple[LimbSystem, ...]:
    """Every limb by itself at a posture."""
    network = at.network
    base, platform = network.mechanism.base, network.mechanism.platform
    found = []
    for limb in network.limbs:
        alone = motion(network.part(limb.joints, (base, platform)), at.posture)
        twists = tuple(tuple(row) for row in alone.platform_twists)
        freedoms = len(alone.network.labels)
        found.append(
            LimbSystem(limb, twists, freedoms, alone.rank, alone.mobility - len(twists))
        )
    return tuple(found)


def counts(
    at: Motion, rank: int, *, on_motion: bool = False
) -> tuple[Counts, tuple[Working, ...]]:
    """All counts, with the working of each.

    Args:
        at: A generic posture, or that of the file.
        rank: Generic rank of the closure equations; where loops tie joint variables
            together that on the motion through the posture.
        on_motion: Whether that is another rank than at the posture; counts that look
            at the systems of limbs are left out then.
    """
    network = at.network
    equations = len(network.rows)
    freedoms, loops = len(network.labels), len(network.loops)
    grubler = freedoms - equations * loops
    redundant = equations * loops - rank
    remark = ""
    if redundant:
        verb = "follows" if redundant == 1 else "follow"
        remark = (
            f"{redundant} of the {equations * loops} closure equations {verb} from "
            f"the others"
        )
    if redundant and not rank:
        remark = f"none of the {redundant} closure equations restrains a joint"
    workings = [
        Working(
            "Grübler–Kutzbach",
            f"{freedoms} - {equations}*{loops}",
            grubler,
            remark,
            "LongCaroKhalil2012 (14), (15)",
        )
    ]
    planar = None
    if equations == 6 and (kind := _common_algebra(at)):
        planar = freedoms - 3 * loops
        workings.append(
            Working(
                f"Grübler–Kutzbach, {kind}",
                f"{freedoms} - 3*{loops}",
                planar,
                f"all joints belong to one {kind} group of motions",
            )
        )
    workings.append(
        Working(
            "Moroskine",
            f"{freedoms} - rank Jc = {freedoms} - {rank}",
            freedoms - rank,
            "",
            "LongCaroKhalil2012 (16)-(18)",
        )
    )
    systems = () if on_motion else limb_systems(at)
    gogu = None
    if len(systems) > 1 and (found := _gogu(at, systems)):
        gogu, working = found
        workings.append(working)
    screw = None
    if not on_motion and (systems or not network.loops):
        screw, working = _screw(at, systems)
        workings.append(working)
    return Counts(grubler, planar, freedoms - rank, gogu, screw), tuple(workings)


def _gogu(at: Motion, systems: Sequence[LimbSystem]) -> tuple[int, Working] | None:
    """Gogu's count: bases of coordinates with the smallest common part."""
    network, prime = at.network, at.posture.prime
    bases = []
    for system in systems:
        rows, size = system.twists, len(system.twists)
        bases.append(
            [
                frozenset(chosen)
                for chosen in combinations(network.rows, size)
                if dimension([[row[i] for i in chosen] for row in rows], prime) == size
            ]
        )
    common: Counter[frozenset[int]] = Counter({frozenset(network.rows): 1})
    for limb_bases in bases:
        if len(common) * len(limb_bases) > MANY_BASES:
            return None
        step: Counter[frozenset[int]] = Counter()
        for known, count in common.items():
            for basis in limb_bases:
                step[known & basis] += count
        common = step
    least = min(len(shared) for shared in common)
    histogram: Counter[int] = Counter()
    for shared, count in common.items():
        histogram[len(shared)] += count
    freedoms = len(network.labels)
    sizes = [len(system.twists) for system in systems]
    # What loops inside limbs, and loops that belong to no limb, take for themselves.
    inside = sum(system.inner_rank for system in systems) + _rank_of_others(at)
    value = freedoms - sum(sizes) + least - inside
    exact = len(at.platform_twists)
    listed = _shortened([f"E_{system.limb.name}" for system in systems], " ∩ ")
    remark = ""
    if sum(histogram.values()) > 1:
        remark = f"{sum(histogram.values())} choices of coordinate bases: " + ", ".join(
            f"{n} share {size}" for size, n in sorted(histogram.items())
        )
    if least != exact:
        remark = f"{remark}; the spaces themselves share {exact}".lstrip("; ")
    if value != at.mobility:
        remark = f"{remark}; the count assumes spaces in general position".lstrip("; ")
    inner = f" - {inside}" if inside else ""
    formula = (
        f"{freedoms} - ({_sum_of(sizes)}) + dim({listed})"
        f"{inner} = {freedoms - sum(sizes)} + {least}{inner}"
    )
    return value, Working(
        "Gogu", formula, value, remark, "LongCaroKhalil2012 (19)-(23)"
    )


def _rank_of_others(at: Motion) -> int:
    """Rank of the closure equations of loops outside all limbs."""
    return sum(alone.rank for alone in _others(at))


def _others(at: Motion) -> list[Motion]:
    """The parts that are no limbs, each by itself."""
    network = at.network
    parts = []
    for part in network.other_parts:
        ends = part.touches[:1] or part.links[:1]
        parts.append(motion(network.part(part.joints, ends), at.posture))
    return parts


def _screw(at: Motion, systems: Sequence[LimbSystem]) -> tuple[int, Working]:
    """Freedoms of the platform, and what the limbs can do by themselves."""
    network, prime = at.network, at.posture.prime
    size = len(network.rows)
    wrenches = [w for system in systems for w in reciprocal(system.twists, prime)]
    held = dimension(wrenches, prime)
    if size == 3:
        held -= 3  # the planar file knows nothing of what holds it in its plane
    idle = sum(system.idle for system in systems)
    idle += sum(alone.mobility for alone in _others(at))
    names = _shortened([f"W_{system.limb.name}" for system in systems], " + ")
    if not systems:
        remark = "no limb connects base and platform"
        if network.mechanism.base == network.mechanism.platform:
            remark = "base and platform are one body"
        return at.mobility, Working("screws", f"{idle}", idle, remark)
    formula = f"{size} - dim({names}) = {size} - {held}"
    remark = ""
    if idle:
        formula += f" + {idle}"
        verb = "freedom moves" if idle == 1 else "freedoms move"
        remark = f"{idle} {verb} limbs or loose joints without the platform"
    value = size - held + idle
    return value, Working("screws", formula, value, remark, "LongCaroKhalil2012 (32)")


def _common_algebra(at: Motion) -> str:
    """``planar`` or ``spherical`` where all joints move in one such group, else empty.

    Rotations of pitch 0 about parallel axes with translations at right angles to them,
    or rotations about axes through one point.
    """
    prime = at.posture.prime
    twists = list(at.posture.twists.values())
    turning = [t for t in twists if any(x % prime for x in t[:3])]
    sliding = [t for t in twists if not any(x % prime for x in t[:3])]
    if not turning:
        return ""
    if any(_product(t[:3], t[3:], prime) for t in turning):
        return ""
    directions = dimension([t[:3] for t in turning], prime)
    if directions == 1:
        along = turning[0][:3]
        # Moments of parallel lines are at right angles to them anyway.
        if any(_product(along, t[3:], prime) for t in sliding):
            return ""
        return "planar"
    basis = independent_rows(turning, prime)
    if sliding or len(basis) != directions:
        return ""
    return "spherical" if _concurrent(basis, prime) else ""


def _concurrent(lines: Sequence[Sequence[int]], prime: int) -> bool:
    """Whether lines pass through one point, their directions being independent.

    Lines of which every two meet are concurrent or coplanar; in a plane three lines
    would have dependent directions.
    """
    return all(
        (_product(a[:3], b[3:], prime) + _product(a[3:], b[:3], prime)) % prime == 0
        for a, b in combinations(lines, 2)
    )


def _product(a: Sequence[int], b: Sequence[int], prime: int) -> int:
    return sum(x * y for x, y in zip(a, b, strict=True)) % prime


def _shortened(names: Sequence[str], separator: str) -> str:
    """Names joined; of more than three the first and the last."""
    if len(names) > 3:
        names = [names[0], "…", names[-1]]
    return separator.join(names)


def _sum_of(sizes: Sequence[int]) -> str:
    """Sizes as a sum; equal ones of more than three limbs as a product."""
    if len(sizes) > 3 and len(set(sizes)) == 1:
        return f"{len(sizes)}*{sizes[0]}"
    return " + ".join(map(str, sizes))
