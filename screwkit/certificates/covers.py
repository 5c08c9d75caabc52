"""Trees that lead from the equations of a component to all of its sheets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from screwkit.algebra.branches import Branch, Pending, without
from screwkit.algebra.division import exact_quotient
from screwkit.algebra.factors import Factor
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.substitution import angle_parts, linear_parts
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.conditions import Place, Problem, with_conditions
from screwkit.certificates.derivation import ProofSearch
from screwkit.certificates.records import Case, Node, Unsolved
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.steps import followed
from screwkit.certificates.texts import read

NODES = 120
"""Nodes of one tree."""


@dataclass(frozen=True)
class _Met:
    """A condition with the unknown in which it is linear, and its coefficients."""

    pending: Pending
    unknown: Unknown
    coefficients: tuple[Polynomial, ...]


class _Cover(ProofSearch):
    """Solves equations one after the other, as far as they can be solved."""

    def node(self, place: Place) -> Node:
        """A condition that is a product or can be solved; else a sheet."""
        number = self.count
        self.count += 1
        if self.count > NODES:
            raise NotProvedError("the equations have too many sheets")
        return self.split_condition(place, number) or self.sheet(place, number)

    def sheet(self, place: Place, number: int) -> Node:
        """What is left when nothing can be split or solved."""
        return Node(number, sheet=True)


class _WholeCover(_Cover):
    """Where several conditions meet, one after the other is met, with its cases.

    Attributes:
        equations: How many the component has.
    """

    equations = 0

    def node(self, place: Place) -> Node:
        """A condition that is a product or can be solved; else a sheet."""
        branch, number = place.branch, self.count
        ended = self.ended(place, number)
        if len(branch.steps) + bool(branch.pending) > self.equations:
            ended = Node(number, small=True)
        if ended is not None:
            self.count += 1
            return ended
        return super().node(place)

    def sheet(self, place: Place, number: int) -> Node:
        """A sheet, with a case for each condition that is met on it."""
        if len(place.branch.pending) < 2:
            return Node(number, sheet=True)
        order = self._order(place)
        ring = place.branch.ring
        roots, cases = [], []
        for met in order:
            kind, index = met.unknown
            written = text(ring, met.pending.condition)
            if kind == "x":
                name = ring.symbols[index - ring.symbol_indices().start]
                roots.append(Unsolved(written, symbol=name))
            else:
                roots.append(Unsolved(written, angle=index))
            cases.append(self._coefficients_vanish(place, met))
        return Node(number, sheet=True, roots=tuple(roots), cases=tuple(cases))

    def _coefficients_vanish(self, place: Place, met: _Met) -> Case:
        """What follows where all coefficients of a condition vanish."""
        ring = place.branch.ring
        for own in met.coefficients:
            written = text(ring, own)
            if self.problem.signs.never_zero(read(written)):
                return Case((written,), 1, end="positive")
            if self.is_of_dimensions(place.branch, Factor(written, (own,))):
                return Case((written,), 1, end="special")
        before = replace(place, branch=without(place.branch, met.pending))
        texts = tuple(text(ring, own) for own in met.coefficients)
        option = self.where(before, met.coefficients)
        return Case(texts, 1, kept=self.on_sheet(option))

    def _order(self, place: Place) -> tuple[_Met, ...]:
        """Conditions, each linear in an unknown that those before it lack.

        Those that are left out vanish where the others do.

        Raises:
            NotProvedError: If there are none.
        """
        branch = place.branch
        told = [own for own in branch.pending if not self._is_multiple(branch, own)]
        for size in range(len(told)):
            for left_out in combinations(told, size):
                kept = [own for own in told if own not in left_out]
                found = next(self._orders(place, kept), None)
                if found is None:
                    continue
                fewer = replace(branch, pending=tuple(kept))
                if not left_out or self.meet(fewer, [own.value for own in left_out]):
                    return found
        raise NotProvedError("the conditions of a sheet cannot be met one by one")

    def _is_multiple(self, branch: Branch, own: Pending) -> bool:
        """Whether a condition is a multiple of a shorter one."""
        return any(
            len(other.value) < len(own.value)
            and exact_quotient(own.value, other.value) is not None
            for other in branch.pending
        )

    def _orders(
        self, place: Place, left: Sequence[Pending]
    ) -> Iterator[tuple[_Met, ...]]:
        """Orders of conditions, those with few further cases first."""
        if not left:
            yield ()
            return
        ring = place.branch.ring
        found = list[_Met]()
        for own in left:
            others = {
                u
                for other in left
                if other is not own
                for u in unknowns(ring, other.value)
            }
            for unknown in unknowns(ring, own.value):
                if unknown not in others:
                    found += self._linear(place, own, unknown)
        found.sort(key=lambda met: self._cost(place, met))
        for met in found:
            rest = [own for own in left if own is not met.pending]
            for order in self._orders(place, rest):
                yield (*order, met)

    def _linear(self, place: Place, own: Pending, unknown: Unknown) -> Iterator[_Met]:
        ring = place.branch.ring
        kind, index = unknown
        (value,), powers = followed(place.branch, [own.condition])
        if powers:  # the checker knows nothing of what it was multiplied with
            return
        parts: tuple[Polynomial, ...] | None
        if kind == "x":
            if value.degrees()[index] != 1:
                return
            parts = linear_parts(ring, value, index)
        else:
            parts = angle_parts(ring, value, index)
        for part in parts or ():
            if followed(place.branch, [part])[0][0] != 0:
                yield _Met(own, unknown, tuple(p for p in parts or () if p != 0))
                return

    def _cost(self, place: Place, met: _Met) -> int:
        ring, branch = place.branch.ring, place.branch
        for own in met.coefficients:
            written = text(ring, own)
            if self.problem.signs.never_zero(read(written)):
                return 0
            if self.is_of_dimensions(branch, Factor(written, (own,))):
                return 1
        return 2 + sum(map(len, met.coefficients))


def cover_of(
    problem: Problem, equations: tuple[Polynomial, ...], *, whole: bool
) -> Node | None:
    """The tree of some equations; None where none was found.

    Args:
        problem: Of the mechanism.
        equations: Of the component.
        whole: Whether every sheet has to be met; else several conditions may meet on
            one, of which it is not known where they hold.
    """
    start = with_conditions(problem.root, equations)
    search: _Cover = _Cover(problem, 0)
    if whole:
        search = _WholeCover(problem, 0)
        search.equations = len(equations)
    try:
        return search.node(Place(start, equations))
    except (NotProvedError, ValueError):
        return None
