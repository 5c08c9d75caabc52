"""Whether a condition leaves one part alone where angles are fixed up to half a turn.

On conditions P·sin φ + Q·cos φ = 0, each with an angle of its own, every polynomial is
a sum of products of the roots w of P² + Q² (`fixed_directions`).  It is irreducible
where no product of some P² + Q² is a square.  A condition A + l·B with l nowhere else
leaves one part of it, unless A and B vanish together on something as large; then their
norms, products over all signs of the roots, have a common factor.  Norms are taken
along a random line modulo a prime, as ranks are: a factor that is there is there along
the line.  So are squares where there are irrational numbers: what is none modulo a
prime is none.  A condition whose norm is irreducible leaves one part as well.

References: [CoxLittleOShea] §3.6 (resultants and common factors), [Schwartz1980].
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import prod
from typing import Any

from flint import fmpq, fmpq_poly, nmod_poly
from flint.utils.flint_exceptions import DomainError

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_degrees import factor_degrees, sums_of
from screwkit.algebra.fixed_directions import Direction, over_roots
from screwkit.algebra.modular import random_prime
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

_Element = dict[int, Any]  # by which roots are factors, as bits
_SMALL, _WIDE = 10_000, 2**60  # coefficients of rational lines, and modulo a prime
_PRIMES = 12  # modulo which a norm is looked at


def leaves_one_part(
    branch: Branch, condition: Polynomial, directions: Sequence[Direction]
) -> bool:
    """Whether a condition is shown to leave one part, where no direction is (0, 0).

    Args:
        branch: Where exactly these directions are pending.
        condition: In normal form.
        directions: All that are pending, each with an angle of its own; they leave one
            part.
    """
    ring = branch.ring
    if ring.radicands or ring.divisors_of:
        return False
    fixed = [d.pending.value.degrees() for d in directions]
    degrees = condition.degrees()
    return any(
        degrees[index] == 1
        and not any(own[index] for own in fixed)
        and _are_coprime(ring, linear_parts(ring, condition, index), directions)
        for index in ring.symbol_indices()
    )


def one_norm_beside(
    branch: Branch, condition: Polynomial, directions: Sequence[Direction]
) -> list[Polynomial] | None:
    """Where a condition may leave more than the one part that it is shown to leave.

    Its norm, but for what the w² are, is a product of coordinates, or of coefficients
    of the directions, and of one irreducible factor, along a rational line: of all
    parts of its zeros each meets a factor, and one alone that which it has once.

    Args:
        branch: Where exactly these directions are pending.
        condition: In normal form.
        directions: All that are pending, each with an angle of its own; they leave one
            part.

    Returns:
        Those coordinates and coefficients; None where no irreducible factor was shown.
    """
    ring = branch.ring
    if ring.radicands or ring.divisors_of:
        return None
    written = over_roots(ring, condition, directions)
    if not written:
        return None
    tried = _short_factors(ring, directions)
    source = random.Random(len(condition))
    size, beside, possible = None, list[Polynomial](), set[int]()
    for _ in range(_PRIMES):
        line = _Line.random(ring, random.Random(11), _Numbers.random(ring, source))
        roots = [_Root.of(ring, direction, line) for direction in directions]
        left = _norm(_element(written, roots, line), roots)
        if left == 0:
            return None
        left = _without(left, [*(root.square for root in roots), *line.denominators])
        for own in tried if size is None else beside:
            rest = _without(left, [line.value(own, line.degrees([own]))])
            if rest.degree() < left.degree() and size is None:
                beside.append(own)
            left = rest
        degrees = factor_degrees(left)
        if degrees is None or size not in (None, left.degree()):
            return None
        possible = sums_of(degrees) if size is None else possible & sums_of(degrees)
        size = left.degree()
        if size and possible == {0, size}:
            return beside
    return None


def _short_factors(
    ring: TrigonometricRing, directions: Sequence[Direction]
) -> list[Polynomial]:
    """Coordinates and coefficients of directions, each once."""
    found = [ring.context.gen(index) for index in ring.symbol_indices()]
    found += [p for d in directions for p in (d.across, d.along)]
    return [*{str(p): p for p in found if p != 0 and not p.is_constant()}.values()]


def are_one_part(branch: Branch, directions: Sequence[Direction]) -> bool:
    """Whether the conditions of directions are shown to leave one part together.

    Parts that differ by the sign of √2 are one: what numbers describe holds on both.

    Args:
        branch: Where exactly these directions are pending.
        directions: Each with an angle of its own.
    """
    ring = branch.ring
    if ring.radicands or ring.divisors_of:
        return False
    source = random.Random(len(directions))
    numbers = _Numbers.random(ring, source) if ring.algebraic_relations else None
    line = _Line.random(ring, source, numbers)
    squares = [_Root.of(ring, d, line).square for d in directions]
    return not any(
        _is_square(prod(chosen[1:], start=chosen[0]))
        for count in range(1, len(squares) + 1)
        for chosen in combinations(squares, count)
    )


@dataclass(frozen=True)
class _Numbers:
    """A prime, and the irrational numbers of a ring as residues, by generator."""

    prime: int
    residues: Mapping[int, int]

    @classmethod
    def random(cls, ring: TrigonometricRing, source: random.Random) -> _Numbers:
        minimal = [(i, m) for i, m in ring.algebraic_relations if isinstance(m, tuple)]
        while True:
            prime = random_prime(source)
            roots = [(i, nmod_poly(list(m), prime).roots()) for i, m in minimal]
            if all(own for _, own in roots):
                return cls(prime, {i: int(own[0][0]) for i, own in roots})


def _is_square(polynomial: Any) -> bool:
    try:
        polynomial.sqrt()
    except (DomainError, ValueError):  # the latter where a denominator is no square
        return False
    return True


def _are_coprime(
    ring: TrigonometricRing,
    pair: tuple[Polynomial, Polynomial],
    directions: Sequence[Direction],
) -> bool:
    if any(polynomial == 0 for polynomial in pair):
        return False
    written = [over_roots(ring, polynomial, directions) for polynomial in pair]
    source = random.Random(len(directions))
    line = _Line.random(ring, source, _Numbers.random(ring, source))
    roots = [_Root.of(ring, direction, line) for direction in directions]
    norms = []
    for parts in written:
        if parts is None:
            return False
        norm = _norm(_element(parts, roots, line), roots)
        if norm == 0:
            return False
        norms.append(norm)
    known = [*(root.square for root in roots), *line.denominators]
    return bool(_without(norms[0].gcd(norms[1]), known).degree() == 0)


def _without(polynomial: Any, known: Sequence[Any]) -> Any:
    """A polynomial without the factors that it shares with known ones."""
    for own in known:
        factor = polynomial.gcd(own)
        while factor.degree() > 0:
            polynomial //= factor
            factor = polynomial.gcd(factor)
    return polynomial


@dataclass(frozen=True)
class _Line:
    """All unknowns along a line; angles by the tangents of their halves.

    Attributes:
        images: Of the generators; those of angles are times their denominators.
        denominators: By angle, 1 + t².
        places: The angle of a generator.
        prime: The modulus; none for rational numbers.
    """

    images: tuple[Any, ...]
    denominators: tuple[Any, ...]
    places: Mapping[int, int]
    prime: int | None

    @classmethod
    def random(
        cls, ring: TrigonometricRing, source: random.Random, numbers: _Numbers | None
    ) -> _Line:
        prime, most = (numbers.prime, _WIDE) if numbers else (None, _SMALL)

        def along() -> Any:
            return _poly([source.randrange(1, most) for _ in range(2)], prime)

        images = [along() for _ in ring.names]
        for index, number in (numbers.residues if numbers else {}).items():
            images[index] = _poly([number], prime)
        denominators, places = [], {}
        for angle in range(len(ring.basis)):
            tangent = along()
            denominators.append(1 + tangent * tangent)
            images[ring.cosine_index(angle)] = 1 - tangent * tangent
            images[ring.sine_index(angle)] = 2 * tangent
            places[ring.cosine_index(angle)] = places[ring.sine_index(angle)] = angle
        return cls(tuple(images), tuple(denominators), places, prime)

    def degrees(self, polynomials: Sequence[Polynomial]) -> list[int]:
        """By angle, in its sine and cosine together."""
        most = [0] * len(self.denominators)
        for polynomial in polynomials:
            for powers in polynomial.monoms():
                own = [0] * len(most)
                for generator, angle in self.places.items():
                    own[angle] += int(powers[generator])
                most = [max(pair) for pair in zip(most, own, strict=True)]
        return most

    def value(self, polynomial: Polynomial, degrees: Sequence[int]) -> Any:
        """The polynomial times the denominators to these degrees."""
        total = _poly([0], self.prime)
        for powers, number in polynomial.to_dict().items():
            term = _poly([number], self.prime)
            left = list(degrees)
            for generator, power in enumerate(powers):
                if power:
                    term *= self.images[generator] ** int(power)
                    if generator in self.places:
                        left[self.places[generator]] -= int(power)
            for denominator, power in zip(self.denominators, left, strict=True):
                term *= denominator**power
            total += term
        return total


def _poly(coefficients: Sequence[Any], prime: int | None) -> Any:
    """In one unknown, of integers or rational numbers."""
    if prime is None:
        return fmpq_poly(list(coefficients))
    numbers = [fmpq(c) for c in coefficients]
    return nmod_poly(
        [int(c.p) * pow(int(c.q), -1, prime) % prime for c in numbers], prime
    )


@dataclass(frozen=True)
class _Root:
    """A root w times some denominators along a line: its square, and these."""

    square: Any
    scale: Any

    @classmethod
    def of(cls, ring: TrigonometricRing, direction: Direction, line: _Line) -> _Root:
        square = direction.square(ring)
        degrees = [d + d % 2 for d in line.degrees([square])]
        scale = _poly([1], line.prime)
        for denominator, degree in zip(line.denominators, degrees, strict=True):
            scale *= denominator ** (degree // 2)
        return cls(line.value(square, degrees), scale)


def _element(
    parts: Mapping[tuple[int, ...], Polynomial], roots: Sequence[_Root], line: _Line
) -> _Element:
    """The sum of parts over their roots, times all roots and some denominators."""
    degrees = line.degrees([*parts.values()])
    found: _Element = {}
    for key, value in parts.items():
        term = line.value(value, degrees)
        bits = 0
        for k, odd in enumerate(key):
            if odd:
                term *= roots[k].scale
            else:
                bits |= 1 << k
        found[bits] = term
    return found


def _norm(element: _Element, roots: Sequence[_Root]) -> Any:
    """The product over all signs of the roots."""
    for k, root in enumerate(roots):
        bit = 1 << k
        plain = {bits: value for bits, value in element.items() if not bits & bit}
        odd = {bits ^ bit: value for bits, value in element.items() if bits & bit}
        element = _product(plain, plain, roots)
        for bits, value in _product(odd, odd, roots).items():
            element[bits] = element.get(bits, 0) - value * root.square
    return element.get(0, 0)


def _product(one: _Element, two: _Element, roots: Sequence[_Root]) -> _Element:
    found: _Element = {}
    for first, value in one.items():
        for second, other in two.items():
            term = value * other
            for k, root in enumerate(roots):
                if first & second & 1 << k:
                    term *= root.square
            found[first ^ second] = found.get(first ^ second, 0) + term
    return found
