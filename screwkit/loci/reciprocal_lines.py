"""Lines through two points of a limb that are reciprocal to its passive twists.

Joins of two points come before parallels to axes, points that the geometry fixes before
any point of an axis.

References: [BenHorinShoham2006].
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from screwkit.algebra.modular import rank
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.bracket_forms import Sample
from screwkit.loci.brackets import Line
from screwkit.loci.placed_points import PlacedPoint, placed_at, power, wrench_through


def reciprocal_lines(
    passive: Sequence[Sequence[Polynomial]],
    own: Sequence[int],
    points: Sequence[PlacedPoint],
    samples: Sequence[tuple[Sequence[int], int]],
) -> tuple[list[Line], int]:
    """Independent lines, and how many wrenches the limb has in general.

    Args:
        passive: Its twists, (ω; v).
        own: Numbers of its points.
        points: Of the mechanism.
        samples: Exact postures, not none; what holds at all of them holds always.
    """
    placed = [Sample(placed_at(points, at, prime), prime) for at, prime in samples]
    twists = [[[residue(x, at, p) for x in t] for t in passive] for at, p in samples]
    wanted = 6 - max(rank(t, s.prime) for t, s in zip(twists, placed, strict=True))
    pairs = sorted(
        combinations(own, 2),
        key=lambda pair: (
            sum(points[i].arbitrary for i in pair),
            sum(points[i].ideal for i in pair),
        ),
    )
    chosen: list[Line] = []
    for a, b in pairs:
        if len(chosen) == wanted:
            break
        reciprocal = all(
            not power(wrench_through(s.points[a], s.points[b]), twist) % s.prime
            for own_twists, s in zip(twists, placed, strict=True)
            for twist in own_twists
        )
        if reciprocal and independent([*chosen, (a, b)], placed[0]):
            chosen.append((a, b))
    return chosen, wanted


def independent(lines: Sequence[Line], sample: Sample) -> bool:
    """Whether lines are independent at an exact posture."""
    rows = [
        [x % sample.prime for x in wrench_through(sample.points[a], sample.points[b])]
        for a, b in lines
    ]
    return rank(rows, sample.prime) == len(lines)
