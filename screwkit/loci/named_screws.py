"""Screws with what a person calls them: axes and slides, the lines of limbs' wrenches.

References: [Merlet1989]; [LongCaroKhalil2012] Table 3.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.modular import rank
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import DIRECTION
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.features import listed
from screwkit.loci.placed_points import (
    PlacedPoint,
    placed_points,
    sample_points,
    wrench_through,
)
from screwkit.loci.reciprocal_lines import reciprocal_lines
from screwkit.screw.nullspace import has_pitch


@dataclass(frozen=True)
class Noun:
    """What screws of one kind are called.

    Attributes:
        one: ``axis``, ``the normal of axes``.
        many: ``axes``, ``the normals of axes``.
        between: Before every further name: ``of axes``; mostly nothing.
    """

    one: str
    many: str
    between: str = ""


AXIS = Noun("axis", "axes")
SLIDE = Noun("slide", "slides")
SCREW = Noun("screw", "screws")
LINE = Noun("line", "lines")
NORMAL = Noun("the normal of axes", "the normals of axes", "of axes ")
JOIN = Noun("the line", "the lines")


@dataclass(frozen=True)
class NamedScrew:
    """A twist or wrench over a ring, and its name.

    Attributes:
        column: (direction, moment).
        noun: What it is.
        name: Its own: ``3``, ``A1 B1``, ``through B1 parallel to axis R1``.
        limb: Number of the limb.
        free: A translation or couple, without a place.
        pitched: Neither that nor a line.
        ball: The joint that turns about a point in every way, of its rotations.
    """

    column: tuple[Polynomial, ...]
    noun: Noun
    name: str
    limb: int
    free: bool = False
    pitched: bool = False
    ball: str = ""

    @property
    def is_line(self) -> bool:
        """Whether it lies on a line: a rotation or a force."""
        return not self.free and not self.pitched

    def at(self, point: Sequence[int], prime: int) -> list[int]:
        """Its coordinates at an exact posture."""
        return [residue(value, point, prime) for value in self.column]


def called(screws: Sequence[NamedScrew]) -> str:
    """``axes 1, 2 and 3``, ``axis 1 and slide P``, ``lines A1 B1 and A2 B2``."""
    groups: dict[Noun, list[str]] = {}
    for screw in screws:
        groups.setdefault(screw.noun, []).append(screw.name)
    return " and ".join(_group(noun, names) for noun, names in groups.items())


def _group(noun: Noun, names: Sequence[str]) -> str:
    if len(names) == 1:
        return f"{noun.one} {names[0]}"
    if noun == JOIN:  # their names have an "and" of their own
        return f"{noun.many} {', '.join(names[:-1])}, and {names[-1]},"
    further = [noun.between + name for name in names[1:]]
    return f"{noun.many} {listed([names[0], *further])}"


def joint_screws(framed: FramedTwists) -> tuple[NamedScrew, ...]:
    """The twists of joints."""
    ball_of = {label: joint for joint, own in framed.balls for label in own}
    found = []
    for label, column in zip(framed.joints, framed.columns, strict=True):
        free = all(value == 0 for value in column[DIRECTION])
        pitched = not free and has_pitch(framed.ring, column)
        noun = SLIDE if free else SCREW if pitched else AXIS
        limb, ball = framed.limb_of(label), ball_of.get(label, "")
        found.append(NamedScrew(tuple(column), noun, label, limb, free, pitched, ball))
    return tuple(found)


def wrench_screws(
    assembly: Assembly, locked: Collection[str] = ()
) -> tuple[NamedScrew, ...]:
    """Independent wrenches of each limb on lines through two of its points.

    Limbs with loops inside are left out; a limb's wrenches need not all be found.

    Args:
        assembly: The mechanism.
        locked: Actuated joints, which resist every motion.
    """
    framed = assembly.common_twists
    samples = sample_points(assembly.root(framed.ring))
    if not samples:
        return ()
    points, owners = placed_points(assembly, samples)
    axes = [s for s in joint_screws(framed) if s.is_line and not s.ball]
    found: list[NamedScrew] = []
    for number, limb in enumerate(assembly.limbs):
        if limb.elements is not None:
            continue
        passive = [framed.column(j) for j in limb.joints if j not in locked]
        own = [i for i, owner in enumerate(owners) if number in owner]
        lines, _ = reciprocal_lines(passive, own, points, samples)
        found += [_join(framed.ring, points[a], points[b], number) for a, b in lines]
    return tuple(_named_as_axis(screw, axes, samples) for screw in found)


def _named_as_axis(
    screw: NamedScrew,
    axes: Sequence[NamedScrew],
    samples: Sequence[tuple[Sequence[int], int]],
) -> NamedScrew:
    """The line by the name of the axis that lies on it, if one does."""
    if screw.is_line:
        for axis in sorted(axes, key=lambda a: a.limb != screw.limb):
            if all(rank([screw.at(*at), axis.at(*at)], at[1]) == 1 for at in samples):
                return replace(screw, noun=AXIS, name=axis.name)
    return screw


def _join(
    ring: TrigonometricRing, a: PlacedPoint, b: PlacedPoint, limb: int
) -> NamedScrew:
    wrench = wrench_through(a.coordinates, b.coordinates)
    column = tuple(ring.normal(value) for value in wrench)
    if a.ideal and b.ideal:
        name = " and ".join(_axis(p) for p in (a, b))
        return NamedScrew(column, NORMAL, name, limb, free=True)
    if a.ideal or b.ideal:
        place, way = (b, a) if a.ideal else (a, b)
        name = f"through {place.name} parallel to axis {_axis(way)}"
        return NamedScrew(column, JOIN, name, limb)
    if a.written and b.written:
        name = " ".join(sorted((a.name, b.name)))
        return NamedScrew(column, LINE, name, limb)
    return NamedScrew(column, JOIN, f"through {a.name} and {b.name}", limb)


def _axis(direction: PlacedPoint) -> str:
    return direction.name.removeprefix("the direction of axis ")
