"""A common root of two conditions in two unknowns, modulo a prime.

One unknown is eliminated by a resultant that is interpolated from its values; the other
is then a root of a common factor [CoxLittleOShea §3.6].
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from typing import TypeAlias

from flint import nmod_poly

Restricted: TypeAlias = Callable[[int], tuple[Sequence[int], Sequence[int]] | None]
"""Coefficients of two conditions in the second unknown, at a value of the first."""

DEGREE = 160
"""Of the resultants that are looked at."""


def common_root(
    restricted: Restricted, degree: int, source: random.Random, prime: int
) -> tuple[int, int] | None:
    """Values of both unknowns; None where none were found.

    Args:
        restricted: None where the first unknown cannot have that value.
        degree: Of the resultant, at most.
        source: Chooses among several roots.
        prime: The modulus.
    """
    if degree > DEGREE:
        return None
    places, values = list[int](), list[int]()
    candidate = 0
    while len(places) <= degree:
        candidate += 1
        pair = restricted(candidate)
        if pair is not None:
            one, two = (nmod_poly([int(c) for c in own], prime) for own in pair)
            places.append(candidate)
            values.append(int(one.resultant(two)))
    eliminant = nmod_poly(interpolated(places, values, prime), prime)
    if eliminant == 0:
        return None
    roots = [int(root) for root, _ in eliminant.roots()]
    source.shuffle(roots)
    for first in roots:
        pair = restricted(first)
        if pair is None:
            continue
        one, two = (nmod_poly([int(c) for c in own], prime) for own in pair)
        shared = one.gcd(two)
        if shared.degree() < 1:
            continue
        others = [int(root) for root, _ in shared.roots()]
        if others:
            return first, source.choice(others)
    return None


def interpolated(places: Sequence[int], values: Sequence[int], prime: int) -> list[int]:
    """Coefficients of the polynomial with these values, by divided differences."""
    table = [int(value) for value in values]
    inverses = dict[int, int]()  # places are near each other: few steps are different
    for order in range(1, len(table)):
        for k in range(len(table) - 1, order - 1, -1):
            step = places[k] - places[k - order]
            inverse = inverses.get(step)
            if inverse is None:
                inverse = inverses[step] = pow(step, -1, prime)
            table[k] = (table[k] - table[k - 1]) * inverse % prime
    total = nmod_poly([0], prime)
    for place, value in zip(reversed(places), reversed(table), strict=True):
        total = total * nmod_poly([-place, 1], prime) + nmod_poly([value], prime)
    return [int(c) for c in total.coeffs()]
