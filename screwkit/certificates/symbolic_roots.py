"""What a condition with the geometry's own square roots says without them.

A·√R + B = 0 times A·√R − B is A²·R − B² = 0, which is a product more often.  Where B is
a multiple of another condition, A·R = 0 is left.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from screwkit.algebra.branches import Branch, Pending
from screwkit.algebra.factors import Factor
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.certificates.conditions import Conditions, Place
from screwkit.certificates.equations_told import Multiple
from screwkit.certificates.steps import added, followed
from screwkit.certificates.sums import Sum

LONGEST = 4_000
"""Terms of a part of the product."""


class _Rooted(NamedTuple):
    """A·w + B, where w is the symbolic root of R, of an unsolved condition."""

    pending: Pending
    root: Polynomial
    square: Polynomial
    odd: Polynomial
    even: Polynomial


def rootless_condition(known: Conditions, place: Place) -> Sum | None:
    """A sum of multiples of conditions without a root they have; None if not found.

    Sums that say nothing new are left out.
    """
    branch = place.branch
    held = {str(primitive(pending.value)) for pending in branch.pending}
    for rooted in _rooted(branch):
        found = _reduced(known, place, rooted) or _norm(known, place, rooted)
        if found is not None and not any(
            str(primitive(own.equations[0])) in held for own, _ in found.factors
        ):
            return found
    return None


def _rooted(branch: Branch) -> list[_Rooted]:
    ring = branch.ring
    return [
        _Rooted(pending, ring.generator(name), inside, odd, even)
        for pending in branch.pending
        for name, inside in ring.radicands.items()
        if pending.value.degrees()[ring.names.index(name)]
        for odd, even in [_parts(ring, pending.value, ring.names.index(name), inside)]
        if odd != 0
    ]


def _reduced(known: Conditions, place: Place, own: _Rooted) -> Sum | None:
    """A·R = 0, where B is 0 or a multiple of another condition."""
    ring = place.branch.ring
    (square,), scale = ring.cleared([own.square])
    times = ring.normal(own.root * scale)
    terms = [_term(place, own.pending, times)]
    if own.even != 0:
        for other in place.branch.pending:
            quotient = known.quotient(own.even, other.value)
            if other != own.pending and quotient is not None:
                terms.append(_term(place, other, ring.normal(-quotient * times)))
                break
        else:
            return None
    return _product(known, place, terms, [own.odd, square])


def _norm(known: Conditions, place: Place, own: _Rooted) -> Sum | None:
    """A²·R − B² = 0."""
    ring = place.branch.ring
    value = own.odd * own.odd * own.square - own.even * own.even
    (whole,), scale = ring.cleared([ring.normal(value)])
    times = ring.normal((own.odd * own.root - own.even) * scale)
    return _product(known, place, [_term(place, own.pending, times)], [whole])


def _product(
    known: Conditions,
    place: Place,
    terms: Sequence[Multiple],
    parts: Sequence[Polynomial],
) -> Sum | None:
    """The sum, its parts followed to the place."""
    followed_parts = [followed(place.branch, [part]) for part in parts]
    if any(part == 0 for (part,), _ in followed_parts):
        return None
    factors: list[tuple[Factor, int]] | None = known.product(
        place.branch, [(part, 1) for (part,), _ in followed_parts], LONGEST
    )
    if not factors:
        return None
    over = [powers for _, powers in followed_parts]
    scaled = (replace(own, over=added(own.over, *over)) for own in terms)
    return Sum(tuple(scaled), tuple(factors))


def _term(place: Place, pending: Pending, times: Polynomial) -> Multiple:
    """An unsolved condition times something."""
    branch, index = place.branch, place.number(pending)
    _, over = followed(branch, [place.conditions[index]])
    return Multiple(-1, index, text(branch.ring, times), over)


def _parts(
    ring: TrigonometricRing, value: Polynomial, index: int, inside: Polynomial
) -> tuple[Polynomial, Polynomial]:
    """(A, B) of A·w + B, where w² is a polynomial."""
    parts = [ring.zero, ring.zero]
    for exponents, coefficient in value.to_dict().items():
        power = int(exponents[index])
        rest = tuple(0 if i == index else e for i, e in enumerate(exponents))
        term = ring.context.from_dict({rest: coefficient}) * inside ** (power // 2)
        parts[power % 2] += term
    return ring.normal(parts[1]), ring.normal(parts[0])
