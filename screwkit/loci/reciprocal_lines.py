"""Lines through two points of a limb that are reciprocal to its passive twists.

Joins of two points come before parallels to axes, points that the geometry fixes before
any point of an axis.

References: [BenHorinShoham2006].
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from itertools import combinations
from typing import TypeAlias

from screwkit.algebra.modular import rank
from screwkit.conventions import SCREW_DIMENSION
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.limb_parts import motion_at
from screwkit.kinematics.told_parts import whole_parts
from screwkit.loci.bracket_forms import Sample
from screwkit.loci.brackets import Line
from screwkit.loci.placed_points import PlacedPoint, placed_at, power, wrench_through

TwistsAt: TypeAlias = Sequence[Sequence[int]]
"""Independent twists (ω; v) at one exact posture."""


def twists_at(
    assembly: Assembly,
    limb: LimbChain,
    locked: Collection[str],
    samples: Sequence[tuple[Sequence[int], int]],
) -> list[TwistsAt]:
    """What a limb with locked joints allows at each posture, its inner loops closed."""
    parts = whole_parts(assembly, limb, locked)
    return [
        motion_at(parts, SCREW_DIMENSION, [*point], prime).twists
        for point, prime in samples
    ]


def reciprocal_lines(
    passive: Sequence[TwistsAt],
    own: Sequence[int],
    points: Sequence[PlacedPoint],
    samples: Sequence[tuple[Sequence[int], int]],
    is_firm: Callable[[Line], bool] | None = None,
) -> tuple[list[Line], int]:
    """Independent lines, and how many wrenches the limb has in general.

    Args:
        passive: Its twists at each of the postures, see `twists_at`.
        own: Numbers of its points.
        points: Of the mechanism.
        samples: Exact postures, not none; what holds at all of them holds always.
        is_firm: Whether two points coincide nowhere, so that their line is never lost;
            such lines come first.
    """
    placed = [Sample(placed_at(points, at, prime), prime) for at, prime in samples]
    wanted = 6 - max(len(twists) for twists in passive)
    pairs = sorted(
        (
            pair
            for pair in combinations(own, 2)
            # Two directions are a couple; one that no axis has gives it no name.
            if not all(points[i].ideal for i in pair)
            or not any(points[i].constructed for i in pair)
        ),
        key=lambda pair: (
            sum(points[i].constructed for i in pair),
            sum(points[i].arbitrary for i in pair),
            sum(points[i].ideal for i in pair),
        ),
    )

    def is_reciprocal(pair: Line) -> bool:
        a, b = pair
        return all(
            not power(wrench_through(s.points[a], s.points[b]), twist) % s.prime
            for own_twists, s in zip(passive, placed, strict=True)
            for twist in own_twists
        )

    lines: Iterable[Line] = filter(is_reciprocal, pairs)
    if is_firm is not None:
        lines = sorted(lines, key=lambda line: not is_firm(line))
    chosen: list[Line] = []
    for line in lines:
        if len(chosen) == wanted:
            break
        if independent([*chosen, line], placed[0]):
            chosen.append(line)
    return chosen, wanted


def independent(lines: Sequence[Line], sample: Sample) -> bool:
    """Whether lines are independent at an exact posture."""
    rows = [
        [x % sample.prime for x in wrench_through(sample.points[a], sample.points[b])]
        for a, b in lines
    ]
    return rank(rows, sample.prime) == len(lines)
