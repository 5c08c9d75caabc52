"""The parts of a branch on which one of the cases of a search holds.

A condition that is solved for a symbol under the proviso that a coefficient is not zero
leaves a rest, which is searched by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from screwkit.algebra.branches import Branch, is_solvable, restricted
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.factors import Factor
from screwkit.algebra.fixed_directions import keeps_directions
from screwkit.algebra.points import residue
from screwkit.algebra.search import Search, replace_steps, still_open
from screwkit.algebra.splitting import split, split_half_angle
from screwkit.algebra.trigonometric import Polynomial
from screwkit.algebra.unshown_parts import Zeros, settling


class Held(NamedTuple):
    """Where a condition holds on a branch.

    Attributes:
        parts: On which it is solved, or pending.
        rest: What vanishes on the rest, where it is solved under a proviso; None where
            there is no rest.
    """

    parts: Sequence[Branch]
    rest: Sequence[Polynomial] | None = None


def parts_where(
    branch: Branch,
    case: Factor,
    left: Sequence[Polynomial],
    search: Search,
    zeros: Zeros,
) -> Held:
    """The parts of a branch where a condition holds.

    Args:
        branch: Where it is imposed.
        case: The condition, with what has the same zeros.
        left: What else is to vanish there.
        search: Known factors; takes what could not be settled.
        zeros: `decomposition.common_zeros`.
    """
    condition, companions = case.equations[0], case.equations[1:]
    if companions:
        whole = restricted(branch, condition, companions)
        if not whole or len(whole[0].pending) <= len(branch.pending):
            return Held(whole)
        parts = None
        if not branch.pending:
            parts = split_half_angle(branch, condition, companions)
        # Of a divisor that is among what is asked the rest is all there is.
        if parts is None or is_among(branch, parts.left[0], left):
            return Held(whole)
        return Held([] if parts.solved is None else [parts.solved], parts.left)
    at_once = branch.pending or search.deepest is not None
    if keeps_directions(branch, condition, left):
        at_once = False
    if at_once and not is_solvable(branch, condition):
        parts = split(branch, condition)
        if parts is not None:
            solved = parts.solved
            if solved is not None:
                on_child = replace_steps(branch, solved.steps[len(branch.steps) :])
                remaining = [on_child.value(p) for p in left]
                if still_open(solved, remaining, search) == []:
                    # Of the rest only a part as large is no limit of the solved one.
                    large = _as_large(branch, solved, parts.left, search, zeros)
                    return Held([solved, *large])
            return Held([] if solved is None else [solved], parts.left)
    return Held(restricted(branch, condition))


def _as_large(
    branch: Branch,
    solved: Branch,
    left: Sequence[Polynomial],
    search: Search,
    zeros: Zeros,
) -> list[Branch]:
    """Parts of the rest that are no limits of the solved part: those of its size."""
    size = solved.codimension
    inner = settling(solved, search)
    rest = zeros(replace(branch, thorough=True), left, inner)
    found = [b for b in rest.branches if b.codimension <= size]
    for b in rest.open:
        if b.codimension > size or search.skip(b):
            continue
        whole = b.points and not any(residue(p, *at) for at in b.points for p in left)
        # With several pending conditions it may consist of parts, some of them zeros.
        if b.codimension == size and whole:
            found.append(b)
        elif b.codimension < size or not b.points or len(b.pending) > 1:
            search.unfinished.append(b)
    return found


def is_among(
    branch: Branch, polynomial: Polynomial, others: Sequence[Polynomial]
) -> bool:
    """Whether a polynomial is among others, up to a constant."""
    key = condition_key(branch.ring, polynomial)
    return any(condition_key(branch.ring, p) == key for p in others if p != 0)
