"""Integers modulo a 61-bit prime: one random exact posture.

Every symbol gets a random value, every angle a random point of the circle, and ranks
of what the kinematics returns are ranks over a field.  A rank can come out too small
only if a polynomial that is not zero vanishes at the random point, which happens with
probability below degree/2⁶⁰ [Schwartz1980]; it never comes out too large.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any, Final, TypeAlias

from flint import fmpz, nmod, nmod_mat, nmod_poly

from screwkit.algebra.angle_measures import Measures
from screwkit.algebra.constants import Combination, ConstantField
from screwkit.algebra.evaluation import add_angles, multiply_angle
from screwkit.algebra.expression import Expression
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.ring import Known

Residue: TypeAlias = Any  # flint.nmod, which has no type stubs

LARGEST = 2**61 - 1
_USUAL = ConstantField.needed_by([], 12)
_ALONE = Measures()


class ResampleError(Exception):
    """The random point lies where a root or an inverse does not exist; draw again."""


def random_prime(source: random.Random) -> int:
    """A random prime of 60 to 61 bits."""
    while True:
        candidate = source.randrange(2**60, LARGEST) | 1
        if fmpz(candidate).is_prime():
            return candidate


class ModularRing:
    """Residues mod a prime, with values drawn on demand and kept.

    Attributes:
        prime: The modulus.
        constants: The field of the geometry's constants: one root mod p is chosen for
            each of its generators, so that √3, √12 and cos(π/6) agree.
        zero, one: 0 and 1 mod p.
        plain: See `Ring`.
        known: See `Ring`.
        measures: Of constant angles; one that is not among them has a value of its own.
    """

    plain: Final = True

    def __init__(
        self,
        seed: int = 0,
        prime: int = LARGEST,
        constants: ConstantField | None = None,
        measures: Measures | None = None,
    ) -> None:
        self.prime = prime
        self.constants = constants or _USUAL
        self.measures = measures or _ALONE
        self._seed = seed
        self._symbols: dict[str, Residue] = {}
        self._angles: dict[str, tuple[Residue, Residue]] = {}
        self._roots: dict[Expression, Residue] = {}
        self.zero, self.one = nmod(0, prime), nmod(1, prime)
        self._generators: dict[str, Residue] = {}
        self.known: Known[Residue] = {}
        self._turns: dict[Fraction, tuple[Residue, Residue]] = {}

    @cached_property
    def _source(self) -> random.Random:
        return random.Random(self._seed)

    def rational(self, value: Fraction) -> Residue:
        """Numerator over denominator mod p."""
        above, below = value.numerator, value.denominator
        if below == 1:
            # Coordinates are 0 or 1 as a rule: one object serves a whole mechanism.
            if not above:
                return self.zero
            return self.one if above == 1 else nmod(above, self.prime)
        return nmod(above, self.prime) / nmod(below, self.prime)

    def symbol(self, name: str) -> Residue:
        """The value drawn for this symbol."""
        if name not in self._symbols:
            self._symbols[name] = self._draw()
        return self._symbols[name]

    def cosine_sine(self, angle: str) -> tuple[Residue, Residue]:
        """The point of the circle drawn for this angle."""
        if angle not in self._angles:
            self._angles[angle] = self._point()
        return self._angles[angle]

    def half_turns(self, count: Fraction) -> tuple[Residue, Residue]:
        """(cos, sin) of a multiple of π, in the generators of the constants.

        Raises:
            ResampleError: If this prime has no such constants; see `prime_for`.
        """
        if count not in self._turns:
            self._turns[count] = (
                self._algebraic(self.constants.cosine(count)),
                self._algebraic(self.constants.cosine(Fraction(1, 2) - count)),
            )
        return self._turns[count]

    def radians(self, value: Fraction) -> tuple[Residue, Residue]:
        """A transcendental constant: its measures are drawn like free angles."""
        pair = self.one, self.zero
        size = abs(value)
        for measure, count in self.measures.of.get(size, ((size, 1),)) if value else ():
            own = self.cosine_sine(str(measure))
            turned = multiply_angle(count if value > 0 else -count, own, self)
            pair = add_angles(pair, turned, self)
        return pair

    def square_root(self, radicand: Expression, value: Residue) -> Residue:
        """A square root mod p, always the same one for the same radicand.

        Raises:
            ResampleError: If there is none at this point.
        """
        if radicand not in self._roots:
            known = rational_value(radicand)
            if known is not None and known >= 0:
                root = self._algebraic(self.constants.square_root(known))
            else:
                root = self._root([int(-value), 0, 1])
            self._roots[radicand] = root
        return self._roots[radicand]

    def inverse(self, divisor: Expression, value: Residue) -> Residue:
        """1/value.

        Raises:
            ResampleError: If the divisor vanishes here.
        """
        if value == 0:
            raise ResampleError
        return 1 / value

    def normal(self, value: Residue) -> Residue:
        """Residues are their own normal form."""
        return value

    def is_zero(self, value: Residue) -> bool:
        """Whether the residue is 0."""
        return not value

    def _draw(self) -> Residue:
        return nmod(self._source.randrange(1, self.prime), self.prime)

    def _point(self) -> tuple[Residue, Residue]:
        while True:
            t = self._draw()
            below = 1 + t * t
            if below != 0:
                return (1 - t * t) / below, 2 * t / below

    def _root(self, coefficients: Sequence[int]) -> Residue:
        roots = nmod_poly(list(coefficients), self.prime).roots()
        if not roots:
            raise ResampleError
        return roots[0][0]

    def _algebraic(self, terms: Combination) -> Residue:
        """A constant from the residues of its field's generators."""
        total = self.zero
        for exponents, coefficient in terms.items():
            term = self.rational(coefficient)
            for name, exponent in zip(
                self.constants.generators, exponents, strict=True
            ):
                if exponent:
                    term = term * self.generator(name) ** exponent
            total = total + term
        return total

    def generator(self, name: str) -> Residue:
        """The residue of a generator of the constants, always the same one.

        Raises:
            ResampleError: If its minimal polynomial has no root mod this prime.
        """
        if name not in self._generators:
            polynomial = self.constants.minimal_polynomials[name]
            self._generators[name] = self._root(polynomial)
        return self._generators[name]


