"""Proofs that a trigonometric polynomial does not split, all modulo one prime.

Written in half-angle tangents and made homogeneous, a polynomial that is linear in a
symbol, or whose restriction to one angle is irreducible of full degree, is a factor
free of that variable times an irreducible one; that factor is constant when
restrictions at two points, which differ in that variable alone, have no common root.
Only univariate polynomials over a prime field are met, and every step is a proof: what
is irreducible, or coprime, with its degree kept mod p, is so over the rationals.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from flint import nmod_poly

from screwkit.algebra.modular import LARGEST, random_prime
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

ATTEMPTS = 8
Variable = tuple[int, ...]  # (sine, cosine) of an angle or (symbol,): generator indices


@dataclass(frozen=True)
class Layout:
    """Which generators of a ring belong together.

    Attributes:
        angles: Positions of (sine, cosine) of each basis angle.
        symbols: Positions of the symbols.
        constants: Positions of the algebraic numbers.
        extensions: Positions of symbolic roots and inverses.
        prime: A modulus in which the algebraic numbers exist.
        constant_values: Their values there.
    """

    angles: tuple[tuple[int, int], ...]
    symbols: tuple[int, ...]
    constants: tuple[int, ...]
    extensions: tuple[int, ...]
    prime: int
    constant_values: tuple[int, ...]

    @classmethod
    def of(cls, ring: TrigonometricRing) -> Layout:
        """The layout of a ring."""
        first, count = len(ring.extensions), len(ring.basis)
        angles = tuple((first + i, first + count + i) for i in range(count))
        after = first + 2 * count
        start = after + len(ring.symbols)
        prime, values = _constants_modulo(ring)
        return cls(
            angles,
            tuple(range(after, start)),
            tuple(range(start, start + len(values))),
            tuple(range(first)),
            prime,
            values,
        )

    def variables(self, degrees: Sequence[int]) -> Iterator[Variable]:
        """The angles and symbols of a polynomial with these degrees."""
        for sine, cosine in self.angles:
            if degrees[sine] or degrees[cosine]:
                yield sine, cosine
        for symbol in self.symbols:
            if degrees[symbol]:
                yield (symbol,)


@dataclass(frozen=True)
class Shape:
    """What univariate restrictions say about the factors of a polynomial.

    Attributes:
        irreducible: Proved; False says nothing.
        settled: Proved, if the polynomial is irreducible when sines and cosines are
            taken for independent generators.
        free_of: Where a factor seems to be free of a variable: that variable.
        degrees: That factor's degree in tan(q/2), by angle; 0 where it is absent.
    """

    irreducible: bool
    settled: bool
    free_of: Variable = ()
    degrees: Mapping[Variable, int] = field(default_factory=dict)


_UNKNOWN = Shape(False, False)
_PROVED = Shape(True, True)


def is_irreducible(layout: Layout, polynomial: Polynomial) -> bool:
    """Whether a proof was found; see `shape`."""
    return shape(layout, polynomial).irreducible


def shape(layout: Layout, polynomial: Polynomial, seed: int = 1) -> Shape:
    """Try to prove that a polynomial does not split.

    A pair of half-angle factors that q → q + π exchanges counts as irreducible.

    Args:
        layout: Of the ring.
        polynomial: In normal form.
        seed: Of the random points.
    """
    degrees = tuple(int(degree) for degree in polynomial.degrees())
    variables = list(layout.variables(degrees))
    if not variables or any(degrees[i] for i in layout.extensions):
        return _UNKNOWN
    angles = [v for v in variables if len(v) == 2]
    if not angles and not layout.constants:
        return Shape(False, True)
    if len(variables) == 1 and len(polynomial) == 1 and polynomial.total_degree() == 1:
        return _PROVED  # sin q and cos q count as irreducible
    terms = _Terms(layout, polynomial, random.Random(seed))
    if not all(terms.keeps_degree(v) for v in variables):
        return _UNKNOWN
    linear = next((v for v in variables if len(v) == 1 and degrees[v[0]] == 1), None)
    if linear is not None:
        return terms.beside(linear, variables)
    for _ in range(ATTEMPTS):
        for angle in sorted(angles, key=terms.degree):
            if terms.turns_sign(angle) or terms.restriction_is_irreducible(angle):
                return terms.beside(angle, variables)
        terms.move()
    return _UNKNOWN


class _Terms:
    """The terms of a polynomial at a random point mod p."""

    def __init__(
        self, layout: Layout, polynomial: Polynomial, source: random.Random
    ) -> None:
        self._layout = layout
        self._source = source
        self._p = layout.prime
        self._exponents = polynomial.monoms()
        self._degrees = polynomial.degrees()
        self._coefficients = [
            int(c.p) * pow(int(c.q), -1, self._p) % self._p
            if c.q != 1
            else int(c.p) % self._p
            for c in polynomial.coeffs()
        ]
        self._angle_degree: dict[Variable, int] = {
            angle: int(max(e[angle[0]] + e[angle[1]] for e in self._exponents))
            for angle in layout.angles
            if self._degrees[angle[0]] or self._degrees[angle[1]]
        }
        self.move()

    def degree(self, angle: Variable) -> int:
        """The degree in sine and cosine of an angle together."""
        return self._angle_degree[angle]

    def move(self) -> None:
        """Take another random point."""
        self._values: dict[int, int] = {}
        for angle in self._angle_degree:
            self._values.update(self._drawn(angle))
        for symbol in self._layout.symbols:
            if self._degrees[symbol]:
                self._values.update(self._drawn((symbol,)))
        constants = self._layout.constant_values
        for position, value in zip(self._layout.constants, constants, strict=True):
            if self._degrees[position]:
                self._values[position] = value
        self._products: Sequence[int] = self._coefficients
        for position, value in self._values.items():
            self._products = self._times(self._products, {position: value})

    def keeps_degree(self, variable: Variable) -> bool:
        """Whether the restriction to a variable has the degree of the polynomial."""
        return self._full(self._restricted(variable, self._products), variable)

    def turns_sign(self, angle: Variable) -> bool:
        """Whether it is a·sin q + b·cos q, which splits, if at all, into a pair."""
        s, c = angle
        return self.degree(angle) == 1 and all(e[s] + e[c] for e in self._exponents)

    def restriction_is_irreducible(self, angle: Variable) -> bool:
        """Whether the restriction to an angle is irreducible and of full degree."""
        restricted = self._restricted(angle, self._products)
        if not self._full(restricted, angle):
            return False
        if self.degree(angle) == 1:
            c, b, a = (int(restricted[i]) for i in range(3))
            return pow(b * b - 4 * a * c, (self._p - 1) // 2, self._p) == self._p - 1
        _, factors = restricted.factor()
        return len(factors) == 1 and factors[0][1] == 1

    def beside(self, variable: Variable, others: Sequence[Variable]) -> Shape:
        """Whether a factor is free of ``variable`` and contains one of ``others``."""
        changed = self._drawn(variable)
        ratio = {
            position: value * pow(self._values[position], -1, self._p) % self._p
            for position, value in changed.items()
        }
        moved = self._times(self._products, ratio)
        shared = {}
        for other in others:
            if other != variable:
                first = self._restricted(other, self._products)
                second = self._restricted(other, moved)
                if not self._full(first, other):
                    return _UNKNOWN
                shared[other] = int(first.gcd(second).degree())
        # Over the rationals a factor without sines and cosines in common with its
        # cofactor would show with the generators taken for independent.
        irreducible = not any(shared.values())
        hidden = any(d for v, d in shared.items() if len(v) == 2)
        settled = irreducible or not (hidden or self._layout.constants)
        return Shape(irreducible, settled, variable, shared)

    def _full(self, restricted: Any, variable: Variable) -> bool:
        if len(variable) == 1:
            return bool(restricted.degree() == self._degrees[variable[0]])
        return bool(restricted.degree() == 2 * self.degree(variable))

    def _drawn(self, variable: Variable) -> dict[int, int]:
        p = self._p
        while True:
            t = self._source.randrange(2, p)
            if len(variable) == 1:
                return {variable[0]: t}
            below = (1 + t * t) % p
            if below and (1 - t * t) % p:
                shrink = pow(below, -1, p)
                return {
                    variable[0]: 2 * t * shrink % p,
                    variable[1]: (1 - t * t) * shrink % p,
                }

    def _times(self, products: Sequence[int], values: dict[int, int]) -> Sequence[int]:
        """Each term times the powers of ``values`` that it contains."""
        p = self._p
        for position, value in values.items():
            powers = [1]
            for _ in range(int(self._degrees[position])):
                powers.append(powers[-1] * value % p)
            products = [
                m * powers[e[position]] % p
                for m, e in zip(products, self._exponents, strict=True)
            ]
        return products

    def _restricted(self, variable: Variable, products: Sequence[int]) -> Any:
        """The polynomial in one variable, for an angle in tan(q/2) times powers."""
        p = self._p
        inverse = {i: pow(self._values[i], -1, p) for i in variable}
        slices: dict[tuple[int, ...], int] = {}
        if len(variable) == 1:
            (x,) = variable
            for m, e in zip(products, self._exponents, strict=True):
                slices[(e[x],)] = slices.get((e[x],), 0) + m
        else:
            s, c = variable
            for m, e in zip(products, self._exponents, strict=True):
                slices[e[s], e[c]] = slices.get((e[s], e[c]), 0) + m
        total = nmod_poly([0], p)
        for exponents, value in slices.items():
            coefficient = value % p
            for position, exponent in zip(variable, exponents, strict=True):
                coefficient = coefficient * pow(inverse[position], exponent, p) % p
            if len(variable) == 1:
                total += nmod_poly([0] * exponents[0] + [coefficient], p)
            else:
                degree = self.degree(variable)
                total += _in_tangent(degree, *exponents, p) * coefficient
        return total


@lru_cache(maxsize=4096)
def _in_tangent(degree: int, sine: int, cosine: int, p: int) -> Any:
    """s^sine c^cosine in t, times (1 + t²)^degree."""
    s, c, w = nmod_poly([0, 2], p), nmod_poly([1, 0, -1], p), nmod_poly([1, 0, 1], p)
    return s**sine * c**cosine * w ** (degree - sine - cosine)


def _constants_modulo(ring: TrigonometricRing) -> tuple[int, tuple[int, ...]]:
    """A prime and values of the algebraic numbers in it."""
    minimal = [m for _, m in ring.algebraic_relations() if isinstance(m, tuple)]
    if not minimal:
        return LARGEST, ()
    source = random.Random(1)
    while True:
        prime = random_prime(source)
        roots = [nmod_poly(list(m), prime).roots() for m in minimal]
        if all(roots):
            return prime, tuple(int(found[0][0]) for found in roots)
