"""A branch on which angles are fixed, and one more condition holds, as one part.

Where conditions fix angles up to half a turn and the norm of one more condition is
irreducible (`one_part`), they leave one part where no direction is (0, 0).  It may have
no unknown by which exact points are drawn: solved for one coordinate after the other,
where their coefficients are not zero, it has.

References: [CoxLittleOShea] §5.4 (the coordinate ring of a variety).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch, Pending, without
from screwkit.algebra.fixed_directions import Direction, fixed_directions
from screwkit.algebra.one_part import are_one_part, one_norm_beside
from screwkit.algebra.points import residue
from screwkit.algebra.search import Search, irreducible_parts
from screwkit.algebra.splitting import split
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.trigonometric import Polynomial

_TRIED = 12
"""Branches that are solved for a coordinate."""


@dataclass(frozen=True)
class OnlyPart:
    """A branch as one part, but for parts on which something short vanishes.

    Attributes:
        part: With the conditions of the branch, and points.
        beside: What vanishes on other parts.
    """

    part: Branch
    beside: tuple[Polynomial, ...]


def only_part(branch: Branch, search: Search) -> OnlyPart | None:
    """The branch, solved so that it has points, where it is shown to be one part.

    Args:
        branch: Where it has no points, and angles that conditions fix are kept.
        search: Known factors.

    Returns:
        None where that was not shown.
    """
    if not branch.directed or branch.points:
        return None
    shown = _directions(branch)
    if shown is None:
        return None
    directions, beside = shown
    nonzero = [*(direction.square(branch.ring) for direction in directions), *beside]
    for solved in _solved(replace(branch, directed=False), search):
        whole = replace(solved, steps=solved.steps[len(branch.steps) :])
        values = [whole.value(own) for own in nonzero]
        if all(any(residue(v, *at) for at in solved.points) for v in values):
            kept = () if beside else branch.texts
            found = replace(solved, conditions=branch.conditions, shown=frozenset(kept))
            return OnlyPart(found, tuple(beside))
    return None


def _directions(branch: Branch) -> tuple[list[Direction], list[Polynomial]] | None:
    """Those that all conditions but one fix, if the conditions leave one part."""
    for last in reversed(branch.pending):
        before = without(branch, last)
        fixed = fixed_directions(before)
        if last.companions or last.beside or len(fixed) < len(before.pending):
            continue
        if not are_one_part(before, fixed):
            continue
        beside = one_norm_beside(before, last.value, fixed)
        if beside is not None:
            return fixed, beside
    return None


def _solved(branch: Branch, search: Search) -> Iterator[Branch]:
    """Parts as large as the branch that have points."""
    waiting = [branch]
    for _ in range(_TRIED):
        if not waiting:
            return
        here = waiting.pop(0)
        if here.points:
            yield here
            continue
        choice = _shortest(here)
        if choice is None:
            continue
        pending, index = choice
        solved = split(without(here, pending), pending.value, (index,))
        if solved is None or solved.solved is None:
            continue
        own = replace(search, found=[], unfinished=[], special=[])
        waiting += [
            part
            for part in irreducible_parts(solved.solved, own)
            if part.codimension == branch.codimension
            and all(divisor != 0 for divisor in part.divisors)
        ]


def _shortest(branch: Branch) -> tuple[Pending, int] | None:
    """A condition and a coordinate in which it is linear, with a short coefficient."""
    best: tuple[int, Pending, int] | None = None
    for pending in branch.pending:
        degrees = pending.value.degrees()
        for index in branch.ring.symbol_indices():
            if degrees[index] != 1 or index in branch.dimensions or pending.companions:
                continue
            size = len(linear_parts(branch.ring, pending.value, index)[0])
            if best is None or size < best[0]:
                best = size, pending, index
    return None if best is None else best[1:]
