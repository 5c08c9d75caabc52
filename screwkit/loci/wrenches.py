"""The wrench reciprocal to five twists, as a vector of polynomials.

Signed minors give it without division; a common factor is taken out.  It then stays
reciprocal everywhere by continuity, and is zero nowhere where the five twists are
independent.

References: [LongCaroKhalil2012] (26), (31).
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.minors import complement_sign, minors_of
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.conventions import DIRECTION, MOMENT


def null_wrench(
    ring: TrigonometricRing, twists: Sequence[Sequence[Polynomial]]
) -> list[Polynomial]:
    """(f; m) with f·v + m·ω = 0 for each of five independent twists (ω; v)."""
    minors = minors_of(ring, twists)
    full = 63
    form: list[Polynomial] = []
    for row in range(6):
        value: Polynomial = minors.get(full ^ 1 << row, ring.zero)
        if complement_sign(1 << row, 6) < 0:
            value = -value
        form.append(value)
    return reduced(ring, [*form[MOMENT], *form[DIRECTION]])


def reduced(ring: TrigonometricRing, vector: Sequence[Polynomial]) -> list[Polynomial]:
    """The vector divided by the greatest common factor of its entries."""
    common = None
    for value in vector:
        if value != 0:
            common = value if common is None else common.gcd(value)
    if common is None:
        return list(vector)
    divided = [value / common for value in vector]
    first = next(value for value in divided if value != 0)
    scale = primitive(first)
    ratio = scale.coeffs()[0] / first.coeffs()[0]
    if len({str(v) for v in divided}) == 1:
        return divided
    return [ring.normal(value * ratio) if ratio < 0 else value for value in divided]
