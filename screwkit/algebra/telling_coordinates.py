"""Which coordinates tell all vectors of polynomials apart.

Twists of a planar mechanism have three coordinates that say all, those about one point
and in one plane likewise; the others are zero or constant combinations of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from flint import fmpq_mat

from screwkit.algebra.trigonometric import Polynomial


def telling_coordinates(vectors: Iterable[Sequence[Polynomial]]) -> tuple[int, ...]:
    """The first coordinates from which all others follow, by constant coefficients.

    They span what all coordinates span over the rational numbers, so ranks and linear
    relations of such vectors are those of these coordinates alone.

    Args:
        vectors: All of one length, in one ring.
    """
    rows: dict[tuple[int, tuple[int, ...]], list[object]] = {}
    width = 0
    for number, vector in enumerate(vectors):
        width = len(vector)
        for place, entry in enumerate(vector):
            for powers, coefficient in entry.to_dict().items():
                row = rows.setdefault((number, powers), [0] * width)
                row[place] = coefficient
    if not rows:
        return ()
    reduced, rank = fmpq_mat(list(rows.values())).rref()
    chosen, start = [], 0
    for line in range(int(rank)):
        start = next(i for i in range(start, width) if reduced[line, i] != 0)
        chosen.append(start)
        start += 1
    return tuple(chosen)
