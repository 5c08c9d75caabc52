"""The wrench system of a locked platform as six lines through points of the mechanism.

Of each limb's wrenches with the actuated joints locked, a basis of lines is looked for,
each through two of the limb's points: centres, common points of axes, points of the
file, and directions of axes as points at infinity.  Their superbracket vanishes where
the lines are dependent; incidences among the points shorten it.

References: [BenHorinShoham2006]; [McMillanWhite1991].
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from screwkit.kinematics.assembly import Assembly
from screwkit.loci.bracket_forms import Sample
from screwkit.loci.brackets import Bracket, Line, bracket
from screwkit.loci.placed_points import (
    PlacedPoint,
    placed_at,
    placed_points,
    sample_points,
)
from screwkit.loci.reciprocal_lines import (
    independent,
    reciprocal_lines,
    twists_at,
)


@dataclass(frozen=True)
class SixLines:
    """Lines through points, and the points at random postures.

    Attributes:
        points: Those that lines pass through.
        lines: Six pairs of their numbers, limb by limb.
        samples: The points at exact postures.
    """

    points: tuple[PlacedPoint, ...]
    lines: tuple[Line, ...]
    samples: tuple[Sample, ...]

    def always_in_a_plane(self, four: Bracket) -> bool:
        """Whether four points are in one plane at every posture."""
        return all(
            bracket([s.points[i] for i in four]) % s.prime == 0 for s in self.samples
        )


def six_lines(assembly: Assembly, actuated: Collection[str]) -> SixLines | str:
    """Lines that span the wrenches of the platform with the actuated joints locked.

    Returns:
        Why there are none, in words.
    """
    framed = assembly.common_twists
    root = assembly.root(framed.ring)
    if assembly.dimension != 6:
        return "the mechanism is planar"
    samples = sample_points(root)
    if not samples:
        return "no exact posture was found"
    points, owners = placed_points(assembly, samples)
    placed = [Sample(placed_at(points, at, prime), prime) for at, prime in samples]
    chosen: list[Line] = []
    for number, limb in enumerate(assembly.limbs):
        passive = twists_at(assembly, limb, actuated, samples)
        own = [i for i, owner in enumerate(owners) if number in owner]
        lines, wanted = reciprocal_lines(passive, own, points, samples)
        if len(lines) < wanted:
            return (
                f"not all wrenches of limb {limb.name} are spanned by lines through "
                f"two of its points"
            )
        chosen += lines
    if len(chosen) > 6:
        chosen = _independent_part(chosen, points, placed[0])
    if len(chosen) != 6:
        return f"the limbs have {len(chosen)} wrenches in all, not six"
    used = sorted({i for line in chosen for i in line})
    place = {old: new for new, old in enumerate(used)}
    return SixLines(
        tuple(points[i] for i in used),
        tuple((place[a], place[b]) for a, b in chosen),
        tuple(Sample([s.points[i] for i in used], s.prime) for s in placed),
    )


def _independent_part(
    lines: Sequence[Line], points: Sequence[PlacedPoint], sample: Sample
) -> list[Line]:
    """Lines that span as much, joins of two points before parallels to axes."""
    kept: list[Line] = []
    for line in sorted(lines, key=lambda pair: sum(points[i].ideal for i in pair)):
        if independent([*kept, line], sample):
            kept.append(line)
    return [line for line in lines if line in kept]
