"""Which multiple of a projective column is the shortest to write.

A column may be multiplied by any constant of the field that the geometry contains.  The
inverses of its own coefficients are tried, since one of them becomes 1 and what all
share goes away; rational factors are left out of every one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import product
from math import gcd, lcm

from flint import arb, ctx, fmpq, fmpq_mat

from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    content,
    primitive,
)

TRIED = 24
"""Coefficients whose inverses are tried."""

Column = tuple[Polynomial, ...]


def shortest_multiple(ring: TrigonometricRing, column: Sequence[Polynomial]) -> Column:
    """The column times a positive constant, with coprime integer coefficients.

    Args:
        ring: Of the entries, in normal form.
        column: Not all zero.

    Returns:
        The multiple by a number of the field with the fewest terms and digits.
    """
    plain = integral(ring, column)
    found = [plain]
    for coefficient in _irrational(ring, plain):
        factor = inverse(ring, coefficient)
        if sign(ring, coefficient) < 0:
            factor = -factor
        found.append(integral(ring, [ring.normal(factor * value) for value in plain]))
    if len(found) == 1:
        return plain
    places = list(_degrees(ring))
    return min(found, key=lambda multiple: _length(multiple, places))


def condition_key(ring: TrigonometricRing, value: Polynomial) -> str:
    """The same text for all multiples of a polynomial by numbers of the field.

    Args:
        ring: Of the polynomial, which is in normal form and not zero.
        value: Its coefficient before the first monomial becomes 1, up to a rational.
    """
    places = list(_degrees(ring))
    if any(value.degrees()[i] > 0 for i in places):
        first = _coefficients(ring, value, places)[0]
        if not first.is_constant():
            value = ring.normal(inverse(ring, first) * value)
    return str(primitive(value))


def is_number(ring: TrigonometricRing, value: Polynomial) -> bool:
    """Whether a polynomial is a number of the constant field."""
    places = _degrees(ring)
    degrees = enumerate(value.degrees())
    return not any(degree > 0 for place, degree in degrees if place not in places)


def sign(ring: TrigonometricRing, number: Polynomial) -> int:
    """−1, 0 or 1: proved by interval arithmetic, fine enough in the end."""
    if number == 0:
        return 0
    bits = 64
    while True:
        with ctx.workprec(bits):
            value = ball(ring, number)
            if value > 0 or value < 0:
                return 1 if value > 0 else -1
        bits *= 2


def ball(ring: TrigonometricRing, number: Polynomial) -> arb:
    """A number of the field at the working precision."""
    values = {}
    for name, written in ring.constant_generators.items():
        if name == "z":
            turn = int(written.removeprefix("2*cos(pi/").removesuffix(")"))
            values[ring.names.index(name)] = 2 * arb.cos_pi_fmpq(fmpq(1, turn))
        else:
            values[ring.names.index(name)] = arb(int(name[1:])).sqrt()
    total = arb(0)
    for exponents, coefficient in number.to_dict().items():
        term = arb(coefficient)
        for place, value in values.items():
            term *= value ** int(exponents[place])
        total += term
    return total


def _degrees(ring: TrigonometricRing) -> dict[int, int]:
    """The degree of each generator of the constant field, by its place."""
    return {
        place: len(polynomial) - 1
        for place, polynomial in ring.algebraic_relations
        if isinstance(polynomial, tuple)
    }


def integral(ring: TrigonometricRing, column: Sequence[Polynomial]) -> Column:
    """A positive rational multiple with integer coefficients without common factor."""
    contents = [content(value) for value in column if value != 0]
    above = reduce(gcd, (abs(int(c.p)) for c in contents))
    below = reduce(lcm, (int(c.q) for c in contents))
    scale = ring.context.constant(fmpq(below, above))
    return tuple(value * scale for value in column)


def _length(column: Column, places: Sequence[int]) -> tuple[int, int, int]:
    """Terms, those that are irrational, and the size of the coefficients."""
    terms = [term for value in column for term in value.to_dict().items()]
    return (
        len(terms),
        sum(any(exponents[i] for i in places) for exponents, _ in terms),
        sum(abs(int(coefficient.p)) for _, coefficient in terms),
    )


def _irrational(ring: TrigonometricRing, column: Column) -> Iterator[Polynomial]:
    """The irrational coefficients of a column, each once."""
    places = list(_degrees(ring))
    if not any(value.degrees()[i] for value in column for i in places if value != 0):
        return
    seen: set[str] = set()
    for value in column:
        for coefficient in _coefficients(ring, value, places):
            key = str(coefficient)
            if not coefficient.is_constant() and key not in seen and len(seen) < TRIED:
                seen.add(key)
                yield coefficient


def _coefficients(
    ring: TrigonometricRing, value: Polynomial, places: Sequence[int]
) -> list[Polynomial]:
    """The factors in the constants before each monomial in everything else."""
    parts: dict[tuple[int, ...], dict[tuple[int, ...], fmpq]] = {}
    for exponents, coefficient in value.to_dict().items():
        own = tuple(int(e) if i in places else 0 for i, e in enumerate(exponents))
        rest = tuple(int(e) - o for e, o in zip(exponents, own, strict=True))
        parts.setdefault(rest, {})[own] = coefficient
    return [ring.context.from_dict(terms) for terms in parts.values()]


def inverse(ring: TrigonometricRing, number: Polynomial) -> Polynomial:
    """1/number for a number of the constant field that is not zero.

    The products of powers of the generators are a basis of the field over the
    rationals; the inverse solves a linear system in it.
    """
    degrees = _degrees(ring)
    powers = [
        dict(zip(degrees, chosen, strict=True))
        for chosen in product(*(range(degree) for degree in degrees.values()))
    ]
    keys = [tuple(p.get(i, 0) for i in range(len(ring.names))) for p in powers]
    basis = [ring.context.from_dict({key: fmpq(1)}) for key in keys]
    rows = [ring.normal(number * unit).to_dict() for unit in basis]
    size = len(basis)
    # Column j holds number · basis j in the basis.
    matrix = fmpq_mat(
        size, size, [rows[j].get(k, 0) for k in keys for j in range(size)]
    )
    one = [int(not any(key)) for key in keys]
    solved = matrix.solve(fmpq_mat(size, 1, one))
    return sum((solved[j, 0] * unit for j, unit in enumerate(basis)), ring.zero)
