"""The ends of ranges, as they are written on the command line."""

from __future__ import annotations

from screwkit.algebra.batch import BatchRing
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.errors import ExpressionError


def end_of_range(part: str, text: str) -> float:
    """A number of a range.

    Args:
        part: The number, an expression of constants.
        text: The whole range, for the refusal.

    Raises:
        ExpressionError: If it is no number.
    """
    try:
        return float(evaluate(parse(part, ()), BatchRing({})))
    except ExpressionError as error:
        raise ExpressionError(f"{text!r}: {error}; the ends are numbers") from None
