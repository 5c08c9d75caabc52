"""The values that unknowns have at finitely many zeros, as roots of polynomials.

Of each unknown there is one polynomial that vanishes at all zeros.  Its numbers are
told from residues modulo several primes together, and must come out again modulo
another one.

References: [CoxLittleOShea] §5.3; [WangGuyDavenport1982].
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from fractions import Fraction
from math import isqrt
from typing import Final

from screwkit.algebra.branches import random_branch_prime
from screwkit.algebra.effort import Effort
from screwkit.algebra.finite_algebra import LARGEST, FiniteAlgebra
from screwkit.algebra.macaulay import multiples
from screwkit.algebra.points_on import Unknown
from screwkit.algebra.residue_systems import residue_systems
from screwkit.algebra.short_fractions import short_fraction
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

PRIMES: Final = 8
"""Modulo which numbers are told, at most."""

_ZEROS: Final = 60
"""Finitely many that are looked at, at most."""


def unknowns_by_numbers(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    away: Sequence[Sequence[Polynomial]],
    effort: Effort,
) -> dict[int, list[Fraction]]:
    """Of unknowns with finitely many values the polynomials of which these are roots.

    Args:
        ring: Of the equations.
        equations: In normal form.
        given: Unknowns that have random values; what depends on them is not found.
        away: Sets whose common zeros are left out.
        effort: Products of residues that it may take.

    Returns:
        By place among the generators (an angle has two), coefficients of 1, x, x² …;
        none where zeros are not seen to be finitely many.
    """
    source = random.Random(20_125)
    told: dict[int, tuple[list[int], int]] = {}
    found: dict[int, list[Fraction]] = {}
    for _ in range(PRIMES):
        prime = random_branch_prime(source)
        own = _by_variable(ring, equations, given, away, (prime, effort), source)
        if own is None:
            return {}
        for place, residues in own.items():
            known, modulus = told.get(place, ([0] * len(residues), 1))
            if len(known) != len(residues) or not modulus % prime:
                return {}
            before = _rational(known, modulus) if modulus > 1 else None
            if before is not None and _holds(before, residues, prime):
                found[place] = before
            told[place] = _together(known, modulus, residues, prime), modulus * prime
        if len(found) == len(own):
            break
    return found


def _by_variable(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    away: Sequence[Sequence[Polynomial]],
    limits: tuple[int, Effort],
    source: random.Random,
) -> dict[int, list[int]] | None:
    """By place among the generators, residues of monic polynomials, constant first."""
    prime, effort = limits
    systems = residue_systems(ring, equations, given, prime, source, away)
    if systems is None or len(systems) != 1 or not systems[0].left:
        return None
    (system,) = systems
    terms, left_out = system.terms(), system.away_terms()
    found = multiples(terms, len(system.left), prime, effort, away=left_out)
    if found is None or found.is_whole or len(found.below()) > LARGEST:
        return None
    size = len(found.below())
    if not effort.spend(size**3 * (len(terms) + len(left_out))):
        return None
    own = FiniteAlgebra(found).by_variable(terms, left_out, _ZEROS)
    places = [system.places[k] for k in system.left]
    return {p: r for p, r in zip(places, own, strict=True) if r}


def _together(
    known: Sequence[int], modulus: int, residues: Sequence[int], prime: int
) -> list[int]:
    """Residues modulo a product."""
    inverse = pow(modulus, -1, prime)
    return [
        old + modulus * ((new - old) * inverse % prime)
        for old, new in zip(known, residues, strict=True)
    ]


def _rational(residues: Sequence[int], modulus: int) -> list[Fraction] | None:
    """The shortest fractions with these residues; None where one is long."""
    largest = isqrt(modulus // 2)
    found = [short_fraction(residue, modulus, largest) for residue in residues]
    told = [value for value in found if value is not None]
    return told if len(told) == len(found) else None


def _holds(numbers: Sequence[Fraction], residues: Sequence[int], prime: int) -> bool:
    """Whether fractions have these residues."""
    return all(
        (value.numerator - residue * value.denominator) % prime == 0
        for value, residue in zip(numbers, residues, strict=True)
    )
