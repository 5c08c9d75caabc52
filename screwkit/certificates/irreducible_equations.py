"""Whether an equation is no product: of polynomials in symbols, sines and cosines.

In the tangent of half an angle such a polynomial has even degree.  So one that is
linear in sine and cosine of an angle, or in a symbol, splits only into a factor that
lacks it and another; common divisors show whether there is such a factor.  For higher
degrees the equation is restricted to one unknown at random values of the others, and
the degrees of its factors there leave no room for a product.

References: [CoxLittleOShea] §3.5 (Gauss's lemma); docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

from enum import Enum

from screwkit.algebra.factor_degrees import factor_degrees, sums_of
from screwkit.certificates.postures import Way
from screwkit.certificates.sheets import Sheets

TRIED = 24
"""Random restrictions to one unknown."""


class Shape(Enum):
    """What is known of an equation."""

    IRREDUCIBLE = "no product"
    PRODUCT = "a product"
    UNKNOWN = "perhaps a product"


def shape_of(sheets: Sheets, text: str, way: Way | None = None) -> Shape:
    """What common divisors and restrictions say about an equation.

    Args:
        sheets: Restrict expressions of one part of a certificate.
        text: The left side of the equation.
        way: Its steps are followed before; its conditions are not asked for.

    Raises:
        RefusedError: If it has too high a degree.
    """
    way = way or Way()
    met = sheets.meeting_all(way, text)
    if len(met) != 1:
        return Shape.PRODUCT if met else Shape.UNKNOWN
    _, unknown, numerator = met[0]
    # What steps divide by may have taken a factor of odd degree away.
    step = 1 if isinstance(unknown, str) or way.steps else 2
    degree = numerator.degree()
    possible = {*range(0, degree + 1, step)}
    for _ in range(TRIED):
        if possible == {0, degree}:
            return Shape.IRREDUCIBLE
        found = factor_degrees(numerator)
        if found is not None and sum(found) == degree:
            possible &= sums_of(found)
        there = sheets.restricted(way, text, sheets.postures.another(), [unknown])
        numerator = there.get(unknown, numerator)
    return Shape.UNKNOWN
