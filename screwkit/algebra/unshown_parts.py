"""Parts of a branch with several pending conditions that its points do not show.

The last of them may be a product where the others vanish: where all its coefficients in
an unknown vanish together it says nothing about that unknown.  Its points lie on one
part then.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

from screwkit.algebra.branches import Branch, without
from screwkit.algebra.fixed_directions import fixed_directions
from screwkit.algebra.linear_systems import linear_systems, solutions_of
from screwkit.algebra.one_part import are_one_part, leaves_one_part
from screwkit.algebra.points import residue
from screwkit.algebra.points_on import coefficients_in, unknowns
from screwkit.algebra.quotients import quotient_of
from screwkit.algebra.search import (
    Decomposition,
    Search,
    is_surely_smaller,
    replace_steps,
)
from screwkit.algebra.trigonometric import Polynomial

SETTLING = 60  # case distinctions to tell a branch from spurious zeros
_NESTED = 12  # searches for parts inside each other

Zeros: TypeAlias = Callable[[Branch, Sequence[Polynomial], Search], Decomposition]
"""Common zeros on a branch: `decomposition.common_zeros`, which asks here in turn."""


def told_apart(branch: Branch, search: Search, zeros: Zeros) -> Branch | None:
    """The branch with what distinguishes it from other zeros of its conditions.

    The last of several pending conditions may be a product where the others vanish:
    where all its coefficients in one unknown vanish together, it says nothing about
    that unknown.  Such a spurious part is excluded by a polynomial of the problem that
    does not vanish there.  None where that could not be settled.
    """
    settled = settled_parts(branch, search, zeros)
    return None if settled is None else settled[0]


def settled_parts(
    branch: Branch, search: Search, zeros: Zeros
) -> tuple[Branch, tuple[Branch, ...]] | None:
    """The same, and parts that are no spurious ones, on which it does not lie.

    Such a part has the size of the branch, and all polynomials of the problem vanish on
    it: conditions y·s = z·c and x·c = z·s hold where x = y = z = 0, and where x, s and
    z are 0.  They are given only if equations of the branch were found that tell it
    from them.
    """
    if len(branch.pending) < 2 or search.every_part:
        return branch, ()
    parts = parts_beside(branch, search, zeros)
    if parts is None:
        return None
    exact = _excluding(branch, parts, search)
    alike = [p for p in parts if _is_alike(p, branch, search)]
    own = _solved(branch) if alike else []
    if not all(any(_is_off(e, part) for e in own) for part in alike):
        return exact, ()
    return replace(exact, extra=(*exact.extra, *own)), tuple(alike)


def _is_alike(part: Branch, branch: Branch, search: Search) -> bool:
    return (
        part.codimension == branch.codimension
        and bool(part.points)
        and not any(_is_off(polynomial, part) for polynomial in search.problem)
    )


def _is_off(polynomial: Polynomial, branch: Branch) -> bool:
    """Whether a polynomial is not zero on a branch."""
    return any(residue(polynomial, *at) for at in branch.points)


def _solved(branch: Branch) -> list[Polynomial]:
    """What pending conditions say of symbols that they determine as polynomials."""
    ring, found = branch.ring, list[Polynomial]()
    values = [pending.value for pending in branch.pending]
    for system in linear_systems(ring, values):
        above = solutions_of(ring, values, system)
        for symbol, value in zip(system.symbols, above, strict=True):
            solved = quotient_of(ring, ring.normal(value), system.determinant)
            if solved is not None:
                found.append(ring.normal(ring.context.gen(symbol) - solved))
    return [own for own in found if not _is_off(own, branch)]


def parts_beside(
    branch: Branch, search: Search, zeros: Zeros
) -> tuple[Branch, ...] | None:
    """Where all coefficients of the last pending condition in an unknown vanish.

    None where it could not be settled.
    """
    if len(branch.pending) < 2 or branch.shown == branch.texts:
        return ()
    last = branch.pending[-1]
    before = without(branch, last)
    if branch.directed:
        fixed = fixed_directions(branch)
        if len(fixed) == len(branch.pending) and not are_one_part(branch, fixed):
            return None
        if _is_over_directions(branch, search, zeros):
            return ()
    others = {u for p in before.pending for u in unknowns(branch.ring, p.value)}
    own = [u for u in unknowns(branch.ring, last.value) if u not in others]
    for unknown in sorted(own):
        coefficients = coefficients_in(branch.ring, last.value, unknown)
        spurious = zeros(before, coefficients, settling(branch, search))
        if spurious.complete:
            return spurious.branches
    earlier = _beside_an_earlier(branch, search, zeros)
    return _beside_a_system(branch, search, zeros) if earlier is None else earlier


def _beside_an_earlier(
    branch: Branch, search: Search, zeros: Zeros
) -> tuple[Branch, ...] | None:
    """The same of another condition than the last, over others that hide no part."""
    if search.nested >= _NESTED:
        return None
    for pending in branch.pending[:-1]:
        before = without(branch, pending)
        others = {u for p in before.pending for u in unknowns(branch.ring, p.value)}
        own = [u for u in unknowns(branch.ring, pending.value) if u not in others]
        if not own or pending.beside or told_apart(before, search, zeros) != before:
            continue
        for unknown in sorted(own):
            coefficients = coefficients_in(branch.ring, pending.value, unknown)
            spurious = zeros(before, coefficients, settling(branch, search))
            if spurious.complete:
                return spurious.branches
    return None


def _is_over_directions(branch: Branch, search: Search, zeros: Zeros) -> bool:
    """Whether the last condition, where angles alone are fixed, leaves no such part.

    It leaves one part where none of the angles is free, and vanishes on nothing as
    large as the branch where one is.
    """
    condition = branch.pending[-1].value
    before = without(branch, branch.pending[-1])
    fixed = fixed_directions(before)
    if len(fixed) < len(before.pending):
        return False
    if not are_one_part(before, fixed):
        return False
    if not leaves_one_part(before, condition, fixed):
        return False
    for direction in fixed:
        ends = [direction.across, direction.along]
        free = zeros(without(before, direction.pending), ends, settling(branch, search))
        if not free.complete or not all(b.points for b in free.branches):
            return False
        for part in free.branches:
            on_part = replace_steps(part, part.steps[len(before.steps) :])
            if part.vanishes([on_part.value(condition)]):
                return False
    return True


def settling(branch: Branch, search: Search) -> Search:
    """For parts as large as the branch; smaller ones are no parts of their own."""
    own = Search(
        search.library,
        budget=SETTLING,
        largest=search.largest,
        nested=search.nested + 1,
    )
    own.further = search.further
    size = branch.codimension
    return replace(
        own,
        skip=lambda part: part.codimension > size,
        surely=lambda part: is_surely_smaller(part, size, own),
    )


def _beside_a_system(
    branch: Branch, search: Search, zeros: Zeros
) -> tuple[Branch, ...] | None:
    """The same where pending conditions determine some symbols together.

    Away from the zeros of the determinant they are a graph over the other conditions,
    as irreducible as these.
    """
    values = [p.value for p in branch.pending]
    if search.nested >= _NESTED:
        return None  # the parts may be given by the same system again
    for system in linear_systems(branch.ring, values):
        before = branch
        for k in system.conditions:
            before = without(before, branch.pending[k])
        if told_apart(before, search, zeros) != before:
            continue
        vanishing = [system.determinant, *(values[k] for k in system.conditions)]
        for p in before.pending:
            vanishing += [vanishing[0] - p.value, vanishing[0] + p.value]
        own = replace(settling(branch, search), budget=4 * SETTLING)
        spurious = zeros(before, vanishing, own)
        if spurious.complete:
            return spurious.branches
    return None


def _excluding(branch: Branch, spurious: Sequence[Branch], search: Search) -> Branch:
    """The branch with an equation that fails on each spurious part of its size."""
    extra: list[Polynomial] = []
    for part in spurious:
        if part.codimension > branch.codimension or not part.points:
            continue
        tell = [p for p in search.problem if _is_off(p, part)]
        if tell and not any(e in tell for e in extra):
            extra.append(min(tell, key=len))
    return replace(branch, extra=(*branch.extra, *extra))
