"""Whether a component lies in another one, or beside it in the zeros of its equations.

References: [CoxLittleOShea] §9.4 (dimension), §9.6 (the tangent space bounds it).
"""

from __future__ import annotations

from contextlib import suppress

from screwkit.algebra.all_roots import rank_at_roots
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Locus
from screwkit.certificates.texts import read


def holds_on(locus: Locus, point: PointRing) -> bool:
    """Whether all equations of a component vanish at a posture."""
    return all(point.value(read(text)) == 0 for text in locus.equations)


def is_whole_part(
    postures: Postures, locus: Locus, other: Locus, point: PointRing
) -> bool:
    """Whether a component is a whole part of the zeros of another one's equations.

    Then no larger part of them contains it.  Near a posture their dimension is at most
    n less the rank of their derivatives; the component has n less its conditions at
    least (Krull).

    Args:
        postures: Of the part of the certificate.
        locus: The component; the other one's equations vanish on it.
        other: The other one.
        point: A posture of the first reach of the component.
    """
    if postures.tied:
        return False
    reach = locus.reach[0]
    conditions = len(reach.steps) + sum(map(_conditions, reach.roots))
    with suppress(ResampleError):
        rows = postures.changes(point, Way(), other.equations)
        return rank_at_roots(rows, postures.prime) >= conditions
    return False


def _conditions(root: Unsolved) -> int:
    """How many of them are met together."""
    return 1 + len(root.together) + (root.beside is not None)
