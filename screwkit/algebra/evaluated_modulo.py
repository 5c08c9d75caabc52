"""Long expressions evaluated modulo a prime, again and again, at little cost.

An expression is laid out once as sums of monomials in what is no sum, product or power;
nothing is multiplied out.  At a point these atoms are evaluated as everywhere else, and
the rest is arithmetic of integers, FLINT's where the same sum is met again and again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Final

from flint import Ordering, nmod_mpoly_ctx

from screwkit.algebra.all_roots import RootValue
from screwkit.algebra.expression import Expression, Sum
from screwkit.algebra.written_terms import factors_of, terms_of

_Slot = tuple[Expression, int]
_SHORT: Final = 6
"""Monomials that are not worth a polynomial of FLINT."""
_OFTEN: Final = 3
"""Values after which such a polynomial is made."""


@dataclass(frozen=True)
class Layout:
    """An expression as a sum of monomials in the powers of its atoms.

    Attributes:
        slots: Atoms with powers; an atom that is a sum has a layout of its own.
        monomials: Coefficients, and the numbers of the slots that are multiplied.
        inner: Layouts of the slots that are sums, by number.
        residues: Of the coefficients, by prime.
        polynomials: The sum as FLINT's polynomial in the slots, by prime; before it is
            made, how often the sum was met.
    """

    slots: tuple[_Slot, ...]
    monomials: tuple[tuple[Fraction, tuple[int, ...]], ...]
    inner: Mapping[int, Layout]
    residues: dict[int, list[int]] = field(default_factory=dict, compare=False)
    polynomials: dict[int, Any] = field(default_factory=dict, compare=False)

    def at(self, prime: int, atom: Callable[[Expression], Any]) -> Any:
        """The value, where atoms have these values: an integer, or at roots."""
        values, at_roots = list[int](), dict[int, RootValue]()
        for number, (own, power) in enumerate(self.slots):
            inner = self.inner.get(number)
            value = atom(own) if inner is None else inner.at(prime, atom)
            if isinstance(value, RootValue):
                at_roots[number] = value**power
                values.append(1)
            else:
                value = int(value)
                values.append(value if power == 1 else pow(value, power, prime))
        if not at_roots and len(self.monomials) > _SHORT:
            made = self.polynomials.get(prime, 0)
            if not isinstance(made, int):
                return int(made(*values))
            self.polynomials[prime] = made + 1
            if made == _OFTEN:
                self.polynomials[prime] = self._polynomial(prime)
        return self._summed(prime, values, at_roots)

    def _summed(
        self, prime: int, values: Sequence[int], at_roots: Mapping[int, RootValue]
    ) -> Any:
        """The sum, where the slots have these values."""
        if prime not in self.residues:
            self.residues[prime] = [
                c.numerator * pow(c.denominator, -1, prime) % prime
                for c, _ in self.monomials
            ]
        totals = dict[tuple[int, ...], int]()
        total = 0
        for number, (_, factors) in zip(
            self.residues[prime], self.monomials, strict=True
        ):
            product = number
            for slot in factors:
                product = product * values[slot] % prime
            if at_roots:
                found = tuple(slot for slot in factors if slot in at_roots)
                totals[found] = totals.get(found, 0) + product
            else:
                total += product
        if not at_roots:
            return total % prime
        return sum(
            (_times(own, [at_roots[k] for k in found]) for found, own in totals.items())
        )

    def _polynomial(self, prime: int) -> Any:
        """The sum with a variable for every slot."""
        width = len(self.slots)
        names = tuple(f"x{number}" for number in range(width))
        terms = dict[tuple[int, ...], int]()
        for residue, (_, factors) in zip(
            self.residues[prime], self.monomials, strict=True
        ):
            exponents = [0] * width
            for slot in factors:
                exponents[slot] += 1
            key = tuple(exponents)
            terms[key] = (terms.get(key, 0) + residue) % prime
        return nmod_mpoly_ctx.get(names, prime, Ordering.lex).from_dict(terms)


def _times(number: int, values: Sequence[RootValue]) -> Any:
    product: Any = number
    for value in values:
        product = value * product
    return product


def laid_out(expression: Expression) -> Layout:
    """The layout of an expression."""
    slots: dict[_Slot, int] = {}
    monomials = []
    for term in terms_of(expression):
        number, powers = factors_of(term)
        own = [slots.setdefault(slot, len(slots)) for slot in powers.items()]
        monomials.append((number, tuple(own)))
    inner = {
        number: laid_out(atom)
        for (atom, _), number in slots.items()
        if isinstance(atom, Sum)
    }
    return Layout(tuple(slots), tuple(monomials), inner)
