"""Common zeros of polynomials, as a list of irreducible branches.

Every polynomial is factored; a common zero lies on one factor of each.  The search
restricts a branch by one factor at a time, substitutes, and goes on with what is left,
so that the list is complete by construction: each case split is exhaustive, a branch is
dropped only when a polynomial on it has no real zero, and what cannot be finished
within the budget is returned as open, never forgotten.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from screwkit.algebra.branches import (
    Branch,
    without,
)
from screwkit.algebra.case_parts import is_among, parts_where
from screwkit.algebra.cases import (
    shortest_choice,
    terms_of,
    terms_of_squares,
)
from screwkit.algebra.fixed_directions import (
    fixed_directions,
    is_mixed,
    vanish_on_directions,
)
from screwkit.algebra.nowhere_zero import (
    is_excluded,
    loses_a_direction,
    without_nowhere_zero,
)
from screwkit.algebra.only_part import only_part
from screwkit.algebra.points import residue
from screwkit.algebra.proved_inside import left_over
from screwkit.algebra.search import (
    Decomposition,
    Search,
    are_multiples,
    before_pending,
    changed_halves,
    is_beyond,
    may_hide_parts,
    refined,
    replace_steps,
    still_open,
)
from screwkit.algebra.special_parts import parts_beside_special
from screwkit.algebra.trigonometric import Polynomial
from screwkit.algebra.unshown_parts import parts_beside, settled_parts
from screwkit.algebra.ways_further import (
    Way,
    eliminated,
    solved_together,
    taken_further,
)

_TERMS_PER_CASE = 80  # longer polynomials use up more of the budget


def common_zeros(
    branch: Branch, polynomials: Sequence[Polynomial], search: Search
) -> Decomposition:
    """Where, on ``branch``, all ``polynomials`` vanish.

    Args:
        branch: The piece of the configuration space to search.
        polynomials: In normal form, in the generators left on the branch.
        search: Budget and known factors; pieces for which ``search.skip`` is true are
            left out (they are contained in something the caller knows), as are the
            zeros of ``search.away``.
    """
    nonzero = [*branch.divisors, *map(branch.value, search.away)]
    ring = branch.ring
    shorter = [
        without_nowhere_zero(ring, [p], nonzero)[0] for p in polynomials if p != 0
    ]
    search.problem = tuple(shorter)
    search.taken_out = []
    if all(p != 0 for p in nonzero):
        _descend(branch, shorter, nonzero, search)
    return Decomposition(
        tuple(search.found), tuple(search.unfinished), tuple(search.special)
    )


def _descend(
    branch: Branch,
    polynomials: list[Polynomial],
    nonzero: list[Polynomial],
    search: Search,
) -> None:
    changed = changed_halves(branch, search)
    if changed is not None:
        again = [p for p in (changed.value, *changed.beside) if p != 0]
        _descend(without(branch, changed), [*again, *polynomials], nonzero, search)
        return
    parts = refined(branch, search)
    if parts is not None:
        for part in parts:
            on_part = replace_steps(part, part.steps[len(branch.steps) :])
            moved = [on_part.value(p) for p in polynomials]
            kept = [on_part.value(p) for p in nonzero]
            if all(p != 0 for p in kept):
                _descend(part, moved, kept, search)
        return
    if is_beyond(branch, (), search):
        return
    if branch.is_special:
        _beside_what_is_special(branch, polynomials, nonzero, search)
        return
    if search.deepest is not None and branch.codimension > search.deepest:
        return
    if search.skip(branch):
        if _beside_what_is_skipped(branch, polynomials, nonzero, search):
            return
        if not branch.directed:
            search.unfinished.append(branch)
            return
    polynomials = branch.without_roots(polynomials)
    left = still_open(branch, polynomials, search)
    if left is None:
        if is_excluded(branch, nonzero) or loses_a_direction(branch):
            return
        if not (
            _along(eliminated(branch, polynomials, nonzero, search), search)
            or _along(taken_further(branch, polynomials, nonzero, search), search)
            or _as_one_part(branch, polynomials, nonzero, search)
        ):
            search.unfinished.append(branch)
        return
    hides = may_hide_parts(branch, search.library)
    if not left:
        if hides and not are_multiples(branch, polynomials):
            search.unfinished.append(branch)
        elif not loses_a_direction(branch):
            _settle(branch, polynomials, nonzero, search)
        return
    if branch.codimension == search.deepest or is_beyond(branch, left, search):
        return
    if search.budget <= 0 or hides:
        search.unfinished.append(branch)
    if search.budget <= 0:
        return
    search.budget -= 1 + sum(map(len, left)) // _TERMS_PER_CASE
    if is_mixed(branch) and _along(eliminated(branch, left, nonzero, search), search):
        return
    if _along(solved_together(branch, left, nonzero, search), search):
        return
    terms = None if search.deepest is not None else terms_of_squares(branch, left)
    if terms is not None:
        if all(p != 1 for p in terms):
            _descend(replace(branch, narrowed=True), terms, nonzero, search)
        return
    choice = shortest_choice(branch, left, nonzero, search.library, search.largest)
    if choice is None:
        search.unfinished.append(branch)
        return
    # Where a direction is excluded to be (0, 0) that was searched before.
    free = [
        direction
        for direction in choice.directions
        # Where it is known not to be (0, 0) there is nothing.
        if not is_among(branch, direction.square(branch.ring), nonzero)
    ]
    excluded = [*nonzero, *(d.square(branch.ring) for d in free)]
    for case in choice.cases:
        terms = None if search.deepest is not None else terms_of(branch, case)
        if terms is not None:
            if all(t != 1 for t in terms):
                real = replace(branch, narrowed=True)
                _descend(real, [*terms, *left], excluded, search)
            continue
        held = parts_where(branch, case, left, search, common_zeros)
        if held.rest is not None:
            _descend(branch, [*held.rest, *left], list(excluded), search)
        for child in held.parts:
            _go_on(branch, child, left, excluded, search)
        if len(case.equations) == 1:
            excluded.append(case.equations[0])
    for direction in free:
        # There the angle is free, and the cases were not searched.
        before = replace(without(branch, direction.pending), narrowed=True)
        ends = [direction.across, direction.along]
        _descend(before, [*ends, *left], [*nonzero], search)


def _go_on(
    branch: Branch,
    part: Branch,
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> None:
    """Search a part on which more conditions are solved, where no divisor vanishes."""
    steps = part.steps[len(branch.steps) :]
    on_part = replace_steps(part, steps)
    kept = [on_part.value(p) for p in nonzero]
    kept += [s.divisor for s in steps if not s.divisor.is_constant()]
    if all(p != 0 for p in kept):
        _descend(part, [on_part.value(p) for p in polynomials], kept, search)


def _beside_what_is_skipped(
    branch: Branch,
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> bool:
    """Go on with parts of a branch that its points do not show.

    It is skipped for its points; where conditions are pending these lie on one part.

    Returns:
        Whether these parts are known.
    """
    if len(branch.pending) < 2 or search.surely(branch):
        return True
    if branch.directed and _is_inside(branch, nonzero, search):
        return True
    systems = left_over(branch, search.inside(branch))
    if systems is not None:
        before, _ = before_pending(branch)
        for system in systems:
            _descend(before, [*system, *polynomials], list(nonzero), search)
        return True
    parts = other_parts(branch, search)
    if parts is None:
        return _along(taken_further(branch, polynomials, nonzero, search), search)
    _descend_parts(branch, parts, polynomials, nonzero, search)
    return True


def _is_inside(branch: Branch, nonzero: Sequence[Polynomial], search: Search) -> bool:
    """Whether a branch where angles are fixed is seen to lie in a known set.

    Where directions are (0, 0) was searched before.
    """
    fixed = fixed_directions(branch)
    if not all(is_among(branch, d.square(branch.ring), nonzero) for d in fixed):
        return False
    return any(
        vanish_on_directions(branch, [*map(branch.value, equations)], fixed)
        for equations in search.inside(branch)
    )


def _beside_what_is_special(
    branch: Branch,
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> None:
    """Go on with parts of a branch that tie no dimensions, if it has such parts."""
    search.special.append(branch)
    if len(branch.pending) < 2 or (
        search.deepest is not None and branch.codimension > search.deepest
    ):
        return
    search.budget -= 1
    parts = beside_special(branch, search) if search.budget > 0 else None
    if parts is None:
        search.unfinished.append(branch)
    else:
        _descend_parts(branch, parts, polynomials, nonzero, search)


def _descend_parts(
    branch: Branch,
    parts: Sequence[Branch],
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> None:
    for part in parts:
        on_part = replace_steps(part, part.steps[len(branch.steps) :])
        kept = [on_part.value(p) for p in nonzero]
        if all(p != 0 for p in kept):
            _descend(part, [on_part.value(p) for p in polynomials], kept, search)


def _settle(
    branch: Branch,
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> None:
    """Take a branch on which all polynomials vanish, or what it consists of."""
    if not _is_possible(branch) and is_excluded(branch, nonzero):
        return
    if _along(eliminated(branch, polynomials, nonzero, search), search):
        return
    settled = (
        settled_parts(branch, search, common_zeros) if _is_possible(branch) else None
    )
    if settled is not None:
        search.found.append(settled[0])
        _descend_parts(branch, settled[1], polynomials, nonzero, search)
    elif not _along(taken_further(branch, polynomials, nonzero, search), search):
        search.unfinished.append(branch)


def _as_one_part(
    branch: Branch,
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> bool:
    """Take a branch that is shown to be one part, or nothing that is smaller.

    Other parts, on which something short vanishes too, are searched.
    """
    only = only_part(branch, search) if search.budget > 0 else None
    if only is None:
        return False
    part = only.part
    on_part = replace_steps(part, part.steps[len(branch.steps) :])
    if not _is_possible(part):
        return False
    if part.is_special:
        search.special.append(part)
    elif part.vanishes([on_part.value(p) for p in polynomials]):
        if not loses_a_direction(part):
            search.found.append(part)
    elif branch.narrowed or search.bound is None or branch.codimension < search.bound:
        return False
    before, again = before_pending(branch)
    for own in only.beside:
        search.budget -= 1
        _descend(before, [own, *again, *polynomials], list(nonzero), search)
    return True


def _along(way: Way | None, search: Search) -> bool:
    """Go on along a way, if there is one."""
    if way is None:
        return False
    search.budget -= 1
    if way.taken_out is not None:
        search.taken_out.append(way.taken_out)
    for part in way.parts:
        _go_on(part.before, part.branch, part.polynomials, part.nonzero, search)
    if way.taken_out is not None:
        search.taken_out.pop()
    return True


def _is_possible(branch: Branch) -> bool:
    """Whether the branch has points, and none at which something nonzero vanishes."""
    return bool(branch.points) and all(
        any(residue(p, *point) for point in branch.points) for p in branch.nonvanishing
    )


def other_parts(branch: Branch, search: Search) -> tuple[Branch, ...] | None:
    """Parts of a branch that its points do not show (`unshown_parts.parts_beside`)."""
    return parts_beside(branch, search, common_zeros)


def beside_special(branch: Branch, search: Search) -> tuple[Branch, ...] | None:
    """All of its size that are not special; None where it could not be settled."""
    return parts_beside_special(branch, search, common_zeros)
