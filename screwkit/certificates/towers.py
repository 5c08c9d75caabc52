"""Several conditions that are met one after the other: postures on every sheet.

Each condition has an unknown, a symbol or an angle, that the conditions before it lack;
or several are linear in as many symbols together, which those before them lack.  m
equations cut out nothing that has fewer than n − m dimensions (Krull).  So where of no
condition all coefficients vanish, nor the determinant of several, whatever they cut
out lies over all values of the other unknowns, and random ones meet it.  Where they do
vanish is a case of its own.

References: [CoxLittleOShea] §9.4 (dimensions of intersections).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Any, TypeVar

from screwkit.algebra.all_roots import at_all_roots
from screwkit.algebra.exact_point import PointRing
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.coefficients import Coefficients
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Case, Node
from screwkit.certificates.root_postures import linear_solution
from screwkit.certificates.sheets import Sheets, Unknown, placed
from screwkit.certificates.texts import RefusedError, read

T = TypeVar("T")

_ATTEMPTS = 200


class Towers:
    """Conditions of ways that are met one after the other.

    Args:
        postures: Of the mechanism.
        sheets: Of single conditions.
        coefficients: Of conditions in their unknowns.
    """

    def __init__(
        self, postures: Postures, sheets: Sheets, coefficients: Coefficients
    ) -> None:
        self._postures, self._sheets = postures, sheets
        self._coefficients = coefficients

    def check(self, node: Node, way: Way) -> None:
        """Check that a sheet's conditions are as they have to be, and its cases.

        Raises:
            RefusedError: If they are not, or coefficients may vanish in no case.
        """
        roots = node.roots
        unknowns = [unknown for own in roots for unknown in _unknowns(own)]
        if len(roots) != len(node.cases) or len({*unknowns}) != len(unknowns):
            raise RefusedError("its conditions have no unknowns or cases of their own")
        if not {e.equation for own in roots for e in members(own)} <= {*way.conditions}:
            raise RefusedError("it is met by other equations than its conditions")
        seen = 0
        for own, case in zip(roots, node.cases, strict=True):
            seen += len(members(own))
            for point in self._postures.several_before(way):
                for member in members(own):
                    self._lacks(member.equation, unknowns[seen:], point, way)
            self._vanishing(own, case, way)

    def _vanishing(self, own: Unsolved, case: Case, way: Way) -> None:
        """Check that a case holds wherever a condition says nothing of its unknown.

        Each of its equations is a coefficient, or the determinant of several.

        Raises:
            RefusedError: If it may not.
        """
        fitting: list[set[int]] = []
        for point in self._postures.several_before(way):
            there = self._postures.moved(point, way)
            if own.together:
                whole = self._coefficients.determinant(members(own), point, way)
                known = (whole, -whole)
            else:
                known = self._coefficients.of(own, point, way)
            values = [there.value(read(text)) for text in case.equations]
            places = [{k for k, x in enumerate(known) if x == v} for v in values]
            fitting = [a & b for a, b in zip(fitting or places, places, strict=True)]
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
                if last.together:
                    for point in self._at(last, start, way):
                        with suppress(ResampleError, ZeroDivisionError):
                            there = self._postures.moved(point, way)
                            results.append(found(point, there))
                    continue

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
        if own.together:
            rows, right = self._coefficients.linear(members(own), point, way)
            with suppress(ResampleError):  # else its determinant vanishes: a case
                found = linear_solution(rows, right, self._postures.prime)
                names = [member.symbol for member in members(own)]
                yield point.changed(numbers=dict(zip(names, found, strict=True)))
            return
        numerator = self._numerator(own, point, way)
        if numerator.degree() < 1:
            return
        places = [root for root, _ in numerator.roots()]
        if len(places) < (numerator // numerator.gcd(numerator.derivative())).degree():
            raise ResampleError
        for root in places:
            yield placed(point, _unknown(own), root)

    def _numerator(self, own: Unsolved, point: PointRing, way: Way) -> Any:
        return self._sheets.numerator(way, own.equation, point, _unknown(own))


def members(own: Unsolved) -> tuple[Unsolved, ...]:
    """A condition, and those that are solved together with it."""
    return (own, *own.together)


def _unknowns(own: Unsolved) -> Iterator[Unknown]:
    return map(_unknown, members(own))


def _unknown(own: Unsolved) -> Unknown:
    return own.angle if own.angle >= 0 else own.symbol
