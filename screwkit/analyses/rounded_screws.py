"""Screws in sentences: long fractions as decimals, which are said to be rounded.

Where an axis is, is exact in the coordinates of the twist beside the sentence; nobody
reads a fraction of ten digits there.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal
from typing import Final

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.parse import parse
from screwkit.analyses.screw_texts import ScrewTexts, Texts

DIGITS: Final = 4
"""Of the longest number that is written out, and of those that are rounded."""

_LONG: Final = re.compile(rf"\d{{{DIGITS + 1},}}")


def rounded(screw: ScrewTexts) -> ScrewTexts:
    """The same screw, what is long in decimals; a direction by its largest coordinate.

    >>> long = ("30000", "-20000", "0")
    >>> short = rounded(ScrewTexts("screw", long, ("0", "1/3", "7"), "2/30001"))
    >>> short.direction, short.point, short.pitch
    (('1', '-0.6667', '0'), ('0', '1/3', '7'), '0.00006666')
    """
    (pitch,) = _decimals((screw.pitch,)) if screw.pitch else ("",)
    return replace(
        screw,
        direction=_decimals(screw.direction, scaled=True),
        point=_decimals(screw.point),
        pitch=pitch,
    )


def _decimals(texts: Sequence[str], *, scaled: bool = False) -> Texts:
    if not any(_LONG.search(text) for text in texts):
        return tuple(texts)
    found = [closed_value(parse(text)) for text in texts]
    values = [value for value in found if value is not None]
    if len(values) < len(texts):
        return tuple(texts)
    size = max(map(abs, values)) if scaled else 1.0
    return tuple(f"{Decimal(f'{value / size:.{DIGITS}g}'):f}" for value in values)
