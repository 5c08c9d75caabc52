"""What is known of a locus whose determinant is too long to be written.

The platform is held by six lines; where they are dependent is a condition of a degree
that is told from values at exact postures along a random line.

References: [BenHorinShoham2006]; [Merlet1989].
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence

from screwkit.algebra.degree_along import degree_along, determinant
from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.points import residue, with_extensions
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.features import listed
from screwkit.loci.figure_words import dependent
from screwkit.loci.limb_wrenches import wrench_screws
from screwkit.loci.named_screws import NamedScrew
from screwkit.results.superbracket import Superbracket

HIGHEST = 150
"""Degree up to which it is looked for."""


def six_lines_in_words(
    assembly: Assembly, actuated: Sequence[str], bracket: Superbracket
) -> str:
    """Where six lines that hold the platform are dependent, and of which degree.

    Args:
        assembly: The mechanism, the platform of which is held by six lines.
        actuated: Its admissible scheme.
        bracket: Of these lines.

    Returns:
        To be said of a locus that is not written out; empty where no names are found.
    """
    screws = wrench_screws(assembly, actuated)
    root = assembly.root(assembly.common_twists.ring)
    if len(screws) != 6 or not root.points:
        return ""
    at, prime = root.points[0]
    rows = [screw.at(at, prime) for screw in screws]
    words: str | None = " or ".join(
        f.words for f in bracket.factors if f.holds != "never"
    )
    words = words or dependent(screws, 5, rows, prime)
    if not words:
        return ""
    told = f"while limbs keep their ranks the platform moves only where {words}"
    degrees = list(_degrees(assembly, screws))
    if not degrees:
        return told
    return f"{told}: a determinant of degree {' and of degree '.join(degrees)}"


def _degrees(assembly: Assembly, screws: Sequence[NamedScrew]) -> Iterator[str]:
    """``3 in x, y and z``: in the symbols of the pose, and in joint variables."""
    ring, mechanism = assembly.common_twists.ring, assembly.mechanism
    pose = mechanism.pose
    if pose is None or ring.radicands:
        return
    moved, turned = (
        {name for part in parts for name in symbols_of(part)}
        for parts in (pose.translation, [x for row in pose.rotation for x in row])
    )
    for names in (moved, turned - moved):
        places = dict(zip(ring.symbols, ring.symbol_indices(), strict=True))
        own = [p.name for p in mechanism.parameters if p.name in names & set(places)]
        degree = _degree(assembly, screws, [places[n] for n in own]) if own else None
        if degree:
            yield f"{degree} in {listed(own)}"


def _degree(
    assembly: Assembly, screws: Sequence[NamedScrew], symbols: Sequence[int]
) -> int | None:
    """In some symbols together, without the divisors of the ring."""
    ring = assembly.common_twists.ring
    start, prime = assembly.root(ring).points[0]
    source = random.Random(29)
    way = {index: source.randrange(1, prime) for index in symbols}
    inverses = [*ring.divisors_of.values()]
    size = 2 + sum(_most([*s.column], symbols) for s in screws)
    size = max(size, *(2 + _most([own], symbols) for own in inverses), 3)
    if size > HIGHEST:
        return None
    values: list[int] = []
    below: list[list[int]] = [[] for _ in inverses]
    for step in range(size + 1):
        moved = list(start)
        for index, slope in way.items():
            moved[index] = (start[index] + step * slope) % prime
        point = with_extensions(ring, moved, prime)
        if point is None:
            return None
        values.append(determinant([s.at(point, prime) for s in screws], prime))
        for own, divisor in zip(below, inverses, strict=True):
            own.append(residue(divisor, point, prime))
    return degree_along(values, below, prime)


def _most(coordinates: Sequence[Polynomial], symbols: Sequence[int]) -> int:
    """The highest degree in some symbols together."""
    return max(
        (
            sum(int(monomial[i]) for i in symbols)
            for value in coordinates
            for monomial in value.monoms()
        ),
        default=0,
    )
