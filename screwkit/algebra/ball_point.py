"""A real point in balls: every value encloses the true one.

Angles are given by the tangents of their halves and symbols by rational numbers, so
that the point itself is exact; constants such as √3 are enclosed.

References: [MooreKearfottCloud2009] §2 (interval arithmetic).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

from flint import arb, ctx, fmpq

from screwkit.algebra.evaluation import add_angles, evaluate, multiply_angle
from screwkit.algebra.expression import Expression

BITS = 160

BallTurn = tuple[Any, Any]


class NoRealValueError(Exception):
    """A root of a negative number, or a quotient by what may be zero."""


class BallPoint:
    """A ring of balls in which angles and symbols have given values.

    Args:
        declared: Each declared angle as an integer combination of basis angles.
        tangents: Of half of each basis angle.
        numbers: Values of symbols.
    """

    plain: Final = True

    def __init__(
        self,
        declared: Mapping[str, Mapping[int, int]],
        tangents: Sequence[Fraction],
        numbers: Mapping[str, Fraction],
    ) -> None:
        self._declared = declared
        ones = ((1 + t * t, 1 - t * t, 2 * t) for t in tangents)
        self.turns = [(_ball(c / w), _ball(s / w)) for w, c, s in ones]
        self.numbers: dict[str, Any] = {n: _ball(x) for n, x in numbers.items()}

    def of(self, expression: Expression) -> Any:
        """A ball around the value of an expression.

        Raises:
            NoRealValueError: If it may have none.
        """
        before = ctx.prec
        ctx.prec = BITS
        try:
            return evaluate(expression, self)
        finally:
            ctx.prec = before

    @property
    def known(self) -> None:
        """Nothing is kept: turns and symbols may be replaced."""
        return None

    @property
    def zero(self) -> Any:
        """0."""
        return arb(0)

    @property
    def one(self) -> Any:
        """1."""
        return arb(1)

    def rational(self, value: Fraction) -> Any:
        """A constant."""
        return _ball(value)

    def symbol(self, name: str) -> Any:
        """A symbol, or π."""
        return arb.pi() if name == "pi" else self.numbers[name]

    def cosine_sine(self, angle: str) -> BallTurn:
        """(cos, sin) of a declared angle."""
        pair: BallTurn = (self.one, self.zero)
        for number, count in self._declared[angle].items():
            pair = add_angles(
                pair, multiply_angle(count, self.turns[number], self), self
            )
        return pair

    def half_turns(self, count: Fraction) -> BallTurn:
        """A constant angle."""
        turn = fmpq(count.numerator, count.denominator)
        return arb.cos_pi_fmpq(turn), arb.sin_pi_fmpq(turn)

    def radians(self, value: Fraction) -> BallTurn:
        """A constant angle."""
        angle = _ball(value)
        return angle.cos(), angle.sin()

    def square_root(self, radicand: Expression, value: Any) -> Any:
        """A root.

        Raises:
            NoRealValueError: If the radicand may be negative.
        """
        if not value >= 0:
            raise NoRealValueError
        return value.sqrt()

    def inverse(self, divisor: Expression, value: Any) -> Any:
        """1/value.

        Raises:
            NoRealValueError: If the divisor may be 0.
        """
        if sign_of(value) == 0:
            raise NoRealValueError
        return 1 / value

    def normal(self, value: Any) -> Any:
        """Balls are their own normal form."""
        return value

    def is_zero(self, value: Any) -> bool:
        """Whether a ball is 0 and nothing else."""
        return bool(value == 0)


def sign_of(value: Any) -> int:
    """1 or −1 where all numbers of a ball have this sign; else 0."""
    if value > 0:
        return 1
    return -1 if value < 0 else 0


def _ball(value: Fraction) -> Any:
    return arb(fmpq(value.numerator, value.denominator))
