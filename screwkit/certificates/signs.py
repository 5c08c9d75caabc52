"""Expressions that vanish nowhere, by the signs of their terms.

A sum whose terms have one sign, one of them never zero, is never zero; even powers and
roots are never negative.  Nor is one whose terms without angles outweigh all others, as
sines and cosines are at most 1, or e + a·sin φ + b·cos φ with e² > a² + b².  Of a
polynomial in one symbol, or in sine and cosine of one angle, with rational numbers,
real zeros are counted.  No proof is found for anything cleverer.
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

_Term = tuple[Fraction, Counter[Expression]]


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
        if self._sum(left)[1] or _keeps_its_sign(left):
            return True
        return bool(self._sign_of_the_rest(left)) or self._is_out_of_reach(left)

    def positive_everywhere(self, expression: Expression) -> bool:
        """Whether a proof was found that the expression is positive, by its terms."""
        return self._of(expression) == (1, True)

    def _sign_of_the_rest(self, terms: list[_Term]) -> int:
        """Of the terms without angles if they outweigh all others, or else 0."""
        still, others = list[_Term](), list[_Term]()
        for number, factors in terms:
            rest = Counter({a: n for a, n in factors.items() if not self._turns(a)})
            if rest == factors:
                still.append((number, rest))
                continue
            sign, _ = self._sum([(number, rest)])
            if not sign:
                return 0
            others.append((-sign * number, rest))
        sign, _ = self._sum(still)
        left = _merged([(sign * number, factors) for number, factors in still] + others)
        return sign if sign and self._sum(left) == (1, True) else 0

    def _is_out_of_reach(self, terms: list[_Term]) -> bool:
        """Whether e² > a² + b² is seen, of the sine and the cosine of one angle."""
        atoms = {atom for _, factors in terms for atom in factors if self._turns(atom)}
        for angle in {a.arguments for a in atoms if isinstance(a, Call)}:
            pair = [Call("sin", angle), Call("cos", angle)]
            if any(sum(factors[a] for a in pair) > 1 for _, factors in terms):
                continue
            squares = list[_Term]()
            for atom in (None, *pair):
                own = [
                    (number, factors - Counter({atom: 1}) if atom else factors)
                    for number, factors in terms
                    if (factors[atom] if atom else not any(factors[a] for a in pair))
                ]
                sign = -1 if atom else 1
                squares += [(sign * m * n, f + g) for m, f in own for n, g in own]
            beyond = _merged(squares)
            if self._sign_of_the_rest(beyond) == 1:
                return True
            # In one angle: its sign is that at the angle 0.
            at_zero = sum(n for n, f in beyond if all(_is_cosine(atom) for atom in f))
            if at_zero > 0 and is_never_zero(beyond):
                return True
        return False

    def _turns(self, atom: Expression) -> bool:
        """Whether it is a sine or cosine of no known sign."""
        if not isinstance(atom, Call) or atom.function not in ("sin", "cos"):
            return False
        return self._of_atom(atom) == (0, False)

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

    def _sum(self, terms: list[_Term]) -> tuple[int, bool]:
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


def _merged(terms: list[_Term]) -> list[_Term]:
    """Terms of different factors, none of them zero."""
    total: dict[frozenset[tuple[Expression, int]], Fraction] = {}
    for number, factors in terms:
        key = frozenset(factors.items())
        total[key] = total.get(key, Fraction(0)) + number
    return [(number, Counter(dict(key))) for key, number in total.items() if number]


def _is_cosine(atom: Expression) -> bool:
    return isinstance(atom, Call) and atom.function == "cos"


def _keeps_its_sign(terms: list[_Term]) -> bool:
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
