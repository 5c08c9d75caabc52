"""What a certificate leaves out, which would make it seem to say more than it does."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace

from screwkit.certificates.closed_postures import ClosedPostures
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.postures import Postures
from screwkit.certificates.records import Part
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.texts import RefusedError
from screwkit.mechanism.graph import independent_loops, limbs
from screwkit.mechanism.model import Mechanism

_ATTEMPTS = 8
"""Choices of postures."""


def missing_from(
    parts: Sequence[Part], mechanism: Mechanism, seed: int
) -> tuple[str, ...]:
    """Limbs, or the loops between them, that a certificate says nothing about.

    Args:
        parts: Of the certificate, which was accepted.
        mechanism: As read from its file.
        seed: Of random postures.
    """
    names = [limb.name for limb in limbs(mechanism)]
    said = {part.limb for part in parts if part.question == "limb"}
    missing = [f"limb {name}" for name in names if name not in said]
    if len(names) < 2 and not independent_loops(mechanism):
        return tuple(missing)
    constraint = next((part for part in parts if part.question == "constraint"), None)
    if constraint is None:
        return (*missing, "constraint")
    scheme = mechanism.actuated
    asked = any(
        part.question == "actuation" and {*part.locked} == {*scheme} for part in parts
    )
    if scheme and not asked and _stops(constraint, mechanism, scheme, seed):
        missing.append("actuation")
    return tuple(missing)


def _stops(
    constraint: Part, mechanism: Mechanism, scheme: Sequence[str], seed: int
) -> bool:
    """Whether the platform has no freedom with the declared scheme locked."""
    part = replace(constraint, question="actuation", locked=tuple(scheme))
    for attempt in range(_ATTEMPTS):
        postures = Postures(mechanism, part, random.Random(f"{seed}/{attempt}"))
        own = GraphMatrix if part.form == "loops" else ScrewMatrix
        matrix = own(postures)
        try:
            points = ClosedPostures(mechanism, postures).in_general()
            return not all(matrix.freedom(point) for point in points)
        except RefusedError:
            continue
    return True
