"""Brackets of points and the superbracket of six lines, each through two points.

Points are homogeneous 4-vectors (x, w); w = 0 is a direction.  The bracket [abcd] is
the determinant of four of them; the superbracket [ab, cd, ef, gh, ij, kl] is the
determinant of six lines in Plücker coordinates, written in brackets by McMillan and
White's 24 monomials.

References: [McMillanWhite1991]; [BenHorinShoham2006].
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Sequence
from functools import cache, lru_cache
from itertools import permutations
from typing import TypeAlias

from screwkit.algebra.ring import S

Line: TypeAlias = tuple[int, int]
"""Two points by their numbers."""

Bracket: TypeAlias = tuple[int, int, int, int]
"""Four points by their numbers, in increasing order."""

Monomial: TypeAlias = tuple[Bracket, ...]

TERMS = (
    "-abcd efgi hjkl",
    "+abcd efhi gjkl",
    "+abcd efgj hikl",
    "-abcd efhj gikl",
    "+abce dfgh ijkl",
    "-abde cfgh ijkl",
    "-abcf degh ijkl",
    "+abdf cegh ijkl",
    "-abce dghi fjkl",
    "+abde cghi fjkl",
    "+abcf dghi ejkl",
    "+abce dghj fikl",
    "-abdf cghi ejkl",
    "-abde cghj fikl",
    "-abcf dghj eikl",
    "+abdf cghj eikl",
    "+abcg defi hjkl",
    "-abdg cefi hjkl",
    "-abch defi gjkl",
    "-abcg defj hikl",
    "+abdh cefi gjkl",
    "+abdg cefj hikl",
    "+abch defj gikl",
    "-abdh cefj gikl",
)


def bracket(rows: Sequence[Sequence[S]]) -> S:
    """Determinant of four points, by 2×2 minors of the first two rows."""
    a, b, c, d = rows

    def minor(x: Sequence[S], y: Sequence[S], i: int, j: int) -> S:
        return x[i] * y[j] - x[j] * y[i]

    pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    over = [minor(a, b, i, j) for i, j in pairs]
    below = [minor(c, d, i, j) for i, j in pairs]
    return (
        over[0] * below[5]
        - over[1] * below[4]
        + over[2] * below[3]
        + over[3] * below[2]
        - over[4] * below[1]
        + over[5] * below[0]
    )


def plane(rows: Sequence[Sequence[S]]) -> list[S]:
    """The plane of three points: x lies on it where Σ plane[i]·x[i] = 0.

    The sum is the bracket [x a b c] up to the sign that all planes share.
    """
    a, b, c = rows

    def minor(i: int, j: int, k: int) -> S:
        return (
            a[i] * (b[j] * c[k] - b[k] * c[j])
            - a[j] * (b[i] * c[k] - b[k] * c[i])
            + a[k] * (b[i] * c[j] - b[j] * c[i])
        )

    return [minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)]


def monomials_of(
    lines: Sequence[Line], vanishes: Callable[[Bracket], bool]
) -> dict[Monomial, int]:
    """The 24 monomials of six lines in this order, collected, without those that are 0.

    Args:
        lines: Six.
        vanishes: Whether four different points are in one plane for every posture.
    """
    letters = dict(
        zip("abcdefghijkl", (p for line in lines for p in line), strict=True)
    )
    found: Counter[Monomial] = Counter()
    for term in TERMS:
        sign = -1 if term[0] == "-" else 1
        brackets: list[Bracket] = []
        for word in term[1:].split():
            a, b, c, d = (letters[letter] for letter in word)
            ordered, turned = _sorted(a, b, c, d)
            if len(set(ordered)) < 4 or vanishes(ordered):
                break
            brackets.append(ordered)
            sign *= turned
        else:
            found[tuple(sorted(brackets))] += sign
    return {monomial: count for monomial, count in found.items() if count}


def shortest_monomials(
    lines: Sequence[Line], vanishes: Callable[[Bracket], bool]
) -> dict[Monomial, int]:
    """`monomials_of` in the order of lines that leaves the fewest.

    The superbracket changes by its sign alone when lines change places.
    """
    best: dict[Monomial, int] | None = None
    once = cache(vanishes)  # the same brackets come up in all orders
    for order in permutations(range(6)):
        found = monomials_of([lines[i] for i in order], once)
        if best is None or _is_shorter(found, best):
            best = found
        if len(best) <= 1:
            break
    return best or {}


def _is_shorter(found: dict[Monomial, int], best: dict[Monomial, int]) -> bool:
    """Whether it has fewer monomials, or as many that share more brackets."""
    if len(found) != len(best):
        return len(found) < len(best)
    return len(common_brackets(found)) > len(common_brackets(best))


def common_brackets(found: Collection[Monomial]) -> list[Bracket]:
    """The brackets that all monomials share, as often as they do."""
    shared: Counter[Bracket] | None = None
    for monomial in found:
        own = Counter(monomial)
        shared = own if shared is None else shared & own
    return sorted((shared or Counter()).elements())


@lru_cache(maxsize=1 << 15)
def _sorted(*points: int) -> tuple[Bracket, int]:
    """Four points in order, and the sign of the permutation."""
    left, sign = list(points), 1
    for i in range(4):
        for j in range(3 - i):
            if left[j] > left[j + 1]:
                left[j], left[j + 1] = left[j + 1], left[j]
                sign = -sign
    a, b, c, d = left
    return (a, b, c, d), sign
