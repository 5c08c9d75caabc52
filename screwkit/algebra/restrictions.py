"""Polynomials restricted to lines through a random point modulo a prime.

All restrictions of a polynomial are taken together: one half of the variables is
replaced by numbers, then the other half, and so on with what is left, which is short.
An angle becomes the tangent of its half, made homogeneous and turned, so that no
factor has its zero at infinity.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias
from weakref import WeakKeyDictionary

from flint import nmod_poly

from screwkit.algebra.modular import LARGEST, random_prime
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

SHORT = 30  # terms that are handled one by one
_BY_TERMS = 2_000  # terms by which a polynomial is taken apart one by one
Variable = tuple[int, ...]  # (sine, cosine) of an angle or (symbol,): generator indices
Restrictions: TypeAlias = dict[Variable, Any]  # univariate ones, flint.nmod_poly


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
        names: Of all generators.
    """

    angles: tuple[tuple[int, int], ...]
    symbols: tuple[int, ...]
    constants: tuple[int, ...]
    extensions: tuple[int, ...]
    prime: int
    constant_values: tuple[int, ...]
    names: tuple[str, ...]

    @classmethod
    def of(cls, ring: TrigonometricRing) -> Layout:
        """The layout of a ring, made once: a prime is sought for its numbers."""
        known = _LAYOUTS.get(ring)
        if known is None:
            known = _LAYOUTS[ring] = cls._made(ring)
        return known

    @classmethod
    def _made(cls, ring: TrigonometricRing) -> Layout:
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
            ring.names,
        )

    def variables(self, degrees: Sequence[int]) -> Iterator[Variable]:
        """The angles and symbols of a polynomial with these degrees."""
        for sine, cosine in self.angles:
            if degrees[sine] or degrees[cosine]:
                yield sine, cosine
        for symbol in self.symbols:
            if degrees[symbol]:
                yield (symbol,)

    def degrees(self, polynomial: Polynomial) -> dict[Variable, int]:
        """By variable that occurs; for an angle in sine and cosine together.

        Args:
            polynomial: In normal form, hence linear in every sine.
        """
        bounds = polynomial.degrees()
        found = {}
        for variable in self.variables(bounds):
            degree = int(bounds[variable[-1]])
            if len(variable) == 2 and bounds[variable[0]]:
                beside = polynomial.derivative(variable[0]).degrees()
                degree = max(degree, 1 + int(beside[variable[1]]))
            found[variable] = degree
        return found


