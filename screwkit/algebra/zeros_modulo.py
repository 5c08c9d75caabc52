"""Whether equations have common zeros at all, and exact points of them.

Decided modulo random primes at random values of what is given.  Equations without a
common zero modulo a prime have none over the rationals but for the finitely many primes
that divide a denominator of one.

References: [CoxLittleOShea] §4.1; [Schwartz1980].
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Final

from screwkit.algebra.branches import random_branch_prime
from screwkit.algebra.effort import Effort
from screwkit.algebra.finite_algebra import LARGEST, FiniteAlgebra
from screwkit.algebra.macaulay import WORK, multiples, zeros
from screwkit.algebra.points import Point, residue
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.residue_systems import ResidueSystem, residue_systems
from screwkit.algebra.solved_residues import solved_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

_SLICES: Final = ((100, 12), (300, 8), (1_100, 4))
"""Monomials that are eliminated together, at most, and slices that are tried so."""

_EFFORT: Final = 12_000_000_000
"""Products of residues on all slices together, at most."""

_PRIMES: Final = 2
"""Primes modulo which there must be no common zero."""


def have_no_zero(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    away: Sequence[Sequence[Polynomial]] = (),
    effort: Effort | None = None,
) -> bool:
    """Whether it is seen that equations have no common zero, complex ones included.

    Args:
        ring: Of the equations.
        equations: In normal form.
        given: Unknowns of which the answer holds in general, as dimensions.
        away: Sets whose common zeros are left out.
        effort: Products of residues that it may take; enough for each system if None.
    """
    source = random.Random(20_122)
    for _ in range(_PRIMES):
        prime = random_branch_prime(source)
        systems = residue_systems(ring, equations, given, prime, source, away)
        if systems is None:
            return False
        parts = [part for own in systems for part in solved_parts(own)]
        if not all(_is_empty(part, effort or Effort(WORK)) for part in parts):
            return False
    return True


def _is_empty(system: ResidueSystem, effort: Effort) -> bool:
    terms, away = system.terms(), system.away_terms()
    found = multiples(terms, len(system.left), system.prime, effort, away=away)
    if found is None or found.is_whole:
        return found is not None
    # Equations of larger degrees have not been asked yet.
    size = len(found.below())
    if size > LARGEST or not effort.spend(size**3 * (len(terms) + len(away))):
        return False
    return FiniteAlgebra(found).are_left_out(terms, away)


def exact_zeros(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    most: int,
    tried: Sequence[tuple[int, int]] = _SLICES,
) -> tuple[tuple[Point, int], ...]:
    """Exact points at which equations hold, with their primes, as far as found.

    As many unknowns have random values as leave finitely many zeros.

    Args:
        ring: Of the equations.
        equations: In normal form.
        given: Unknowns that any value may be given to, as dimensions.
        most: So many points are enough.
        tried: Monomials that are eliminated together, at most, and slices tried so.
    """
    free = [*dict.fromkeys(u for e in equations for u in unknowns(ring, e))]
    free = [unknown for unknown in free if unknown not in given]
    source = random.Random(20_123)
    least = max(0, len(free) - len(equations))
    found: list[tuple[Point, int]] = []
    effort = Effort(_EFFORT)
    for width, slices in tried:
        number = least
        if found or effort.left < 0:
            break
        for _ in range(slices):
            sliced = [*given, *source.sample(free, number)]
            here = _on_slice(ring, equations, sliced, (width, effort), source)
            found += here.points
            if here.is_wide and not here.points:
                number = min(number + 1, len(free))
            elif here.is_empty:
                number = max(number - 1, least)
            # Wide systems take seconds: there one point is enough.
            if len(found) >= most or (found and width == _SLICES[-1][0]):
                return tuple(found[:most])
    return tuple(found)


@dataclass(frozen=True)
class _Slice:
    """Zeros at values of some unknowns.

    Attributes:
        points: Those with coordinates modulo the prime.
        is_wide: Whether more monomials would have been needed, somewhere.
        is_empty: Whether there is no zero at all.
    """

    points: tuple[tuple[Point, int], ...]
    is_wide: bool
    is_empty: bool


def _on_slice(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    limits: tuple[int, Effort],
    source: random.Random,
) -> _Slice:
    """The zeros at random values of what is given."""
    prime = random_branch_prime(source)
    systems = residue_systems(ring, equations, given, prime, source)
    if systems is None:
        return _Slice((), False, False)
    points: list[tuple[Point, int]] = []
    wide = whole = 0
    for system in systems:
        terms, count = system.terms(), len(system.left)
        implied = multiples(terms, count, prime, limits[1], widest=limits[0])
        if implied is None:
            wide += 1
        elif implied.is_whole:
            whole += 1
        else:
            own = (system.point(ring, values) for values in zeros(implied, source))
            points += ((p, prime) for p in own if _is_on(equations, p, prime))
    return _Slice(tuple(points), wide > 0, whole == len(systems))


def _is_on(equations: Sequence[Polynomial], point: Point, prime: int) -> bool:
    return not any(residue(equation, point, prime) for equation in equations)
