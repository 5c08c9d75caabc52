"""What the dependence of lines and couples looks like: pencils, planes, complexes.

Lines are dependent exactly where they lie as follows [Merlet1989]; a couple is a line
at infinity.  What holds for every posture shortens the words: of three lines in a plane
only a common point is to be said.

References: [Merlet1989]; [Hunt1978] §12; [LongCaroKhalil2012] Table 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from screwkit.algebra.modular import rank
from screwkit.conventions import DIRECTION
from screwkit.loci.named_screws import SLIDE, NamedScrew, called
from screwkit.loci.placed_points import power

Rows = Sequence[Sequence[int]]


def dependent(
    screws: Sequence[NamedScrew], rank_left: int, generic: Rows, prime: int
) -> str | None:
    """How screws lie that span no more than so many dimensions; None without a name.

    Args:
        screws: None a combination of others at the rank that is left, in general.
        rank_left: Dimensions that they span where the sentence holds.
        generic: Their coordinates at a random posture.
        prime: The modulus.
    """
    lines = [s for s in screws if s.is_line]
    free = [s for s in screws if s.free]
    if len(lines) + len(free) < len(screws):
        return _pitched(screws, rank_left)
    if not lines:
        return dependent_directions(screws, rank_left)
    if not free:
        return _of_lines(lines, rank_left, generic, prime)
    if len(screws) == 3 and rank_left == 2 and len(lines) == 2:
        rows = [generic[i] for i, s in enumerate(screws) if s.is_line]
        return _two_and_a_couple(lines, free[0], rows, prime)
    if len(screws) == 4 and rank_left == 3 and len(lines) == 2:
        rows = [generic[i] for i, s in enumerate(screws) if s.is_line]
        if rank([row[DIRECTION] for row in rows], prime) == 1:
            # Their difference is free: it is normal to their plane.
            plane = f"the normal of the plane of {called(lines)}"
            return f"{called(free)} and {plane} are parallel to one plane"
    return _complex(screws, rank_left)


def dependent_directions(screws: Sequence[NamedScrew], rank_left: int) -> str | None:
    """How screws lie whose directions are dependent."""
    if rank_left == 1:
        return f"{called(screws)} are parallel"
    if rank_left == 2:
        return f"{called(screws)} are parallel to one plane"
    return None


def _of_lines(
    lines: Sequence[NamedScrew], rank_left: int, generic: Rows, prime: int
) -> str | None:
    named = called(lines)
    if rank_left == 1:
        return f"{named} are one line"
    if rank_left == 2:
        directions = rank([row[DIRECTION] for row in generic], prime)
        meet = _all_meet(generic, prime)
        if directions == 1 or (meet and directions == 3):
            return f"{named} lie in one plane"
        if meet:
            return f"{named} meet in one point or are parallel"
        return f"{named} lie in one plane and meet in one point or are parallel"
    return _complex(lines, rank_left) if len(lines) == rank_left + 1 else None


def _all_meet(rows: Rows, prime: int) -> bool:
    """Whether lines meet in pairs: in one point, or in one plane."""
    return not any(power(a, b) % prime for a, b in combinations(rows, 2))


def _two_and_a_couple(
    lines: Sequence[NamedScrew], free: NamedScrew, rows: Rows, prime: int
) -> str:
    across, pair = called([free]), called(lines)
    if rank([row[DIRECTION] for row in rows], prime) == 1:
        return f"{across} is normal to the plane of {pair}"
    return f"{pair} are parallel and {across} is normal to their plane"


def _complex(screws: Sequence[NamedScrew], rank_left: int) -> str | None:
    figure = {
        3: "generators of one regulus, or of a degenerate one",
        4: "lines of one linear congruence",
        5: "lines of one linear complex",
    }.get(rank_left)
    if figure is None or len(screws) != rank_left + 1:
        return None
    couples = ", couples as lines at infinity" if any(s.free for s in screws) else ""
    return f"{called(screws)} are {figure}{couples}"


def _pitched(screws: Sequence[NamedScrew], rank_left: int) -> str | None:
    if len(screws) != rank_left + 1:
        return None
    if rank_left == 1:
        return f"{called(screws)} are one screw"
    return f"one of {called(screws)} is a combination of the others"


def dependent_about(
    centre: str, screws: Sequence[NamedScrew], rank_left: int
) -> str | None:
    """How screws lie that are dependent up to all rotations, or forces, about a point.

    A line acts on the point along the normal of their plane, a free screw along itself.
    """
    lines = [s for s in screws if s.is_line]
    free = [s for s in screws if s.free]
    if len(lines) + len(free) < len(screws) or len(screws) != rank_left + 1:
        return None
    if not lines:
        return dependent_directions(free, rank_left)
    named = called(lines)
    if rank_left == 0:
        return f"{named} passes through {centre}"
    if rank_left == 1 and not free:
        return f"{named} lie in one plane with {centre}"
    if rank_left == 1:
        return f"{called(free)} is normal to the plane of {named} and {centre}"
    if not free:
        return f"the planes of {centre} with {named} have a line in common"
    if len(lines) == 2:
        across = f"the line through {centre} that meets {named}"
        return f"{called(free)} is normal to {across}"
    kind = "slides" if all(s.noun == SLIDE for s in free) else "directions"
    normal = f"the common normal of {kind}"
    named_free = called(free).removeprefix("slides ")
    return f"{normal} {named_free} is parallel to the plane of {named} and {centre}"


def dependent_along(
    axis: str, screws: Sequence[NamedScrew], rank_left: int
) -> str | None:
    """How forces lie that are dependent up to all couples normal to an axis.

    Two of them are parallel, with equal moments about the axis for equal forces.
    """
    if len(screws) != rank_left + 1:
        return None
    named = called(screws)
    if rank_left == 1:
        return f"{named} are parallel, in one plane parallel to axis {axis}"
    couple = f"a couple normal to axis {axis}"
    return f"some forces along {named} add up to no more than {couple}"
