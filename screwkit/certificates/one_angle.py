"""Expressions that are polynomials in sine and cosine of one angle, in numbers.

References: [CoxLittleOShea] §1.3 (the circle by the tangent of half an angle).
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

from screwkit.algebra.expression import Call, Expression
from screwkit.algebra.sturm import real_zeros

_DEGREE = 40

_Coefficients = list[Fraction]


def is_never_zero(terms: list[tuple[Fraction, Counter[Expression]]]) -> bool:
    """Whether terms are such a polynomial, and it has no zero on the circle.

    Args:
        terms: The number and the powers of each.
    """
    found = _in_tangent(terms)
    # The last coefficient belongs to the angle π, which has no tangent.
    return found is not None and found[-1] != 0 and not real_zeros(found)


def _in_tangent(
    terms: list[tuple[Fraction, Counter[Expression]]],
) -> _Coefficients | None:
    """Coefficients in the tangent t of half the angle, times a power of 1 + t²."""
    atoms = {atom for _, powers in terms for atom in powers}
    angles = set()
    for atom in atoms:
        if not isinstance(atom, Call) or atom.function not in ("sin", "cos"):
            return None
        angles.add(atom.arguments)
    degree = max((powers.total() for _, powers in terms), default=0)
    if len(angles) != 1 or degree > _DEGREE:
        return None
    factors = {"sin": [0, 2, 0], "cos": [1, 0, -1]}
    total = [Fraction(0)] * (2 * degree + 1)
    for number, powers in terms:
        own = [number]
        for atom, power in powers.items():
            if isinstance(atom, Call):
                for _ in range(power):
                    own = _times(own, factors[atom.function])
        for _ in range(degree - powers.total()):
            own = _times(own, [1, 0, 1])
        total = [a + b for a, b in zip(total, own, strict=True)]
    return total


def _times(one: _Coefficients, other: list[int]) -> _Coefficients:
    found = [Fraction(0)] * (len(one) + len(other) - 1)
    for i, a in enumerate(one):
        for k, b in enumerate(other):
            found[i + k] += a * b
    return found
