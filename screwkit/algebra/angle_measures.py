"""Common measures of constant angles: 3/10, 1/5 and 1/10 are multiples of 1/10.

The sine and cosine of a rational number of radians are transcendental [Lindemann1882],
and free of each other but for the integer relations of the angles: 3/10 = 1/10 + 1/5
makes cos(3/10) a polynomial in the others.  All rationals are related, yet a relation
n₁·r₁ + n₂·r₂ + … = 0 shows itself only in polynomials whose degree in the pairs is half
of |n₁| + |n₂| + … at least; relations up to `LONGEST` are used.

References: [Lindemann1882]; [LenstraLenstraLovasz1982].
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import lcm
from typing import Final, TypeAlias

from flint import fmpz_mat

LONGEST: Final = 8
"""Sum of the coefficients of a relation that is used."""

_HEAVY = 10**6  # what must become 0 weighs more than any short relation

Combination: TypeAlias = tuple[tuple[Fraction, int], ...]


@dataclass(frozen=True)
class Measures:
    """Constant angles as integer combinations of fewer ones.

    Attributes:
        values: The measures, positive numbers of radians.
        of: Each angle in the measures.
        made_of: Each measure in the angles.
    """

    values: tuple[Fraction, ...] = ()
    of: Mapping[Fraction, Combination] = field(default_factory=dict)
    made_of: Mapping[Fraction, Combination] = field(default_factory=dict)


def common_measures(angles: Iterable[Fraction]) -> Measures:
    """Measures of which no short relation is left.

    Args:
        angles: Positive numbers of radians, no two equal.
    """
    given = tuple(angles)
    relations = _short_relations(given) if len(given) > 1 else []
    table = _kernel(relations, len(given)) if relations else []
    values, made = _measured(given, table)
    if not table or not all(values):
        alone: dict[Fraction, Combination] = {a: ((a, 1),) for a in given}
        return Measures(given, alone, alone)
    signs = [1 if value > 0 else -1 for value in values]
    sizes = [abs(value) for value in values]
    of = {
        angle: _combination(sizes, [s * n for s, n in zip(signs, row, strict=True)])
        for angle, row in zip(given, table, strict=True)
    }
    made_of = {
        size: _combination(given, [s * n for n in row])
        for size, s, row in zip(sizes, signs, made, strict=True)
    }
    return Measures(tuple(sizes), of, made_of)


def _combination(angles: Iterable[Fraction], counts: Iterable[int]) -> Combination:
    return tuple((a, n) for a, n in zip(angles, counts, strict=True) if n)


def _short_relations(angles: tuple[Fraction, ...]) -> list[list[int]]:
    """Of a reduced basis of all integer relations those that are short."""
    below = lcm(*(angle.denominator for angle in angles))
    basis = _kernel([[int(angle * below) for angle in angles]], len(angles))
    rows = [list(row) for row in zip(*basis, strict=True)]
    return [row for row in rows if sum(map(abs, row)) <= LONGEST]


def _kernel(rows: list[list[int]], size: int) -> list[list[int]]:
    """A reduced basis of the integer vectors that all rows map to 0, as columns."""
    heavy = _HEAVY * size * (1 + max(abs(n) for row in rows for n in row))
    table = [
        [*(int(i == j) for j in range(size)), *(heavy * row[i] for row in rows)]
        for i in range(size)
    ]
    reduced = _integers(fmpz_mat(table).lll())
    kept = [row[:size] for row in reduced if not any(row[size:])]
    return [[row[i] for row in kept] for i in range(size)]


def _measured(
    angles: tuple[Fraction, ...], table: list[list[int]]
) -> tuple[tuple[Fraction, ...], list[list[int]]]:
    """Values of the measures by which ``table`` gives the angles, and their making.

    The rows of the table generate all integer vectors; those combinations of them that
    are unit vectors make the measures of the angles.
    """
    if not table:
        return (), []
    count, size = len(table[0]), len(table)
    extended = [
        [*(_HEAVY * n for n in row), *(int(i == j) for j in range(size))]
        for i, row in enumerate(table)
    ]
    reduced = _integers(fmpz_mat(extended).lll())
    whole = [row for row in reduced if any(row[:count])]
    square = fmpz_mat([[n // _HEAVY for n in row[:count]] for row in whole])
    made = _integers(square.solve(fmpz_mat([row[count:] for row in whole])))
    values = [
        sum((n * a for n, a in zip(row, angles, strict=True)), Fraction(0))
        for row in made
    ]
    return tuple(values), made


def _integers(matrix: fmpz_mat) -> list[list[int]]:
    return [[int(x) for x in row] for row in matrix.tolist()]
