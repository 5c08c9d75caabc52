"""What a search left open, told by linear algebra: nothing new, or where it lies.

What such a branch fulfils and the minors that vanish where limbs become dependent are
more equations than unknowns as a rule.  Whether all their zeros, complex ones
included, lie in what is known, or where nothing may be, is then a matter of linear
algebra.  Where they do not, short equations that the others imply come out, and the
search goes on with these.

References: [CoxLittleOShea] §4.1, §4.4.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.effort import Effort
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.factors import factor
from screwkit.algebra.finite_values import unknowns_by_numbers
from screwkit.algebra.implied_modulo import implied_equations
from screwkit.algebra.points import residue
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.search import Search, before_pending
from screwkit.algebra.sturm import real_zeros
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.algebra.zeros_modulo import have_no_zero

MOST_UNKNOWNS = 6
"""Angles count twice."""

SHORT = 200
"""Terms of a divisor that is factored."""

LONGEST = 3_000
"""Terms of one equation."""

WORK = 3_000_000_000
"""Products of residues for one branch."""

TOLD = 250_000_000
"""The same for equations that are implied, modulo one prime."""

_BUDGET = 60
"""Case distinctions for the zeros of what is implied."""


def parts_left(
    branch: Branch,
    lists: Sequence[Sequence[Polynomial]],
    known: Sequence[Sequence[Polynomial]],
    library: FactorLibrary,
    effort: Effort,
) -> list[Branch] | None:
    """Smaller branches on which everything lies that is on one and not known.

    Args:
        branch: What of it is special, or where its divisors vanish, is left out.
        lists: Minors in the generators of the whole ring, or those left on a branch
            around this one; what is looked for are zeros of all of one list.
        known: Equations of sets, in the generators of the whole ring.
        library: Of the branch's ring; factors met before.
        effort: Products of residues that it may take.

    Returns:
        None where that was not seen.
    """
    parts: list[Branch] = []
    for minors in lists:
        implied = _implied(branch, minors, known, library, effort)
        if implied is None:
            return None
        if not implied:
            continue
        before, again = before_pending(branch)
        own = Search(library, budget=_BUDGET, every_part=True)
        zeros = common_zeros(before, [*implied, *again], own)
        if zeros.open:
            return None
        found = [*zeros.branches, *zeros.special]
        if any(part.codimension <= branch.codimension for part in found):
            return None
        parts += found
    return parts


def _implied(
    branch: Branch,
    minors: Sequence[Polynomial],
    known: Sequence[Sequence[Polynomial]],
    library: FactorLibrary,
    effort: Effort,
) -> list[Polynomial] | None:
    """Equations of what is not known; none where that is nothing, None if not seen."""
    ring = branch.ring
    equations = [v for p in branch.pending for v in (p.value, *p.beside) if v != 0]
    equations += [v for v in map(branch.value, minors) if v != 0]
    if not equations or max(map(len, equations)) > LONGEST:
        return None
    away = _away(branch, known, library)
    if not all(away):
        return []
    given: list[Unknown] = [("x", index) for index in branch.dimensions]
    met = {u for e in equations for u in unknowns(ring, e)}.difference(given)
    if sum(1 + (kind == "angle") for kind, _ in met) > MOST_UNKNOWNS:
        return None
    # What speaks of other unknowns says nothing here.
    inside = [
        own
        for own in away
        if {u for e in own for u in unknowns(ring, e)} <= met.union(given)
    ]
    own = Effort(min(WORK, effort.left))
    effort.spend(own.left)
    is_empty = have_no_zero(ring, equations, given, inside, own)
    values = {}
    if not is_empty and own.left > 0:
        values = unknowns_by_numbers(ring, equations, given, inside, own)
    effort.left += max(0, own.left)
    if is_empty or not all(map(real_zeros, values.values())):
        return []
    if not effort.spend(2 * TOLD):
        return None
    told = implied_equations(ring, equations, given, inside, TOLD)
    alone = [_in_one(ring, place, own) for place, own in values.items()]
    return [e for e in (*alone, *told) if _is_news(branch, e)] or None


def _in_one(
    ring: TrigonometricRing, place: int, coefficients: Sequence[Fraction]
) -> Polynomial:
    """A polynomial in one generator."""
    gen = ring.context.gens()[place]
    total = ring.zero
    for power, value in enumerate(coefficients):
        total += ring.rational(value) * gen**power
    return primitive(ring.normal(total))


def _is_news(branch: Branch, equation: Polynomial) -> bool:
    """Whether an equation does not hold on a branch already, as far as is seen."""
    if any(divmod(equation, p.value)[1] == 0 for p in branch.pending):
        return False
    points = branch.points
    return not points or any(residue(equation, *at) for at in points)


def _away(
    branch: Branch, known: Sequence[Sequence[Polynomial]], library: FactorLibrary
) -> list[list[Polynomial]]:
    """Sets that do not count on a branch; without equations where all of it is one."""
    gens = branch.ring.context.gens()
    away = [[own] for own in _factors(branch.ring, branch.divisors, library)]
    away += [[branch.value(gens[index])] for index in branch.nonzero]
    away += [branch.column(direction) for direction in branch.directions]
    away += [[*map(branch.value, equations)] for equations in known]
    return [[e for e in own if e != 0] for own in away]


def _factors(
    ring: TrigonometricRing, polynomials: Iterable[Polynomial], library: FactorLibrary
) -> list[Polynomial]:
    """Different factors, of long polynomials these themselves."""
    found: dict[str, Polynomial] = {}
    for polynomial in polynomials:
        if polynomial == 0 or len(polynomial) > SHORT:
            found[str(polynomial)] = polynomial
            continue
        for part, _ in factor(ring, polynomial, library).factors:
            found |= {part.key: part.equations[0]}
    return list(found.values())
