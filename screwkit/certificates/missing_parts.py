"""What a certificate leaves out, which would make it seem to say more than it does."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace

from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Part
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.model import Mechanism


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
    if len(names) < 2:
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
    postures = Postures(mechanism, part, random.Random(seed))
    matrix = ScrewMatrix(postures)
    return not all(matrix.freedom(point) for point in postures.several(Way()))