def prime_for(
    turn: int, radicands: Sequence[Fraction], seed: int, bits: int = 61
) -> int:
    """A random prime in which cos(kπ/turn) and the roots of these rationals exist."""
    source = random.Random(seed)
    step = 16 * turn
    while True:
        number = source.randrange(2 ** (bits - 1) // step, 2**bits // step)
        prime = number * step + 1
        if fmpz(prime).is_prime() and all(
            pow(r.numerator * r.denominator % prime, (prime - 1) // 2, prime) <= 1
            for r in radicands
        ):
            return prime


def residue_matrix(rows: Sequence[Sequence[Residue]], width: int, prime: int) -> Any:
    """A matrix of residues in FLINT's form.

    Most entries of a mechanism's matrices are 0 and cost nothing.
    """
    matrix = nmod_mat(len(rows), width, prime)
    for i, row in enumerate(rows):
        for j, value in enumerate(row):
            if value:
                matrix[i, j] = value
    return matrix


def rank(rows: Sequence[Sequence[Residue]], prime: int) -> int:
    """Rank of a matrix of residues."""
    if not rows or not rows[0]:
        return 0
    return int(residue_matrix(rows, len(rows[0]), prime).rank())


def annihilator(
    rows: Sequence[Sequence[Residue]], width: int, prime: int
) -> list[list[int]]:
    """Basis of the vectors x with row·x = 0 for every row."""
    return null_vectors(residue_matrix(rows, width, prime))


def null_vectors(matrix: Any) -> list[list[int]]:
    """The same of a matrix in FLINT's form."""
    kernel, nullity = matrix.nullspace()
    width = matrix.ncols()
    return [[int(kernel[i, j]) for i in range(width)] for j in range(int(nullity))]


def independent(rows: Sequence[Sequence[Residue]], prime: int) -> list[int]:
    """Numbers of the first rows that are independent."""
    if not rows or not rows[0]:
        return []
    return pivots(residue_matrix(rows, len(rows[0]), prime).transpose())


def pivots(matrix: Any) -> list[int]:
    """Numbers of the first columns that are independent, ascending."""
    return leading(*matrix.rref())


def leading(reduced: Any, rank: int) -> list[int]:
    """Where the rows of a matrix in reduced row echelon form begin."""
    chosen, start = [], 0
    for line in range(int(rank)):
        start = next(i for i in range(start, reduced.ncols()) if reduced[line, i])
        chosen.append(start)
        start += 1
    return chosen


def echelon(rows: Sequence[Sequence[Residue]], prime: int) -> list[list[int]]:
    """The reduced row echelon form without zero rows: the same for every basis."""
    if not rows or not rows[0]:
        return []
    return reduced_rows(residue_matrix(rows, len(rows[0]), prime))


def reduced_rows(matrix: Any) -> list[list[int]]:
    """The same of a matrix in FLINT's form."""
    reduced, rank = matrix.rref()
    width = matrix.ncols()
    return [[int(reduced[i, j]) for j in range(width)] for i in range(int(rank))]
