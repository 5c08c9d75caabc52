"""Angles that occur as numbers too: the turns of helical joints, and of what rolls.

A ring takes θ, sin θ and cos θ for three unknowns.  Where conditions make θ an
algebraic number other than 0, its sine and cosine are transcendental, so that no
equation with algebraic coefficients holds between them but sin² θ + cos² θ = 1
[Lindemann1882]; θ = 0 has cos θ = 1.

References: [Lindemann1882].
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.substitution import Substitution
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def are_no_angles(
    ring: TrigonometricRing,
    assumptions: Assumptions,
    steps: Iterable[Substitution],
    pending: Iterable[Polynomial],
    on_branch: Callable[[Sequence[Polynomial]], Sequence[Polynomial]],
) -> bool:
    """Whether an angle that conditions make a number has another sine or cosine there.

    Args:
        ring: Of the conditions.
        assumptions: About its symbols.
        steps: That solve conditions.
        pending: What these have made of conditions that could not be solved.
        on_branch: A vector after the steps, up to a common factor.
    """
    if not ring.angles_as_numbers:
        return False
    constants = map(ring.names.index, ring.constant_generators)
    algebraic = {*constants, *_relations(steps)}
    left = [_places(value) for value in pending]
    for k, angle in ring.angles_as_numbers.items():
        sine, cosine = ring.sines[k], ring.cosines[k]
        turn, *turned, one = on_branch([angle, sine, cosine, ring.one])
        if not _places(turn) | _places(one) <= algebraic:
            continue
        if turn == 0:
            apart = (turned[0], turned[1] - one)
            if any(v != 0 and assumptions.is_nonzero(ring, v) for v in apart):
                return True
        elif assumptions.is_nonzero(ring, turn):
            own = algebraic | {ring.sine_index(k), ring.cosine_index(k)}
            fixed = any(_places(value) <= algebraic for value in turned)
            if fixed or any(places <= own for places in left):
                return True
    return False


def _relations(steps: Iterable[Substitution]) -> set[int]:
    """Places of the sines and cosines that steps make algebraic numbers."""
    found: set[int] = set()
    for step in steps:
        if step.relation is not None:
            found.update(index for index, *_ in (step.relation, *step.field))
    return found


def _places(polynomial: Polynomial) -> set[int]:
    """Of the generators that occur."""
    return {i for i, degree in enumerate(polynomial.degrees()) if degree > 0}


def single_angles(ring: TrigonometricRing) -> dict[int, int] | None:
    """Of each basis angle that is a symbol too the place of that symbol.

    None where such an angle is no basis angle by itself.
    """
    first = ring.symbol_indices().start
    gens = ring.context.gens()
    angles = {name for form in ring.basis for name, _ in form}
    both = {first + i: n for i, n in enumerate(ring.symbols) if n in angles}
    found = {
        k: place
        for k, angle in ring.angles_as_numbers.items()
        for place in both
        if angle == gens[place]
    }
    return found if len(found) == len(both) else None
