"""What has been factored in one ring: irreducible factors, found once and divided out.

Mechanisms have few factors, which occur again and again.  A polynomial that is not
divided by known factors is split as it stands; every piece is proved irreducible
(`irreducible`) or rewritten in half angles, where factors are unique (`half_angle`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from screwkit.algebra.division import Divisor, exact_quotient
from screwkit.algebra.half_angle import Form, HalfAngles
from screwkit.algebra.irreducible import Shape, is_irreducible, shape
from screwkit.algebra.known_factors import KnownFactors
from screwkit.algebra.over_roots import quotient_number, square_roots
from screwkit.algebra.points import residue
from screwkit.algebra.restrictions import Layout, Probe, Restrictions
from screwkit.algebra.scaled_symbols import scaled
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

_SHORT = 12  # terms; factored as they stand before anything else


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
        self._probe = Probe(self._layout, 7)
        self._points = [self._probe.point(moved) for moved in (False, True)]
        self._roots = square_roots(ring)
        self._rational: FactorLibrary | None = None
        self._pieces: dict[str, list[tuple[Factor, int]]] = {}
        self._known = KnownFactors(self._layout)
        self._residues: dict[str, tuple[int, ...]] = {}
        for sine, cosine in zip(ring.sines, ring.cosines, strict=True):
            self.irreducible(sine)
            self.irreducible(cosine)

    def irreducible(
        self,
        polynomial: Polynomial,
        certified: bool = True,
        restrictions: Restrictions | None = None,
    ) -> Factor:
        """The factor of a polynomial known not to split.

        Args:
            polynomial: Primitive and in normal form.
            certified: Whether that is proved.
            restrictions: At the library's point, up to numbers.
        """
        key = str(polynomial)
        factor = self.factors.get(key)
        if factor is None:
            factor = self.factors[key] = Factor(key, (polynomial,), certified)
            if not self.is_extended(polynomial):
                if restrictions is None:
                    restrictions = self._probe.restrictions(polynomial)
                if restrictions:
                    divisor = self._divisor(polynomial)
                    self._known.add(key, divisor, restrictions)
        return factor

    def is_extended(self, polynomial: Polynomial) -> bool:
        """Whether symbolic roots or inverses occur in a polynomial."""
        if not self._layout.extensions:
            return False
        degrees = polynomial.degrees()
        return any(degrees[i] for i in self._layout.extensions)

    def factored(self, polynomial: Polynomial) -> list[tuple[Factor, int]]:
        """The factors of a primitive polynomial in normal form, without constants."""
        known = None
        if len(polynomial) > _SHORT and not self.is_extended(polynomial):
            known = self._probe.restrictions(polynomial)
        if known is None:
            return self.paired(self.split(polynomial))
        keys, rest, known = self._known.divided(polynomial, known)
        found = [(self.factors[key], number) for key, number in keys]
        if not rest.is_constant():
            found = found + self.split(rest, known)
        return self.paired(collected(found))

    def _numbers(self, polynomial: Polynomial) -> Polynomial:
        """An irrational number that divides a polynomial; 1 where there is none."""
        degrees = polynomial.degrees()
        variables = list(self._layout.variables(degrees))
        if not variables or not any(degrees[i] for i in self._layout.constants):
            return self.ring.one
        values = {
            self.ring.names[i]: 2 + 3 * n
            for n, i in enumerate(i for variable in variables for i in variable)
        }
        first = polynomial.subs(values)
        second = polynomial.subs({name: value + 1 for name, value in values.items()})
        common = first.gcd(second)
        exact = not common.is_constant() and exact_quotient(polynomial, common)
        return primitive(common) if exact else self.ring.one

    def split(
        self, polynomial: Polynomial, known: Restrictions | None = None
    ) -> list[tuple[Factor, int]]:
        """As `factored`, but trying no known factors, and with halves unpaired.

        Args:
            polynomial: To be split.
            known: Its restrictions at the library's point, up to numbers.
        """
        key = str(polynomial)
        if key in self.factors:
            return [(self.factors[key], 1)]
        if key not in self._pieces:
            self._pieces[key] = self._split(polynomial, known)
        return self._pieces[key]

    def paired(self, factors: Sequence[tuple[Factor, int]]) -> list[tuple[Factor, int]]:
        """Half-angle factors of different pieces that make up whole ones."""
        odd = [(part.form, m) for part, m in factors if part.form is not None]
        if len(odd) < 2:
            return list(factors)
        whole = [(part, m) for part, m in factors if part.form is None]
        paired = self._halves.paired(odd)
        return collected([*whole, *((self._final(form), m) for form, m in paired)])

    def residues(self, polynomial: Polynomial) -> tuple[int, ...]:
        """Values of a polynomial, made homogeneous in the angles, at two points."""
        degrees = self._layout.degrees(polynomial)
        found = []
        for values, tangents in self._points:
            result = residue(polynomial, values, self.prime)
            for angle, t in zip(self._layout.angles, tangents, strict=True):
                result = result * pow(1 + t * t, degrees.get(angle, 0), self.prime)
            found.append(result % self.prime)
        return tuple(found)

    def factor_residues(self, factor: Factor) -> tuple[int, ...]:
        """Of a factor, at the points of `residues`."""
        if factor.key not in self._residues:
            if factor.form is None:
                found = self.residues(factor.polynomial)
            else:
                found = tuple(
                    residue(factor.form.polynomial, [*values, *tangents], self.prime)
                    for values, tangents in self._points
                )
            self._residues[factor.key] = found
        return self._residues[factor.key]

    @property
    def prime(self) -> int:
        """The modulus of residues."""
        return self._layout.prime

    def _each(
        self, pieces: Sequence[tuple[Polynomial, int]]
    ) -> list[tuple[Factor, int]]:
        """What FLINT found, each piece split further."""
        return collected(
            (factor, n * int(m))
            for piece, m in pieces
            for factor, n in self.split(primitive(piece))
        )

    def _split(
        self, polynomial: Polynomial, known: Restrictions | None
    ) -> list[tuple[Factor, int]]:
        number = self._numbers(polynomial)
        if number != 1:
            rest = self.split(primitive(polynomial / number), known)
            return collected([*self.split(number), *rest])
        parts = self._in_scaled_symbols(polynomial)
        if parts is not None:
            return parts
        short = len(polynomial) <= _SHORT
        pieces = polynomial.factor()[1] if short else []
        if len(pieces) > 1 or (pieces and pieces[0][1] > 1):
            return self._each(pieces)
        found = shape(self._layout, polynomial, 1, self._probe, known)
        if found.irreducible:
            return [(self.irreducible(polynomial, True, known), 1)]
        over_roots = self._over_roots(polynomial)
        if over_roots is not None:
            return over_roots
        parts = self._parted(polynomial, found)
        if parts is not None:
            return parts
        pieces = pieces or polynomial.factor()[1]
        if len(pieces) > 1 or pieces[0][1] > 1:
            return self._each(pieces)
        if found.settled:
            return [(self.irreducible(polynomial), 1)]
        whole = self._halved_once(polynomial)
        if whole is not None:
            return collected(
                (factor, n * m)
                for form, m in whole
                for factor, n in self.split(self._halves.whole(form))
            )
        angles = self._halves.degrees(polynomial)
        return [(self._final(form), m) for form, m in self._halved(polynomial, angles)]

    def _over_roots(self, polynomial: Polynomial) -> list[tuple[Factor, int]] | None:
        """The factors where square roots of numbers are at hand, all proved."""
        if not self._roots or self.is_extended(polynomial):
            return None
        halves, angles = self._halves, self._halves.degrees(polynomial)
        found = halves.factor_over_roots(halves.form(polynomial, angles), self._roots)
        if found is None:
            return None
        if len(found) == 1 and found[0][1] == 1:
            return [(self.irreducible(polynomial), 1)]
        whole = halves.product(form for form, m in found for _ in range(m))
        number = quotient_number(polynomial, halves.exact(whole), self._roots)
        parts = [
            (self._final(form, proved=True), m) for form, m in halves.paired(found)
        ]
        return parts if number is None else [(self.irreducible(number), 1), *parts]

    def _in_scaled_symbols(
        self, polynomial: Polynomial
    ) -> list[tuple[Factor, int]] | None:
        """Factors that show when some symbols are counted in units of a root."""
        form = scaled(self.ring, self._layout, polynomial)
        if form is None or form.polynomial.is_constant():
            return None
        if self._rational is None:
            self._rational = FactorLibrary(self.ring)
        inner = self._rational.factored(form.polynomial)
        if any(part.form is not None for part, _ in inner):
            return None
        found, roots = [], int(form.odd)
        for part, multiplicity in inner:
            factor, odd = form.unscaled(part.polynomial)
            found.append((self.irreducible(factor, part.certified), multiplicity))
            roots += odd * multiplicity
        if roots & 1:
            root = self.ring.context.gens()[form.root]
            found.append((self.irreducible(root), 1))
        return collected(found)

    def _parted(
        self, polynomial: Polynomial, found: Shape
    ) -> list[tuple[Factor, int]] | None:
        """The factors free of some variable, and the one that contains it."""
        if not any(found.degrees.values()):
            return None
        if any(len(v) == 2 and degree % 2 for v, degree in found.degrees.items()):
            return None
        common = quotient = None
        occurring = polynomial.degrees()
        roots = [i for i in self._layout.constants if occurring[i]]
        for absent in ([], roots) if roots else ([],):
            common = self._halves.common(polynomial, found.degrees, absent)
            if common is not None:
                common = primitive(common / self._numbers(common))
                quotient = self._divisor(common).divide(polynomial)
            if quotient is not None:
                break
        if common is None or quotient is None:
            # Parts that contain the same irrational number cannot be separated while
            # it is taken for a generator, neither here nor in half angles.
            hidden = [(self.irreducible(polynomial, False), 1)]
            return hidden if roots else None
        rest = primitive(quotient)
        degrees = self._layout.degrees(common)
        if found.rest_irreducible and all(
            len(v) * degrees.get(v, 0) == d for v, d in found.degrees.items()
        ):
            last = [(self.irreducible(rest), 1)]
        else:
            last = self.split(rest)
        return collected([*self.split(common), *last])

    def _divisor(self, polynomial: Polynomial) -> Divisor:
        return Divisor(polynomial, self.ring, self._halves, self._layout)

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

    def _final(self, form: Form, *, proved: bool = False) -> Factor:
        """The factor of a form that cannot be split further."""
        equations = self._halves.equations(form)
        proved = proved or not self.ring.has_extensions
        if len(equations) == 1:
            certified = proved or is_irreducible(self._layout, equations[0])
            return self.irreducible(equations[0], certified)
        key = "; ".join(map(str, equations))
        if key not in self.factors:
            certified = proved
            self.factors[key] = Factor(key, equations, certified, form)
        return self.factors[key]


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
