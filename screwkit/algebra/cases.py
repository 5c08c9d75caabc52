"""Which case distinction comes next: the factors on one of which every zero lies.

Every polynomial is factored; the one that leaves the fewest and shortest cases is
chosen.  What two conditions imply together may leave simpler ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from weakref import WeakKeyDictionary

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, is_solvable
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.elimination import half_angle_steps
from screwkit.algebra.factors import Factor, FactorLibrary, factor
from screwkit.algebra.fixed_directions import (
    Direction,
    fixed_directions,
    occurs,
    parted,
)
from screwkit.algebra.implied import LONGEST, eliminants, resolvents
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.real_zeros import vanishing_together
from screwkit.algebra.substitution import reduced
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

SHORT = 200
"""Terms of a polynomial whose possible factors are kept; they depend on no branch."""

_POSSIBLE: WeakKeyDictionary[
    FactorLibrary, dict[tuple[Assumptions, str], tuple[Factor, ...]]
] = WeakKeyDictionary()

_DIVISORS: WeakKeyDictionary[FactorLibrary, frozenset[str]] = WeakKeyDictionary()

MOST_TERMS = 4_000_000
"""Terms of a polynomial that is expanded, divided, or factored without sines."""

_TRIED = 10  # polynomials that are factored to choose the next case split
_ALONE = 2_000  # terms of the shortest one, which is factored before all is left open


@dataclass(frozen=True)
class Choice:
    """Factors on one of which every zero lies, or else where a direction is (0, 0).

    Attributes:
        cases: Simple ones first.
        directions: Of angles that pending conditions fix.
    """

    cases: tuple[Factor, ...]
    directions: tuple[Direction, ...] = ()


def is_too_long(ring: TrigonometricRing, polynomial: Polynomial, largest: int) -> bool:
    """Whether a polynomial is not factored, even if nothing else is left.

    Args:
        ring: Of the polynomial.
        polynomial: In normal form.
        largest: Terms of what has sines and cosines, or roots of symbols; without them
            FLINT factors millions, as they stand.
    """
    if len(polynomial) <= largest:
        return False
    first = ring.symbol_indices().start  # numbers come after the symbols
    plain = not any(polynomial.degrees()[:first])
    return not plain or len(polynomial) > MOST_TERMS


def shortest_choice(
    branch: Branch,
    polynomials: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    library: FactorLibrary,
    largest: int,
) -> Choice | None:
    """The irreducible factors of the polynomial that leaves the fewest, shortest cases.

    No case where some polynomial has no zero on the branch; None where all are too long
    to be factored.
    """
    excluded = _factor_keys(branch, nonzero, library, largest)
    fixed = fixed_directions(branch) if branch.directed else []
    best: Choice | None = None
    for polynomial in _with_resolvents(branch, polynomials)[:_TRIED]:
        own, cases = _on_directions(branch, polynomial, fixed, library)
        if best is None:
            short = not is_too_long(branch.ring, polynomial, max(largest, _ALONE))
        else:
            short = len(polynomial) <= largest
        if short:
            plain = possible_factors(branch, polynomial, library)
            if not own or len(plain) >= _in_postures(branch, cases):
                own, cases = (), plain
        elif not own:
            break
        kept = tuple(f for f in cases if f.key not in excluded)
        choice = Choice(kept, own)
        if not kept and not own:
            return choice
        if best is None or (
            _cost(branch, choice.cases, fixed) < _cost(branch, best.cases, fixed)
        ):
            best = choice
        if _cost(branch, best.cases, fixed) <= (0, 2, 0):
            break
    if best is None:
        return None
    simple = sorted(best.cases, key=lambda f: (len(f.equations), len(f.equations[0])))
    return replace(best, cases=tuple(simple))


def _on_directions(
    branch: Branch,
    polynomial: Polynomial,
    fixed: Sequence[Direction],
    library: FactorLibrary,
) -> tuple[tuple[Direction, ...], list[Factor]]:
    """Factors where some angles are fixed, and which; none where that shows nothing."""
    own = tuple(d for d in fixed if occurs(branch.ring, polynomial, d.angle))
    parts = parted(branch.ring, polynomial, own, library) if own else None
    if parts is None:
        return (), []
    both = (parts.content, parts.rest)
    return own, [f for p in both for f in possible_factors(branch, p, library)]


def _in_postures(branch: Branch, cases: Sequence[Factor]) -> int:
    """How many of some factors speak of postures, not of dimensions alone."""
    degrees = (f.equations[0].degrees() for f in cases)
    return sum(
        any(d and k not in branch.dimensions for k, d in enumerate(own))
        for own in degrees
    )


def _cost(
    branch: Branch, cases: Sequence[Factor], fixed: Sequence[Direction]
) -> tuple[int, int, int]:
    """Conditions that cannot be solved are dear, many simple ones are cheap.

    Where angles are fixed one condition is written in many ways; those in the other
    unknowns leave the angles fixed.
    """
    unsolved = [
        f.equations[0]
        for f in cases
        if len(f.equations) == 1 and not is_solvable(branch, f.equations[0])
    ]
    terms = sum(map(len, unsolved))
    if not fixed:
        return terms, len(cases), 0
    mixed = sum(any(occurs(branch.ring, p, d.angle) for d in fixed) for p in unsolved)
    return mixed, len(cases), terms


def _with_resolvents(branch: Branch, left: Sequence[Polynomial]) -> list[Polynomial]:
    """The polynomials and what two of them imply together."""
    if branch.pending:
        return list(left)
    known = {str(p) for p in left}
    implied = reduced(resolvents(branch.ring, left), branch.steps)
    fresh = [p for p in implied if p != 0 and str(p) not in known]
    return sorted([*left, *fresh], key=len)


def _factor_keys(
    branch: Branch,
    polynomials: Sequence[Polynomial],
    library: FactorLibrary,
    largest: int,
) -> set[str]:
    keys: set[str] = set()
    for polynomial in polynomials:
        if len(polynomial) <= largest:
            keys |= {f.key for f in possible_factors(branch, polynomial, library)}
    return keys


def terms_of_squares(
    branch: Branch, polynomials: Sequence[Polynomial]
) -> list[Polynomial] | None:
    """The polynomials, and what vanishes wherever one that keeps its sign does.

    None where there is no such one, or nothing new.
    """
    for polynomial in polynomials:
        terms = vanishing_together(branch.ring, branch.assumptions, polynomial)
        if terms is None:
            continue
        known = {condition_key(branch.ring, p) for p in polynomials}
        if any(condition_key(branch.ring, term) not in known for term in terms):
            return [*terms, *polynomials]
    return None


def terms_of(branch: Branch, case: Factor) -> list[Polynomial] | None:
    """What vanishes wherever a factor does, if that is a sum of squares."""
    if len(case.equations) > 1:
        return None
    return vanishing_together(branch.ring, branch.assumptions, case.equations[0])


def implied_cases(
    branch: Branch, library: FactorLibrary, largest: int
) -> list[Factor] | None:
    """Solvable factors of something that two pending conditions imply."""
    values = [p.value for p in branch.pending]
    for _, _, polynomial in _implied(branch, values, largest):
        cases = possible_factors(branch, polynomial, library)
        if all(_is_simple(branch, case) for case in cases):
            return cases
    return None


def _implied(
    branch: Branch, values: Sequence[Polynomial], largest: int
) -> Iterator[tuple[Polynomial, Polynomial, Polynomial]]:
    """Two equations of a branch after two, with each polynomial that they imply."""
    for one, two in combinations(values, 2):
        if max(len(one), len(two)) > LONGEST:
            continue
        # Squares in them may be known: of an angle that is fixed by numbers.
        for polynomial in reduced(eliminants(branch.ring, one, two), branch.steps):
            if polynomial == 0:
                continue
            if len(polynomial) > largest:
                break
            yield one, two, polynomial


def implied_products(
    branch: Branch, library: FactorLibrary, largest: int
) -> list[Factor] | None:
    """Factors of what two equations of a branch imply, each simpler than these.

    They need not be solvable.  Of several such products the shortest is taken, none
    with a factor that is an equation of the branch already.
    """
    values = [v for p in branch.pending for v in (p.value, *p.beside) if v != 0]
    known = {str(primitive(v)) for v in values}
    found: list[tuple[int, list[Factor]]] = []
    for one, two, polynomial in _implied(branch, values, largest):
        cases = possible_factors(branch, polynomial, library)
        parts = [e for case in cases for e in case.equations]
        if all(_is_simpler(branch.ring, e, one, two) for e in parts) and not any(
            {str(e) for e in case.equations} <= known for case in cases
        ):
            found.append((sum(map(len, parts)), cases))
    return min(found, key=lambda own: own[0], default=(0, None))[1]


def _is_simpler(
    ring: TrigonometricRing, part: Polynomial, one: Polynomial, two: Polynomial
) -> bool:
    """Shorter than either of two equations; or with fewer unknowns, and not longer."""
    if len(part) < min(len(one), len(two)):
        return True
    fewest = min(len(unknowns(ring, one)), len(unknowns(ring, two)))
    return len(part) <= max(len(one), len(two)) and len(unknowns(ring, part)) < fewest


def _is_simple(branch: Branch, case: Factor) -> bool:
    condition, *companions = case.equations
    if companions:
        steps = half_angle_steps(branch.ring, branch.assumptions, condition, companions)
        return steps is not None
    return is_solvable(branch, case.equations[0]) or terms_of(branch, case) is not None


def possible_factors(
    branch: Branch, polynomial: Polynomial, library: FactorLibrary
) -> list[Factor]:
    """The irreducible factors that can vanish under the branch's assumptions.

    A square root vanishes where its radicand does, whose factors stand for it.  What
    the geometry divides by, such as the square of a quaternion, vanishes nowhere.
    """
    if branch.ring.radicands or len(polynomial) > SHORT:
        return _possible_factors(branch, polynomial, library)
    known = _POSSIBLE.setdefault(library, {})
    key = branch.assumptions, str(polynomial)
    if key not in known:
        known[key] = tuple(_possible_factors(branch, polynomial, library))
    return [*known[key]]


def _possible_factors(
    branch: Branch, polynomial: Polynomial, library: FactorLibrary
) -> list[Factor]:
    factored = factor(branch.ring, polynomial, library)
    divisors = _factors_of_divisors(branch.ring, library)
    found: dict[str, Factor] = {}
    for part, _ in factored.factors:
        if part.key in divisors:
            continue
        radicand = _radicand(branch, part.equations[0])
        if radicand is not None:
            inside = branch.value(branch.ring.without_divisors([radicand])[0])
            if inside != 0:
                found |= {f.key: f for f in possible_factors(branch, inside, library)}
                continue
        if not branch.assumptions.is_nonzero(branch.ring, part.equations[0]):
            found[part.key] = part
    return list(found.values())


def _factors_of_divisors(
    ring: TrigonometricRing, library: FactorLibrary
) -> frozenset[str]:
    """Keys of the factors of what the geometry divides by."""
    if not ring.divisors_of:
        return frozenset()
    if library not in _DIVISORS:
        plain = [ring.cleared([value])[0][0] for value in ring.divisors_of.values()]
        _DIVISORS[library] = frozenset(
            part.key
            for value in plain
            if value != 0 and len(value) <= SHORT
            for part, _ in factor(ring, value, library).factors
        )
    return _DIVISORS[library]


def _radicand(branch: Branch, polynomial: Polynomial) -> Polynomial | None:
    """The square of a symbolic root; None of what is no such root."""
    ring = branch.ring
    for name, inside in ring.radicands.items():
        if polynomial == ring.generator(name):
            return inside
    return None
