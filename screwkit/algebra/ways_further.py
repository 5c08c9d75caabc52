"""Ways on from a branch whose pending conditions cannot be solved one by one.

Two of them may imply something simpler, several may be solved together, or one may give
an angle that is taken out of another.  Each way is a list of parts whose union is the
branch, with what is still to be imposed on each.

References: [CoxLittleOShea] §3.1, §3.6 (elimination, and what partial solutions miss).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.cases import (
    implied_cases,
    implied_products,
    possible_factors,
    terms_of,
)
from screwkit.algebra.factors import Factor
from screwkit.algebra.search import Search, before_pending
from screwkit.algebra.splitting import (
    Split,
    split_angle,
    split_difference,
    split_system,
)
from screwkit.algebra.trigonometric import Polynomial

_ANGLES = 12
"""Taken out of conditions, one after the other."""


@dataclass(frozen=True)
class Part:
    """A part of a branch on which a search goes on.

    Attributes:
        before: What its equations are written on.
        branch: The part, with more conditions solved.
        polynomials: That are to vanish, on ``before``.
        nonzero: What is zero nowhere, on ``before``.
    """

    before: Branch
    branch: Branch
    polynomials: tuple[Polynomial, ...]
    nonzero: tuple[Polynomial, ...]


@dataclass(frozen=True)
class Way:
    """Parts that together are a branch.

    Attributes:
        parts: Each is searched.
        taken_out: The conditions, if an angle is taken out of one of them.
    """

    parts: tuple[Part, ...]
    taken_out: frozenset[str] | None = None


Polynomials = Sequence[Polynomial]


def eliminated(
    branch: Branch, polynomials: Polynomials, nonzero: Polynomials, search: Search
) -> Way | None:
    """By what two pending conditions imply, where that can be solved.

    They are imposed again after it, and may turn out to be products.
    """
    if len(branch.pending) < 2 or search.budget <= 0:
        return None
    choice = implied_cases(branch, search.library, search.largest)
    if choice is None:
        return None
    return Way(tuple(_on_factors(branch, choice, polynomials, nonzero, search)))


def taken_further(
    branch: Branch, polynomials: Polynomials, nonzero: Polynomials, search: Search
) -> Way | None:
    """Of a branch that would be left open; None where that is not possible."""
    if not search.further or len(branch.pending) < 2 or search.budget <= 0:
        return None
    parts = split_difference(branch) if branch.thorough else None
    if parts is not None:
        before, again = before_pending(branch)
        again += polynomials
        return _split(before, parts, before, (again, again), nonzero)
    without_angle = None
    if not branch.points:
        without_angle = _angle_taken_out(branch, polynomials, nonzero, search)
    if without_angle is not None:
        return without_angle
    choice = implied_products(branch, search.library, search.largest)
    if choice is None:
        return solved_together(branch, polynomials, nonzero, search)
    return Way(tuple(_on_factors(branch, choice, polynomials, nonzero, search)))


def solved_together(
    branch: Branch, polynomials: Polynomials, nonzero: Polynomials, search: Search
) -> Way | None:
    """By pending conditions solved together, and where that is not possible."""
    parts = split_system(branch) if search.further else None
    if parts is None:
        return None
    before, again = before_pending(branch)
    asked = [*again, *polynomials], polynomials
    return _split(before, parts, branch, asked, nonzero)


def _split(
    before: Branch,
    parts: Split,
    solved_on: Branch,
    asked: tuple[Polynomials, Polynomials],
    nonzero: Polynomials,
) -> Way:
    """The rest and the solved part, with what is asked of each."""
    on_rest, on_solved = asked
    kept = tuple(nonzero)
    found = [Part(before, before, (*parts.left, *on_rest), kept)]
    if parts.solved is not None:
        found.append(Part(solved_on, parts.solved, tuple(on_solved), kept))
    return Way(tuple(found))


def _angle_taken_out(
    branch: Branch, polynomials: Polynomials, nonzero: Polynomials, search: Search
) -> Way | None:
    """By an angle taken out of one pending condition by another one."""
    own = frozenset(str(pending.value) for pending in branch.pending)
    if own in search.taken_out or len(search.taken_out) > _ANGLES:
        return None
    parts = split_angle(branch)
    if parts is None or len(parts.implied) > search.largest:
        return None
    before, _ = before_pending(branch)
    # Complex zeros of P² + Q² are left out, real ones are not.
    real = replace(before, narrowed=True)
    found = [Part(real, real, (*parts.left, *polynomials), tuple(nonzero))]
    kept = *nonzero, *parts.nonzero
    again = *parts.again, *polynomials
    for case in possible_factors(parts.before, parts.implied, search.library):
        found += [
            Part(before, child, again, kept)
            for child in restricted(parts.before, case.equations[0], case.equations[1:])
        ]
    return Way(tuple(found), own)


def _on_factors(
    branch: Branch,
    choice: Sequence[Factor],
    polynomials: Polynomials,
    nonzero: Polynomials,
    search: Search,
) -> Iterator[Part]:
    """Where one of some factors vanishes; what is pending is imposed after it."""
    before, pending = before_pending(branch)
    again, kept = (*pending, *polynomials), tuple(nonzero)
    for case in choice:
        terms = None if search.deepest is not None else terms_of(branch, case)
        if terms is not None:
            if all(t != 1 for t in terms):
                real = replace(before, narrowed=True)
                yield Part(real, real, (*terms, *again), kept)
            continue
        for child in restricted(before, case.equations[0], case.equations[1:]):
            yield Part(before, child, again, kept)
