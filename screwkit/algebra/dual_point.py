"""First derivatives of expressions at an exact point, by dual numbers modulo a prime.

A dual number a + Σ bᵢεᵢ with εᵢεⱼ = 0 carries a value and its changes along several
directions; every ring operation carries all [CoxLittleOShea §9.6, for tangent spaces].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, TypeAlias

from screwkit.algebra.evaluation import add_angles, evaluate, multiply_angle
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.expression import Expression
from screwkit.algebra.modular import ResampleError, Residue
from screwkit.algebra.ring import Known

Changes: TypeAlias = Mapping[int, Residue]
"""Along directions, by number; along those left out there is none."""


@dataclass(frozen=True)
class Dual:
    """A residue and its changes."""

    value: Residue
    changes: Changes

    def __add__(self, other: Dual) -> Dual:
        if not other.changes:
            return Dual(self.value + other.value, self.changes)
        changes = dict(self.changes)
        for k, change in other.changes.items():
            changes[k] = changes[k] + change if k in changes else change
        return Dual(self.value + other.value, changes)

    def __sub__(self, other: Dual) -> Dual:
        return self + -other

    def __mul__(self, other: Dual) -> Dual:
        changes = {k: change * other.value for k, change in self.changes.items()}
        for k, change in other.changes.items():
            own = self.value * change
            changes[k] = changes[k] + own if k in changes else own
        return Dual(self.value * other.value, changes)

    def __neg__(self) -> Dual:
        return Dual(-self.value, {k: -change for k, change in self.changes.items()})

    def over(self, other: Dual) -> Dual:
        """The quotient.

        Raises:
            ResampleError: If the divisor is 0.
        """
        if other.value == 0:
            raise ResampleError
        inverse = 1 / other.value
        rate = -inverse * inverse
        return self * Dual(inverse, {k: c * rate for k, c in other.changes.items()})

    def is_still(self) -> bool:
        """Whether nothing changes."""
        return all(change == 0 for change in self.changes.values())


DualTurn = tuple[Dual, Dual]


class DualRing:
    """The ring of dual numbers at a point that moves in some directions.

    Args:
        point: Gives the values.
        declared: Each declared angle as an integer combination of basis angles.
        directions: Numbers of basis angles, and symbols, that the point moves with.
    """

    plain: Final = True

    def __init__(
        self,
        point: PointRing,
        declared: Mapping[str, Mapping[int, int]],
        directions: Sequence[int | str],
    ) -> None:
        self._point = point
        self._declared = declared
        places = {direction: k for k, direction in enumerate(directions)}
        self._turns: list[DualTurn] = []
        for number, (cosine, sine) in enumerate(point.turns):
            k = places.get(number)
            down, up = ({}, {}) if k is None else ({k: -sine}, {k: cosine})
            self._turns.append((Dual(cosine, down), Dual(sine, up)))
        self._numbers = {
            name: Dual(value, {places[name]: point.one} if name in places else {})
            for name, value in point.numbers.items()
        }
        self._angles: dict[str, DualTurn] = {}
        self.known: Known[Dual] = {}

    def turn(self, angle: int, to: DualTurn) -> None:
        """Give a basis angle another (cos, sin)."""
        self._turns[angle] = to
        self.known, self._angles = {}, {}

    def replace(self, symbol: str, value: Dual) -> None:
        """Give a symbol another value."""
        self._numbers[symbol] = value
        self.known = {}

    def still(self, turn: tuple[Residue, Residue]) -> DualTurn:
        """(cos, sin) of an angle that does not move."""
        return Dual(turn[0], {}), Dual(turn[1], {})

    def of(self, expression: Expression) -> Dual:
        """An expression with its changes."""
        return evaluate(expression, self)

    @property
    def zero(self) -> Dual:
        """0."""
        return Dual(self._point.zero, {})

    @property
    def one(self) -> Dual:
        """1."""
        return Dual(self._point.one, {})

    def rational(self, value: Fraction) -> Dual:
        """A constant."""
        return Dual(self._point.rational(value), {})

    def symbol(self, name: str) -> Dual:
        """A symbol."""
        return self._numbers[name]

    def cosine_sine(self, angle: str) -> DualTurn:
        """(cos, sin) of a declared angle."""
        pair = self._angles.get(angle)
        if pair is None:
            pair = (self.one, self.zero)
            for number, count in self._declared[angle].items():
                own = multiply_angle(count, self._turns[number], self)
                pair = add_angles(pair, own, self)
            self._angles[angle] = pair
        return pair

    def half_turns(self, count: Fraction) -> DualTurn:
        """A constant angle."""
        cosine, sine = self._point.half_turns(count)
        return self.still((cosine, sine))

    def radians(self, value: Fraction) -> DualTurn:
        """A constant angle."""
        cosine, sine = self._point.radians(value)
        return self.still((cosine, sine))

    def square_root(self, radicand: Expression, value: Dual) -> Dual:
        """A root, which changes by half the changes over the root.

        Raises:
            ResampleError: If there is none, or it is 0.
        """
        root = self._point.square_root(radicand, value.value)
        if root == 0:
            if value.is_still():
                return Dual(root, {})
            raise ResampleError
        rate = 1 / (root + root)
        return Dual(root, {k: change * rate for k, change in value.changes.items()})

    def inverse(self, divisor: Expression, value: Dual) -> Dual:
        """1/value."""
        return self.one.over(value)

    def normal(self, value: Dual) -> Dual:
        """Dual numbers are their own normal form."""
        return value

    def is_zero(self, value: Dual) -> bool:
        """Whether value and changes are 0."""
        return bool(value.value == 0 and value.is_still())
