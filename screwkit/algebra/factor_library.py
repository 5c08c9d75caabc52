"""What has been factored in one ring: irreducible factors, found once and divided out.

Mechanisms have few factors, which occur again and again.  A polynomial that is not
divided by known factors is split as it stands; every piece is proved irreducible
(`irreducible`) or rewritten in half angles, where factors are unique (`half_angle`).
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from flint import fmpq

from screwkit.algebra.half_angle import Form, HalfAngles
from screwkit.algebra.irreducible import Layout, Shape, is_irreducible, shape
from screwkit.algebra.points import random_point, residue
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
    primitive,
)

LARGEST_NORM = 400  # terms; see `_Divisor`


@dataclass(frozen=True)
class Factor:
    """An irreducible factor; equal when it is the same locus with the same proof.

    Attributes:
        key: Canonical identity within a ring.
        equations: The factor vanishes where all of them do: one primitive polynomial
            in normal form, or two where only a half-angle form shows the factor.
        certified: Whether irreducibility is proved.
        form: The half-angle form where there are two equations.
    """

    key: str
    equations: tuple[Polynomial, ...] = field(compare=False)
    certified: bool = field(default=True, compare=False)
    form: Form | None = field(default=None, compare=False, repr=False)

    @property
    def polynomial(self) -> Polynomial:
        """The single equation.

        Raises:
            ValueError: If a half-angle factor has two.
        """
        if self.form is not None:
            raise ValueError(
                "a half-angle factor is no polynomial in sines and cosines"
            )
        return self.equations[0]


class FactorLibrary:
    """What has been factored in one ring, and the tools to factor more.

    Attributes:
        ring: All polynomials belong to it.
        factors: The irreducible factors met so far, by key.
    """

    def __init__(self, ring: TrigonometricRing) -> None:
        self.ring = ring
        self.factors: dict[str, Factor] = {}
        self._layout = Layout.of(ring)
        self._halves = HalfAngles(ring, self._layout)
        self._pieces: dict[str, list[tuple[Factor, int]]] = {}
        self._values: dict[str, tuple[int, int]] = {}
        if not ring.has_extensions:
            self._point = _Point(ring, self._layout, self._halves)
        self._divisors: dict[str, _Divisor] = {}
        for sine, cosine in zip(ring.sines, ring.cosines, strict=True):
            self.irreducible(sine)
            self.irreducible(cosine)

    def irreducible(self, polynomial: Polynomial, certified: bool = True) -> Factor:
        """The factor of a polynomial known not to split."""
        key = str(polynomial)
        factor = self.factors.get(key)
        if factor is None:
            factor = Factor(key, (polynomial,), certified)
            self._keep(factor)
        return factor

    def split(self, polynomial: Polynomial) -> list[tuple[Factor, int]]:
        """The factors of a primitive polynomial in normal form, without constants."""
        key = str(polynomial)
        if key in self.factors:
            return [(self.factors[key], 1)]
        if key not in self._pieces:
            self._pieces[key] = self._split(polynomial)
        return self._pieces[key]

    def paired(self, factors: Sequence[tuple[Factor, int]]) -> list[tuple[Factor, int]]:
        """Half-angle factors of different pieces that make up whole ones."""
        odd = [(part.form, m) for part, m in factors if part.form is not None]
        if len(odd) < 2:
            return list(factors)
        whole = [(part, m) for part, m in factors if part.form is None]
        paired = self._halves.paired(odd)
        return collected([*whole, *((self._final(form), m) for form, m in paired)])

    def value(self, polynomial: Polynomial) -> int:
        """The value of a primitive polynomial at the library's rational point."""
        return self._point.value(polynomial)

    def factor_value(self, factor: Factor) -> tuple[int, int]:
        """Of a factor: `value` and residue at the library's modular point."""
        return self._values[factor.key]

    def residue(self, polynomial: Polynomial) -> int:
        """The value of a polynomial at the library's modular point."""
        return self._point.residue(polynomial)

    def divided(
        self, polynomial: Polynomial, value: int
    ) -> tuple[list[tuple[Factor, int]], Polynomial]:
        """Known factors of a polynomial, and what is left of it.

        A factor must divide in value at a random integer point; the division itself is
        exact, by the norm of the factor, so nothing rests on the point.
        """
        found = []
        for key, divisor in list(self._divisors.items()):
            known = self._values[key][0]
            multiplicity = 0
            while value % known == 0:
                quotient = divisor.divide(polynomial, self.ring)
                if quotient is None:
                    break
                polynomial, value = primitive(quotient), value // known
                multiplicity += 1
            if multiplicity:
                found.append((self.factors[key], multiplicity))
                if polynomial.is_constant():
                    break
        return found, polynomial

    def _split(self, polynomial: Polynomial) -> list[tuple[Factor, int]]:
        found = shape(self._layout, polynomial)
        if found.irreducible:
            return [(self.irreducible(polynomial), 1)]
        pieces = polynomial.factor()[1]
        if len(pieces) > 1 or pieces[0][1] > 1:
            return collected(
                (factor, n * int(m))
                for piece, m in pieces
                for factor, n in self.split(primitive(piece))
            )
        if found.settled:
            return [(self.irreducible(polynomial), 1)]
        parts = self._parted(polynomial, found) or self._halved_once(polynomial)
        if parts is not None:
            return collected(
                (factor, n * m)
                for form, m in parts
                for factor, n in self.split(self._halves.whole(form))
            )
        degrees = self._halves.degrees(polynomial)
        return [(self._final(form), m) for form, m in self._halved(polynomial, degrees)]

    def _parted(
        self, polynomial: Polynomial, found: Shape
    ) -> list[tuple[Form, int]] | None:
        """A factor that is free of some variable, and its cofactor."""
        if not any(found.degrees.values()) or self._layout.constants:
            return None
        wanted, absent = {}, list(found.free_of)
        for i, angle in enumerate(self._layout.angles):
            if angle in found.degrees:
                wanted[i] = found.degrees[angle]
                if not wanted[i]:
                    absent += angle
        if any(degree % 2 for degree in wanted.values()):
            return None
        return self._halves.parted(polynomial, wanted, absent)

    def _halved_once(self, polynomial: Polynomial) -> list[tuple[Form, int]] | None:
        """Factors that show when one angle is halved and others are left."""
        degrees = self._halves.degrees(polynomial)
        if len(degrees) == 1:
            return None
        for angle, degree in degrees.items():
            if degree > 1:
                parts = self._halved(polynomial, (angle,))
                if len(parts) > 1 or parts[0][1] > 1:
                    return None if any(form.odd for form, _ in parts) else parts
        return None

    def _halved(
        self, polynomial: Polynomial, angles: Iterable[int]
    ) -> list[tuple[Form, int]]:
        halves = self._halves
        return halves.paired(halves.factor(halves.form(polynomial, angles)))

    def _final(self, form: Form) -> Factor:
        """The factor of a form that cannot be split further."""
        equations = self._halves.equations(form)
        if len(equations) == 1:
            certified = not self.ring.has_extensions or is_irreducible(
                self._layout, equations[0]
            )
            return self.irreducible(equations[0], certified)
        key = "; ".join(map(str, equations))
        factor = self.factors.get(key)
        if factor is None:
            factor = Factor(key, equations, not self.ring.has_extensions, form)
            self._keep(factor)
        return factor

    def _keep(self, factor: Factor) -> None:
        self.factors[factor.key] = factor
        if self.ring.has_extensions:
            return
        if factor.form is not None:
            self._values[factor.key] = self._point.form_values(factor.form)
            return
        polynomial = factor.polynomial
        self._values[factor.key] = (self.value(polynomial), self.residue(polynomial))
        self._divisors[factor.key] = _Divisor(polynomial, self.ring, self._layout)


