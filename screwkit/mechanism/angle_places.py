"""Whether angles stand where angles are asked for, and are such as can be turned by.

Lengths and coordinates are no angles, so that acos(x) alone is none of them; and an
angle is a sum of whole multiples of symbols, or nothing exact follows from it.
"""

from __future__ import annotations

from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.expression import Expression
from screwkit.algebra.survey import SurveyRing
from screwkit.errors import ExpressionError


def misplaced(expression: Expression, *, angle: bool) -> str:
    """Why an expression cannot stand where an angle, or a number, is asked for.

    Args:
        expression: What stands there.
        angle: Whether an angle is asked for, in radians.

    Returns:
        Empty where it can.
    """
    ring = SurveyRing()
    try:
        if angle:
            cosine_sine(expression, ring)
        else:
            evaluate(expression, ring)
    except ExpressionError as error:
        return str(error)
    return ""
