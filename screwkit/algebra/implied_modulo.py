"""Short equations that hold where others do and some sets do not.

Modulo a prime they are sums of multiples of what is given, with what vanishes on those
sets divided out (`macaulay`).  Their numbers are told from the residues; modulo another
prime the same ones must come out.

References: [CoxLittleOShea] §4.4; [WangGuyDavenport1982].
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from fractions import Fraction
from typing import Final

from flint import fmpq

from screwkit.algebra.branches import random_branch_prime
from screwkit.algebra.echelon_modulo import Echelon
from screwkit.algebra.effort import Effort
from screwkit.algebra.macaulay import echelon_of
from screwkit.algebra.monomials import Terms, degree_of
from screwkit.algebra.points_on import Unknown
from screwkit.algebra.residue_systems import ResidueSystem, residue_systems
from screwkit.algebra.short_fractions import short_fraction
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

MOST: Final = 12
"""Equations, at most; short ones of low degree come first."""

_LARGEST: Final = 1 << 26
"""Numerators and denominators; larger ones come out by chance too often."""


def implied_equations(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    away: Sequence[Sequence[Polynomial]],
    work: int,
) -> list[Polynomial]:
    """Equations with rational numbers, of lower degree than what is given or as low.

    Args:
        ring: Of the equations.
        equations: In normal form.
        given: Unknowns that have random values; equations that depend on them do not
            come out.
        away: Sets whose common zeros are left out.
        work: Products of residues for one prime, at most.
    """
    source = random.Random(20_124)
    told: list[dict[str, Polynomial]] = []
    for _ in range(2):
        prime = random_branch_prime(source)
        systems = residue_systems(ring, equations, given, prime, source, away)
        if systems is None or len(systems) != 1 or not systems[0].left:
            return []
        (system,) = systems
        rows = echelon_of(
            system.terms(),
            len(system.left),
            prime,
            Effort(work),
            away=system.away_terms(),
        )
        told.append({str(p): p for p in _short_ones(ring, system, rows)})
    both = [p for text, p in told[0].items() if text in told[1]]
    return both[:MOST]


def _short_ones(
    ring: TrigonometricRing, system: ResidueSystem, rows: Echelon
) -> list[Polynomial]:
    """Rows of low degree whose numbers are short, in the generators of the ring."""
    leads = sorted(rows.leads, key=lambda lead: (sum(lead), lead))[: 4 * MOST]
    own = [rows.row(lead) for lead in leads]
    own.sort(key=lambda row: (degree_of(row), len(row)))
    places = [system.places[k] for k in system.left]
    width = len(ring.context.gens())
    found = []
    for row in own:
        terms = _rational(row, system.prime)
        if terms is None:
            continue
        lifted = {}
        for exponents, value in terms.items():
            key = [0] * width
            for place, power in zip(places, exponents, strict=True):
                key[place] = power
            lifted[tuple(key)] = fmpq(value.numerator, value.denominator)
        polynomial = ring.normal(ring.context.from_dict(lifted))
        if polynomial != 0:
            found.append(primitive(polynomial))
    return found


def _rational(row: Terms, prime: int) -> dict[tuple[int, ...], Fraction] | None:
    """With the shortest fractions of these residues; None where one is long."""
    found = {}
    for monomial, residue in row.items():
        value = short_fraction(residue, prime, _LARGEST)
        if value is None:
            return None
        found[monomial] = value
    return found
