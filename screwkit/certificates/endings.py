"""Why nothing is left to be done at a node: on a component, or in another node."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from weakref import WeakKeyDictionary

from screwkit.algebra.factors import Factor
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.certificates.conditions import Conditions, Option, Place
from screwkit.certificates.records import Node


@dataclass(frozen=True)
class Finished:
    """A node that is finished.

    Attributes:
        solved: Equations that its steps solve.
        conditions: On the way to it.
    """

    number: int
    solved: tuple[Polynomial, ...]
    conditions: tuple[Polynomial, ...]


@dataclass
class Endings(Conditions):
    """Questions about the branches of one problem, with the nodes that are finished.

    Attributes:
        finished: In the order in which they were.
    """

    finished: list[Finished] = field(default_factory=list, kw_only=True)
    _by_itself: WeakKeyDictionary[Place, Node | None] = field(
        default_factory=WeakKeyDictionary, init=False
    )

    def finish(self, number: int, place: Place) -> None:
        """Note a node with what tells its postures."""
        branch = place.branch
        sheets = {str(sheet) for sheet in branch.sheets}
        unsolved = {str(pending.condition) for pending in branch.pending}
        solved = tuple(e for e in branch.equations(sheets) if str(e) not in unsolved)
        self.finished.append(Finished(number, solved, place.conditions))

    def ended(self, place: Place, number: int) -> Node | None:
        """Why nothing is to be done on a node; None where something is."""
        if place not in self._by_itself:
            self._by_itself[place] = self._ended_by_itself(place)
        found = self._by_itself[place]
        if found is not None:
            return replace(found, number=number)
        branch = place.branch
        for earlier in self.finished:
            if (
                branch.points
                and self.all_vanish((*earlier.solved, *earlier.conditions), branch)
                and all(branch.value(equation) == 0 for equation in earlier.solved)
                and self.surely(place, earlier.conditions)
            ):
                return Node(number, earlier=earlier.number)
        return None

    def _ended_by_itself(self, place: Place) -> Node | None:
        """Why nothing is to be done on a node, other nodes aside."""
        branch = place.branch
        for label, square in self.problem.axes.items():
            multiples = self.multiples(place, [square])
            if multiples is None:
                multiples = self.multiples(place, self.problem.directions[label])
            if multiples is not None:
                return Node(-1, axis=label, multiples=multiples)
        symbol = branch.vanishing_symbol
        if symbol is not None:
            return Node(-1, vanishing=symbol)
        for k, equations in enumerate(self.problem.components):
            if not branch.points or self.all_vanish(equations, branch):
                multiples = self.multiples(place, equations)
                if multiples is not None:
                    return Node(-1, component=k, multiples=multiples)
        return None

    def is_held(self, place: Place, factors: Iterable[tuple[Factor, int]]) -> bool:
        """Whether some factor vanishes where unsolved conditions of the node do."""
        held = {str(primitive(pending.value)) for pending in place.branch.pending}
        return any(
            all(str(primitive(equation)) in held for equation in own.equations)
            for own, _ in factors
        )

    def is_open(self, option: Option) -> bool:
        """Whether work is left there."""
        branch = option.place.branch
        if option.impossible is not None or (branch.points and branch.is_special):
            return False
        return self.ended(option.place, -1) is None
