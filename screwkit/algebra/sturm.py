"""How many real zeros a polynomial in one unknown has, by Sturm's theorem.

References: [BasuPollackRoy2006] §2.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise


def real_zeros(coefficients: Sequence[Fraction]) -> int:
    """The number of different real zeros.

    Args:
        coefficients: Of 1, x, x² …; not all zero.

    Raises:
        ValueError: If all are zero.
    """
    first = _trimmed(coefficients)
    if not first:
        raise ValueError("every number is a zero of 0")
    chain = [first, _trimmed([k * c for k, c in enumerate(first)][1:])]
    while chain[-1]:
        chain.append([-c for c in _remainder(chain[-2], chain[-1])])
    chain.pop()
    above = [own[-1] > 0 for own in chain]
    below = [(own[-1] > 0) == (len(own) % 2 == 1) for own in chain]
    return _changes(below) - _changes(above)


def _trimmed(coefficients: Sequence[Fraction]) -> list[Fraction]:
    found = list(coefficients)
    while found and not found[-1]:
        found.pop()
    return found


def _remainder(above: Sequence[Fraction], below: Sequence[Fraction]) -> list[Fraction]:
    left = list(above)
    while len(left) >= len(below):
        factor = left[-1] / below[-1]
        shift = len(left) - len(below)
        for k, c in enumerate(below):
            left[shift + k] -= factor * c
        left = _trimmed(left[:-1])
    return left


def _changes(signs: Sequence[bool]) -> int:
    return sum(one != other for one, other in pairwise(signs))
