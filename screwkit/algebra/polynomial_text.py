"""Exact polynomials as text of the expression grammar, straight from FLINT.

Terms are ordered by degree and then by their symbols, r3 before d3, as the literature
tends to write; within a term come the number, constants, lengths, and the cosines and
sines in the order of the joints.  Angles are merged first (`angles`).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from operator import itemgetter
from weakref import WeakKeyDictionary

from screwkit.algebra.angles import Form, Merged, merged, natural
from screwkit.algebra.expression import Expression
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.algebra.text import expression_text
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
)


def text(ring: TrigonometricRing, polynomial: Polynomial) -> str:
    """A polynomial in normal form, sign included: ``2*r1*cos(q2) + d3``."""
    if polynomial == 0:
        return "0"
    return _printer(ring).text(polynomial, sign_matters=True)


def equation_text(ring: TrigonometricRing, polynomial: Polynomial) -> str:
    """The left side of ``polynomial = 0``: up to a sign, so that the first is plus."""
    return _printer(ring).text(polynomial, sign_matters=False)


def merged_text(ring: TrigonometricRing, polynomial: Merged) -> str:
    """A polynomial as it stands in merged angles, sign included."""
    return _printer(ring).write(polynomial, sign_matters=True)


def to_expression(ring: TrigonometricRing, polynomial: Polynomial) -> Expression:
    """A polynomial in normal form as an expression."""
    return parse(text(ring, polynomial), limits=RESULT_LIMITS)


class PolynomialPrinter:
    """Writes polynomials of one ring and remembers what it has written."""

    def __init__(self, ring: TrigonometricRing) -> None:
        self._ring = ring
        self._written: dict[tuple[str, bool], str] = {}
        count = len(ring.basis)
        self._constants = [ring.names.index(name) for name in ring.constant_generators]
        self._names = [""] * len(ring.names)
        for name, written in ring.constant_generators.items():
            self._names[ring.names.index(name)] = written
        for extension in ring.extensions:
            inside = expression_text(extension.of)
            self._names[ring.names.index(extension.name)] = (
                f"sqrt({inside})" if extension.kind == "root" else f"({inside})^(-1)"
            )
        symbols = sorted(
            zip(ring.symbol_indices(), ring.symbols, strict=True),
            key=lambda pair: _length_order(pair[1]),
        )
        for place, name in symbols:
            self._names[place] = name
        self._fixed = [
            *self._constants,
            *(place for place, _ in symbols),
            *range(len(ring.extensions)),
        ]
        self._angles = [
            (ring.sine_index(i), ring.cosine_index(i)) for i in range(count)
        ]

    def text(self, polynomial: Polynomial, sign_matters: bool) -> str:
        """See `text` and `equation_text`."""
        if polynomial.is_constant():
            return str(as_fraction(polynomial))
        key = str(polynomial), sign_matters
        if key not in self._written:
            short = merged(self._ring, polynomial)
            self._written[key] = self.write(short, sign_matters)
        return self._written[key]

    def write(self, short: Merged, sign_matters: bool) -> str:
        """A polynomial in the angles it is given in."""
        value = short.polynomial
        if value.is_constant():
            return str(as_fraction(value))
        degrees = value.degrees()
        names = list(self._names)
        angles = [
            i for i, (s, c) in enumerate(self._angles) if degrees[s] or degrees[c]
        ]
        angles.sort(key=lambda i: _angle_order(short.forms[i]))
        order = [place for place in self._fixed if degrees[place]]
        for i in angles:
            argument = angle_text(short.forms[i])
            sine, cosine = self._angles[i]
            if i in short.exchanged:
                sine, cosine = cosine, sine
            names[cosine], names[sine] = f"cos({argument})", f"sin({argument})"
            order += [place for place in (cosine, sine) if degrees[place]]
        return self._sum(value, order, names, sign_matters)

    def _sum(
        self,
        polynomial: Polynomial,
        order: Sequence[int],
        names: Sequence[str],
        sign_matters: bool,
    ) -> str:
        chosen = itemgetter(*order, order[0])  # repeated: always a tuple
        skipped = sum(place in self._constants for place in order)
        bounds = polynomial.degrees()
        powers = [
            ["", names[place]]
            + [_power(names[place], e) for e in range(2, int(bounds[place]) + 1)]
            for place in order
        ]
        terms = []
        for monomial, coefficient in zip(
            polynomial.monoms(), polynomial.coeffs(), strict=True
        ):
            exponents = list(map(int, chosen(monomial)))
            exponents.pop()
            free = exponents[skipped:] if skipped else exponents
            terms.append((sum(free), free, exponents, coefficient))
        terms.sort(key=itemgetter(0, 1, 2), reverse=True)
        flip = not sign_matters and terms[0][3] < 0
        pieces = []
        for _, _, exponents, coefficient in terms:
            factors = [
                texts[e] for texts, e in zip(powers, exponents, strict=True) if e
            ]
            if skipped > 1:
                factors = _roots_joined(factors)
            numerator, denominator = int(coefficient.p), int(coefficient.q)
            negative = (numerator < 0) != flip
            if abs(numerator) != 1 or not factors:
                factors.insert(0, str(abs(numerator)))
            term = "*".join(factors)
            if denominator != 1:
                term += f"/{denominator}"
            pieces.append((" - " if negative else " + ") + term)
        joined = "".join(pieces)
        return joined[3:] if joined.startswith(" + ") else f"-{joined[3:]}"


def angle_text(form: Form) -> str:
    """``q6 - q1``."""
    pieces = []
    for name, count in form:
        size = "" if abs(count) == 1 else f"{abs(count)}*"
        pieces.append(f"{' - ' if count < 0 else ' + '}{size}{name}")
    joined = "".join(pieces)
    return joined[3:] if joined.startswith(" + ") else f"-{joined[3:]}"


def _roots_joined(factors: list[str]) -> list[str]:
    """``sqrt(10)`` for ``sqrt(2)``, ``sqrt(5)``, in front of all others.

    >>> _roots_joined(["sqrt(2)", "sqrt(5)", "x"])
    ['sqrt(10)', 'x']
    """
    inside = [own[5:-1] for own in factors if own.startswith("sqrt(")]
    numbers = [int(own) for own in inside if own.isdecimal()]
    if len(numbers) < 2:
        return factors
    roots = {f"sqrt({number})" for number in numbers}
    return [f"sqrt({prod(numbers)})", *(own for own in factors if own not in roots)]


def _power(name: str, exponent: int) -> str:
    return f"({name})^{exponent}" if "*" in name[:2] else f"{name}^{exponent}"


def _length_order(name: str) -> tuple[bool, tuple[int, ...], object]:
    """Numbered lengths first, letters from z to a: r1, r3, d3; then x, y, z."""
    letters = name.rstrip("0123456789_")
    if letters == name:
        return True, (), name
    return False, tuple(-ord(letter) for letter in letters), natural(name)


def _angle_order(form: Form) -> tuple[int, object]:
    """Single angles in the order of their names, then sums."""
    return len(form), [natural(name) for name, _ in form]


_PRINTERS: WeakKeyDictionary[TrigonometricRing, PolynomialPrinter] = WeakKeyDictionary()


def _printer(ring: TrigonometricRing) -> PolynomialPrinter:
    printer = _PRINTERS.get(ring)
    if printer is None:
        printer = _PRINTERS[ring] = PolynomialPrinter(ring)
    return printer
