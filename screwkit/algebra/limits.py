"""How large a text, and what it folds to, may be.

A short text can denote a giant: stacked powers, long decimals, vectors that double at
every name.  These are the bounds, and how a value is measured against them.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from screwkit.algebra.expression import Expression, Power
from screwkit.algebra.expression_building import children


@dataclass(frozen=True)
class Limits:
    """How large a text and what it folds to may be.

    Attributes:
        length: Characters.
        depth: Nested parentheses, calls, powers and signs.
        digits: Digits of a number; a decimal exponent may shift it by as many.
        exponent: Exponents, stacked ones multiplied.
        bits: Bits of the numerator and of the denominator of a folded constant.
        leaves: Size of what vectors combine to, in numbers and symbols.
    """

    length: int = 2_000
    depth: int = 60
    digits: int = 40
    exponent: int = 64
    bits: int = 1_024
    leaves: int = 20_000


FILE_LIMITS: Final = Limits()
"""For text that a person wrote."""
RESULT_LIMITS: Final = Limits(length=1_000_000, digits=400, bits=16_384)
"""For text that the engine wrote and that is read back."""


def bits(value: Fraction) -> int:
    """Bits of the longer of numerator and denominator."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def stacked(expression: Expression) -> int:
    """The largest product of exponents on a way down."""
    own = expression.exponent if isinstance(expression, Power) else 1
    return abs(own) * max((stacked(child) for child in children(expression)), default=1)


def leaves(expression: Expression) -> int:
    """Numbers and symbols in an expression."""
    below = children(expression)
    return sum(map(leaves, below)) if below else 1
