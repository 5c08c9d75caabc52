"""The one motion a platform keeps, named by the axes and points of the mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from screwkit.conventions import DIRECTION, MOMENT
from screwkit.loci.features import Axis, Features
from screwkit.loci.placed_features import Residue
from screwkit.screw.vector import Vector, cross, dot, subtract


class Motion(NamedTuple):
    """A motion in words.

    Attributes:
        named: Whether they place it by something the mechanism has.
    """

    text: str
    named: bool


def motion_in_words(
    twist: Sequence[int], prime: int, features: Features[Residue]
) -> Motion:
    """A twist at an exact point.

    Args:
        twist: (ω; v), residues.
        prime: The modulus.
        features: The axes and points there.
    """
    a, b, c = (Residue(x, prime) for x in twist[DIRECTION])
    x, y, z = (Residue(x, prime) for x in twist[MOMENT])
    omega, v = (a, b, c), (x, y, z)
    if _vanishes(omega):
        along = _alike(v, features)
        if along is None:
            text = "the platform can translate: every wrench is normal to that "
            return Motion(f"{text}direction", named=False)
        return Motion(
            f"the platform can translate {along}: every wrench is normal to that "
            f"direction",
            named=True,
        )
    if dot(omega, v).value:
        along = _alike(omega, features)
        if along is None:
            text = "the platform keeps one screw motion, reciprocal to every wrench"
            return Motion(text, named=False)
        return Motion(
            f"the platform keeps one screw motion with its axis {along}, reciprocal "
            f"to every wrench",
            named=True,
        )
    return _turning(omega, v, features)


def _turning(
    omega: Vector[Residue], v: Vector[Residue], features: Features[Residue]
) -> Motion:
    """A rotation: its line is an axis, passes through points, or is parallel to one."""
    through = [
        p.name
        for p in features.points
        if _vanishes(subtract(v, cross(p.position, omega)))
    ]
    same = [
        axis.joint
        for axis in features.axes
        if axis.point is not None
        and _vanishes(cross(axis.direction, omega))
        and _vanishes(subtract(v, cross(axis.point, omega)))
    ]
    along = _alike(omega, features)
    if same:
        line = f"axis {same[0]}"
    elif len(through) > 1:
        line = f"the line through {through[0]} and {through[1]}"
    elif through and along is not None:
        line = f"the line through {through[0]} {along}"
    elif through:
        line = f"a line through {through[0]}"
    elif along is not None:
        line = f"a line {along}"
    else:
        text = "the platform can turn about a line that every wrench meets"
        return Motion(text, named=False)
    return Motion(f"the platform can turn about {line}: every wrench meets it", True)


def _alike(direction: Vector[Residue], features: Features[Residue]) -> str | None:
    """The first axis or slide of that direction, in words; slides first."""
    parallel = [
        axis for axis in features.axes if _vanishes(cross(axis.direction, direction))
    ]
    parallel.sort(key=_turns)
    if not parallel:
        return None
    first = parallel[0]
    kind = "axis" if _turns(first) else "slide"
    return f"parallel to {kind} {first.joint}"


def _turns(axis: Axis[Residue]) -> bool:
    return axis.point is not None


def _vanishes(vector: Sequence[Residue]) -> bool:
    return not any(x.value for x in vector)
