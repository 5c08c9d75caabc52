"""Numbers over a known denominator, told from their residue by rounding.

The integer combinations of a few irrationalities that vanish modulo a number form a
lattice, the same for all residues.  Reduced once, it gives the shortest combination
with a given residue by one rounding [Babai1986], where a search would reduce a lattice
anew.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from flint import fmpq_mat, fmpz, fmpz_mat

TRIED: Final = 8
"""Denominators for which one residue is looked at."""


@dataclass(frozen=True)
class VanishingCombinations:
    """The lattice of integers c with Σ c·unit = 0 modulo a number, the first unit 1.

    Attributes:
        modulus: The number.
        rows: A reduced basis.
        weights: Coordinates of (1, 0, …, 0) in it, times ``size``.
        size: The determinant of the basis.
        height: Coefficients up to this are no chance.
    """

    modulus: int
    rows: tuple[tuple[int, ...], ...]
    weights: tuple[int, ...]
    size: int
    height: int

    @classmethod
    def of(
        cls, units: Sequence[int], modulus: int, chance: int
    ) -> VanishingCombinations:
        """The lattice of some irrationalities.

        Args:
            units: Their residues, the first 1.
            modulus: The product of the primes.
            chance: A random residue passes for a number once in so many.
        """
        count = len(units)
        rows = [[int(i == j) for j in range(count)] for i in range(count)]
        for row, unit in zip(rows, units, strict=True):
            row[0] = -unit % modulus
        rows[0][0] = modulus
        basis = fmpz_mat(rows).lll()
        size = int(basis.det())
        inverse = fmpq_mat(basis).inv() * size
        least = max(modulus // (chance * TRIED), 1)
        return cls(
            modulus,
            tuple(tuple(int(basis[i, j]) for j in range(count)) for i in range(count)),
            tuple(int(inverse[0, j].p) for j in range(count)),
            size,
            (int(fmpz(least).root(count)) - 1) // 2,
        )

    def over(self, below: int, residue: int) -> list[int] | None:
        """Numerators of a number over a denominator; None if they are not short."""
        above = self.nearest(below * residue % self.modulus)
        return above if max(map(abs, above)) <= self.height else None

    def nearest(self, residue: int) -> list[int]:
        """A short integer combination with this residue."""
        found = [residue, *[0] * (len(self.rows) - 1)]
        for row, weight in zip(self.rows, self.weights, strict=True):
            times = (2 * residue * weight + self.size) // (2 * self.size)
            found = [x - times * y for x, y in zip(found, row, strict=True)]
        return found
