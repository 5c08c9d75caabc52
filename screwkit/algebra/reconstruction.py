"""From residues modulo two primes back to the exact number.

A number of the geometry's constant field is a short integer combination of a few known
irrationalities over a short denominator.  Modulo both primes at once such combinations
form a lattice; its shortest vector, if it is far shorter than chance allows, is the
number.  Where no such vector exists the answer is None, never the nearest guess.

References: [LenstraLenstraLovasz1982], [WangGuyDavenport1982].
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations, product
from math import gcd, isqrt, lcm, prod

from flint import fmpz_mat, nmod_poly

from screwkit.algebra.algebraic_numbers import AlgebraicNumber, Irrationality
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.modular import ModularRing, ResampleError
from screwkit.algebra.short_fractions import short_fraction
from screwkit.algebra.short_numbers import TRIED, VanishingCombinations

LARGEST = 12  # degrees beyond which two primes tell no number from chance
CHANCE = 2**48  # a random residue passes for a number once in this many
SMALL = 2**30  # integers that two residues tell at a glance


@dataclass(frozen=True)
class Reconstruction:
    """The way back from two rings of residues with the same constants.

    Attributes:
        field: The constants.
        primes: Two different ones.
        generators: The residue of each generator of ``field`` modulo each prime, by its
            name.  One that is missing was not used.
    """

    field: ConstantField
    primes: tuple[int, int]
    generators: tuple[Mapping[str, int], Mapping[str, int]]

    @classmethod
    def between(cls, first: ModularRing, second: ModularRing) -> Reconstruction:
        """Back from these rings, which share the field of their constants.

        Raises:
            ValueError: If their fields differ or their primes do not.
        """
        if first.constants != second.constants or first.prime == second.prime:
            raise ValueError(
                "two rings of one constant field and two primes are needed"
            )
        return cls(
            first.constants,
            (first.prime, second.prime),
            (_generators(first), _generators(second)),
        )

    def number(self, first: int, second: int) -> AlgebraicNumber | None:
        """The number with these residues; None if no short one has them.

        A residue drawn at random is taken for a number with probability 1/`CHANCE` for
        each of the few subfields that are tried, small ones first.
        """
        pair = int(first), int(second)
        if pair not in self._known:
            self._known[pair] = self._found(*pair)
        return self._known[pair]

    @cached_property
    def _known(self) -> dict[tuple[int, int], AlgebraicNumber | None]:
        """What was asked before; the same entries come again and again."""
        return {}

    def _found(self, first: int, second: int) -> AlgebraicNumber | None:
        p, q = self.primes
        one, other = (first + p // 2) % p - p // 2, (second + q // 2) % q - q // 2
        if one == other and abs(one) < SMALL:
            unit = self._units[0][0]
            return AlgebraicNumber(((unit, Fraction(one)),) if one else ())
        residue = self._both(first, second)
        for units, vanishing in self._vanishing:
            for below in self._denominators:
                above = vanishing.over(below, residue)
                if above is not None:
                    terms = zip(units, above, strict=True)
                    return AlgebraicNumber(
                        tuple(
                            (self._units[i][0], Fraction(c, below))
                            for i, c in terms
                            if c
                        )
                    )
        for units in self._subfields:
            found = self._short(residue, units)
            if found is not None:
                below = lcm(*(c.denominator for _, c in found.terms))
                self._denominators[:] = [below, *self._denominators[: TRIED - 1]]
                return found
        return None

    @cached_property
    def _denominators(self) -> list[int]:
        """Those met last: the entries of a vector share theirs as a rule."""
        return [1]

    @cached_property
    def _vanishing(self) -> tuple[tuple[tuple[int, ...], VanishingCombinations], ...]:
        """What vanishes in each of the subfields."""
        return tuple(
            (
                units,
                VanishingCombinations.of(
                    [self._units[i][1] for i in units], self._modulus, CHANCE
                ),
            )
            for units in self._subfields
        )

    def numbers(
        self, first: Sequence[int], second: Sequence[int]
    ) -> tuple[AlgebraicNumber, ...] | None:
        """All of these numbers, or None."""
        found = []
        for pair in zip(first, second, strict=True):
            number = self.number(*pair)
            if number is None:
                return None
            found.append(number)
        return tuple(found)

    def direction(
        self, first: Sequence[int], second: Sequence[int]
    ) -> tuple[AlgebraicNumber, ...] | None:
        """A vector that is known up to a factor, different modulo each prime.

        Coefficients come out integral and without common factor, the first entry that
        is not zero positive, divided by the entry that makes the texts shortest.
        """
        p, q = self.primes
        found: list[tuple[AlgebraicNumber, ...]] = []
        for a, b in zip(first, second, strict=True):
            if a % p and b % q:
                inverses = pow(int(a), -1, p), pow(int(b), -1, q)
                vector = self.numbers(
                    [int(x) * inverses[0] % p for x in first],
                    [int(x) * inverses[1] % q for x in second],
                )
                if vector is not None:
                    found.append(_primitive(vector))
                    if all(number.is_rational for number in vector):
                        return found[0]  # so are all others, and they are the same
        return min(found, key=_length, default=None)

    def roots(
        self, first: Sequence[int], second: Sequence[int]
    ) -> tuple[tuple[int, int, AlgebraicNumber], ...]:
        """The roots in the field of a polynomial, with their residues, ascending.

        Args:
            first: Its coefficients modulo the first prime, constant term first.
            second: The same modulo the second prime.
        """
        p, q = self.primes
        choices = product(
            nmod_poly([int(c) for c in first], p).roots(),
            nmod_poly([int(c) for c in second], q).roots(),
        )
        found = []
        for (a, _), (b, _) in choices:
            number = self.number(int(a), int(b))
            if number is not None:
                found.append((int(a), int(b), number))
        return tuple(sorted(found, key=lambda root: float(root[2])))

    def _rational(self, residue: int) -> AlgebraicNumber | None:
        """The same among rationals."""
        value = short_fraction(residue, self._modulus, self._height)
        if value is None:
            return None
        return AlgebraicNumber(((self._units[0][0], value),) if value else ())

    @cached_property
    def _height(self) -> int:
        """Numerators and denominators up to this are no chance."""
        return (isqrt(self._modulus // CHANCE) - 1) // 2

    @cached_property
    def _units(self) -> tuple[tuple[Irrationality, int], ...]:
        """A basis of the field over Q, 1 first, with residues modulo both primes."""
        known = self.generators[0].keys() & self.generators[1].keys()
        primes = [r for r in self.field.primes if f"r{r}" in known]
        steps, powers = [Fraction(0)], [1]
        if "z" in known:
            degree = len(self.field.minimal_polynomials["z"]) - 1
            steps = [Fraction(k, self.field.turn) for k in range(degree)]
            # V_k = z V_(k-1) - V_(k-2) is 2cos(kπ/n), and 2 for k = 0
            z, last = self._generator("z"), 2
            powers.append(z)
            for _ in range(2, degree):
                powers.append((z * powers[-1] - last) % self._modulus)
                last = powers[-2]
        units = []
        for count in range(len(primes) + 1):
            for chosen in combinations(primes, count):
                root = prod(self._generator(f"r{r}") for r in chosen)
                for step, residue in zip(steps, powers, strict=False):
                    unit = Irrationality(prod(chosen), step)
                    units.append((unit, root * residue % self._modulus))
        return tuple(units)

    @cached_property
    def _subfields(self) -> tuple[tuple[int, ...], ...]:
        """Parts of the basis: 1, pairs with 1, biquadratic, cyclotomic fields, all."""
        place = {unit: i for i, (unit, _) in enumerate(self._units)}
        chosen: list[tuple[int, ...]] = [(0,)]
        chosen += [
            (0, i)
            for unit, i in place.items()
            if i and (len(place) <= LARGEST or not unit.turn)
        ]
        roots = [unit.radicand for unit in place if not unit.turn and unit.radicand > 1]
        for a, b in combinations(roots, 2):
            third = a * b // gcd(a, b) ** 2
            if third > b:
                chosen.append((0, *(place[Irrationality(r)] for r in (a, b, third))))
        chosen.append(tuple(i for unit, i in place.items() if unit.radicand == 1))
        chosen.append(tuple(range(len(place))))
        return tuple(x for x in dict.fromkeys(chosen) if len(x) <= LARGEST)

    @property
    def _modulus(self) -> int:
        return self.primes[0] * self.primes[1]

    def _generator(self, name: str) -> int:
        return self._both(self.generators[0][name], self.generators[1][name])

    def _both(self, first: int, second: int) -> int:
        """The residue modulo the product of the primes."""
        p, q = self.primes
        return first % p + p * ((second - first % p) * self._inverse % q)

    @cached_property
    def _inverse(self) -> int:
        """Of the first prime modulo the second."""
        p, q = self.primes
        return pow(p, -1, q)

    def _short(self, both: int, units: Sequence[int]) -> AlgebraicNumber | None:
        """The number x by the shortest (d, c) with d·x = Σ c·unit modulo both."""
        if len(units) == 1:
            return self._rational(both)
        residues = [both]
        residues += [-self._units[i][1] for i in units[1:]]
        size = len(residues) + 1
        rows = [[int(i == j) for j in range(size)] for i in range(size)]
        for row, residue in zip(rows, residues, strict=False):
            row[-1] = residue % self._modulus
        rows[-1][-1] = self._modulus
        reduced = fmpz_mat(rows).lll()
        below, *rest, constant = (int(reduced[0, j]) for j in range(size))
        height = max(abs(below), abs(constant), *(abs(c) for c in rest), 1)
        if not below or (2 * height + 1) ** size * CHANCE > self._modulus:
            return None
        terms = zip(units, (constant, *rest), strict=True)
        return AlgebraicNumber(
            tuple((self._units[i][0], Fraction(c, below)) for i, c in terms if c)
        )


def _generators(ring: ModularRing) -> Mapping[str, int]:
    return dict(_existing(ring))


def _existing(ring: ModularRing) -> Iterator[tuple[str, int]]:
    """A generator without a root modulo this prime cannot have been used."""
    for name in ring.constants.generators:
        try:
            yield name, int(ring.generator(name))
        except ResampleError:
            continue


def _primitive(vector: tuple[AlgebraicNumber, ...]) -> tuple[AlgebraicNumber, ...]:
    """Integral, without common factor, the first entry that is not zero positive."""
    coefficients = [
        coefficient * (2 if unit.turn else 1)
        for number in vector
        for unit, coefficient in number.terms
    ]
    factor = Fraction(
        lcm(*(c.denominator for c in coefficients)),
        gcd(*(c.numerator for c in coefficients)),
    )
    factor *= next(number.sign for number in vector if number.terms)
    return tuple(number.scaled(factor) for number in vector)


def _length(vector: Sequence[AlgebraicNumber]) -> tuple[int, int]:
    texts = [number.text for number in vector]
    return sum("(" in text for text in texts), sum(map(len, texts))
