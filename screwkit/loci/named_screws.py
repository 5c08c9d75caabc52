"""Screws with what a person calls them: axes, slides, lines and couples.

References: [Merlet1989]; [LongCaroKhalil2012] Table 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.conventions import DIRECTION
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.features import listed
from screwkit.screw.nullspace import has_pitch


@dataclass(frozen=True)
class Noun:
    """What screws of one kind are called.

    Attributes:
        one: ``axis``, ``the normal of axes``.
        many: ``axes``, ``the normals of axes``.
        between: Before every further name: ``of axes``; mostly nothing.
        apart: Whether commas part the names, which have an "and" of their own.
    """

    one: str
    many: str
    between: str = ""
    apart: bool = False


AXIS = Noun("axis", "axes")
SLIDE = Noun("slide", "slides")
SCREW = Noun("screw", "screws")
LINE = Noun("line", "lines")
NORMAL = Noun("the normal of axes", "the normals of axes", "of axes ")
JOIN = Noun("the line", "the lines", apart=True)


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
    first, *further = [
        noun.between + name if n else name for n, name in enumerate(names)
    ]
    if noun.apart:
        return f"{noun.many} {', '.join([first, *further[:-1]])}, and {further[-1]},"
    return f"{noun.many} {listed([first, *further])}"


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
