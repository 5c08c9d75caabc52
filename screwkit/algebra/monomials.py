"""Exponents of monomials, and polynomials modulo a prime by them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

Exponents: TypeAlias = tuple[int, ...]
Terms: TypeAlias = Mapping[Exponents, int]
"""A polynomial: residues by exponents; never empty, and none of them 0."""


def monomials(count: int, degree: int) -> list[Exponents]:
    """All exponents of at most a degree, those of large degree first."""
    found: list[list[Exponents]] = [[(0,) * count]]
    for _ in range(degree):
        higher = dict.fromkeys(
            times(m, unit(k, count)) for m in found[-1] for k in range(count)
        )
        found.append(sorted(higher, reverse=True))
    return [monomial for level in reversed(found) for monomial in level]


def unit(number: int, count: int) -> Exponents:
    """A variable, as a monomial."""
    return tuple(int(k == number) for k in range(count))


def times(one: Exponents, other: Exponents) -> Exponents:
    """The product of two monomials."""
    return tuple(map(int.__add__, one, other))


def multiple(terms: Terms, monomial: Exponents) -> Terms:
    """A polynomial times a monomial."""
    return {times(own, monomial): value for own, value in terms.items()}


def degree_of(terms: Terms) -> int:
    """The largest degree of a monomial in it."""
    return max(map(sum, terms))


def raised(rows: Sequence[Terms], units: Sequence[Exponents]) -> list[Terms]:
    """Every polynomial times every variable."""
    return [multiple(row, own) for row in rows for own in units]
