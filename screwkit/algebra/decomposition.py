"""Common zeros of polynomials, as a list of irreducible branches.

Every polynomial is factored; a common zero lies on one factor of each.  The search
restricts a branch by one factor at a time, substitutes, and goes on with what is left,
so that the list is complete by construction: each case split is exhaustive, a branch is
dropped only when a polynomial on it has no real zero, and what cannot be finished
within the budget is returned as open, never forgotten.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

from screwkit.algebra.branches import (
    Branch,
    Split,
    is_solvable,
    restricted,
    split,
    without,
)
from screwkit.algebra.factors import Factor, FactorLibrary, factor
from screwkit.algebra.points import residue
from screwkit.algebra.points_on import coefficients_in, unknowns
from screwkit.algebra.substitution import Substitution, angle_parts
from screwkit.algebra.trigonometric import Polynomial, primitive

_SHORT = 24  # terms of a polynomial from which resolvents are formed
_PAIRS = 6
_TERMS_PER_CASE = 80  # longer polynomials use up more of the budget
_SETTLING = 60  # case distinctions to tell a branch from spurious zeros
_TRIED = 10  # polynomials that are factored to choose the next case split


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
    """One decomposition under way: its budget, and the factors met so far."""

    library: FactorLibrary
    budget: int = 600
    largest: int = 400
    skip: Callable[[Branch], bool] = lambda branch: False
    source: random.Random = field(default_factory=lambda: random.Random(20121))
    found: list[Branch] = field(default_factory=list)
    unfinished: list[Branch] = field(default_factory=list)
    special: list[Branch] = field(default_factory=list)
    problem: tuple[Polynomial, ...] = ()


def common_zeros(
    branch: Branch, polynomials: Sequence[Polynomial], search: Search
) -> Decomposition:
    """Where, on ``branch``, all ``polynomials`` vanish.

    Args:
        branch: The piece of the configuration space to search.
        polynomials: In normal form, in the generators left on the branch.
        search: Budget and known factors; pieces for which ``search.skip`` is true are
            left out (they are contained in something the caller knows).
    """
    search.problem = tuple(p for p in polynomials if p != 0)
    nonzero = branch.divisors
    if all(p != 0 for p in nonzero):
        _descend(branch, list(polynomials), nonzero, search)
    return Decomposition(
        tuple(search.found), tuple(search.unfinished), tuple(search.special)
    )


def _descend(
    branch: Branch,
    polynomials: list[Polynomial],
    nonzero: list[Polynomial],
    search: Search,
) -> None:
    parts = _refined(branch, search)
    if parts is not None:
        for part in parts:
            on_part = replace_steps(part, part.steps[len(branch.steps) :])
            moved = [on_part.value(p) for p in polynomials]
            kept = [on_part.value(p) for p in nonzero]
            if all(p != 0 for p in kept):
                _descend(part, moved, kept, search)
        return
    if branch.is_special:
        search.special.append(branch)
        return
    if search.skip(branch):
        return
    left = _still_open(branch, polynomials, search)
    if left is None:
        search.unfinished.append(branch)
        return
    if not left:
        exact = told_apart(branch, search) if branch.points else None
        if exact is None:
            search.unfinished.append(branch)
        else:
            search.found.append(exact)
        return
    if search.budget <= 0:
        search.unfinished.append(branch)
        return
    search.budget -= 1 + sum(map(len, left)) // _TERMS_PER_CASE
    choice = _shortest_choice(branch, left, nonzero, search)
    if choice is None:
        search.unfinished.append(branch)
        return
    excluded = list(nonzero)
    for case in choice:
        for child in _children(branch, case, left, excluded, search):
            on_child = replace_steps(child, step := child.steps[len(branch.steps) :])
            kept = [on_child.value(p) for p in excluded]
            kept += [s.divisor for s in step if not s.divisor.is_constant()]
            if any(p == 0 for p in kept):
                continue
            _descend(child, [on_child.value(p) for p in left], kept, search)
        if len(case.equations) == 1:
            excluded.append(case.equations[0])


def irreducible_parts(branch: Branch, search: Search) -> list[Branch]:
    """The branch split until all its pending conditions are irreducible on it."""
    parts = _refined(branch, search)
    if parts is None:
        return [branch]
    return [inner for part in parts for inner in irreducible_parts(part, search)]


def _refined(branch: Branch, search: Search) -> list[Branch] | None:
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
        return [part for case in cases for part in _parts(before, case, search)]
    return None


def _parts(branch: Branch, case: Factor, search: Search) -> list[Branch]:
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


def told_apart(branch: Branch, search: Search) -> Branch | None:
    """The branch with what distinguishes it from other zeros of its conditions.

    The last of several pending conditions may be a product where the others vanish:
    where all its coefficients in one unknown vanish together, it says nothing about
    that unknown.  Such a spurious part is excluded by a polynomial of the problem that
    does not vanish there.  None where that could not be settled.
    """
    if len(branch.pending) < 2:
        return branch
    parts = other_parts(branch, search)
    return None if parts is None else _excluding(branch, parts, search)


def other_parts(branch: Branch, search: Search) -> tuple[Branch, ...] | None:
    """Where all coefficients of the last pending condition in an unknown vanish.

    None where it could not be settled.
    """
    if len(branch.pending) < 2:
        return ()
    last = branch.pending[-1]
    before = without(branch, last)
    others = {u for p in before.pending for u in unknowns(branch.ring, p.value)}
    own = [u for u in unknowns(branch.ring, last.value) if u not in others]
    for unknown in sorted(own):
        coefficients = coefficients_in(branch.ring, last.value, unknown)
        inner = Search(search.library, budget=_SETTLING, largest=search.largest)
        spurious = common_zeros(before, coefficients, inner)
        if spurious.complete:
            return spurious.branches
    return None


def _excluding(branch: Branch, spurious: Sequence[Branch], search: Search) -> Branch:
    """The branch with an equation that fails on each spurious part of its size."""
    extra: list[Polynomial] = []
    for part in spurious:
        if part.codimension > branch.codimension or not part.points:
            continue
        tell = [p for p in search.problem if any(residue(p, *at) for at in part.points)]
        if tell and not any(e in tell for e in extra):
            extra.append(min(tell, key=len))
    return replace(branch, extra=(*branch.extra, *extra))


def _children(
    branch: Branch,
    case: Factor,
    left: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> list[Branch]:
    """The parts of the branch where a condition holds.

    Where it is solved for a symbol under the proviso that a coefficient is not zero,
    the rest is searched at once.
    """
    condition, companions = case.equations[0], case.equations[1:]
    if companions:
        return _parts(branch, case, search)
    if branch.pending and not is_solvable(branch, condition):
        parts = split(branch, condition)
        if parts is not None:
            on_child = replace_steps(branch, parts.solved.steps[len(branch.steps) :])
            remaining = [on_child.value(p) for p in left]
            if _still_open(parts.solved, remaining, search) == []:
                # Of the rest only a part as large is no limit of the solved one.
                return [parts.solved, *_as_large(branch, parts, search)]
            _descend(branch, [*parts.left, *left], list(nonzero), search)
            return [parts.solved]
    return restricted(branch, condition)


def _as_large(branch: Branch, parts: Split, search: Search) -> list[Branch]:
    """Parts of the rest that are no limits of the solved part: those of its size."""
    inner = Search(search.library, budget=_SETTLING, largest=search.largest)
    size = parts.solved.codimension
    rest = common_zeros(replace(branch, thorough=True), parts.left, inner)
    found = [b for b in rest.branches if b.codimension <= size]
    for b in rest.open:
        if b.codimension == size and b.points:
            whole = not any(residue(p, *at) for at in b.points for p in parts.left)
            found += [b] if whole else []
        elif b.codimension <= size:
            search.unfinished.append(b)
    return found


def replace_steps(branch: Branch, steps: Sequence[Substitution]) -> Branch:
    """A branch that applies only these of the steps."""
    return replace(branch, conditions=(), steps=tuple(steps), pending=())


def _still_open(
    branch: Branch, polynomials: Sequence[Polynomial], search: Search
) -> list[Polynomial] | None:
    """The polynomials that do not vanish on all of the branch, shortest first.

    None where a pending condition admits no exact point, so that it cannot be told.
    """
    left = {str(q): q for p in polynomials if p != 0 for q in (primitive(p),)}
    if branch.pending and left:
        points = [branch.point(search.source) for _ in range(3)]
        if any(point is None for point in points):
            return None
        left = {
            key: p
            for key, p in left.items()
            if any(residue(p, *point) for point in points if point is not None)
        }
    return sorted(left.values(), key=len)


def _shortest_choice(
    branch: Branch,
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    search: Search,
) -> list[Factor] | None:
    """The irreducible factors of the polynomial that leaves the fewest, shortest cases.

    An empty list where some polynomial has no zero on the branch; None where all are
    too long to be factored.
    """
    excluded = _factor_keys(branch, nonzero, search)
    best: list[Factor] | None = None
    for polynomial in _with_resolvents(branch, polynomials)[:_TRIED]:
        if len(polynomial) > search.largest:
            break
        cases = possible_factors(branch, polynomial, search.library)
        cases = [f for f in cases if f.key not in excluded]
        if not cases:
            return []
        if best is None or _cost(branch, cases) < _cost(branch, best):
            best = cases
        if _cost(branch, best) <= (0, 2):
            break
    if best is None:
        return None
    return sorted(best, key=lambda f: (len(f.equations), len(f.equations[0])))


def _cost(branch: Branch, cases: Sequence[Factor]) -> tuple[int, int]:
    """Conditions that cannot be solved are dear, many simple ones are cheap."""
    return (
        sum(
            len(f.equations[0])
            for f in cases
            if len(f.equations) == 1 and not is_solvable(branch, f.equations[0])
        ),
        len(cases),
    )


def _with_resolvents(branch: Branch, left: Sequence[Polynomial]) -> list[Polynomial]:
    """The polynomials and what two of them imply together.

    Two conditions P·sin φ + Q·cos φ = 0 on one angle have a common solution only where
    the determinant of their coefficients vanishes.
    """
    if branch.pending:
        return list(left)
    ring = branch.ring
    implied: dict[str, Polynomial] = {}
    short = [(p, p.degrees()) for p in left if len(p) <= _SHORT]
    for angle in range(len(ring.basis)):
        places = ring.sine_index(angle), ring.cosine_index(angle)
        rows = []
        for polynomial, degrees in short:
            if max(degrees[place] for place in places) != 1:
                continue
            parts = angle_parts(ring, polynomial, angle)
            if parts is not None and parts[2] == 0:
                rows.append(parts[:2])
                if len(rows) == _PAIRS:
                    break
        for (p, q), (u, v) in combinations(rows, 2):
            resolvent = ring.normal(p * v - q * u)
            if resolvent != 0:
                resolvent = primitive(resolvent)
                implied[str(resolvent)] = resolvent
    known = {str(p) for p in left}
    fresh = [p for key, p in implied.items() if key not in known]
    return sorted([*left, *fresh], key=len)


def _factor_keys(
    branch: Branch, polynomials: Sequence[Polynomial], search: Search
) -> set[str]:
    keys: set[str] = set()
    for polynomial in polynomials:
        if len(polynomial) <= search.largest:
            keys |= {
                f.key for f in possible_factors(branch, polynomial, search.library)
            }
    return keys


def possible_factors(
    branch: Branch, polynomial: Polynomial, library: FactorLibrary
) -> list[Factor]:
    """The irreducible factors that can vanish under the branch's assumptions."""
    factored = factor(branch.ring, polynomial, library)
    return [
        f
        for f, _ in factored.factors
        if not branch.assumptions.is_nonzero(branch.ring, f.equations[0])
    ]
