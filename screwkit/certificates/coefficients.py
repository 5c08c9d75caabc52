"""Coefficients of a condition in an unknown, from its values at exact points.

In a symbol those of its powers; in an angle φ those of cos^j φ and sin φ·cos^j φ, in
which sin²φ = 1 − cos²φ leaves one way to write it.  Of several conditions that are
linear in as many symbols together: the determinant.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

from screwkit.algebra.common_root import interpolated
from screwkit.algebra.exact_point import (
    PointRing,
    Turn,
    determinant_modulo,
    random_residue,
)
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.root_postures import linear_solution
from screwkit.certificates.texts import RefusedError, read

HIGHEST = 8
"""Degree in an unknown."""

COMPARED = 2
"""Further values at which a form is compared."""


class Coefficients:
    """Of the conditions of one part.

    Args:
        postures: Of the mechanism.
        source: Of randomness.
    """

    def __init__(self, postures: Postures, source: random.Random) -> None:
        self._postures, self._source = postures, source

    def of(self, own: Unsolved, point: PointRing, way: Way) -> tuple[Any, ...]:
        """All coefficients; where all of them vanish the condition says nothing.

        Args:
            own: The condition with its unknown and degree.
            point: Before the steps; the other unknowns have its values.
            way: Its steps are followed.

        Raises:
            RefusedError: If it is no polynomial of this degree in the unknown.
        """
        if not 1 <= own.degree <= HIGHEST:
            raise RefusedError(f"{own.equation} has no degree or too high a one")
        if own.angle >= 0:
            return self._in_angle(own, point, way)
        return self._in_symbol(own, point, way)

    def _in_symbol(self, own: Unsolved, point: PointRing, way: Way) -> tuple[Any, ...]:
        equation = read(own.equation)
        if own.symbol not in point.numbers:
            raise RefusedError(f"there is no symbol {own.symbol!r}")

        def at(value: Any) -> Any:
            moved = point.changed(numbers={own.symbol: value})
            return self._postures.moved(moved, way).value(equation)

        p = self._postures.prime
        places = [*range(own.degree + 1)]
        values = [int(at(point.one * place)) for place in places]
        found = [point.one * c for c in interpolated(places, values, p)]
        for _ in range(COMPARED):
            x = random_residue(self._source, p)
            if at(x) != sum((c * x**k for k, c in enumerate(found)), point.zero):
                raise RefusedError(f"an equation has another degree in {own.symbol}")
        return tuple(found)

    def _in_angle(self, own: Unsolved, point: PointRing, way: Way) -> tuple[Any, ...]:
        equation = read(own.equation)
        if own.angle >= len(point.turns):
            raise RefusedError(f"there is no basis angle {own.angle}")

        def at(turn: Turn) -> Any:
            turned = point.changed(own.angle, turn)
            return self._postures.moved(turned, way).value(equation)

        def row(turn: Turn) -> list[Any]:
            cosine, sine = turn
            powers = [cosine**k for k in range(own.degree + 1)]
            return [*powers, *(sine * power for power in powers[:-1])]

        size = 2 * own.degree + 1
        turns = [self._postures.turn() for _ in range(size + COMPARED)]
        rows, values = [row(turn) for turn in turns], [at(turn) for turn in turns]
        p = self._postures.prime
        found = linear_solution(rows[:size], values[:size], p)
        for line, value in zip(rows[size:], values[size:], strict=True):
            if value != sum((c * x for c, x in zip(found, line, strict=True))):
                raise RefusedError("an equation has another degree in an angle")
        return found

    def determinant(
        self, system: Sequence[Unsolved], point: PointRing, way: Way
    ) -> Any:
        """Of the coefficients of as many symbols; elsewhere these have one solution.

        Args:
            system: Conditions with a symbol each.
            point: Before the steps.
            way: Its steps are followed.

        Raises:
            RefusedError: If they are not linear in these symbols together.
        """
        rows, _ = self.linear(system, point, way)
        return determinant_modulo(rows, self._postures.prime)

    def linear(
        self, system: Sequence[Unsolved], point: PointRing, way: Way
    ) -> tuple[list[list[Any]], list[Any]]:
        """The coefficients of a linear system, and its right sides.

        Raises:
            RefusedError: If it is none.
        """
        if any(u.angle >= 0 or u.symbol not in point.numbers for u in system):
            raise RefusedError("equations are solved together for what is no symbol")
        names = [u.symbol for u in system]
        equations = [read(u.equation) for u in system]

        def at(values: Sequence[Any]) -> list[Any]:
            moved = point.changed(numbers=dict(zip(names, values, strict=True)))
            there = self._postures.moved(moved, way)
            return [there.value(equation) for equation in equations]

        zeros = [point.zero for _ in names]
        constants = at(zeros)
        units = [
            at([*zeros[:k], point.one, *zeros[k + 1 :]]) for k in range(len(names))
        ]
        rows = [
            [unit[k] - constants[k] for unit in units] for k in range(len(equations))
        ]
        for _ in range(COMPARED):
            xs = [random_residue(self._source, self._postures.prime) for _ in names]
            for row, constant, value in zip(rows, constants, at(xs), strict=True):
                if value != sum(
                    (a * x for a, x in zip(row, xs, strict=True)), constant
                ):
                    raise RefusedError("equations are not linear in symbols together")
        return rows, [-constant for constant in constants]
