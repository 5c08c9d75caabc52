"""Algebraic numbers that geometry contains: sqrt(3), cos(2π/5).

Square roots of rationals live in the field spanned by the roots of the primes that
occur; cosines of multiples of 15° lie in the same field.  Other rational angles need
x = 2 cos(π/n) and its minimal polynomial; a root that lies in that field already is
written in x by its Gauss sum, so that the generators stay independent.

References: [Washington1997], §2 (cyclotomic fields), §4 (Gauss sums).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, isqrt, lcm

from flint import fmpz, fmpz_poly

Combination = dict[tuple[int, ...], Fraction]


@dataclass(frozen=True)
class ConstantField:
    """A real field Q(√p, …, 2cos(π/n)) with independent generators.

    Attributes:
        primes: Primes whose square roots are generators ``r2``, ``r3`` …
        turn: n of the generator ``z`` = 2 cos(π/n); 0 where there is none.
    """

    primes: tuple[int, ...]
    turn: int

    @classmethod
    def needed_by(cls, radicands: Sequence[Fraction], turn: int) -> ConstantField:
        """The field that holds these square roots and the cosines of kπ/turn."""
        primes = {p for value in radicands for p in _odd_primes_of(value)}
        cyclotomic = 0
        if 12 % turn:
            cyclotomic = lcm(turn, 2)  # sines are cosines of the complement
            primes = {p for p in primes if (2 * cyclotomic) % _discriminant(p)}
        else:
            if turn % 4 == 0:
                primes.add(2)
            if turn % 3 == 0:
                primes.add(3)
        return cls(tuple(sorted(primes)), cyclotomic)

    @property
    def generators(self) -> tuple[str, ...]:
        """Names of the generators."""
        names = tuple(f"r{p}" for p in self.primes)
        return (*names, "z") if self.turn else names

    @property
    def texts(self) -> Mapping[str, str]:
        """What each generator is called in the expression grammar."""
        texts = {f"r{p}": f"sqrt({p})" for p in self.primes}
        if self.turn:
            texts["z"] = f"2*cos(pi/{self.turn})"
        return texts

    @property
    def minimal_polynomials(self) -> Mapping[str, tuple[int, ...]]:
        """Coefficients, constant term first, of each generator's polynomial."""
        polynomials: dict[str, tuple[int, ...]] = {
            f"r{p}": (-p, 0, 1) for p in self.primes
        }
        if self.turn:
            polynomials["z"] = _minimal_of_cosine(2 * self.turn)
        return polynomials

    def square_root(self, value: Fraction) -> Combination:
        """√value in the generators."""
        if value < 0:
            raise ValueError("square root of a negative number")
        outside, inside = _square_part(value.numerator * value.denominator)
        combination = {self._unit(): Fraction(outside, value.denominator)}
        for prime in _odd_primes_of(Fraction(inside)):
            combination = self._times(combination, self._prime_root(prime))
        return combination

    def cosine(self, half_turns: Fraction) -> Combination:
        """cos(half_turns·π) in the generators."""
        if self.turn and (self.turn * half_turns).denominator == 1:
            return self._chebyshev(int(self.turn * half_turns))
        angle = half_turns % 2
        if angle > 1:
            angle = 2 - angle
        sign = 1
        if angle > Fraction(1, 2):
            angle, sign = 1 - angle, -1
        if angle in _SIMPLE:
            terms = _SIMPLE[angle]
            total: Combination = {}
            for radicand, coefficient in terms.items():
                for key, value in self.square_root(Fraction(radicand)).items():
                    total[key] = (
                        total.get(key, Fraction(0)) + sign * coefficient * value
                    )
            return total
        raise KeyError(half_turns)

    def _unit(self) -> tuple[int, ...]:
        return (0,) * len(self.generators)

    def _prime_root(self, prime: int) -> Combination:
        if prime in self.primes:
            position = self.primes.index(prime)
            key = tuple(int(i == position) for i in range(len(self.generators)))
            return {key: Fraction(1)}
        # Gauss sum: √D = Σ (D/a) cos(2πa/D) for a fundamental discriminant D > 0.
        # Only for discriminants ≡ 0, 1 mod 4; 4p otherwise, whose root is 2√p.
        modulus = _discriminant(prime)
        total: Combination = {}
        for a in range(1, modulus):
            symbol = _kronecker(modulus, a)
            if symbol:
                steps = Fraction(2 * a * self.turn, modulus)
                for key, value in self._chebyshev(int(steps)).items():
                    total[key] = total.get(key, Fraction(0)) + symbol * value
        shrink = isqrt(modulus // prime)
        return {key: value / shrink for key, value in total.items() if value}

    def _chebyshev(self, count: int) -> Combination:
        """cos(count·π/turn) as a polynomial in z = 2cos(π/turn)."""
        previous, current = fmpz_poly([2]), fmpz_poly([0, 1])
        for _ in range(abs(count)):
            previous, current = current, fmpz_poly([0, 1]) * current - previous
        remainder = previous % fmpz_poly(list(_minimal_of_cosine(2 * self.turn)))
        unit = self._unit()
        return {
            (*unit[:-1], power): Fraction(int(coefficient), 2)
            for power, coefficient in enumerate(remainder.coeffs())
            if coefficient
        } or {unit: Fraction(0)}

    def _times(self, left: Combination, right: Combination) -> Combination:
        product: Combination = {}
        for a, x in left.items():
            for b, y in right.items():
                key = tuple(i + j for i, j in zip(a, b, strict=True))
                product[key] = product.get(key, Fraction(0)) + x * y
        return product


_HALF, _QUARTER = Fraction(1, 2), Fraction(1, 4)
_SIMPLE: Mapping[Fraction, Mapping[int, Fraction]] = {
    Fraction(0): {1: Fraction(1)},
    Fraction(1, 12): {6: _QUARTER, 2: _QUARTER},
    Fraction(1, 6): {3: _HALF},
    Fraction(1, 4): {2: _HALF},
    Fraction(1, 3): {1: _HALF},
    Fraction(5, 12): {6: _QUARTER, 2: -_QUARTER},
    Fraction(1, 2): {},
}


def _minimal_of_cosine(order: int) -> tuple[int, ...]:
    """Minimal polynomial of 2cos(2π/order), from FLINT."""
    return tuple(int(c) for c in fmpz_poly.cos_minpoly(order).coeffs())


def _square_part(value: int) -> tuple[int, int]:
    """(a, b) with a²·b = value and b square-free."""
    outside, inside = 1, 1
    for prime, exponent in fmpz(value).factor():
        outside *= int(prime) ** (exponent // 2)
        inside *= int(prime) ** (exponent % 2)
    return outside, inside


def _odd_primes_of(value: Fraction) -> list[int]:
    """Primes that occur to an odd power."""
    if value <= 0:
        return []
    product = fmpz(value.numerator * value.denominator)
    return [int(p) for p, exponent in product.factor() if exponent % 2]


def _discriminant(prime: int) -> int:
    return prime if prime % 4 == 1 else 4 * prime


def _kronecker(upper: int, lower: int) -> int:
    if gcd(upper, lower) > 1:
        return 0
    if lower % 2 == 0:
        half = 1 if upper % 8 in (1, 7) else -1
        return half * _kronecker(upper, lower // 2)
    return _jacobi(upper % lower, lower) if lower > 1 else 1


def _jacobi(a: int, n: int) -> int:
    result = 1
    a %= n
    while a:
        while a % 2 == 0:
            a //= 2
            if n % 8 in (3, 5):
                result = -result
        a, n = n, a
        if a % 4 == 3 and n % 4 == 3:
            result = -result
        a %= n
    return result if n == 1 else 0