class Probe:
    """A random point mod p, and restrictions of polynomials to lines through it."""

    def __init__(self, layout: Layout, seed: int) -> None:
        self._layout = layout
        self._source = random.Random(seed)
        self._halves: dict[int, int] = {}
        self._values: dict[int, int] = {}
        self._moved: dict[int, tuple[int, int, int]] = {}
        self._powers: dict[tuple[int, ...], Any] = {}
        self._tangents: dict[int, tuple[Any, Any, Any]] = {}
        for sine, cosine in layout.angles:
            t, self._values[sine], self._values[cosine] = self._on_circle()
            self._halves[sine] = t
            self._moved[sine] = self._on_circle()
            # The tangent is that of a turned angle, for which no factor has its zero
            # at infinity.
            _, s, c = self._on_circle()
            p = layout.prime
            self._tangents[sine] = (
                nmod_poly([s, 2 * c, -s], p),
                nmod_poly([c, -2 * s, -c], p),
                nmod_poly([1, 0, 1], p),
            )
        for symbol in layout.symbols:
            self._values[symbol] = self._source.randrange(2, layout.prime)
        pairs = zip(layout.constants, layout.constant_values, strict=True)
        self._fixed = dict(pairs)
        self._constants = {layout.names[i]: v for i, v in self._fixed.items()}

    def restrictions(self, polynomial: Polynomial) -> Restrictions | None:
        """By variable; None where one of them loses its degree.

        Args:
            polynomial: In normal form, without symbolic roots and inverses.
        """
        degrees = self._layout.degrees(polynomial)
        reduced = polynomial.subs(self._constants) if self._constants else polynomial
        found: Restrictions = {}
        self._descend(reduced, list(degrees), self._values, degrees, found)
        for variable, restricted in found.items():
            if restricted.degree() != degrees[variable] * len(variable):
                return None
        return found

    def _descend(
        self,
        polynomial: Polynomial,
        variables: Sequence[Variable],
        values: Mapping[int, int],
        degrees: Mapping[Variable, int],
        found: Restrictions,
    ) -> None:
        if len(variables) == 1:
            (variable,) = variables
            found[variable] = self._univariate(polynomial, variable, degrees[variable])
        elif variables and len(polynomial) <= SHORT:
            self._all_at_once(polynomial, variables, values, degrees, found)
        elif variables:
            middle = len(variables) // 2
            parts = variables[:middle], variables[middle:]
            for kept, dropped in (parts, parts[::-1]):
                part = polynomial.subs(self._named(values, dropped))
                self._descend(part, kept, values, degrees, found)

    def _all_at_once(
        self,
        polynomial: Polynomial,
        variables: Sequence[Variable],
        values: Mapping[int, int],
        degrees: Mapping[Variable, int],
        found: Restrictions,
    ) -> None:
        """The restrictions of a short polynomial, term by term."""
        p = self._layout.prime
        power: dict[tuple[Variable, tuple[int, ...]], int] = {}
        sums: list[dict[tuple[int, ...], int]] = [{} for _ in variables]
        for exponents, coefficient in polynomial.to_dict().items():
            product = _residue(coefficient, p)
            before, parts = [], []
            for variable in variables:
                key = variable, tuple([int(exponents[i]) for i in variable])
                if key not in power:
                    value = 1
                    for i, exponent in zip(*key, strict=True):
                        value = value * pow(values[i], exponent, p) % p
                    power[key] = value
                parts.append(key)
                before.append(product)
                product = product * power[key] % p
            after = 1
            for number in range(len(variables) - 1, -1, -1):
                key = parts[number]
                slices = sums[number]
                slices[key[1]] = slices.get(key[1], 0) + before[number] * after
                after = after * power[key] % p
        for variable, slices in zip(variables, sums, strict=True):
            found[variable] = self._summed(slices, variable, degrees[variable])

    def _named(
        self, values: Mapping[int, int], variables: Sequence[Variable]
    ) -> dict[str, int]:
        names = self._layout.names
        return {names[i]: values[i] for variable in variables for i in variable}

    def _univariate(
        self, polynomial: Polynomial, variable: Variable, degree: int
    ) -> Any:
        """In the symbol or the tangent, with the degree of the polynomial."""
        p = self._layout.prime
        slices = {
            tuple([int(exponents[i]) for i in variable]): _residue(coefficient, p)
            for exponents, coefficient in polynomial.to_dict().items()
        }
        return self._summed(slices, variable, degree)

    def _summed(
        self, slices: Mapping[tuple[int, ...], int], variable: Variable, degree: int
    ) -> Any:
        p = self._layout.prime
        if len(variable) == 1:
            coefficients = [0] * (1 + max((k for (k,) in slices), default=0))
            for (k,), value in slices.items():
                coefficients[k] = value % p
            return nmod_poly(coefficients, p)
        total = nmod_poly([0], p)
        for powers, value in slices.items():
            total += self._in_tangent(variable[0], degree, *powers) * (value % p)
        return total

    def _in_tangent(self, angle: int, degree: int, sine: int, cosine: int) -> Any:
        """s^sine c^cosine in t, times (1 + t²)^degree."""
        key = angle, degree, sine, cosine
        power = self._powers.get(key)
        if power is None:
            s, c, w = self._tangents[angle]
            power = s**sine * c**cosine * w ** (degree - sine - cosine)
            self._powers[key] = power
        return power

    def point(self, moved: bool) -> tuple[list[int], list[int]]:
        """Values of all generators, and tan(q/2) by angle.

        Args:
            moved: The point where all angles are moved.
        """
        values = self._values | self._fixed
        halves = self._halves
        if moved:
            for sine, cosine in self._layout.angles:
                _, values[sine], values[cosine] = self._moved[sine]
            halves = {sine: t for sine, (t, _, _) in self._moved.items()}
            values |= {i: values[i] + 1 for i in self._layout.symbols}
        tangents = [halves[sine] for sine, _ in self._layout.angles]
        return [values.get(i, 0) for i in range(len(self._layout.names))], tangents

    def _on_circle(self) -> tuple[int, int, int]:
        """(tan(q/2), sin q, cos q)."""
        p = self._layout.prime
        while True:
            t = self._source.randrange(2, p)
            below = (1 + t * t) % p
            if below and (1 - t * t) % p:
                shrink = pow(below, -1, p)
                return t, 2 * t * shrink % p, (1 - t * t) * shrink % p


def coefficients(
    polynomial: Polynomial, places: Sequence[int]
) -> dict[tuple[int, ...], Polynomial]:
    """The coefficients of a polynomial with respect to powers of some generators.

    Args:
        polynomial: Not zero.
        places: Positions of the generators.
    """
    context = polynomial.context()
    if len(polynomial) <= _BY_TERMS:
        found: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
        for exponents, coefficient in polynomial.to_dict().items():
            rest = list(exponents)
            for place in places:
                rest[place] = 0
            key = tuple(int(exponents[place]) for place in places)
            found.setdefault(key, {})[tuple(rest)] = coefficient
        return {key: context.from_dict(terms) for key, terms in found.items()}
    names = context.names()
    parts: dict[tuple[int, ...], Polynomial] = {(): polynomial}
    for place in places:
        generator = context.gen(place)
        slices = {}
        for key, part in parts.items():
            rest, power = part, 0
            while rest != 0:
                constant = rest.subs({names[place]: 0})
                if constant != 0:
                    slices[*key, power] = constant
                    rest -= constant
                rest, power = rest / generator, power + 1
        parts = slices
    return parts


_LAYOUTS: WeakKeyDictionary[TrigonometricRing, Layout] = WeakKeyDictionary()


def _residue(coefficient: Any, p: int) -> int:
    value = int(coefficient.p) % p
    below = int(coefficient.q)
    return value if below == 1 else value * pow(below, -1, p) % p


def _constants_modulo(ring: TrigonometricRing) -> tuple[int, tuple[int, ...]]:
    """A prime and values of the algebraic numbers in it."""
    minimal = [m for _, m in ring.algebraic_relations if isinstance(m, tuple)]
    if not minimal:
        return LARGEST, ()
    source = random.Random(1)
    while True:
        prime = random_prime(source)
        roots = [nmod_poly(list(m), prime).roots() for m in minimal]
        if all(roots):
            return prime, tuple(int(found[0][0]) for found in roots)


def divides(parts: Restrictions, whole: Restrictions) -> bool:
    """Whether every restriction divides."""
    for variable, restricted in parts.items():
        other = whole.get(variable)
        if other is None or other % restricted != 0:
            return False
    return True
