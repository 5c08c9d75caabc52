"""Nodes at which conditions are met in turn, with what follows elsewhere."""

from __future__ import annotations

from abc import ABC
from collections.abc import Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.branches import without
from screwkit.algebra.factors import Factor
from screwkit.algebra.polynomial_text import text
from screwkit.certificates.case_nodes import CaseNodes
from screwkit.certificates.conditions import Place
from screwkit.certificates.met_conditions import Met
from screwkit.certificates.records import Case, Node
from screwkit.certificates.texts import read


@dataclass
class SheetNodes(CaseNodes, ABC):
    """Writes such nodes."""

    def bare_sheet(self, place: Place, number: int, order: Sequence[Met]) -> Node:
        """A sheet without what follows on its cases."""
        ring = place.branch.ring
        cases = tuple(
            Case(tuple(text(ring, own) for own in met.coefficients), 1) for met in order
        )
        roots = tuple(met.written(ring) for met in order)
        return Node(number, sheet=True, roots=roots, cases=cases)

    def sheet_of(self, place: Place, number: int, order: Sequence[Met]) -> Node:
        """A sheet, with a case for each condition that is met on it."""
        bare = self.bare_sheet(place, number, order)
        cases = tuple(self.unsaid(place, met) for met in order)
        return replace(bare, cases=cases)

    def unsaid(self, place: Place, met: Met) -> Case:
        """What follows where conditions say nothing of their unknowns."""
        ring = place.branch.ring
        end = self.end_of(place, met)
        if end is not None:
            return end
        branch = place.branch
        if len(met.pending) == 1:  # it is implied there
            branch = without(branch, met.pending[0])
        texts = tuple(text(ring, own) for own in met.coefficients)
        option = self.where(replace(place, branch=branch), met.coefficients)
        return Case(texts, 1, kept=self.on_sheet(option))

    def end_of(self, place: Place, met: Met) -> Case | None:
        """A coefficient that vanishes nowhere, or for special dimensions alone."""
        ring = place.branch.ring
        for own in met.coefficients:
            written = text(ring, own)
            if self.problem.signs.never_zero(read(written)):
                return Case((written,), 1, end="positive")
            if self.is_of_dimensions(place.branch, Factor(written, (own,))):
                return Case((written,), 1, end="special")
        return None

    def cost(self, place: Place, met: Met) -> int:
        """Roughly what is left where conditions say nothing; 0 if nothing is."""
        if self.end_of(place, met) is not None:
            return 0
        return 2 + min(map(len, met.coefficients)) + len(met.coefficients)
