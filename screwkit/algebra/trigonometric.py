"""The exact ring: polynomials in sines, cosines and symbols over the rationals.

A scalar is a FLINT polynomial (`fmpq_mpoly`) in generators s_i, c_i for a set of
*basis angles*, one generator for every symbol, and one for every algebraic number that
the geometry contains.  Relations (s² + c² = 1, w² = 3, …) give a normal form in which
equal scalars are equal polynomials, so that zero is decided and never guessed.

A basis angle is an integer combination of joint angles, such as q6 − q1; the basis is
unimodular, so nothing is lost, and a good one keeps every later polynomial short.

References: [CoxLittleOShea], §2.3 (normal forms).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, Final, TypeAlias

from flint import Ordering, fmpq, fmpq_mpoly_ctx, fmpq_poly

from screwkit.algebra.angle_basis import AngleForm, inverse_forms
from screwkit.algebra.angle_measures import common_measures
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.evaluation import add_angles, evaluate, multiply_angle
from screwkit.algebra.expression import Expression, Number
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.ring import Known
from screwkit.algebra.survey import SurveyRing, rational_root
from screwkit.errors import ExpressionError

Polynomial: TypeAlias = Any  # flint.fmpq_mpoly, which has no type stubs


@dataclass(frozen=True)
class Extension:
    """A generator w that stands for an algebraic function of the symbols.

    Attributes:
        kind: ``root``: w² = ``of``; ``inverse``: w · ``of`` = 1.
    """

    name: str
    kind: str
    of: Expression


def plain_basis(angles: Sequence[str]) -> tuple[AngleForm, ...]:
    """Every angle is its own basis angle."""
    return tuple(((angle, 1),) for angle in angles)


class TrigonometricRing:
    """Q[s, c, symbols] modulo its relations; see the module's docstring.

    Attributes:
        basis: The basis angles as integer combinations of declared angles.
        symbols: The symbols that occur as numbers.
        measures: Of the rational numbers of radians; the last basis angles.
        extensions: Square roots and inverses of symbolic quantities.
        context: The FLINT context all polynomials of this ring live in.
        plain: See `Ring`.
    """

    plain: Final = False

    def __init__(
        self, survey: SurveyRing, basis: Sequence[AngleForm] | None = None
    ) -> None:
        angles = [*survey.angles]
        self.basis = tuple(plain_basis(angles) if basis is None else basis)
        self.measures = common_measures(survey.constant_angles)
        self.basis += tuple(((str(angle), 1),) for angle in self.measures.values)
        self.symbols = tuple(survey.symbols)
        self._constants = ConstantField.needed_by(
            [r.value for r in survey.roots if isinstance(r, Number)], survey.turn
        )
        self.extensions = tuple(
            Extension(f"w{i}", "inverse", of) for i, of in enumerate(survey.divisors)
        ) + tuple(
            Extension(f"v{i}", "root", of)
            for i, of in reversed(tuple(enumerate(survey.roots)))
            if not isinstance(of, Number)
        )
        count = len(self.basis)
        names = [extension.name for extension in self.extensions]
        names += [f"s{i}" for i in range(count)] + [f"c{i}" for i in range(count)]
        names += [f"x{i}" for i in range(len(self.symbols))]
        names += list(self._constants.generators)
        self.context = fmpq_mpoly_ctx.get(names or ["one"], Ordering.lex)
        self.names = tuple(names)
        gens = dict(zip(names, self.context.gens(), strict=False))
        self._gens = gens
        self._zero = self.context.constant(0)
        self._turns: dict[Fraction, tuple[Polynomial, Polynomial]] = {}
        self._constant_angles: dict[Fraction, tuple[Polynomial, Polynomial]] = {}
        self._one = self.context.constant(1)
        self.sines = tuple(gens[f"s{i}"] for i in range(count))
        self.cosines = tuple(gens[f"c{i}"] for i in range(count))
        self._symbol = {name: gens[f"x{i}"] for i, name in enumerate(self.symbols)}
        self._relations: list[tuple[int, int, Polynomial]] = []
        index = {name: i for i, name in enumerate(names)}
        for s, c, i in zip(self.sines, self.cosines, range(count), strict=True):
            self._relations.append((index[f"s{i}"], 2, s**2 + c**2 - 1))
        for name, coefficients in self._constants.minimal_polynomials.items():
            polynomial = sum(
                (a * gens[name] ** k for k, a in enumerate(coefficients)), self._zero
            )
            self._relations.append((index[name], len(coefficients) - 1, polynomial))
        self._angle_pairs = self._declared_angles()
        self._extended: dict[Expression, Polynomial] = {}
        self._divisor_values: dict[str, Polynomial] = {}
        self._radicands: dict[str, Polynomial] = {}
        self.known: Known[Polynomial] | None = None  # normal forms are not yet final
        self._extend(index)
        self.known = {}

    # -- construction ------------------------------------------------------------

    def _declared_angles(self) -> dict[str, tuple[Polynomial, Polynomial]]:
        """(cos, sin) of each declared angle from those of the basis angles."""
        pairs = {}
        for name, combination in inverse_forms(self.basis).items():
            pair = (self._one, self._zero)
            for i, count in combination:
                basis = (self.cosines[i], self.sines[i])
                pair = add_angles(pair, multiply_angle(count, basis, self), self)
            pairs[name] = pair
        return pairs

    def _extend(self, index: Mapping[str, int]) -> None:
        """Relations of roots and inverses, inner ones first, applied outer first."""
        for extension in reversed(self.extensions):
            inside = evaluate(extension.of, self)
            generator = self._gens[extension.name]
            if extension.kind == "root":
                exact = _polynomial_root(inside)
                self._radicands[extension.name] = inside
                self._extended[extension.of] = generator if exact is None else exact
                relation = (index[extension.name], 2, generator**2 - inside)
                self._relations.insert(0, relation)
            elif inside.is_constant():
                if inside == 0:
                    raise ExpressionError("a divisor is zero for every posture")
            else:
                self._divisor_values[extension.name] = inside
                relation = (index[extension.name], 1, generator * inside - 1)
                self._relations.insert(0, relation)

    # -- the ring ----------------------------------------------------------------

    @property
    def zero(self) -> Polynomial:
        """The polynomial 0."""
        return self._zero

    @property
    def one(self) -> Polynomial:
        """The polynomial 1."""
        return self._one

    def rational(self, value: Fraction) -> Polynomial:
        """A constant polynomial."""
        return self.context.constant(fmpq(value.numerator, value.denominator))

    def symbol(self, name: str) -> Polynomial:
        """The generator of a symbol."""
        return self._symbol[name]

    def cosine_sine(self, angle: str) -> tuple[Polynomial, Polynomial]:
        """(cos, sin) of a declared angle, in the basis angles."""
        return self._angle_pairs[angle]

    def half_turns(self, count: Fraction) -> tuple[Polynomial, Polynomial]:
        """(cos, sin) of ``count``·π, exact."""
        if count not in self._turns:
            self._turns[count] = (
                self._algebraic(self._constants.cosine(count)),
                self._algebraic(self._constants.cosine(Fraction(1, 2) - count)),
            )
        return self._turns[count]

    def radians(self, value: Fraction) -> tuple[Polynomial, Polynomial]:
        """(cos, sin) of a rational angle: transcendental, hence by generators."""
        if value not in self._constant_angles:
            pair = self._one, self._zero
            for measure, count in self.measures.of[abs(value)] if value else ():
                own = self._angle_pairs[str(measure)]
                turned = multiply_angle(count if value > 0 else -count, own, self)
                pair = add_angles(pair, turned, self)
            self._constant_angles[value] = pair
        return self._constant_angles[value]

    def square_root(self, radicand: Expression, value: Polynomial) -> Polynomial:
        """A rational, an algebraic number or the generator of this root."""
        if value.is_constant():
            constant = as_fraction(value)
            rational = rational_root(constant)
            if rational is not None:
                return self.rational(rational)
            if rational_value(radicand) is not None:
                return self._algebraic(self._constants.square_root(constant))
        return self._extended[radicand]

    def inverse(self, divisor: Expression, value: Polynomial) -> Polynomial:
        """The generator that stands for 1/``divisor``, or a rational."""
        if value.is_constant():
            constant = as_fraction(value)
            if not constant:
                raise ExpressionError("a divisor is zero for every posture")
            return self.rational(1 / constant)
        for extension in self.extensions:
            if extension.kind == "inverse" and extension.of == divisor:
                return self._gens[extension.name]
        raise KeyError(divisor)

    def normal(self, value: Polynomial) -> Polynomial:
        """The remainder on division by the relations."""
        if value.is_constant():
            return value
        for _ in range(8):
            degrees = value.degrees()
            changed = False
            for generator, degree, relation in self._relations:
                if degrees[generator] >= degree:
                    value = divmod(value, relation)[1]
                    degrees = value.degrees()
                    changed = True
            if not changed or not self.extensions:
                break
        return value

    def is_zero(self, value: Polynomial) -> bool:
        """Whether a normal form is the zero polynomial."""
        return bool(value == 0)

    # -- helpers of the engine ---------------------------------------------------

    @cached_property
    def has_extensions(self) -> bool:
        """Whether any symbolic root or inverse, or irrational constant, occurs."""
        return bool(self.extensions or self._constants.generators)

    @property
    def radicands(self) -> Mapping[str, Polynomial]:
        """The squares of symbolic roots by the name of their generator."""
        return self._radicands

    @property
    def constant_angles(self) -> tuple[str, ...]:
        """Names of the basis angles that are rational numbers of radians."""
        return tuple(str(angle) for angle in self.measures.values)

    @cached_property
    def algebraic_relations(
        self,
    ) -> list[tuple[int, Polynomial | tuple[int, ...]]]:
        """(generator, radicand or minimal polynomial), inner ones first."""
        index = {name: i for i, name in enumerate(self.names)}
        found: list[tuple[int, Polynomial | tuple[int, ...]]] = [
            (index[name], coefficients)
            for name, coefficients in self._constants.minimal_polynomials.items()
        ]
        found += [
            (index[extension.name], self._radicands[extension.name])
            for extension in reversed(self.extensions)
            if extension.kind == "root"
        ]
        return found

    @property
    def constant_generators(self) -> Mapping[str, str]:
        """Text of the algebraic numbers by the name of their generator."""
        return self._constants.texts

    @cached_property
    def angles_as_numbers(self) -> Mapping[int, Polynomial]:
        """The basis angles that are sums of symbols of this ring, as these sums."""
        return {
            k: sum((self._symbol[name] * n for name, n in form), self._zero)
            for k, form in enumerate(self.basis)
            if all(name in self._symbol for name, _ in form)
        }

    def sine_index(self, angle: int) -> int:
        """Index of the generator of a basis angle's sine."""
        return len(self.extensions) + angle

    def cosine_index(self, angle: int) -> int:
        """Index of the generator of a basis angle's cosine."""
        return len(self.extensions) + len(self.basis) + angle

    def symbol_indices(self) -> range:
        """Indices of the generators of the symbols."""
        start = len(self.extensions) + 2 * len(self.basis)
        return range(start, start + len(self.symbols))

    def generator(self, name: str) -> Polynomial:
        """A generator by its internal name."""
        return self._gens[name]

    def without_divisors(self, column: Sequence[Polynomial]) -> list[Polynomial]:
        """The column times whatever clears its inverses; a screw is projective."""
        return self.cleared(column)[0]

    def cleared(
        self, column: Sequence[Polynomial]
    ) -> tuple[list[Polynomial], Polynomial]:
        """`without_divisors`, and what the column was multiplied with."""
        values = [*column, self._one]
        for name, divisor in self._divisor_values.items():
            index = self.names.index(name)
            power = max(int(p.degrees()[index]) for p in values)
            if power:
                over = (_cleared(p, index, power, divisor, self) for p in values)
                values = [self.normal(p) for p in over]
        return values[:-1], values[-1]

    @property
    def divisors_of(self) -> Mapping[str, Polynomial]:
        """What each generator that stands for an inverse is the inverse of."""
        return self._divisor_values

    @cached_property
    def geometry_divisors(self) -> Mapping[int, Polynomial]:
        """What the geometry divides by, by number in its survey, if no root is in it.

        Inverses in it are cleared.
        """
        found = {
            int(name[1:]): self.cleared([divisor])[0][0]
            for name, divisor in self._divisor_values.items()
        }
        places = [self.names.index(name) for name in self.radicands]
        return {
            number: divisor
            for number, divisor in found.items()
            if not any(divisor.degrees()[place] for place in places)
        }

    def _algebraic(self, terms: Mapping[tuple[int, ...], Fraction]) -> Polynomial:
        gens = [self._gens[name] for name in self._constants.generators]
        total = self._zero
        for exponents, coefficient in terms.items():
            term = self.rational(coefficient)
            for gen, exponent in zip(gens, exponents, strict=True):
                term = term * gen**exponent
            total = total + term
        return self.normal(total)