class _Point:
    """A rational point and a modular one at which products are compared."""

    def __init__(
        self, ring: TrigonometricRing, layout: Layout, halves: HalfAngles
    ) -> None:
        source = random.Random(7)
        self._halves = halves
        self._pairs = []
        exact: list[fmpq] = [fmpq(0)] * len(ring.names)
        for sine, cosine in layout.angles:
            u, v = source.randrange(1, 2**16) * 2, source.randrange(2**16) * 2 + 1
            self._pairs.append((u, v))
            w = u * u + v * v
            exact[sine], exact[cosine] = fmpq(2 * u * v, w), fmpq(v * v - u * u, w)
        self._symbols = [0] * len(ring.names)
        for symbol in layout.symbols:
            self._symbols[symbol] = source.randrange(2**16, 2**20)
            exact[symbol] = fmpq(self._symbols[symbol])
        self._exact = exact
        self._modular = random_point(ring, source)

    def value(self, polynomial: Polynomial) -> int:
        """The value, times what makes the angles homogeneous: an integer."""
        if polynomial.is_constant():
            return int(as_fraction(polynomial))
        value = polynomial(*self._exact)
        for i, degree in self._halves.degrees(polynomial).items():
            u, v = self._pairs[i]
            value *= (u * u + v * v) ** degree
        return int(value.p)

    def residue(self, polynomial: Polynomial) -> int:
        """The value modulo the prime of `points`."""
        return residue(polynomial, self._modular)

    def form_values(self, form: Form) -> tuple[int, int]:
        """The value of an odd form, and 0 where a residue would be ambiguous."""
        return self._halves.value(form, self._pairs, self._symbols), 0


class _Divisor:
    """Divides by one polynomial, by its norm over the angles it contains."""

    def __init__(
        self, polynomial: Polynomial, ring: TrigonometricRing, layout: Layout
    ) -> None:
        self._polynomial = polynomial
        self._cofactor: Polynomial | None = ring.one
        self._norm = polynomial
        degrees = polynomial.degrees()
        for (sine, _), generator in zip(layout.angles, ring.sines, strict=True):
            if degrees[sine]:
                mirrored = self._norm.compose(
                    *(-g if g == generator else g for g in ring.context.gens())
                )
                if len(mirrored) ** 2 > LARGEST_NORM:
                    self._cofactor = None
                    return
                self._cofactor = ring.normal(self._cofactor * mirrored)
                self._norm = ring.normal(self._norm * mirrored)

    def divide(
        self, polynomial: Polynomial, ring: TrigonometricRing
    ) -> Polynomial | None:
        """The quotient, or None where the division was not found to be exact."""
        quotient, rest = divmod(polynomial, self._polynomial)
        if rest == 0:
            return ring.normal(quotient)
        if self._cofactor is None:
            return None
        raised = ring.normal(polynomial * self._cofactor)
        quotient, rest = divmod(raised, self._norm)
        return quotient if rest == 0 else None


def collected(
    factors: Iterable[tuple[Factor, int]],
) -> list[tuple[Factor, int]]:
    """Equal factors together."""
    count: dict[str, int] = {}
    kept: dict[str, Factor] = {}
    for part, multiplicity in factors:
        kept[part.key] = part
        count[part.key] = count.get(part.key, 0) + multiplicity
    return [(part, count[key]) for key, part in kept.items()]
