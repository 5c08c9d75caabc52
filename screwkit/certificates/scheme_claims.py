"""Whether actuation schemes hold the platform, as a certificate says.

At an exact posture with random values the platform is never freer than in general, but
for a probability below degree/2⁶⁰, and never less free: a posture at which it keeps
still proves a scheme admissible; where it moves at random postures it moves everywhere.

References: [Schwartz1980]; docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

import random

from screwkit.algebra.modular import ResampleError
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Part, SchemeClaims
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.texts import NoPostureError, RefusedError
from screwkit.mechanism.model import Mechanism

ATTEMPTS = 8
"""Choices of postures before the claims are given up."""


def check_schemes(claims: SchemeClaims, mechanism: Mechanism, seed: str) -> None:
    """Check every claim about a scheme.

    Args:
        claims: About schemes of the mechanism.
        mechanism: As read from its file.
        seed: Of the random postures; whoever wrote the claims must not know it.

    Raises:
        RefusedError: With what does not hold.
    """
    if not claims.schemes:
        raise RefusedError("it speaks of no scheme")
    for attempt in range(ATTEMPTS):
        try:
            return _examined(claims, mechanism, random.Random(f"{seed}/{attempt}"))
        except (ResampleError, NoPostureError):
            continue
        except (LookupError, ArithmeticError, ValueError, RecursionError) as error:
            raise RefusedError(f"it does not fit the mechanism: {error!r}") from None
    raise RefusedError("no exact posture was found at which schemes could be looked at")


def _examined(
    claims: SchemeClaims, mechanism: Mechanism, source: random.Random
) -> None:
    part = Part("actuation", claims.origin, claims.angles, 0, (), claims.form)
    postures = Postures(mechanism, part, source)
    if postures.tied:  # the postures that it draws need not be closed
        raise RefusedError("of schemes where loops tie joint variables it says nothing")
    points = postures.several(Way())
    kind = GraphMatrix if claims.form else ScrewMatrix
    every = {*kind(postures).columns}
    seen = set[frozenset[str]]()
    for claim in claims.schemes:
        named = ", ".join(claim.actuated)
        chosen = frozenset(claim.actuated)
        if not chosen <= every or len(chosen) < len(claim.actuated):
            raise RefusedError(f"scheme {named}: these are not freedoms of the limbs")
        if chosen in seen:
            raise RefusedError(f"scheme {named} stands twice")
        seen.add(chosen)
        matrix = kind(postures, chosen)
        freedom = min(matrix.freedom(point) for point in points)
        if freedom != claim.freedom:
            raise RefusedError(
                f"scheme {named}: the platform has {freedom} freedoms with these "
                f"locked, not {claim.freedom}"
            )
