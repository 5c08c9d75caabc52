"""Several conditions that are met one after the other: postures on every sheet.

Each condition is linear in an unknown, a symbol or sine and cosine of an angle, that
the conditions before it lack.  m equations cut out nothing that has fewer than n − m
dimensions (Krull).  So where of no condition all coefficients vanish, whatever they cut
out lies over all values of the other unknowns, and random ones meet it.  Where all
coefficients of a condition vanish is a case of its own.

References: [CoxLittleOShea] §9.4 (dimensions of intersections).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from screwkit.algebra.all_roots import at_all_roots
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Node, Unsolved
from screwkit.certificates.sheets import Sheets, Unknown, placed
from screwkit.certificates.solutions import Solutions
from screwkit.certificates.texts import RefusedError, read

T = TypeVar("T")

_ATTEMPTS = 200


class Towers:
    """Conditions of ways that are met one after the other.

    Args:
        postures: Of the mechanism.
        sheets: Of single conditions.
        solutions: Tells the coefficients of what is linear.
    """

    def __init__(
        self, postures: Postures, sheets: Sheets, solutions: Solutions
    ) -> None:
        self._postures, self._sheets, self._solutions = postures, sheets, solutions

    def check(self, node: Node, way: Way) -> None:
        """Check that a sheet's conditions are linear, and what its cases are.

        Raises:
            RefusedError: If one is not linear, or its coefficients may vanish in no
                case.
        """
        roots = node.roots
        unknowns = [_unknown(own) for own in roots]
        if len(roots) != len(node.cases) or len({*unknowns}) != len(roots):
            raise RefusedError("its conditions have no unknowns or cases of their own")
        if not {own.equation for own in roots} <= {*way.conditions}:
            raise RefusedError("it is met by other equations than its conditions")
        for number, (own, case) in enumerate(zip(roots, node.cases, strict=True)):
            fitting = [{*range(3)} for _ in case.equations]
            for point in self._postures.several_before(way):
                there = self._postures.moved(point, way)
                self._lacks(own.equation, unknowns[number + 1 :], point, way)
                known = self._solutions.coefficients(own, point, way)
                for text, places in zip(case.equations, fitting, strict=True):
                    value = there.value(read(text))
                    places &= {k for k, x in enumerate(known) if x == value}
            if not fitting or not all(fitting):
                raise RefusedError(f"{own.equation} has other coefficients")

    def _lacks(
        self, text: str, unknowns: Sequence[Unknown], point: PointRing, way: Way
    ) -> None:
        for unknown in unknowns:
            values = {
                int(there.value(read(text)))
                for value in (point.one, point.one + point.one)
                for there in [self._postures.moved(placed(point, unknown, value), way)]
            }
            if len(values) > 1:
                raise RefusedError(f"{text} does not lack the unknowns behind it")

    def on(
        self,
        way: Way,
        roots: Sequence[Unsolved],
        found: Callable[[PointRing, PointRing], T],
    ) -> list[T]:
        """What is found on every sheet of the conditions, their cases left out.

        Args:
            way: Its steps are followed.
            roots: The conditions with their unknowns.
            found: Called with the points before and after the steps.

        Raises:
            ResampleError: If they have no roots at random postures.
        """
        *first, last = roots
        results = []
        for before in self._sheets.choices(way):
            for start in self._all_of(first, before, way):

                def at(root: Any, start: PointRing = start) -> list[T]:
                    try:
                        moved = placed(start, _unknown(last), root)
                        there = self._postures.moved(moved, way)
                    except (ResampleError, ZeroDivisionError):
                        return []  # outside of the chart: no real posture
                    return [found(moved, there)]

                numerator = self._numerator(last, start, way)
                if numerator.degree() > 0:  # else it is in a case, or nowhere
                    results += [x for own in at_all_roots(numerator, at) for x in own]
        return results

    def _all_of(
        self, roots: Sequence[Unsolved], before: PointRing, way: Way
    ) -> list[PointRing]:
        """Points at all roots of the conditions, which are residues there."""
        choice = before.sheet
        for _ in range(_ATTEMPTS):
            points = [before]
            try:
                for own in roots:
                    points = [x for point in points for x in self._at(own, point, way)]
            except ResampleError:
                before = self._postures.another()
                before.sheet = choice
            else:
                return points
        raise ResampleError

    def _at(self, own: Unsolved, point: PointRing, way: Way) -> Iterator[PointRing]:
        """Points at all roots of a condition.

        Raises:
            ResampleError: If one of them is no residue.
        """
        numerator = self._numerator(own, point, way)
        if numerator.degree() < 1:
            return
        found = [root for root, _ in numerator.roots()]
        if len(found) < (numerator // numerator.gcd(numerator.derivative())).degree():
            raise ResampleError
        for root in found:
            yield placed(point, _unknown(own), root)

    def _numerator(self, own: Unsolved, point: PointRing, way: Way) -> Any:
        return self._sheets.numerator(way, own.equation, point, _unknown(own))


def _unknown(own: Unsolved) -> Unknown:
    return own.angle if own.angle >= 0 else own.symbol
