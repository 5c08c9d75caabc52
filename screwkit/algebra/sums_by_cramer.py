"""Sums of conditions that are linear in some symbols together, by Cramer's rule.

Of m conditions that are linear in m symbols, the sum with the cofactors of one symbol
holds that symbol alone of the m; of m + 1 conditions there is a sum that holds none.
Where the conditions say that vectors are parallel, or lie in a plane, such sums are
products: of a coordinate of a vector and what ties the directions.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from screwkit.algebra.minors import minors_of
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.sums_of_conditions import Combination
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.errors import TooLargeError

LARGEST = 3
"""Symbols that are taken out together, at most."""

LONGEST = 60
"""Terms of a condition that is used."""

FILLED = 20_000
"""Products of terms that one more column of a minor may take."""


@dataclass(frozen=True)
class CramerSum:
    """A sum, and the symbols that all but one of are no longer in it.

    Attributes:
        symbols: Indices of generators.
    """

    combination: Combination
    symbols: tuple[int, ...]


def sums_by_cramer(
    ring: TrigonometricRing,
    conditions: Sequence[Polynomial],
    dimensions: Collection[int] = (),
) -> Iterator[CramerSum]:
    """Sums without most of the symbols in which conditions are linear.

    Args:
        ring: Of the conditions.
        conditions: Not zero.
        dimensions: Indices of symbols that are taken out one by one only.

    Yields:
        Few symbols first; sums that are too long are left out.
    """
    places = [k for k, own in enumerate(conditions) if len(own) <= LONGEST]
    for size in range(1, LARGEST + 1):
        for symbols in combinations(ring.symbol_indices(), size):
            if size > 1 and {*symbols} & {*dimensions}:
                continue
            own = [
                k
                for k in places
                if any(conditions[k].degrees()[i] for i in symbols)
                and _is_affine(conditions[k], symbols)
            ]
            for count in (size, size + 1) if size > 1 else (size + 1,):
                for chosen in combinations(own, count):
                    columns = _coefficients(ring, conditions, chosen, symbols)
                    # As many conditions as symbols keep one of these.
                    kept = range(size) if count == size else (None,)
                    for k in kept:
                        left = [own for n, own in enumerate(columns) if n != k]
                        yield from _summed(ring, conditions, chosen, symbols, left)


def _is_affine(condition: Polynomial, symbols: Sequence[int]) -> bool:
    """Of first degree in some symbols together."""
    return all(sum(int(own[i]) for i in symbols) <= 1 for own in condition.monoms())


def _coefficients(
    ring: TrigonometricRing,
    conditions: Sequence[Polynomial],
    chosen: Sequence[int],
    symbols: Sequence[int],
) -> list[list[Polynomial]]:
    return [
        [linear_parts(ring, conditions[k], symbol)[0] for k in chosen]
        for symbol in symbols
    ]


def _summed(
    ring: TrigonometricRing,
    conditions: Sequence[Polynomial],
    chosen: Sequence[int],
    symbols: Sequence[int],
    columns: Sequence[Sequence[Polynomial]],
) -> Iterator[CramerSum]:
    """Conditions times the minors of the coefficients that leave their row out."""
    try:
        minors = minors_of(ring, columns, FILLED)
    except TooLargeError:
        return
    whole = (1 << len(chosen)) - 1
    times = [ring.zero] * len(conditions)
    for number, place in enumerate(chosen):
        minor: Polynomial = minors.get(whole ^ 1 << number, ring.zero)
        times[place] = -minor if number % 2 else minor
    pairs = [(times[k], conditions[k]) for k in chosen if times[k] != 0]
    if len(pairs) < 2 or sum(len(a) * len(b) for a, b in pairs) > FILLED:
        return
    value = ring.normal(sum((a * b for a, b in pairs), ring.zero))
    if value != 0:
        yield CramerSum(Combination(value, tuple(times)), tuple(symbols))
