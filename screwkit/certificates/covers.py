"""Trees that lead from the equations of a component to all of its sheets."""

from __future__ import annotations

from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.conditions import Place, Problem, with_conditions
from screwkit.certificates.derivation import ProofSearch
from screwkit.certificates.records import Node
from screwkit.certificates.roots import NotProvedError

NODES = 120
"""Nodes of one tree."""


class _Cover(ProofSearch):
    """Solves equations one after the other, as far as they can be solved."""

    def node(self, place: Place) -> Node:
        """A condition that is a product or can be solved; else a sheet."""
        number = self.count
        self.count += 1
        if self.count > NODES:
            raise NotProvedError("the equations have too many sheets")
        return self.split_condition(place, number) or Node(number, sheet=True)


def cover_of(problem: Problem, equations: tuple[Polynomial, ...]) -> Node | None:
    """The tree of some equations; None where none was found."""
    start = with_conditions(problem.root, equations)
    try:
        return _Cover(problem, 0).node(Place(start, equations))
    except (NotProvedError, ValueError):
        return None
