"""All sheets of a condition: postures at every one of its roots.

A condition that is a product has sheets that a random root need not meet.  Here one
unknown is moved to all roots at once, in whatever field they lie, so that each factor
in which the unknown occurs is met.  Whether a factor lacks it is seen by common
divisors: such a factor stays where the unknown is changed.  So nothing has to be known
about the factors of a condition, and what is found is found on all of them.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeAlias, TypeVar

from screwkit.algebra.all_roots import at_all_roots
from screwkit.algebra.exact_point import PointRing, random_residue, turn_of
from screwkit.algebra.fractions_modulo import NoFractionError, fraction_of
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.texts import RefusedError, read

T = TypeVar("T")
Unknown: TypeAlias = int | str
"""Number of a basis angle, or name of a symbol."""


class Sheets:
    """Draws postures on all sheets of conditions.

    Args:
        postures: Of the mechanism.
        source: Of randomness.
    """

    def __init__(self, postures: Postures, source: random.Random) -> None:
        self.postures, self._source = postures, source

    def on(
        self,
        way: Way,
        text: str | None,
        found: Callable[[PointRing, PointRing], T],
    ) -> list[T]:
        """What is found on every sheet of the postures where an expression vanishes.

        Args:
            way: Its steps are followed; its conditions are not asked for.
            text: Of the expression; None: all postures of the way.
            found: Called with the points before and after the steps.

        Raises:
            RefusedError: If the expression has too high a degree.
        """
        results = []
        for before in self.choices(way):
            if text is None:
                results.append(found(before, self.postures.moved(before, way)))
                continue
            for start, unknown, numerator in self.meeting_all(way, text, before):

                def at(
                    root: Any, start: PointRing = start, unknown: Unknown = unknown
                ) -> list[T]:
                    try:
                        moved = placed(start, unknown, root)
                        there = self.postures.moved(moved, way)
                    except (ResampleError, ZeroDivisionError):
                        return []  # outside of the chart: no real posture
                    return [found(moved, there)]

                results += [x for own in at_all_roots(numerator, at) for x in own]
        return results

    def choices(self, way: Way) -> Iterator[PointRing]:
        """A random point before the steps for every choice of solutions in numbers."""
        count = sum(step.kind == "numbers" for step in way.steps)
        yield from self.postures.several_before(way)[: 2**count]

    def active(self, way: Way) -> tuple[str, ...]:
        """The conditions of a way that its steps do not fulfil."""
        points = [self.postures.moved(b, way) for b in self.choices(way)]
        return tuple(
            text
            for text in dict.fromkeys(way.conditions)
            if any(point.value(read(text)) != 0 for point in points)
        )

    def meeting_all(
        self, way: Way, text: str, before: PointRing | None = None
    ) -> list[tuple[PointRing, Unknown, Any]]:
        """Unknowns and the polynomials in them whose roots meet every sheet.

        More than one where some factor of the expression lacks the first unknown.

        Args:
            way: Its steps are followed.
            text: Of the expression.
            before: The other unknowns have its values; if left out, random ones.

        Raises:
            RefusedError: If the expression has too high a degree.
        """
        before = next(self.choices(way)) if before is None else before
        found = []
        unknowns = self.postures.unknowns_of([text], way)
        left = self.restricted(way, text, before, unknowns)
        other = before
        while left:
            unknown = min(left, key=lambda u: (left[u].degree(), str(u)))
            found.append((before, unknown, left.pop(unknown)))
            # A factor without the unknowns that were moved stays when they change.
            value = random_residue(self._source, self.postures.prime)
            other = placed(other, unknown, value)
            there = self.restricted(way, text, other, left)
            shared = {u: left[u].gcd(there[u]) for u in left if u in there}
            left = {u: own for u, own in shared.items() if own.degree() > 0}
        return found

    def restricted(
        self,
        way: Way,
        text: str,
        before: PointRing,
        unknowns: Iterable[Unknown],
    ) -> dict[Unknown, Any]:
        """An expression as a polynomial in one unknown alone, where it has a root.

        Of a fraction the numerator.
        """
        found = {u: self.numerator(way, text, before, u) for u in unknowns}
        return {u: own for u, own in found.items() if own.degree() > 0}

    def numerator(
        self, way: Way, text: str, before: PointRing, unknown: Unknown
    ) -> Any:
        """An expression as a polynomial in one unknown; of a fraction the numerator.

        Raises:
            RefusedError: If the expression has too high a degree.
        """
        expression = read(text)

        def value(place: Any) -> Any:
            try:
                moved = placed(before, unknown, place)
                return self.postures.moved(moved, way).value(expression)
            except (ResampleError, ZeroDivisionError):
                return None

        try:
            return fraction_of(value, self._source, self.postures.prime)[0]
        except NoFractionError:
            raise RefusedError(f"{text} has too high a degree") from None


def placed(point: PointRing, unknown: Unknown, value: Any) -> PointRing:
    """The point with another value of a symbol, or an angle turned further.

    Args:
        point: Where everything else is as it was.
        unknown: What is moved.
        value: Of the symbol, or the tangent of half the further turn.

    Raises:
        ResampleError: If no turn has this tangent.
    """
    if isinstance(unknown, str):
        return point.changed(numbers={unknown: value})
    turn = turn_of(value)
    if turn is None:
        raise ResampleError
    (c, s), (cosine, sine) = turn, point.turns[unknown]
    return point.changed(unknown, (cosine * c - sine * s, sine * c + cosine * s))
