"""A rational function of one unknown from its values modulo a prime.

Cauchy interpolation: the polynomial with these values is divided into the polynomial
that vanishes at the places (Euclid's algorithm), half the way; what is found is
compared at further random places.

References: [vonzurGathenGerhard2013] §5.8.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

from flint import nmod, nmod_poly

from screwkit.algebra.common_root import interpolated

MOST = 512
"""Values from which one function is made, at most; it doubles."""

_FIRST = 6
_COMPARED = 2


class NoFractionError(Exception):
    """The degree is too high, or there are no values."""


def fraction_of(
    value: Callable[[Any], Any], source: random.Random, prime: int
) -> tuple[Any, Any]:
    """Numerator and denominator without a common divisor.

    Args:
        value: Of the function at a residue; None where it has none.
        source: Of the places at which the result is compared.
        prime: The modulus.

    Raises:
        NoFractionError: If none was found.
    """
    compared = list[tuple[Any, Any]]()
    missed = 0
    while len(compared) < _COMPARED:
        place = nmod(source.randrange(prime), prime)
        known = value(place)
        missed += known is None
        if missed > _FIRST:
            raise NoFractionError
        if known is not None:
            compared.append((place, known))
    if len({int(known) for _, known in compared}) == 1:
        return nmod_poly([int(compared[0][1])], prime), nmod_poly([1], prime)
    places, values = list[int](), list[int]()
    size, place_number = _FIRST, 0
    while size <= MOST:
        while len(places) < size:
            place_number += 1
            known = value(nmod(place_number, prime))
            if known is not None:
                places.append(place_number)
                values.append(int(known))
            elif place_number > 4 * MOST:
                raise NoFractionError
        above, below = _reconstructed(places, values, prime)
        if all(above(x) == below(x) * y and below(x) != 0 for x, y in compared):
            return above, below
        size *= 2
    raise NoFractionError


def _reconstructed(places: list[int], values: list[int], prime: int) -> tuple[Any, Any]:
    whole = nmod_poly([1], prime)
    for place in places:
        whole = whole * nmod_poly([-place, 1], prime)
    one = nmod_poly(interpolated(places, values, prime), prime)
    older, newer = nmod_poly([0], prime), nmod_poly([1], prime)
    while 2 * one.degree() >= len(places):
        quotient, rest = divmod(whole, one)
        whole, one = one, rest
        older, newer = newer, older - quotient * newer
    shared = one.gcd(newer)
    return one // shared, newer // shared
