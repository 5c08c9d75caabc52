"""The texts of a certificate are polynomials, and scales vanish at no posture.

By a quotient anything would be a multiple of anything: x = (x/y)·y holds at random
postures, and says nothing where y = 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from itertools import product
from typing import Any

from screwkit.algebra.expression import Call, Expression, Power, Quotient
from screwkit.algebra.expression_building import children, symbols_of
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.text import expression_text
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Part
from screwkit.certificates.signs import Signs
from screwkit.certificates.texts import RefusedError, names_in, read

_WORDS = frozenset(
    {
        "kind",
        "symbol",
        "end",
        "axis",
        "vanishing",
        "question",
        "origin",
        "limb",
        "reason",
    }
    | {"numbers", "locked", "columns", "angles", "sides"}
)
"""Fields that hold names, or numbers that are read as such."""

_HIGHEST = 4
_MOST_DIVISORS = 3


def all_plain(part: Part, postures: Postures, signs: Signs) -> None:
    """Check every text of a part, and its scales.

    Raises:
        RefusedError: If a text is no polynomial, or a scale may vanish.
    """
    # As the texts are: read from what was written.
    radicands = [read(expression_text(own)) for own in postures.radicands]
    for text in {*_texts(part)}:
        if not _is_polynomial(read(text), radicands):
            raise RefusedError(f"{text} is no polynomial")
    for text in {*(part.scales or {}).values()}:
        if not signs.never_zero(read(text)) and not _is_of_divisors(text, postures):
            raise RefusedError(f"{text}, by which twists are multiplied, may vanish")


def _texts(part: Part) -> Iterator[str]:
    waiting: list[Any] = [part]
    while waiting:
        here = waiting.pop()
        if isinstance(here, str):
            if here:
                yield here
        elif isinstance(here, (tuple, list)):
            waiting.extend(here)
        elif is_dataclass(here):
            kept = (own for own in fields(here) if own.name not in _WORDS)
            for own in kept:
                value = getattr(here, own.name)
                scales = own.name == "scales" and value
                waiting.extend(value.values() if scales else [value])


def _is_polynomial(expression: Expression, radicands: Sequence[Expression]) -> bool:
    """In symbols, sines, cosines, numbers and the geometry's own roots."""
    waiting = [expression]
    while waiting:
        here = waiting.pop()
        match here:
            case Quotient(_, below):
                if rational_value(below) in (None, 0):
                    return False
            case Power(base, exponent) if exponent < 0:
                if rational_value(base) in (None, 0):
                    return False
            case Call("sqrt", (inside,)):
                if inside in radicands:
                    continue  # it may hold what the geometry divides by
                known = rational_value(inside)
                if known is None or known < 0:
                    return False
            case Call("sin" | "cos", _):
                pass
            case Call():
                return False
        waiting.extend(children(here))
    return True


def _is_of_divisors(text: str, postures: Postures) -> bool:
    """Whether it is a number times powers of what the geometry divides by.

    Where that vanishes there is no posture.
    """
    names = names_in(text)
    divisors = [d for d in postures.divisors if symbols_of(d) <= names]
    if len(divisors) > _MOST_DIVISORS:
        return False
    points = postures.several(Way())
    own = [point.value(read(text)) for point in points]
    values = [[point.value(d) for d in divisors] for point in points]
    for powers in product(range(_HIGHEST + 1), repeat=len(divisors)):
        ratios = set()
        for value, known in zip(own, values, strict=True):
            below = points[0].one
            for divisor, power in zip(known, powers, strict=True):
                below = below * divisor**power
            ratios.add(int(value / below))
        if len(ratios) == 1 and ratios != {0}:
            return True
    return False
