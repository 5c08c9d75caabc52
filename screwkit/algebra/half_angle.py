"""Trigonometric polynomials as forms in sines and cosines of half angles.

With u = sin(q/2) and v = cos(q/2) a polynomial of degree d in sin q and cos q is a form
of degree 2d in u and v, and forms factor uniquely.  A factor of even degree in every
angle is a polynomial in sin q and cos q again.  A factor of odd degree is paired with
its image under q → q + π where that divides too; sin q = 2uv and cos q = (v + u)(v − u)
are such pairs.  One that stays alone, such as a·sin(q/2) − d·cos(q/2), is a locus of
its own that no single polynomial in sin q and cos q shows without a companion.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from flint import Ordering, fmpq_mpoly_ctx
from flint.utils.flint_exceptions import DomainError

from screwkit.algebra.over_roots import (
    Root,
    factors_over_roots,
    monic,
    square_roots,
)
from screwkit.algebra.restrictions import Layout, Variable, coefficients
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

Degrees: TypeAlias = Mapping[int, int]  # by basis angle; absent ones do not occur
Key: TypeAlias = tuple[str, tuple[tuple[int, int], ...]]


@dataclass(frozen=True, eq=False)
class Form:
    """A form in u, v of some angles, written in t = u/v.

    Attributes:
        polynomial: In the context of `HalfAngles`; t of angle i is generator ``t<i>``.
        degrees: In u and v together, by angle.
    """

    polynomial: Polynomial
    degrees: Degrees

    @property
    def odd(self) -> tuple[int, ...]:
        """The angles in which the degree is odd."""
        return tuple(i for i, degree in sorted(self.degrees.items()) if degree % 2)

    @property
    def key(self) -> Key:
        """What equal forms have in common."""
        return str(self.polynomial), tuple(sorted(self.degrees.items()))


class HalfAngles:
    """Goes between a ring and the forms in half angles of its basis angles."""

    def __init__(self, ring: TrigonometricRing, layout: Layout) -> None:
        self._ring = ring
        self._layout = layout
        self._angles = layout.angles
        self._size = len(ring.names)
        names = [*ring.names, *(f"t{i}" for i in range(len(layout.angles)))]
        self._names = names
        self._context = fmpq_mpoly_ctx.get(names, Ordering.lex)
        gens = self._context.gens()
        self._one = self._context.constant(1)
        self._pairs = [(gens[s], gens[c]) for s, c in layout.angles]
        self._tangents = gens[self._size :]
        self._roots = square_roots(ring)

    def degrees(self, polynomial: Polynomial) -> dict[int, int]:
        """The degree in sine and cosine together of every angle that occurs."""
        degrees = self._layout.degrees(polynomial)
        return {
            i: degrees[angle]
            for i, angle in enumerate(self._angles)
            if angle in degrees
        }

    def form(self, polynomial: Polynomial, angles: Iterable[int]) -> Form:
        """The polynomial with these angles, which must occur in it, halved."""
        degrees = self.degrees(polynomial)
        chosen = {i: degrees[i] for i in angles}
        halved = self._form(polynomial.project_to_context(self._context), chosen)
        return Form(halved, {i: 2 * degree for i, degree in chosen.items()})

    def _form(self, polynomial: Polynomial, degrees: Degrees) -> Polynomial:
        """With some angles, of given degrees, halved."""
        for i, degree in degrees.items():
            t = self._tangents[i]
            sine, cosine, unit = 2 * t, 1 - t**2, 1 + t**2
            polynomial = self._sum(
                part * (sine**a * cosine**b * unit ** (degree - a - b))
                for (a, b), part in coefficients(polynomial, self._angles[i]).items()
            )
        return polynomial

    def _degree(self, polynomial: Polynomial, angle: int) -> int:
        """In sine and cosine together."""
        s, c = self._angles[angle]
        return max(sum(key) for key in coefficients(polynomial, (s, c)))

    def whole(self, form: Form) -> Polynomial:
        """The primitive polynomial in normal form of a form of even degrees."""
        return primitive(self.exact(form))

    def exact(self, form: Form) -> Polynomial:
        """The value, in normal form, of a form of even degrees."""
        polynomial = form.polynomial
        for i, degree in form.degrees.items():
            s, c = self._pairs[i]
            half = degree // 2
            polynomial = self._sum(
                part
                * (1 - c) ** (k // 2)
                * (1 + c) ** (half - (k + 1) // 2)
                * (s if k % 2 else 1)
                for (k,), part in coefficients(polynomial, (self._size + i,)).items()
            )
        value = polynomial.project_to_context(self._ring.context)
        return self._ring.normal(value) / 2 ** (sum(form.degrees.values()) // 2)

    def factor(self, form: Form) -> list[tuple[Form, int]]:
        """The irreducible factors of a form, those that vanish at t = ∞ included."""
        return self._as_forms(form, form.polynomial.factor()[1])

    def factor_over_roots(
        self, form: Form, roots: Sequence[Root]
    ) -> list[tuple[Form, int]] | None:
        """`factor` over the field of square roots; None where that is not proved."""
        found = factors_over_roots(form.polynomial, self._names, roots)
        return None if found is None else self._as_forms(form, found)

    def _as_forms(
        self, form: Form, factors: Iterable[tuple[Polynomial, int]]
    ) -> list[tuple[Form, int]]:
        parts = []
        left = dict(form.degrees)
        for factor, multiplicity in factors:
            bounds = factor.degrees()
            degrees = {
                i: int(bounds[self._size + i])
                for i in form.degrees
                if bounds[self._size + i]
            }
            parts.append((Form(primitive(factor), degrees), int(multiplicity)))
            for i, degree in degrees.items():
                left[i] -= degree * int(multiplicity)
        parts += [
            (Form(self._one, {i: 1}), degree) for i, degree in left.items() if degree
        ]
        return parts

    def common(
        self,
        polynomial: Polynomial,
        wanted: Mapping[Variable, int],
        without: Sequence[int] = (),
    ) -> Polynomial | None:
        """A factor that contains some variables only.

        It divides every coefficient with respect to the others.

        Args:
            polynomial: To be split.
            wanted: The degree of the factor in tan(q/2), by angle, and by symbol.
            without: Other generators that it does not contain.

        Returns:
            The common factor of some coefficients, of these degrees at most; None where
            there is none.
        """
        shared = {
            i: wanted.get(self._angles[i], 0)
            for i, degree in self.degrees(polynomial).items()
            if 0 < wanted.get(self._angles[i], 0) < 2 * degree
        }
        bounds = polynomial.degrees()
        absent = [*without]
        absent += [
            i
            for variable in self._layout.variables(bounds)
            if not wanted.get(variable)
            for i in variable
        ]
        limits = {self._size + i: degree for i, degree in shared.items()}
        for variable, degree in wanted.items():
            limits |= {i: degree // len(variable) for i in variable}
        raised = polynomial.project_to_context(self._context)
        common = None
        for part in sorted(coefficients(raised, absent).values(), key=len):
            form = self._form(part, {i: self._degree(part, i) for i in shared})
            common = form if common is None else common.gcd(form)
            bounds = common.degrees()
            if all(bounds[i] <= degree for i, degree in limits.items()):
                break
        else:
            return None
        found = self.whole(Form(primitive(common), shared))
        return None if found.is_constant() else found

    def quotient(
        self, polynomial: Polynomial, divisor: Polynomial
    ) -> Polynomial | None:
        """The polynomial that gives a polynomial when multiplied by a divisor."""
        below = self.degrees(divisor)
        above = self.degrees(polynomial)
        if any(above.get(i, 0) < degree for i, degree in below.items()):
            return None
        degrees = {i: d for i, d in below.items() if d < above[i]}
        pair = (polynomial, {i: above[i] for i in degrees}), (divisor, degrees)
        try:
            if not degrees:  # in half angles they would read the same
                return polynomial / divisor
            forms = [
                self._form(p.project_to_context(self._context), d) for p, d in pair
            ]
            found = forms[0] / forms[1]
        except DomainError:
            return None
        left = {i: 2 * (above[i] - degrees[i]) for i in degrees}
        bounds = found.degrees()
        if any(bounds[self._size + i] > degree for i, degree in left.items()):
            return None
        return self.exact(Form(found, left))

    def paired(self, parts: Sequence[tuple[Form, int]]) -> list[tuple[Form, int]]:
        """Odd factors times their images under q → q + π, where all of them divide."""
        members: dict[Key, Form] = {}
        keys: list[Key] = []
        for form, _ in parts:
            key = self._monic(form).key
            # Of two multiples of one form the second stays what it is.
            keys.append(form.key if members.get(key, form).key != form.key else key)
            members[keys[-1]] = form
        count = {k: m for k, (_, m) in zip(keys, parts, strict=True)}
        result = []
        for key in keys:
            form = members[key]
            if form.odd:
                orbit = self._orbit(form)
                shared = min(count.get(key, 0) for key in orbit)
                if shared and len(orbit) > 1:
                    for image in orbit:
                        count[image] -= shared
                    whole = self.product(members[image] for image in orbit)
                    result.append((whole, shared))
            else:
                result.append((form, count.pop(key)))
        left = ((members[k], count[k]) for k in keys if members[k].odd)
        return [*result, *((form, m) for form, m in left if m)]

    def product(self, forms: Iterable[Form]) -> Form:
        """The product of forms."""
        polynomial, degrees = self._one, dict[int, int]()
        for form in forms:
            polynomial = polynomial * form.polynomial
            for i, degree in form.degrees.items():
                degrees[i] = degrees.get(i, 0) + degree
        return Form(polynomial, degrees)

    def equations(self, form: Form) -> tuple[Polynomial, ...]:
        """Polynomials whose common zeros are those of a form.

        A form of odd degree is multiplied by the cosine and by the sine of half the
        sum of its odd angles, which have no common zero.
        """
        if not form.odd:
            return (self.whole(form),)
        cosine, sine = self._one, self._one - self._one
        for i in form.odd:
            t = self._tangents[i]
            cosine, sine = cosine - sine * t, sine + cosine * t
        whole = [
            self.whole(self.product((form, Form(factor, dict.fromkeys(form.odd, 1)))))
            for factor in (sine, cosine)
        ]
        return tuple(sorted(whole, key=lambda p: (len(p), str(p))))

    def linear_parts(self, form: Form, angle: int) -> tuple[Polynomial, Polynomial]:
        """(a, b) of a form a·sin(q/2) + b·cos(q/2) that is odd in this angle alone."""
        slices = coefficients(form.polynomial, (self._size + angle,))
        rest = {i: degree for i, degree in form.degrees.items() if i != angle}
        zero = self._context.constant(0)
        a, b = (self.exact(Form(slices.get((k,), zero), rest)) for k in (1, 0))
        return a, b

    def _orbit(self, form: Form) -> dict[Key, Form]:
        """By what they have in common with their multiples by numbers."""
        form = self._monic(form)
        orbit: dict[Key, Form] = {form.key: form}
        for i in form.odd:
            for known in list(orbit.values()):
                image = self._monic(self._turned(known, i))
                orbit.setdefault(image.key, image)
        return orbit

    def _turned(self, form: Form, angle: int) -> Form:
        """The image under q → q + π, where u becomes v and v becomes −u."""
        place, degree = self._size + angle, form.degrees[angle]
        terms = {}
        for exponents, coefficient in form.polynomial.to_dict().items():
            k = int(exponents[place])
            moved = (*exponents[:place], degree - k, *exponents[place + 1 :])
            terms[moved] = -coefficient if (degree - k) % 2 else coefficient
        return Form(primitive(self._context.from_dict(terms)), form.degrees)

    def _monic(self, form: Form) -> Form:
        """The multiple of a form by a number that equal ones have in common."""
        degrees = form.polynomial.degrees()
        if not any(degrees[root.place] for root in self._roots):
            return form
        scaled = monic(form.polynomial, self._names, self._roots)
        return form if scaled is None else Form(primitive(scaled), form.degrees)

    def _sum(self, terms: Iterable[Polynomial]) -> Polynomial:
        return sum(terms, self._context.constant(0))
