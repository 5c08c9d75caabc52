"""A search for common zeros: its records, and branches by irreducible conditions."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, field

from screwkit.algebra.branches import Branch, is_solvable, restricted, without
from screwkit.algebra.cases import possible_factors
from screwkit.algebra.factors import Factor, FactorLibrary
from screwkit.algebra.trigonometric import Polynomial, primitive


@dataclass(frozen=True)
class Decomposition:
    """Branches whose union is the common zero set, up to what is open.

    Attributes:
        branches: On each of them every polynomial vanishes.
        open: Pieces that contain all further zeros, if there are any.
        special: Pieces met only by special dimensions of the mechanism; not searched.
    """

    branches: tuple[Branch, ...]
    open: tuple[Branch, ...] = ()
    special: tuple[Branch, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether nothing is left open."""
        return not self.open


@dataclass
class Search:
    """One decomposition under way: its budget, and the factors met so far.

    With ``every_part`` all parts are wanted, those too that are no parts of the locus.
    """

    library: FactorLibrary
    budget: int = 600
    largest: int = 400
    skip: Callable[[Branch], bool] = lambda branch: False
    source: random.Random = field(default_factory=lambda: random.Random(20121))
    found: list[Branch] = field(default_factory=list)
    unfinished: list[Branch] = field(default_factory=list)
    special: list[Branch] = field(default_factory=list)
    problem: tuple[Polynomial, ...] = ()
    every_part: bool = False


def irreducible_parts(branch: Branch, search: Search) -> list[Branch]:
    """The branch split until all its pending conditions are irreducible on it."""
    parts = refined(branch, search)
    if parts is None:
        return [branch]
    return [inner for part in parts for inner in irreducible_parts(part, search)]


def refined(branch: Branch, search: Search) -> list[Branch] | None:
    """The branch with pending conditions that later steps made reducible split up.

    None where all of them are still irreducible.
    """
    for pending in branch.pending:
        if len(pending.value) > search.largest:
            continue
        cases = possible_factors(branch, pending.value, search.library)
        same = len(cases) == 1 and str(cases[0].equations[0]) in (
            str(pending.value),
            str(primitive(pending.value)),
        )
        if same and not is_solvable(branch, cases[0].equations[0]):
            continue
        before = without(branch, pending)
        return [part for case in cases for part in parts_where(before, case, search)]
    return None


def parts_where(branch: Branch, case: Factor, search: Search) -> list[Branch]:
    """The parts of a branch on which a factor vanishes.

    A half-angle factor that cannot be solved has no single equation to go on with; it
    is left open.
    """
    parts = restricted(branch, case.equations[0], case.equations[1:])
    if len(case.equations) == 1 or not parts:
        return parts
    if len(parts[0].pending) > len(branch.pending):
        search.unfinished.extend(parts)
        return []
    return parts
