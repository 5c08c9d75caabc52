"""A basis of a screw system that a person would choose.

Free vectors first (couples among wrenches, translations among twists), then lines, then
screws.  A line's place is free up to the free vectors at right angles to nothing: it is
put through a given point where the system allows that.  Directions come from a reduced
echelon form, so that they are the base axes wherever these lie in the system.

References: [Hunt1978] (systems and their free vectors).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

from screwkit.conventions import DIRECTION, MOMENT
from screwkit.reasons.residue_spaces import reduced_echelon
from screwkit.screw.vector import cross, dot

Row: TypeAlias = tuple[int, ...]
"""(direction; moment) modulo a prime."""
_SHIFTS = tuple(Fraction(s) for s in ("1", "-1", "2", "-2", "1/2", "-1/2"))


def kind_of(screw: Sequence[int], prime: int) -> str:
    """``free`` (no direction), ``line`` (no pitch) or ``screw``."""
    direction, moment = screw[DIRECTION], screw[MOMENT]
    if not any(direction):
        return "free"
    return "screw" if dot(direction, moment) % prime else "line"


def product(wrench: Sequence[int], twist: Sequence[int], prime: int) -> int:
    """The reciprocal product f·v + m·ω."""
    forward = dot(wrench[DIRECTION], twist[MOMENT])
    return int(forward + dot(wrench[MOMENT], twist[DIRECTION])) % prime


def about(screw: Sequence[int], point: Sequence[int], prime: int) -> Row:
    """The same screw with its moment about another point."""
    direction, moment = screw[DIRECTION], screw[MOMENT]
    lever = cross(point, direction)
    return (
        *direction,
        *((m - c) % prime for m, c in zip(moment, lever, strict=True)),
    )


def passes(screw: Sequence[int], point: Sequence[int], prime: int) -> bool:
    """Whether the axis of a screw goes through a point; never for free vectors."""
    here = about(screw, point, prime)
    across = cross(here[DIRECTION], here[MOMENT])
    return any(here[DIRECTION]) and not any(x % prime for x in across)


def readable_basis(
    system: Sequence[Sequence[int]], prime: int, point: Sequence[int] = (0, 0, 0)
) -> list[Row]:
    """Free vectors, then lines and screws, of a system given by any screws of it.

    Args:
        system: Screws that span it.
        prime: The modulus.
        point: Lines pass through it where the system allows.
    """
    named = [
        {i: x for i, x in enumerate(about(row, point, prime)) if x} for row in system
    ]
    rows = [
        tuple(row.get(i, 0) for i in range(6))
        for row in reduced_echelon(named, prime, lambda i: i)
    ]
    free = [row for row in rows if kind_of(row, prime) == "free"]
    directed = rows[: len(rows) - len(free)]
    for number, row in enumerate(directed):
        others = [*free, *directed[:number], *directed[number + 1 :]]
        directed[number] = _straightened(row, others, prime)
    back = [-x for x in point]
    lines = [row for row in directed if kind_of(row, prime) == "line"]
    screws = [row for row in directed if kind_of(row, prime) == "screw"]
    return [about(row, back, prime) for row in (*free, *lines, *screws)]


def _straightened(row: Row, others: Sequence[Row], prime: int) -> Row:
    """The screw plus a multiple of another that makes it a line, if one does."""
    pitch = dot(row[DIRECTION], row[MOMENT]) % prime
    if not pitch:
        return row
    for other in others:
        mixed = product(row, other, prime)
        if kind_of(other, prime) == "free":
            if mixed:
                return _plus(row, -pitch * pow(mixed, -1, prime), other, prime)
            continue
        own = dot(other[DIRECTION], other[MOMENT])
        for shift in _SHIFTS:
            t = shift.numerator * pow(shift.denominator, -1, prime)
            if not (pitch + t * mixed + t * t * own) % prime:
                return _plus(row, t, other, prime)
    return row


def _plus(row: Row, factor: int, other: Row, prime: int) -> Row:
    return tuple((a + factor * b) % prime for a, b in zip(row, other, strict=True))
