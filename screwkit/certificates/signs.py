"""Expressions that vanish nowhere, by the signs of their terms.

A sum whose terms have one sign, one of them never zero, is never zero; even powers and
roots are never negative.  Of a polynomial in one symbol, or in sine and cosine of one
angle, with rational numbers, real zeros are counted.  No proof is found for anything
cleverer.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass
from fractions import Fraction

from screwkit.algebra.expression import (
    Call,
    Expression,
    Number,
    Pi,
    Product,
    Sum,
    Symbol,
)
from screwkit.algebra.sturm import real_zeros
from screwkit.algebra.written_terms import factors_of, terms_of
from screwkit.certificates.one_angle import is_never_zero
from screwkit.certificates.one_symbol import coefficients_of
from screwkit.mechanism.model import Mechanism


@dataclass(frozen=True)
class Signs:
    """What is taken for granted about symbols.

    Attributes:
        positive: Symbols that are > 0.
        nonzero: Symbols that are not 0.
    """

    positive: Collection[str]
    nonzero: Collection[str]

    def never_zero(self, expression: Expression) -> bool:
        """Whether a proof was found that the expression vanishes at no real values."""
        terms = [factors_of(term) for term in terms_of(expression)]
        common = terms[0][1]
        for _, factors in terms[1:]:
            common = common & factors
        if not all(self._of_atom(atom)[1] for atom in common):
            return False
        left = [(number, own - common) for number, own in terms]
        return self._sum(left)[1] or _keeps_its_sign(left)

    def _of_atom(self, atom: Expression) -> tuple[int, bool]:
        """(1 for ≥ 0, −1 for ≤ 0, 0 for unknown; whether it is never 0)."""
        match atom:
            case Symbol(name):
                if name in self.positive:
                    return 1, True
                return 0, name in self.nonzero
            case Pi():
                return 1, True
            case Call("sqrt", (radicand,)):
                return 1, self._of(radicand) == (1, True)
            case Call("cos", (Product((Number(turn), Pi())),)) if abs(turn) < Fraction(
                1, 2
            ):
                return 1, True
            case Sum():
                return self._of(atom)
            case _:
                return 0, False

    def _of(self, expression: Expression) -> tuple[int, bool]:
        return self._sum([factors_of(term) for term in terms_of(expression)])

    def _sum(
        self, terms: list[tuple[Fraction, Counter[Expression]]]
    ) -> tuple[int, bool]:
        total: tuple[int, bool] | None = None
        for number, factors in terms:
            if not number:
                continue
            sign, never = (1 if number > 0 else -1), True
            for atom, power in factors.items():
                own, strict = self._of_atom(atom)
                sign *= own if power % 2 else 1
                never = never and strict
            if total is None:
                total = sign, never
            elif not sign or sign != total[0]:
                return 0, False
            else:
                total = sign, total[1] or never
        return total or (0, False)


def _keeps_its_sign(terms: list[tuple[Fraction, Counter[Expression]]]) -> bool:
    """Whether a sum is a polynomial in one symbol, or angle, without a real zero."""
    if is_never_zero(terms):
        return True
    found = coefficients_of(terms)
    return found is not None and any(found) and not real_zeros(found)


def declared_signs(mechanism: Mechanism) -> tuple[set[str], set[str]]:
    """Symbols that a file declares to be positive, and those that are not 0."""
    own = mechanism.parameters
    positive = {p.name for p in own if p.positive}
    return positive, positive | {p.name for p in own if p.nonzero}