def as_fraction(constant: Polynomial) -> Fraction:
    """The value of a constant polynomial."""
    if constant == 0:
        return Fraction(0)
    value = constant.coeffs()[0]
    return Fraction(int(value.p), int(value.q))


def primitive(value: Polynomial) -> Polynomial:
    """The polynomial with coprime integer coefficients, first one positive."""
    return value / content(value) if value != 0 else value


def content(value: Polynomial) -> Any:
    """The rational by which `primitive` divides, with the sign of the first term."""
    coefficients = value.coeffs()
    # As one polynomial they get their common denominator in one sweep of FLINT's.
    together = fmpq_poly(coefficients)
    sign = -1 if coefficients[0] < 0 else 1
    return fmpq(sign * together.numer().content(), together.denom())


def _polynomial_root(value: Polynomial) -> Polynomial | None:
    try:
        return value.sqrt()
    except Exception:
        return None


def _cleared(
    value: Polynomial,
    index: int,
    power: int,
    divisor: Polynomial,
    ring: TrigonometricRing,
) -> Polynomial:
    """``value`` times divisor^power, with the inverse generator cancelled."""
    parts: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in value.to_dict().items():
        rest = tuple(0 if i == index else e for i, e in enumerate(exponents))
        parts.setdefault(int(exponents[index]), {})[rest] = coefficient
    total = ring.zero
    for exponent, terms in parts.items():
        total += ring.context.from_dict(terms) * divisor ** (power - exponent)
    return total
