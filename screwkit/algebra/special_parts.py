"""Parts of a branch that tie no dimensions, although its points lie on one that does.

Several conditions can be homogeneous in lengths of the posture and in a difference of
dimensions (z, x and a − b): all vanish where these do, and points are drawn there.
Where their determinant vanishes other postures meet them, at any dimensions.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

import random
from dataclasses import replace

from screwkit.algebra.branches import Branch, Pending, restricted, without
from screwkit.algebra.linear_systems import LinearSystem, linear_systems
from screwkit.algebra.points import residue
from screwkit.algebra.points_on import Unknown, coefficients_in, unknowns
from screwkit.algebra.search import Search, irreducible_parts, replace_steps
from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.trigonometric import Polynomial
from screwkit.algebra.unshown_parts import SETTLING, Zeros, settling

_NESTED = 2
"""Searches for parts, in each other, in which special sets are taken apart too."""

_DEEPEST = 6
"""The same of sets of which all but a small part is seen to be special at once."""

_SHEETS = 2
"""Roots of a condition that points tell apart."""

_DRAWN = 40
"""Points, each at one of the roots at random; they miss one in one case of 2³⁹."""

_SEEN = 12
"""Special branches, met one beside the other, that are taken for one."""


def parts_beside_special(
    branch: Branch, search: Search, zeros: Zeros
) -> tuple[Branch, ...] | None:
    """Parts of the size of a special branch that are not special.

    Args:
        branch: Special at its points.
        search: Known factors.
        zeros: `decomposition.common_zeros`.

    Returns:
        None where it could not be settled whether these are all.
    """
    found: list[Branch] = []
    seen: list[Branch] = []
    waiting = [branch]
    while waiting:
        here = waiting.pop()
        if any(here.texts == b.texts and here.sheets == b.sheets for b in seen):
            continue
        seen.append(here)
        parts = _beside(here, search, zeros)
        if parts is None or len(seen) > _SEEN:
            return None
        waiting += [part for part in parts if part.is_special]
        found += [part for part in parts if not part.is_special]
    return tuple(found)


def _beside(branch: Branch, search: Search, zeros: Zeros) -> tuple[Branch, ...] | None:
    """Parts of the size of a special branch that its points do not show.

    A condition with an unknown of its own, that is no dimension, ties the same
    dimensions as the others do, but where all its coefficients in that unknown vanish.
    Conditions that give some symbols together are a graph over the others, one part
    where these are, but where their determinant vanishes.  Cheaper are subsets of a
    set that is special all over, and a condition with two roots at most over such a
    set, or over any irreducible one where points at both are special.

    Returns:
        Among them are all that are not special; None where that could not be settled.
    """
    if len(branch.pending) < 2 or _lies_in_special(branch):
        return ()
    if search.nested >= _DEEPEST:
        return None
    for pending in branch.pending:
        for unknown in _own_unknowns(branch, pending, dimensions=True):
            found = _beside_two_sheets(branch, pending, unknown, search, zeros)
            if found is not None:
                return found
    for system in linear_systems(branch.ring, [p.value for p in branch.pending]):
        found = _beside_a_graph(branch, system, search, zeros)
        if found is not None:
            return found
    if search.nested >= _NESTED:
        return None
    for pending in branch.pending:
        for unknown in _own_unknowns(branch, pending):
            found = _beside_a_root(branch, pending, unknown, search, zeros)
            if found is not None:
                return found
    return None


def _lies_in_special(branch: Branch) -> bool:
    """Whether what is solved ties dimensions, alone or with one pending condition.

    That set is irreducible, so that its points speak for all of it and what lies in it.
    """
    return any(
        wider.points and wider.is_special
        for kept in (None, *branch.pending)
        for wider in [_with_one(branch, kept)]
    )


def _with_one(branch: Branch, kept: Pending | None) -> Branch:
    """The branch with one of its pending conditions at most."""
    for pending in branch.pending:
        if pending is not kept:
            branch = without(branch, pending)
    return branch


def _beside_two_sheets(
    branch: Branch, pending: Pending, unknown: Unknown, search: Search, zeros: Zeros
) -> tuple[Branch, ...] | None:
    """Where a condition over an irreducible set has two roots at most, all tied.

    These roots are one part or two, each over all of that set, and many random points
    are asked.  What is left is where all coefficients vanish.
    """
    before = without(branch, pending)
    if len(before.pending) > 1 or _roots(branch, pending, unknown) > _SHEETS:
        return None
    coefficients = coefficients_in(branch.ring, pending.value, unknown)
    source = random.Random(31)
    for _ in range(_DRAWN):
        point = branch.point(source)
        if point is None or not branch.ties_dimensions_at(*point):
            return None
        if not any(residue(value, *point) for value in coefficients):
            return None
    free = zeros(before, coefficients, settling(branch, search))
    return free.branches if free.complete else None


def _roots(branch: Branch, pending: Pending, unknown: Unknown) -> int:
    """How many values of an unknown a condition has at most."""
    kind, number = unknown
    if kind == "x":
        return int(pending.value.degrees()[number])
    parts = angle_parts(branch.ring, pending.value, number)
    return _SHEETS if parts is not None else _SHEETS + 1


def _own_unknowns(
    branch: Branch, pending: Pending, *, dimensions: bool = False
) -> list[Unknown]:
    """Unknowns of one condition that are in no other; dimensions only if asked for."""
    if pending.beside:
        return []
    ring = branch.ring
    others = {
        unknown
        for p in branch.pending
        if p is not pending
        for value in (p.value, *p.beside)
        for unknown in unknowns(ring, value)
    }
    barred = set() if dimensions else {("x", index) for index in branch.dimensions}
    own = unknowns(ring, pending.value)
    return [u for u in own if u not in others and u not in barred]


def _beside_a_root(
    branch: Branch, pending: Pending, unknown: Unknown, search: Search, zeros: Zeros
) -> tuple[Branch, ...] | None:
    before = without(branch, pending)
    if not before.points or not before.is_special:
        return None
    inner = _beside(before, search, zeros)
    if inner is None:
        return None
    coefficients = coefficients_in(branch.ring, pending.value, unknown)
    free = zeros(before, coefficients, settling(branch, search))
    if not free.complete:
        return None
    found = list(free.branches)
    for part in inner:
        value = replace_steps(part, part.steps[len(before.steps) :]).value(
            pending.value
        )
        if value == 0 or part.vanishes([value]):
            return None
        split = replace(search, found=[], unfinished=[], special=[])
        for piece in restricted(part, value):
            found += irreducible_parts(piece, split)
        if split.unfinished:
            return None
    return tuple(found)


def _beside_a_graph(
    branch: Branch, system: LinearSystem, search: Search, zeros: Zeros
) -> tuple[Branch, ...] | None:
    held = [branch.pending[k] for k in system.conditions]
    if any(p.beside for p in branch.pending):
        return None
    if not all(residue(system.determinant, *at) for at in branch.points):
        return None
    before = branch
    for pending in held:
        before = without(before, pending)
    if len(before.pending) > 1:
        return None
    vanishing: list[Polynomial] = [system.determinant, *(p.value for p in held)]
    for p in before.pending:
        vanishing += [vanishing[0] - p.value, vanishing[0] + p.value]
    own = replace(settling(branch, search), budget=4 * SETTLING)
    found = zeros(before, vanishing, own)
    return found.branches if found.complete else None
