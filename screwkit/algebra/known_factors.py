"""Factors met before, divided out of a polynomial.

Mechanisms have few factors, and there may be thousands: only those are tried whose
unknowns all occur, and only where they divide in all restrictions.
"""

from __future__ import annotations

from screwkit.algebra.division import Divisor
from screwkit.algebra.restrictions import Layout, Restrictions, divides
from screwkit.algebra.trigonometric import Polynomial, primitive


class KnownFactors:
    """Irreducible polynomials, in the order in which they were met.

    Args:
        layout: Of their ring.
    """

    def __init__(self, layout: Layout) -> None:
        self._layout = layout
        self._known: list[tuple[str, Divisor, Restrictions]] = []
        self._by_unknowns: dict[frozenset[tuple[int, ...]], list[int]] = {}

    def add(self, key: str, divisor: Divisor, restrictions: Restrictions) -> None:
        """Take note of a factor, by its name.

        Args:
            key: Its name.
            divisor: Divides by it.
            restrictions: Of it, at the library's point, up to numbers.
        """
        same = self._by_unknowns.setdefault(frozenset(restrictions), [])
        same.append(len(self._known))
        self._known.append((key, divisor, restrictions))

    def divided(
        self, polynomial: Polynomial, known: Restrictions
    ) -> tuple[list[tuple[str, int]], Polynomial, Restrictions]:
        """Known factors of a polynomial, what is left of it, and its restrictions.

        A factor must divide in all restrictions; the division itself is exact, so
        nothing rests on the point.
        """
        found = []
        occurring = frozenset(known)
        groups = (n for own, n in self._by_unknowns.items() if own <= occurring)
        for number in sorted(n for group in groups for n in group):
            key, divisor, parts = self._known[number]
            multiplicity = 0
            while divides(parts, known):
                quotient = divisor.divide(polynomial)
                if quotient is None:
                    break
                polynomial = primitive(quotient)
                occurs = self._layout.degrees(polynomial)
                known = {
                    v: restricted // parts[v] if v in parts else restricted
                    for v, restricted in known.items()
                    if v in occurs
                }
                multiplicity += 1
            if multiplicity:
                found.append((key, multiplicity))
                if polynomial.is_constant():
                    break
        return found, polynomial, known
