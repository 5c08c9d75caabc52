"""Exact postures that satisfy conditions which were not solved: roots modulo a prime.

References: [CoxLittleOShea] §3.6 (resultants).
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from screwkit.algebra.common_root import common_root, interpolated
from screwkit.algebra.exact_point import (
    PointRing,
    determinant_modulo,
    roots_of,
    turn_of,
)
from screwkit.algebra.expression import Expression
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.texts import RefusedError, read

_DEGREE = 60


class Roots:
    """Moves points onto conditions.

    Args:
        prime: Modulus of the points.
        source: Chooses among several roots.
    """

    def __init__(self, prime: int, source: random.Random) -> None:
        self._prime, self._source = prime, source

    def met(self, point: PointRing, roots: Sequence[Unsolved]) -> PointRing:
        """The point moved to where conditions hold, one after the other.

        Raises:
            RefusedError: If a degree is too high, or an unknown is none.
            ResampleError: If a condition has no root there.
        """
        for unsolved in roots:
            beside = 0 if unsolved.beside is None else unsolved.beside.degree
            if max(unsolved.degree, beside, *unsolved.across, 0) > _DEGREE:
                raise RefusedError(f"{unsolved.equation} = 0 has too high a degree")
            if unsolved.together:
                point = self._on_all(point, (unsolved, *unsolved.together))
            elif unsolved.beside is None:
                point = self._on_root(point, unsolved)
            else:
                point = self._on_both(point, unsolved, unsolved.beside)
        return point

    def _on_root(self, point: PointRing, unsolved: Unsolved) -> PointRing:
        """The point moved along one angle or symbol to where an equation holds."""
        own = self._restricted(
            point, unsolved, read(unsolved.equation), unsolved.degree
        )
        if not any(own):
            return point
        found = roots_of(own, self._prime)
        if not found:
            raise ResampleError
        return _placed(point, unsolved, self._source.choice(found))

    def _on_all(self, point: PointRing, system: Sequence[Unsolved]) -> PointRing:
        """The point moved along several symbols to where linear equations hold."""
        if any(u.angle >= 0 or u.symbol not in point.numbers for u in system):
            raise RefusedError("equations are solved together for what is no symbol")
        origin = point.changed(numbers={u.symbol: point.zero for u in system})
        units = [origin.changed(numbers={u.symbol: point.one}) for u in system]
        rows, right = [], []
        for equation in (read(u.equation) for u in system):
            constant = origin.value(equation)
            rows.append([unit.value(equation) - constant for unit in units])
            right.append(-constant)
        found = linear_solution(rows, right, self._prime)
        return point.changed(
            numbers={u.symbol: x for u, x in zip(system, found, strict=True)}
        )

    def _on_both(self, point: PointRing, one: Unsolved, two: Unsolved) -> PointRing:
        """The point moved along two angles or symbols to where two equations hold."""
        if len(one.across) != 2:
            raise RefusedError("two conditions without their degrees")
        first, second = read(one.equation), read(two.equation)
        crossed, back = one.across

        def restricted(value: int) -> tuple[list[int], list[int]] | None:
            try:
                moved = _placed(point, one, value)
                below = 1 + value * value if one.angle >= 0 else 1
                return (
                    _times(
                        self._restricted(moved, two, first, crossed), below, one.degree
                    ),
                    _times(
                        self._restricted(moved, two, second, two.degree), below, back
                    ),
                )
            except ResampleError:
                return None

        sizes = 2 if one.angle >= 0 else 1, 2 if two.angle >= 0 else 1
        bound = sizes[0] * sizes[1] * (one.degree * two.degree + back * crossed)
        found = common_root(restricted, bound, self._source, self._prime)
        if found is None:
            raise ResampleError
        return _placed(_placed(point, one, found[0]), two, found[1])

    def _restricted(
        self, point: PointRing, unsolved: Unsolved, equation: Expression, degree: int
    ) -> list[int]:
        """Coefficients of an equation in the unknown, or in the tangent of its half."""
        values, places = list[int](), list[int]()
        place, turning = 0, unsolved.angle >= 0
        while len(places) <= (2 * degree if turning else degree):
            place += 1
            value = _placed(point, unsolved, place).value(equation)
            if turning:
                value = value * point.rational(Fraction(1 + place * place)) ** degree
            values.append(int(value))
            places.append(place)
        return interpolated(places, values, self._prime)


def linear_solution(
    rows: Sequence[Sequence[Any]], values: Sequence[Any], prime: int
) -> tuple[Any, ...]:
    """The solution of a regular system of linear equations (Cramer's rule).

    Raises:
        ResampleError: If the system is not regular.
    """
    whole = determinant_modulo(rows, prime)
    if whole == 0:
        raise ResampleError
    return tuple(
        determinant_modulo(
            [
                [*row[:k], value, *row[k + 1 :]]
                for row, value in zip(rows, values, strict=True)
            ],
            prime,
        )
        / whole
        for k in range(len(values))
    )


def _placed(point: PointRing, unsolved: Unsolved, place: int) -> PointRing:
    """The point with another value of a symbol, or of the tangent of half an angle."""
    value = point.rational(Fraction(place))
    if unsolved.angle < 0:
        if unsolved.symbol not in point.numbers:
            raise RefusedError(f"there is no symbol {unsolved.symbol!r}")
        return point.changed(numbers={unsolved.symbol: value})
    turn = turn_of(value)
    if turn is None:
        raise ResampleError
    return point.changed(unsolved.angle, turn)


def _times(coefficients: Sequence[int], factor: int, power: int) -> list[int]:
    return [value * factor**power for value in coefficients]
