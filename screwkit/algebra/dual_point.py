"""First derivatives of expressions at an exact point, by dual numbers modulo a prime.

A dual number a + bε with ε² = 0 carries a value and its change along one direction;
every ring operation carries both [CoxLittleOShea §9.6, for tangent spaces].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from screwkit.algebra.evaluation import add_angles, evaluate, multiply_angle
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.expression import Expression
from screwkit.algebra.modular import ResampleError, Residue


@dataclass(frozen=True)
class Dual:
    """A residue and its change."""

    value: Residue
    change: Residue

    def __add__(self, other: Dual) -> Dual:
        return Dual(self.value + other.value, self.change + other.change)

    def __sub__(self, other: Dual) -> Dual:
        return Dual(self.value - other.value, self.change - other.change)

    def __mul__(self, other: Dual) -> Dual:
        change = self.value * other.change + self.change * other.value
        return Dual(self.value * other.value, change)

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.change)

    def over(self, other: Dual) -> Dual:
        """The quotient.

        Raises:
            ResampleError: If the divisor is 0.
        """
        if other.value == 0:
            raise ResampleError
        ratio = self.value / other.value
        return Dual(ratio, (self.change - ratio * other.change) / other.value)


DualTurn = tuple[Dual, Dual]


class DualRing:
    """The ring of dual numbers at a point that moves in one direction.

    Args:
        point: Gives the values.
        declared: Each declared angle as an integer combination of basis angles.
        turns: (cos, sin) of the basis angles.
        numbers: Symbols.
    """

    plain: Final = True

    def __init__(
        self,
        point: PointRing,
        declared: Mapping[str, Mapping[int, int]],
        turns: Sequence[DualTurn],
        numbers: Mapping[str, Dual],
    ) -> None:
        self._point = point
        self._declared = declared
        self.turns = list(turns)
        self.numbers = dict(numbers)

    @classmethod
    def along(
        cls,
        point: PointRing,
        declared: Mapping[str, Mapping[int, int]],
        direction: int | str,
    ) -> DualRing:
        """A point that moves with one basis angle or one symbol."""
        zero, one = point.zero, point.one
        turns = []
        for number, (cosine, sine) in enumerate(point.turns):
            rate = one if number == direction else zero
            turns.append((Dual(cosine, -sine * rate), Dual(sine, cosine * rate)))
        numbers = {
            name: Dual(value, one if name == direction else zero)
            for name, value in point.numbers.items()
        }
        return cls(point, declared, turns, numbers)

    def still(self, turn: tuple[Residue, Residue]) -> DualTurn:
        """(cos, sin) of an angle that does not move."""
        return Dual(turn[0], self._point.zero), Dual(turn[1], self._point.zero)

    def of(self, expression: Expression) -> Dual:
        """An expression with its change."""
        return evaluate(expression, self)

    @property
    def known(self) -> None:
        """Nothing is kept: turns and symbols may be replaced."""
        return None

    @property
    def zero(self) -> Dual:
        """0."""
        return Dual(self._point.zero, self._point.zero)

    @property
    def one(self) -> Dual:
        """1."""
        return Dual(self._point.one, self._point.zero)

    def rational(self, value: Fraction) -> Dual:
        """A constant."""
        return Dual(self._point.rational(value), self._point.zero)

    def symbol(self, name: str) -> Dual:
        """A symbol."""
        return self.numbers[name]

    def cosine_sine(self, angle: str) -> DualTurn:
        """(cos, sin) of a declared angle."""
        pair = (self.one, self.zero)
        for number, count in self._declared[angle].items():
            pair = add_angles(
                pair, multiply_angle(count, self.turns[number], self), self
            )
        return pair

    def half_turns(self, count: Fraction) -> DualTurn:
        """A constant angle."""
        cosine, sine = self._point.half_turns(count)
        return Dual(cosine, self._point.zero), Dual(sine, self._point.zero)

    def radians(self, value: Fraction) -> DualTurn:
        """A constant angle."""
        cosine, sine = self._point.radians(value)
        return Dual(cosine, self._point.zero), Dual(sine, self._point.zero)

    def square_root(self, radicand: Expression, value: Dual) -> Dual:
        """A root, which changes by half the change over the root.

        Raises:
            ResampleError: If there is none, or it is 0.
        """
        root = self._point.square_root(radicand, value.value)
        if root == 0:
            if value.change == 0:
                return Dual(root, self._point.zero)
            raise ResampleError
        return Dual(root, value.change / (root + root))

    def inverse(self, divisor: Expression, value: Dual) -> Dual:
        """1/value."""
        return self.one.over(value)

    def normal(self, value: Dual) -> Dual:
        """Dual numbers are their own normal form."""
        return value

    def is_zero(self, value: Dual) -> bool:
        """Whether value and change are 0."""
        return bool(value.value == 0 and value.change == 0)
