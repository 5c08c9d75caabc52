"""Whether the solutions that a certificate gives of a case are all there are.

Four rules, each checked by values at random points: an angle up to its opposite, an
angle by two linear equations, an angle in numbers, a symbol.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from screwkit.algebra.exact_point import PointRing, Turn
from screwkit.algebra.expression import Expression
from screwkit.certificates.equations_told import Step
from screwkit.certificates.multiples import divided
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Case
from screwkit.certificates.root_postures import linear_solution
from screwkit.certificates.signs import Signs
from screwkit.certificates.texts import RefusedError, fraction, read


class Solutions:
    """The rules by which cases are solved.

    Args:
        postures: Of the mechanism.
        signs: Of its symbols.
    """

    def __init__(self, postures: Postures, signs: Signs) -> None:
        self._postures = postures
        self._signs = signs

    def solved(self, case: Case, steps: Sequence[Step], way: Way) -> None:
        """Whether the steps are all solutions of the case."""
        kinds = {step.kind for step in steps}
        if kinds == {"angle"} and len(steps) == 2 and len(case.equations) == 1:
            self._two_turns(case, steps, way)
        elif len(steps) != 1:
            raise RefusedError("the sheets of a case are not all its solutions")
        elif kinds == {"numbers"} and len(case.equations) == 1:
            step = steps[0]
            self.numbers(case, step.angle, step.numbers, way)
        elif kinds == {"pair"} and len(case.equations) == 2:
            self._pair(case, steps[0], way)
        elif kinds == {"symbol"} and len(case.equations) == 1:
            self._symbol(case.equations[0], steps[0], way)
        else:
            raise RefusedError("a case is not solved by any rule")

    def squares(self, case: Case, way: Way) -> tuple[str, ...]:
        """What vanishes where a sum of squares does.

        Raises:
            RefusedError: If a multiple of the case's equation is no such sum.
        """
        if not case.squares:
            return ()
        if len(case.equations) != 1 or not case.times:
            raise RefusedError("several equations are no sum of squares")
        for square in case.squares:
            if not self._signs.positive_everywhere(read(square.weight)):
                raise RefusedError(f"{square.weight}, a weight, is not positive")
        for point in self._postures.several(way):
            left = point.value(read(case.equations[0])) * point.value(read(case.times))
            for square in case.squares:
                base = point.value(read(square.base))
                left = left - point.value(read(square.weight)) * base * base
            if left != 0:
                raise RefusedError(f"{case.equations[0]} is no sum of these squares")
        return tuple(square.base for square in case.squares)

    def satisfied(self, step: Step, point: PointRing) -> bool:
        """Whether a posture has the values that a step gives."""
        if step.kind == "symbol":
            left = point.value(read(step.over)) * point.symbol(step.symbol)
            return bool(left == point.value(read(step.value)))
        cosine, sine = point.turns[step.angle]
        if step.kind == "numbers":
            a, b, c = (point.rational(fraction(text)) for text in step.numbers)
            return bool(a * sine + b * cosine + c == 0)
        over = point.value(read(step.over))
        return bool(
            over * cosine == point.value(read(step.cosine))
            and over * sine == point.value(read(step.sine))
        )

    def _linear(
        self, text: str, angle: int, point: PointRing, way: Way
    ) -> tuple[Any, Any, Any]:
        """(P, Q, R) with expression = P·sin φ + Q·cos φ + R for every φ.

        Raises:
            RefusedError: If it is not of that form.
        """
        if not 0 <= angle < len(point.turns):
            raise RefusedError(f"there is no basis angle {angle}")

        equation, way = read(text), self._postures.bearing_on(text, way)

        def at(turn: Turn) -> Any:
            turned = point.changed(angle, turn)
            return self._postures.moved(turned, way).value(equation)

        turns = [self._postures.turn() for _ in range(4)]
        rows = [(sine, cosine, point.one) for cosine, sine in turns]
        values = [at(turn) for turn in turns]
        p, q, r = linear_solution(rows[:3], values[:3], self._postures.prime)
        for (s, c, _), value in zip(rows[3:], values[3:], strict=True):
            if value != p * s + q * c + r:
                raise RefusedError("an equation is not linear in sine and cosine")
        return p, q, r

    def _linear_in(
        self, symbol: str, text: str, point: PointRing, way: Way
    ) -> tuple[Any, Any]:
        """(A, B) with expression = A·x + B for every value of a symbol x.

        Raises:
            RefusedError: If it is not of that form.
        """
        if symbol not in point.numbers:
            raise RefusedError(f"there is no symbol {symbol!r}")

        equation, way = read(text), self._postures.bearing_on(text, way)

        def at(value: Any) -> Any:
            moved = point.changed(numbers={symbol: value})
            return self._postures.moved(moved, way).value(equation)

        x = point.symbol(symbol)
        y = x + point.one
        a = at(y) - at(x)
        b = at(x) - a * x
        if at(x + y) != a * (x + y) + b or at(x * y) != a * x * y + b:
            raise RefusedError(f"an equation is not linear in {symbol}")
        return a, b

    def _two_turns(self, case: Case, steps: Sequence[Step], way: Way) -> None:
        """P·sin φ + Q·cos φ = 0 with constant P² + Q²: two opposite turns."""
        first, second = steps
        if first.angle != second.angle:
            raise RefusedError("the sheets of a case turn different angles")
        squares = set()
        for point in self._postures.several_before(way):
            p, q, r = self._linear(case.equations[0], first.angle, point, way)
            squares.add(int(p * p + q * q))
            sines = [point.value(read(step.sine)) for step in steps]
            cosines = [point.value(read(step.cosine)) for step in steps]
            s, c = sines[0], cosines[0]
            if (
                r != 0
                or s * s + c * c != 1
                or p * s + q * c != 0
                or sines[1] != -s
                or cosines[1] != -c
                or {step.over for step in steps} != {"1"}
            ):
                raise RefusedError(f"{case.equations[0]} = 0 is solved otherwise")
        if len(squares) > 1 or squares == {0}:
            raise RefusedError(f"{case.equations[0]} = 0 may say nothing of an angle")

    def numbers(
        self, case: Case, angle: int, numbers: Sequence[str], way: Way
    ) -> tuple[Fraction, Fraction, Fraction]:
        """a·sin φ + b·cos φ + c = 0 in numbers, up to a number."""
        if len(numbers) != 3:
            raise RefusedError("three numbers are needed")
        a, b, c = map(fraction, numbers)
        if not a and not b:
            raise RefusedError("the equation says nothing of an angle")
        ratios = set()
        for point in self._postures.several_before(way):
            found = self._linear(case.equations[0], angle, point, way)
            given = [point.rational(value) for value in (a, b, c)]
            ratio = found[0] / given[0] if a else found[1] / given[1]
            if ratio == 0 or any(
                own != ratio * known for own, known in zip(found, given, strict=True)
            ):
                raise RefusedError(f"{case.equations[0]} has other numbers")
            ratios.add(int(ratio))
        if len(ratios) > 1:
            raise RefusedError(f"{case.equations[0]} has a factor besides")
        return a, b, c

    def elsewhere(self, case: Case, way: Way) -> None:
        """Whether an angle solved in numbers is never where an equation in it holds."""
        angle = case.angle
        own = self.numbers(case, angle, case.numbers, Way())
        for step in way.steps:
            if step.kind != "numbers" or step.angle != angle:
                continue
            a, b, c = map(fraction, step.numbers)
            u, v, w = own
            below = a * v - b * u
            sine, cosine = b * w - c * v, c * u - a * w  # times below
            if sine**2 + cosine**2 != below**2:
                return
        raise RefusedError(f"{case.equations[0]} may vanish")

    def divides(self, case: Case, way: Way) -> None:
        """A divisor that vanishes at no posture is a multiple of the case.

        One of a step, or one of the geometry, which is not defined elsewhere.
        """
        if case.divisor is None or len(case.equations) != 1:
            raise RefusedError("a case without its divisor")
        multiple, equation = case.divisor, read(case.equations[0])
        for point in self._postures.several(way):
            if case.end == "undefined":
                left = point.value(self._divisor_of_geometry(multiple.equation))
            else:
                left = divided({str(multiple.equation): 1}, way, point)
            left = left * divided(multiple.over, way, point)
            if left != point.value(read(multiple.times)) * point.value(equation):
                raise RefusedError(f"{case.equations[0]} is in no divisor")

    def _divisor_of_geometry(self, number: int) -> Expression:
        if not 0 <= number < len(self._postures.divisors):
            raise RefusedError(f"the geometry has no divisor {number}")
        return self._postures.divisors[number]

    def _pair(self, case: Case, step: Step, way: Way) -> None:
        """Two equations linear in sine and cosine with a determinant never zero."""
        if not self._signs.never_zero(read(step.over)):
            raise RefusedError(f"{step.over} may vanish")
        for point in self._postures.several_before(way):
            rows = [
                self._linear(text, step.angle, point, way) for text in case.equations
            ]
            (p, q, r), (u, v, w) = rows
            over = point.value(read(step.over))
            s, c = point.value(read(step.sine)), point.value(read(step.cosine))
            if (
                p * v - q * u != over
                or p * s + q * c + r * over != 0
                or u * s + v * c + w * over != 0
                or s * s + c * c != over * over
            ):
                raise RefusedError(f"{case.equations[0]} = 0 is solved otherwise")

    def _symbol(self, text: str, step: Step, way: Way) -> None:
        """A·x + B = 0 where A and B have no common zero."""
        for point in self._postures.several_before(way):
            a, b = self._linear_in(step.symbol, text, point, way)
            if a * point.value(read(step.value)) + b * point.value(read(step.over)):
                raise RefusedError(f"an equation is solved otherwise for {step.symbol}")
            if a == 0 or point.value(read(step.over)) == 0:
                raise RefusedError(f"an equation does not determine {step.symbol}")
            if a != point.value(read(step.over)):
                raise RefusedError(f"{step.over} is not what is divided by")
        if self._signs.never_zero(read(step.over)):
            return
        self._never_both(step, way)

    def _never_both(self, step: Step, way: Way) -> None:
        """Wherever the divisor vanishes the numerator does not."""
        if not step.never:
            raise RefusedError(f"{step.over} may vanish")
        self.solved(Case((step.over,), 1), step.never, way)
        for solved in step.never:
            # Of the numerator on the sheet a text with signs is given as its value.
            value = read(solved.value)
            if not self._signs.never_zero(value):
                raise RefusedError(f"{step.value} may vanish together with {step.over}")
            sheet = replace(solved, value="")
            there = replace(way, steps=(*way.steps, sheet))
            if self._postures.excluded(there):
                continue
            for point in self._postures.several(there):
                if point.value(read(step.value)) != point.value(value):
                    raise RefusedError(f"{step.value} has another value there")
