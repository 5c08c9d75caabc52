"""Residues at one chosen point: every angle and symbol has the value it was given.

Unlike `modular.ModularRing`, which draws what it is asked for, this ring holds a point
that can be changed, so that postures on a condition can be built step by step.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence

from flint import nmod, nmod_mat, nmod_poly

from screwkit.algebra.angle_measures import Measures
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.evaluated_modulo import Layout, laid_out
from screwkit.algebra.evaluation import add_angles, evaluate, multiply_angle
from screwkit.algebra.expression import Call, Expression, Number, Symbol
from screwkit.algebra.modular import ModularRing, ResampleError, Residue
from screwkit.algebra.rational_values import rational_value

Turn = tuple[Residue, Residue]
"""(cos, sin) of an angle."""


class PointRing(ModularRing):
    """Residues mod p with given values of basis angles and symbols.

    Args:
        prime: The modulus.
        constants: The field of the geometry's constants; has roots mod ``prime``.
        declared: Each declared angle as an integer combination of basis angles.
        turns: (cos, sin) of the basis angles.
        numbers: Values of symbols.
        constants_of: Another point mod the same prime, whose constants serve here too.
        measures: Of the constant angles; those in ``declared``.

    Attributes:
        sheet: Which of several solutions are taken at this point, bit by bit.
    """

    def __init__(
        self,
        prime: int,
        constants: ConstantField,
        declared: Mapping[str, Mapping[int, int]],
        turns: Sequence[Turn],
        numbers: Mapping[str, Residue],
        constants_of: PointRing | None = None,
        measures: Measures | None = None,
    ) -> None:
        super().__init__(0, prime, constants, measures)
        self.sheet = 0
        if constants_of is not None:
            self._generators = constants_of._generators
            self._turns = constants_of._turns
            self.sheet = constants_of.sheet
        self._layouts: dict[int, tuple[Expression, Layout]] = (
            {} if constants_of is None else constants_of._layouts
        )
        self.turns = tuple(turns)
        self.numbers = dict(numbers)
        self._declared = declared

    def changed(
        self,
        angle: int | None = None,
        turn: Turn | None = None,
        numbers: Mapping[str, Residue] | None = None,
    ) -> PointRing:
        """The point with one basis angle or some symbols moved."""
        other = object.__new__(type(self))  # as `copy` does, with less ado
        vars(other).update(vars(self))
        if angle is not None and turn is not None:
            turns = list(self.turns)
            turns[angle] = turn
            other.turns = tuple(turns)
            # Angles without this one stay where they are.
            kept = {
                name: pair
                for name, pair in self._angles.items()
                if angle not in self._declared[name]
            }
        else:
            kept = dict(self._angles)
        if numbers:
            other.numbers = self.numbers | dict(numbers)
        other.known, other._angles, other._roots = {}, kept, {}
        return other

    def value(self, expression: Expression) -> Residue:
        """What an expression is here.

        Raises:
            ResampleError: If a root or an inverse in it does not exist here.
        """
        if isinstance(expression, Number):
            return self.rational(expression.value)
        known = self._layouts.get(id(expression))
        if known is None:
            known = self._layouts[id(expression)] = expression, laid_out(expression)
        value = known[1].at(self.prime, self._atom)
        return nmod(value, self.prime) if isinstance(value, int) else value

    def _atom(self, expression: Expression) -> Residue:
        """The value of what is no sum, product or power; most are met here at once."""
        match expression:
            case Symbol(name):
                return self.numbers[name]
            case Call("cos", (Symbol(name),)):
                return self.cosine_sine(name)[0]
            case Call("sin", (Symbol(name),)):
                return self.cosine_sine(name)[1]
        return evaluate(expression, self)

    def symbol(self, name: str) -> Residue:
        """The value given for this symbol."""
        return self.numbers[name]

    def cosine_sine(self, angle: str) -> Turn:
        """(cos, sin) of a declared angle, from those of the basis."""
        if angle not in self._angles:
            pair = (self.one, self.zero)
            for number, count in self._declared[angle].items():
                turned = multiply_angle(count, self.turns[number], self)
                pair = add_angles(pair, turned, self)
            self._angles[angle] = pair
        return self._angles[angle]

    def square_root(self, radicand: Expression, value: Residue) -> Residue:
        """The root of this value that is the same wherever the value is the same."""
        known = rational_value(radicand)
        if known is not None and known >= 0:
            return super().square_root(radicand, value)
        roots = sorted(roots_of([int(-value), 0, 1], self.prime))
        if not roots:
            raise ResampleError
        return nmod(roots[0], self.prime)


def roots_of(coefficients: Sequence[int], prime: int) -> list[int]:
    """The roots mod p of a polynomial that is not zero, constant coefficient first."""
    return [int(root) for root, _ in nmod_poly(list(coefficients), prime).roots()]


def random_residue(source: random.Random, prime: int) -> Residue:
    """Not 0."""
    return nmod(source.randrange(1, prime), prime)


def random_turn(source: random.Random, prime: int) -> Turn:
    """A random point of the circle."""
    while True:
        turn = turn_of(random_residue(source, prime))
        if turn is not None:
            return turn


def turn_of(tangent: Residue) -> Turn | None:
    """(cos, sin) of the angle with this tangent of its half."""
    below = 1 + tangent * tangent
    if below == 0:
        return None
    return (1 - tangent * tangent) / below, 2 * tangent / below


def determinant_modulo(rows: Sequence[Sequence[Residue]], prime: int) -> Residue:
    """Determinant of a square matrix; 1 of the empty one."""
    if not rows:
        return nmod(1, prime)
    entries = [int(value) for row in rows for value in row]
    return nmod(int(nmod_mat(len(rows), len(rows), entries, prime).det()), prime)
