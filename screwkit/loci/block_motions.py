"""What the blocks of limbs let through, by names: the twists behind loops inside.

Chains side by side share few motions.  Where all forces that a block resists along are
parallel to one plane it translates along the normal of that; a rotation that it keeps
is about a line through two points, or the line that planes of two axes have in common.
With the axes and slides in series with them such twists say what the wrenches of the
limb hide: how the halves of an articulated platform move.

References: [Hunt1978] §13 (systems in series and in parallel).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from screwkit.algebra.modular import annihilator, rank
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.conventions import DIRECTION, SCREW_DIMENSION
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.limb_parts import SideBySide, motion_at
from screwkit.kinematics.told_parts import whole_parts
from screwkit.loci.brackets import Line
from screwkit.loci.named_screws import JOIN, NamedScrew, Noun, joint_screws
from screwkit.loci.placed_features import features_of
from screwkit.loci.placed_points import (
    PlacedPoint,
    placed_points,
    sample_points,
    wrench_through,
)
from screwkit.loci.reciprocal_lines import TwistsAt, reciprocal_lines
from screwkit.screw.vector import Vector, cross, dot, subtract

_POINTS = 12  # of a limb that are joined
_PLANES = 8  # of a limb that are met

ACROSS = Noun("the direction normal to", "the directions normal to", "to ", apart=True)

Samples = Sequence[tuple[Sequence[int], int]]


def block_motions(
    assembly: Assembly, locked: Collection[str] = ()
) -> tuple[NamedScrew, ...]:
    """Independent twists of each block that have a name, and what is in series.

    A block's twists need not all be found.

    Args:
        assembly: The mechanism.
        locked: Actuated joints, which are held.
    """
    framed = assembly.common_twists
    samples = sample_points(assembly.root(framed.ring))
    if not samples:
        return ()
    points, owners = placed_points(assembly, samples)
    joints = [s for s in joint_screws(framed) if s.name not in locked]
    found: list[NamedScrew] = []
    for number, limb in enumerate(assembly.limbs):
        if not limb.nested:
            continue
        blocks = [
            part
            for part in whole_parts(assembly, limb, locked)
            if isinstance(part, SideBySide)
        ]
        own = [i for i, owner in enumerate(owners) if number in owner]
        for block in blocks:
            twists = [
                motion_at([block], SCREW_DIMENSION, [*at], prime).twists
                for at, prime in samples
            ]
            found += _Block(assembly, number, points, own, twists, samples).named()
        found += [s for s in joints if s.limb == number and _in_series(limb, s)]
    return tuple(found)


def _in_series(limb: LimbChain, screw: NamedScrew) -> bool:
    """Whether a joint carries the whole end of its limb."""
    return limb.elements is None or screw.name.split(":")[0] in limb.elements


@dataclass(frozen=True)
class _Block:
    """A block, and its twists at exact postures.

    Attributes:
        points: Of the mechanism.
        own: Numbers of those of the limb.
        twists: At each of the samples.
    """

    assembly: Assembly
    limb: int
    points: Sequence[PlacedPoint]
    own: Sequence[int]
    twists: Sequence[TwistsAt]
    samples: Samples

    def named(self) -> list[NamedScrew]:
        """Independent twists, translations first."""
        found: list[NamedScrew] = []
        rows: list[list[int]] = []
        at, prime = self.samples[0]
        for screw in self._candidates():
            if len(rows) == len(self.twists[0]):
                break
            row = screw.at(at, prime)
            if rank([*rows, row], prime) > len(rows) and self._allows(screw):
                rows.append(row)
                found.append(screw)
        return found

    def _allows(self, screw: NamedScrew) -> bool:
        at, prime = self.samples[0]
        if not screw.free and not any(screw.at(at, prime)[DIRECTION]):
            return False
        return all(
            rank([*twists, screw.at(*at)], at[1]) == len(twists)
            for twists, at in zip(self.twists, self.samples, strict=True)
        )

    def _candidates(self) -> Iterator[NamedScrew]:
        yield from self._translation()
        joints = joint_screws(self.assembly.common_twists)
        yield from (
            s for s in joints if s.limb == self.limb and s.is_line and not s.ball
        )
        yield from self._joins()
        yield from self._common_lines()

    def _translation(self) -> Iterator[NamedScrew]:
        """Normal to two lines, where all forces that are resisted are so too."""
        at, prime = self.samples[0]
        forms = annihilator(self.twists[0], SCREW_DIMENSION, prime)
        # A form is (m; f): it multiplies (ω; v).
        if rank([form[3:] for form in forms], prime) != 2:
            return
        lines, _ = reciprocal_lines(self.twists, self.own, self.points, self.samples)
        for one, other in combinations(lines, 2):
            a, b = (self._along(line) for line in (one, other))
            way = self._normal(cross(a, b))
            if not any(residue(x, at, prime) for x in way):
                continue
            zero = self.assembly.common_twists.ring.zero
            name = f"{self._line(one)} and {self._line(other)}"
            name = name.replace("line ", "lines ", 1).replace(" and line ", " and ")
            column = (zero, zero, zero, *way)
            yield NamedScrew(column, ACROSS, name, self.limb, free=True)
            return

    def _joins(self) -> Iterator[NamedScrew]:
        """Rotations about lines through two points, or parallel to an axis."""
        finite = [
            i
            for i in self.own
            if not self.points[i].ideal and not self.points[i].arbitrary
        ][:_POINTS]
        ideal = [i for i in self.own if self.points[i].ideal]
        ring = self.assembly.common_twists.ring
        pairs = [*combinations(finite, 2), *((p, d) for p in finite for d in ideal)]
        for pair in pairs:
            a, b = (self.points[i] for i in pair)
            column = [
                ring.normal(x) for x in wrench_through(a.coordinates, b.coordinates)
            ]
            name = self._line(pair).removeprefix("the line ")
            if b.ideal:
                name = f"through {a.name} parallel to {_axis(b)}"
            yield NamedScrew(tuple(column), JOIN, name, self.limb)

    def _common_lines(self) -> Iterator[NamedScrew]:
        """Rotations about the lines that two planes of meeting axes have in common."""
        framed = self.assembly.common_twists
        features = features_of(framed)
        planes = [
            (features.normal(i, j), features.points[corner].position, f"{i}, {j}")
            for i, j, corner in features.planes
            if framed.limb_of(i) == framed.limb_of(j) == self.limb
        ][:_PLANES]
        for (n, p, one), (o, q, other) in combinations(planes, 2):
            way = self._normal(cross(n, o))
            first, second = (
                tuple(dot(o, q) * x for x in n),
                tuple(dot(n, p) * x for x in o),
            )
            moment = self._normal(subtract(_three(first), _three(second)))
            column = framed.ring.without_divisors([*way, *moment])
            name = f"in which the planes of axes {one} and of axes {other} meet"
            yield NamedScrew(tuple(column), JOIN, name, self.limb)

    def _along(self, line: Line) -> Vector[Polynomial]:
        a, b = (self.points[i].coordinates for i in line)
        return _three(wrench_through(a, b)[DIRECTION])

    def _normal(self, vector: Vector[Polynomial]) -> Vector[Polynomial]:
        ring = self.assembly.common_twists.ring
        x, y, z = ring.without_divisors([ring.normal(value) for value in vector])
        return x, y, z

    def _line(self, line: Line) -> str:
        """A line in words: of one that is parallel to an axis the axis alone."""
        a, b = (self.points[i] for i in line)
        if a.ideal or b.ideal:
            return _axis(a if a.ideal else b)
        if a.written and b.written:
            return f"line {' '.join(sorted((a.name, b.name)))}"
        return f"the line through {a.name} and {b.name}"


def _axis(direction: PlacedPoint) -> str:
    return direction.name.removeprefix("the direction of ")


def _three(values: Sequence[Polynomial]) -> Vector[Polynomial]:
    x, y, z = values
    return x, y, z
