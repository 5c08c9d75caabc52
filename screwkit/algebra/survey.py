"""Which generators the exact ring needs, found by evaluating once with blanks.

The kinematics is run over a ring whose scalars are all blank and which only writes
down what it is asked for; nothing is computed and nothing can be forgotten.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from math import isqrt, lcm
from typing import ClassVar

from screwkit.algebra.expression import Expression, Number
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.ring import Known


@dataclass(frozen=True, slots=True)
class Blank:
    """A scalar without a value."""

    def __add__(self, other: Blank) -> Blank:
        return self

    def __sub__(self, other: Blank) -> Blank:
        return self

    def __mul__(self, other: Blank) -> Blank:
        return self

    def __neg__(self) -> Blank:
        return self


_BLANK = Blank()


@dataclass
class SurveyRing:
    """Writes down every symbol, angle, root and divisor that is asked for.

    Attributes:
        symbols: Names met as numbers, in order of appearance.
        angles: Names met as angles, in order of appearance.
        constant_angles: Rational numbers of radians.
        roots: Radicands; inner ones before outer ones.
        divisors: Divisors; inner ones before outer ones.
        turn: Least n such that all constant angles are multiples of π/n.
        plain: See `Ring`.
        known: See `Ring`.
    """

    plain: ClassVar[bool] = True

    symbols: dict[str, None] = field(default_factory=dict)
    angles: dict[str, None] = field(default_factory=dict)
    constant_angles: dict[Fraction, None] = field(default_factory=dict)
    roots: dict[Expression, None] = field(default_factory=dict)
    divisors: dict[Expression, None] = field(default_factory=dict)
    turn: int = 1
    known: Known[Blank] = field(default_factory=dict, repr=False, compare=False)

    @property
    def zero(self) -> Blank:
        """A blank."""
        return _BLANK

    @property
    def one(self) -> Blank:
        """A blank."""
        return _BLANK

    def rational(self, value: Fraction) -> Blank:
        """Nothing to write down."""
        return _BLANK

    def symbol(self, name: str) -> Blank:
        """Write down a symbol."""
        self.symbols[name] = None
        return _BLANK

    def cosine_sine(self, angle: str) -> tuple[Blank, Blank]:
        """Write down an angle."""
        self.angles[angle] = None
        return _BLANK, _BLANK

    def half_turns(self, count: Fraction) -> tuple[Blank, Blank]:
        """Write down the denominator of a multiple of π."""
        self.turn = lcm(self.turn, count.denominator)
        return _BLANK, _BLANK

    def radians(self, value: Fraction) -> tuple[Blank, Blank]:
        """Write down a constant angle."""
        if value:
            self.constant_angles[abs(value)] = None
        return _BLANK, _BLANK

    def square_root(self, radicand: Expression, value: Blank) -> Blank:
        """Write down a radicand that is not the square of a rational."""
        known = rational_value(radicand)
        if known is None:
            self.roots[radicand] = None
        elif rational_root(known) is None:
            self.roots[Number(known)] = None
        return _BLANK

    def inverse(self, divisor: Expression, value: Blank) -> Blank:
        """Write down a divisor."""
        if rational_value(divisor) is None:
            self.divisors[divisor] = None
        return _BLANK

    def normal(self, value: Blank) -> Blank:
        """The same blank."""
        return value

    def is_zero(self, value: Blank) -> bool:
        """A blank is never known to be zero."""
        return False


def rational_root(value: Fraction) -> Fraction | None:
    """The square root of a rational where it is rational."""
    if value < 0:
        return None
    above, below = isqrt(value.numerator), isqrt(value.denominator)
    if above * above == value.numerator and below * below == value.denominator:
        return Fraction(above, below)
    return None
