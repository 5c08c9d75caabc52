"""Whether a component has real postures: shown by values with sure signs.

An equation that is positive at one real posture and negative at another vanishes
between them; where it is no product, real postures fill it then, but for a set of
smaller dimension.  Where all equations are solved, one choice of
the angles and symbols that are left is enough.

References: [BochnakCosteRoy1998] §4.5 (the sign-changing criterion).
"""

from __future__ import annotations

import random
from collections.abc import Collection, Mapping
from dataclasses import replace
from fractions import Fraction

from screwkit.algebra.ball_point import BallPoint, NoRealValueError, sign_of
from screwkit.certificates.equations_told import Step
from screwkit.certificates.records import Locus, Reach, Side
from screwkit.certificates.texts import RefusedError, fraction, read

_DRAWN = 200


class RealPostures:
    """The real postures that a certificate gives for components.

    Args:
        declared: Each declared angle as an integer combination of basis angles.
        angles: Number of basis angles.
        symbols: Names of the others.
        positive: Symbols that are > 0.
        nonzero: Symbols that are not 0.
    """

    def __init__(
        self,
        declared: Mapping[str, Mapping[int, int]],
        angles: int,
        symbols: Collection[str],
        positive: Collection[str],
        nonzero: Collection[str],
    ) -> None:
        self._declared, self._angles, self._symbols = declared, angles, symbols
        self._positive, self._nonzero = positive, nonzero

    def shown(self, locus: Locus) -> bool:
        """Whether a component is shown to have real postures.

        Raises:
            RefusedError: If what is given for it shows nothing.
        """
        if not locus.sides:
            return False
        try:
            points = [self._point(side) for side in locus.sides]
            if len(points) == 1:
                self._solved(points[0], locus.reach[0])
            elif len(points) == 2 and len(locus.equations) == 1:
                self._between(points, locus)
            else:
                raise RefusedError("its real postures do not fit its equations")
        except NoRealValueError:
            raise RefusedError("a real posture of it is none") from None
        return True

    def drawn(self, source: random.Random) -> Side:
        """A random real posture."""
        numbers = {}
        for name in self._symbols:
            size = Fraction(source.randint(1, 32), 8)
            free = name not in self._positive and name not in self._nonzero
            numbers[name] = str(-size if free and source.random() < 0.5 else size)
        tangents = [Fraction(source.randint(-24, 24), 8) for _ in range(self._angles)]
        return Side(tuple(map(str, tangents)), numbers)

    def sign(self, text: str, side: Side) -> int:
        """Of an expression at a real posture, 0 where it is not sure."""
        return sign_of(self._point(side).of(read(text)))

    def _point(self, side: Side) -> BallPoint:
        numbers = {name: fraction(text) for name, text in side.symbols.items()}
        tangents = [fraction(text) for text in side.tangents]
        if len(tangents) != self._angles or {*numbers} != {*self._symbols}:
            raise RefusedError("a real posture of it lacks an angle or a symbol")
        for name, value in numbers.items():
            if (name in self._positive and value <= 0) or (
                name in self._nonzero and not value
            ):
                raise RefusedError(f"{name} cannot be {value}")
        return BallPoint(self._declared, tangents, numbers)

    def _between(self, points: list[BallPoint], locus: Locus) -> None:
        """The equation has both signs, and nothing between forbids a path."""
        expression = read(locus.equations[0])
        if {sign_of(point.of(expression)) for point in points} != {1, -1}:
            raise RefusedError("it does not have both signs at its real postures")
        one, two = (side.symbols for side in locus.sides)
        for name in self._nonzero:
            if name in one and fraction(one[name]) * fraction(two[name]) < 0:
                raise RefusedError(f"{name} = 0 lies between its real postures")

    def _solved(self, point: BallPoint, reach: Reach) -> None:
        """The steps have real values."""
        if reach.roots:
            raise RefusedError("its equations are not all solved")
        for step in reversed(reach.steps):
            self._follow(point, step)
        for name, value in point.numbers.items():
            if (name in self._positive and sign_of(value) < 1) or (
                name in self._nonzero and not sign_of(value)
            ):
                raise RefusedError(f"{name} has a wrong sign at its real posture")

    def _follow(self, point: BallPoint, step: Step) -> None:
        if step.kind == "numbers":
            a, b, c = map(fraction, step.numbers)
            square = a * a + b * b
            root = point.square_root(read("0"), point.rational(square - c * c))
            # The foot of the line a·s + b·c + c₀ = 0 and half of its chord.
            point.turns[step.angle] = (
                (point.rational(-b * c) + root * point.rational(a))
                / point.rational(square),
                (point.rational(-a * c) - root * point.rational(b))
                / point.rational(square),
            )
            return
        below = point.inverse(read("0"), point.of(read(step.over)))
        if step.kind == "symbol":
            if step.symbol not in point.numbers:
                raise RefusedError(f"there is no symbol {step.symbol!r}")
            point.numbers[step.symbol] = point.of(read(step.value)) * below
        else:
            cosine = point.of(read(step.cosine)) * below
            point.turns[step.angle] = cosine, point.of(read(step.sine)) * below


def sides_of(real: RealPostures, locus: Locus, source: random.Random) -> Locus:
    """A component with real postures, where random ones show some."""
    found = dict[int, Side]()
    for _ in range(_DRAWN):
        side = real.drawn(source)
        try:
            if not locus.reach[0].roots:
                alone = replace(locus, sides=(side,))
                real.shown(alone)
                return alone
            if len(locus.equations) > 1:
                return locus
            found[real.sign(locus.equations[0], side)] = side
        except (RefusedError, NoRealValueError):
            continue
        if {1, -1} <= {*found}:
            return replace(locus, sides=(found[1], found[-1]))
    return locus
