"""Proofs that a trigonometric polynomial does not split, all modulo one prime.

Written in half-angle tangents and made homogeneous, a polynomial that is linear in a
symbol, or whose restriction to one angle is irreducible of full degree, is a factor
free of that variable times an irreducible one; that factor is constant when
restrictions at two points, which differ in that variable alone, have no common root.
Only univariate polynomials over a prime field are met, and every step is a proof: what
is irreducible, or coprime, with its degree kept mod p, is so over the rationals.

All restrictions of a polynomial are taken together: one half of the variables is
replaced by numbers, then the other half, and so on with what is left, which is short.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from flint import nmod_poly

from screwkit.algebra.modular import LARGEST, random_prime
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

ATTEMPTS = 8
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


@dataclass(frozen=True)
class Shape:
    """What univariate restrictions say about the factors of a polynomial.

    Attributes:
        irreducible: Proved; False says nothing.
        settled: Proved, if the polynomial is irreducible when sines and cosines are
            taken for independent generators.
        free_of: Where a factor seems to be free of a variable: that variable.
        degrees: That factor's degree in tan(q/2), by angle, and by symbol; 0 where it
            is absent.
    """

    irreducible: bool
    settled: bool
    free_of: Variable = ()
    degrees: Mapping[Variable, int] = field(default_factory=dict)


_UNKNOWN = Shape(False, False)
_PROVED = Shape(True, True)


class Probe:
    """A random point mod p, and restrictions of polynomials to lines through it."""

    def __init__(self, layout: Layout, seed: int) -> None:
        self._layout = layout
        self._source = random.Random(seed)
        self._values: dict[int, int] = {}
        self._powers: dict[tuple[int, ...], Any] = {}
        self._tangents: dict[int, tuple[Any, Any, Any]] = {}
        for sine, cosine in layout.angles:
            self._values[sine], self._values[cosine] = self._on_circle()
            # The tangent is that of a turned angle, for which no factor has its zero
            # at infinity.
            s, c = self._on_circle()
            p = layout.prime
            self._tangents[sine] = (
                nmod_poly([s, 2 * c, -s], p),
                nmod_poly([c, -2 * s, -c], p),
                nmod_poly([1, 0, 1], p),
            )
        for symbol in layout.symbols:
            self._values[symbol] = self._source.randrange(2, layout.prime)
        values = zip(layout.constants, layout.constant_values, strict=True)
        self._constants = {layout.names[i]: value for i, value in values}

    def restrictions(
        self, polynomial: Polynomial, moved: Variable = ()
    ) -> Restrictions | None:
        """By variable; None where one of them loses its degree.

        Args:
            polynomial: In normal form, without symbolic roots and inverses.
            moved: Take another value of this variable, and no restriction to it.
        """
        values = dict(self._values)
        if len(moved) == 2:
            values[moved[0]], values[moved[1]] = self._on_circle()
        elif moved:
            values[moved[0]] = self._source.randrange(2, self._layout.prime)
        degrees = self._layout.degrees(polynomial)
        reduced = polynomial.subs(self._constants) if self._constants else polynomial
        wanted = [variable for variable in degrees if variable != moved]
        if moved:
            reduced = reduced.subs(self._named(values, [moved]))
        found: Restrictions = {}
        self._descend(reduced, wanted, values, degrees, found)
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
        elif variables:
            middle = len(variables) // 2
            parts = variables[:middle], variables[middle:]
            for kept, dropped in (parts, parts[::-1]):
                part = polynomial.subs(self._named(values, dropped))
                self._descend(part, kept, values, degrees, found)

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
        total = nmod_poly([0], p)
        for exponents, coefficient in polynomial.to_dict().items():
            value = int(coefficient.p) % p
            if coefficient.q != 1:
                value = value * pow(int(coefficient.q), -1, p) % p
            powers = [int(exponents[i]) for i in variable]
            if len(variable) == 1:
                total += nmod_poly([0] * powers[0] + [value], p)
            else:
                total += self._in_tangent(variable[0], degree, *powers) * value
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

    def _on_circle(self) -> tuple[int, int]:
        p = self._layout.prime
        while True:
            t = self._source.randrange(2, p)
            below = (1 + t * t) % p
            if below and (1 - t * t) % p:
                shrink = pow(below, -1, p)
                return 2 * t * shrink % p, (1 - t * t) * shrink % p


def is_irreducible(layout: Layout, polynomial: Polynomial) -> bool:
    """Whether a proof was found; see `shape`."""
    return shape(layout, polynomial).irreducible


def shape(
    layout: Layout,
    polynomial: Polynomial,
    seed: int = 1,
    probe: Probe | None = None,
    known: Restrictions | None = None,
) -> Shape:
    """Try to prove that a polynomial does not split.

    A pair of half-angle factors that q → q + π exchanges counts as irreducible.

    Args:
        layout: Of the ring.
        polynomial: In normal form.
        seed: Of the random points.
        probe: The first point.
        known: Restrictions at that point, up to numbers.
    """
    bounds = polynomial.degrees()
    variables = list(layout.variables(bounds))
    if not variables or any(bounds[i] for i in layout.extensions):
        return _UNKNOWN
    angles = [v for v in variables if len(v) == 2]
    if not angles and not layout.constants:
        return Shape(False, True)
    if len(variables) == 1 and len(polynomial) == 1 and polynomial.total_degree() == 1:
        return _PROVED  # sin q and cos q count as irreducible
    linear = next((v for v in variables if len(v) == 1 and bounds[v[0]] == 1), None)
    turning = [v for v in angles if _turns_sign(layout, polynomial, v)]
    for attempt in range(ATTEMPTS):
        if probe is None:
            probe, known = Probe(layout, seed + 1000 * attempt), None
        if known is None:
            known = probe.restrictions(polynomial)
        if known is not None:
            irreducible = (v for v in _ascending(known) if _is_irreducible(known[v]))
            chosen = linear or next(iter(turning), None) or next(irreducible, None)
            if chosen:
                return _beside(layout, polynomial, probe, chosen, known)
            if not any(_is_squarefree(known[v]) for v in angles):
                break
        probe = None
    return _UNKNOWN


def _ascending(known: Restrictions) -> list[Variable]:
    angles = [variable for variable in known if len(variable) == 2]
    return sorted(angles, key=lambda v: int(known[v].degree()))


def _is_irreducible(restricted: Any) -> bool:
    p = int(restricted.modulus())
    if restricted.degree() == 2:
        c, b, a = (int(restricted[i]) for i in range(3))
        return pow(b * b - 4 * a * c, (p - 1) // 2, p) == p - 1
    _, factors = restricted.factor()
    return len(factors) == 1 and factors[0][1] == 1


def _is_squarefree(restricted: Any) -> bool:
    return bool(restricted.gcd(restricted.derivative()).degree() == 0)


def _turns_sign(layout: Layout, polynomial: Polynomial, angle: Variable) -> bool:
    """Whether it is a·sin q + b·cos q, which splits, if at all, into a pair."""
    sine, cosine = (layout.names[i] for i in angle)
    bounds = polynomial.degrees()
    if bounds[angle[1]] > 1 or polynomial.subs({sine: 0, cosine: 0}) != 0:
        return False
    return not (
        bounds[angle[0]]
        and bounds[angle[1]]
        and polynomial.derivative(angle[0]).degrees()[angle[1]]
    )


def _beside(
    layout: Layout,
    polynomial: Polynomial,
    probe: Probe,
    variable: Variable,
    known: Restrictions,
) -> Shape:
    """Whether a factor is free of ``variable`` and contains another."""
    moved = probe.restrictions(polynomial, variable)
    if moved is None:
        return _UNKNOWN
    shared = {v: int(known[v].gcd(second).degree()) for v, second in moved.items()}
    # Over the rationals a factor without sines and cosines in common with its
    # cofactor would show with the generators taken for independent.
    irreducible = not any(shared.values())
    hidden = any(d for v, d in shared.items() if len(v) == 2)
    settled = irreducible or not (hidden or layout.constants)
    return Shape(irreducible, settled, variable, shared)


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
