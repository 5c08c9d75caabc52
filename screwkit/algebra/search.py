"""A search for common zeros: its records, and branches by irreducible conditions."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace

from screwkit.algebra.branches import (
    Branch,
    Pending,
    is_solvable,
    restricted,
    without,
)
from screwkit.algebra.cases import possible_factors, terms_of
from screwkit.algebra.division import Divisor
from screwkit.algebra.factors import Factor, FactorLibrary
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.points import residue
from screwkit.algebra.restrictions import Layout, coefficients
from screwkit.algebra.substitution import Substitution
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
    Zeros of ``away``, in the generators of the whole ring, are not looked for: they
    are known, and what is asked is divided by them.  With ``deepest`` parts of larger
    codimension are left out: where as many equations are asked, they are no parts of
    their own (Krull), as long as zeros are not replaced by their real ones.  The same
    is done with ``bound``, where that is known of what is looked for, of parts that are
    surely smaller; real zeros in their place are looked for further.  What is
    skipped for its points may have parts, of several pending conditions, that these do
    not show: ``inside`` gives the equations of known sets that the points lie in, and
    ``surely`` tells that the whole branch lies in one.  With ``further`` branches that
    would be left open are gone on with by what two of their equations imply, or by
    several of these solved together.  Parts of branches are looked for by searches in
    which the same may be asked: ``nested`` counts how often.
    ``taken_out`` are the conditions of branches, each inside the one before, from which
    angles are being taken out.
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
    away: tuple[Polynomial, ...] = ()
    deepest: int | None = None
    bound: int | None = None
    inside: Callable[[Branch], Iterable[Sequence[Polynomial]]] = lambda branch: ()
    surely: Callable[[Branch], bool] = lambda branch: False
    further: bool = False
    nested: int = 0
    taken_out: list[frozenset[str]] = field(default_factory=list)


def may_hide_parts(branch: Branch, library: FactorLibrary) -> bool:
    """Whether a pending condition may be a product over square roots of numbers.

    Long ones are not split there; exact points may then lie on one part alone.
    """
    for pending in branch.pending:
        for polynomial in (pending.value, primitive(pending.value)):
            factor = library.factors.get(str(polynomial))
            if factor is None or factor.certified:
                continue
            if not library.is_extended(polynomial):
                return True
    return False


def is_surely_smaller(branch: Branch, size: int, search: Search) -> bool:
    """Whether all parts of a branch have a larger codimension than a given one.

    One condition leaves a part on which a second one, that is no multiple of it, is not
    zero; a third one may vanish on a part of what these leave.
    """
    if branch.codimension <= size or len(branch.pending) > 2:
        return False
    if any(p.companions or len(p.value) > search.largest for p in branch.pending):
        return False
    return not may_hide_parts(branch, search.library)


def is_beyond(branch: Branch, left: Sequence[Polynomial], search: Search) -> bool:
    """Whether the zeros on a branch of what is left are below ``search.bound``."""
    if search.bound is None or branch.narrowed:
        return False
    if left and len(branch.pending) < 2:  # irreducible: less of it is smaller
        return is_surely_smaller(branch, search.bound - 1, search)
    return is_surely_smaller(branch, search.bound, search)


def are_multiples(branch: Branch, polynomials: Sequence[Polynomial]) -> bool:
    """Whether each polynomial is seen to be a multiple of a pending condition."""
    ring = branch.ring
    layout = Layout.of(ring)
    halves = HalfAngles(ring, layout)
    divisors = [Divisor(p.value, ring, halves, layout) for p in branch.pending]
    return all(
        p == 0 or any(divisor.divide(p) is not None for divisor in divisors)
        for p in polynomials
    )


def irreducible_parts(branch: Branch, search: Search) -> list[Branch]:
    """The branch split until all its pending conditions are irreducible on it.

    Equations of a half-angle condition that is no longer one factor are imposed again.
    """
    changed = changed_halves(branch, search)
    if changed is not None:
        again = [without(branch, changed)]
        for value in (changed.value, *changed.beside):
            again = [part for own in again for part in imposed(own, value, search)]
        return again
    parts = refined(branch, search)
    if parts is None:
        return [branch]
    return [inner for part in parts for inner in irreducible_parts(part, search)]


def imposed(branch: Branch, equation: Polynomial, search: Search) -> list[Branch]:
    """The parts of a branch on which an equation of the whole ring holds."""
    value = branch.value(equation)
    if value == 0 or branch.vanishes([value]):
        return [branch]
    found: list[Branch] = []
    for case in possible_factors(branch, value, search.library):
        for part in restricted(branch, case.equations[0], case.equations[1:]):
            found.extend(irreducible_parts(part, search))
    return found


def refined(branch: Branch, search: Search) -> list[Branch] | None:
    """The branch with pending conditions that later steps made reducible split up.

    None where all of them are still irreducible, and no two the same.
    """
    seen: set[str] = set()
    for pending in branch.pending:
        text = str(primitive(pending.value))
        if text in seen and not pending.beside:
            return [without(branch, pending)]
        seen.add(text)
        if len(pending.value) > search.largest:
            continue
        if pending.companions:
            continue
        before = without(branch, pending)
        value = _left_by_others(before, pending.value)
        if value == 0:
            return [before]
        cases = possible_factors(branch, value, search.library)
        same = len(cases) == 1 and str(cases[0].equations[0]) in (
            str(pending.value),
            str(primitive(pending.value)),
        )
        settled = same and not is_solvable(branch, cases[0].equations[0])
        if settled and _real_terms(branch, cases[0], search) is None:
            continue
        return [part for case in cases for part in _parts_where(before, case, search)]
    return None


def _left_by_others(branch: Branch, value: Polynomial) -> Polynomial:
    """What a condition says where the pending ones of a branch hold.

    Coefficients that one of these divides are left out: with Q = 0 pending, of
    P·sin φ + Q·cos φ the product P·sin φ.
    """
    ring = branch.ring
    known = [p.value for p in branch.pending if not p.companions]
    degrees = value.degrees()
    angles = range(len(ring.basis))
    turns = [(ring.sine_index(k), ring.cosine_index(k)) for k in angles]
    for own in (*turns, *((index,) for index in ring.symbol_indices())):
        if not known or value == 0 or not any(degrees[place] for place in own):
            continue
        parts = coefficients(value, own)
        for powers, part in parts.items():
            if len(parts) > 1 and any(divmod(part, one)[1] == 0 for one in known):
                gone = part
                for place, power in zip(own, powers, strict=True):
                    gone *= ring.context.gen(place) ** power
                value -= gone
    return value


def _real_terms(
    branch: Branch, case: Factor, search: Search
) -> list[Polynomial] | None:
    """`terms_of`, if real zeros are looked for."""
    return None if search.deepest is not None else terms_of(branch, case)


def _parts_where(branch: Branch, case: Factor, search: Search) -> list[Branch]:
    """Where a factor vanishes; of one that keeps its sign, what vanishes with it."""
    terms = _real_terms(branch, case, search)
    if terms is None:
        return restricted(branch, case.equations[0], case.equations[1:])
    parts = [replace(branch, narrowed=True)]
    for value in (*terms, case.equations[0]):
        parts = [part for own in parts for part in imposed(own, value, search)]
    return parts


def changed_halves(branch: Branch, search: Search) -> Pending | None:
    """A pending condition in half angles that is no longer one factor.

    Its equations then have to be imposed again: only together do they say what it was.
    """
    for pending in branch.pending:
        if not pending.companions or pending.value == pending.condition:
            continue
        if len(pending.value) > search.largest:
            continue
        own = {str(primitive(p)) for p in (pending.value, *pending.beside) if p != 0}
        cases = possible_factors(branch, pending.value, search.library)
        if not any({str(primitive(e)) for e in f.equations} == own for f in cases):
            return pending
    return None


def before_pending(branch: Branch) -> tuple[Branch, list[Polynomial]]:
    """The branch before any of its pending conditions, and what these say."""
    before = branch
    for pending in branch.pending:
        before = without(before, pending)
    return before, [v for p in branch.pending for v in (p.value, *p.beside) if v != 0]


def replace_steps(branch: Branch, steps: Sequence[Substitution]) -> Branch:
    """A branch that applies only these of the steps."""
    return replace(branch, conditions=(), steps=tuple(steps), pending=())


def still_open(
    branch: Branch, polynomials: Sequence[Polynomial], search: Search
) -> list[Polynomial] | None:
    """The polynomials that do not vanish on all of the branch, shortest first.

    None where a pending condition admits no exact point, so that it cannot be told.
    """
    left = {str(q): q for p in polynomials if p != 0 for q in (primitive(p),)}
    if branch.pending and left:
        another = branch.points and branch.point(search.source)
        if not another:
            return None
        points = [*branch.points, another]
        left = {
            key: p
            for key, p in left.items()
            if any(residue(p, *point) for point in points)
        }
    return sorted(left.values(), key=len)
