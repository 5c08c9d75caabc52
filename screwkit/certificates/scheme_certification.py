"""Certificates of an answer of `schemes`: which schemes hold the platform."""

from __future__ import annotations

from screwkit.certificates.records import (
    Certificate,
    SchemeClaim,
    SchemeClaims,
    Source,
)
from screwkit.certificates.scheme_claims import check_schemes
from screwkit.certificates.written import SCHEMA
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.whole_graph import WholeGraph
from screwkit.results.schemes import Schemes


def certified_schemes(
    subject: Assembly | WholeGraph, answer: Schemes, mechanism: Source, version: str
) -> Certificate:
    """The certificate of the schemes that an answer lists.

    Args:
        subject: The limbs of the mechanism, or its joint graph.
        answer: About it.
        mechanism: As it was read, to be carried along.
        version: Of the package.

    Raises:
        RefusedError: If the answer is wrong, or lists nothing.
    """
    if isinstance(subject, WholeGraph):
        framed, dimension, form = subject.framed, len(subject.network.rows), "loops"
    else:
        framed, dimension, form = subject.common_twists, subject.dimension, ""
    claims = SchemeClaims(
        framed.origin,
        tuple(dict(own) for own in framed.ring.basis),
        tuple(
            SchemeClaim(scheme.actuated, dimension - scheme.generic_rank)
            for scheme in answer.schemes
        ),
        form,
    )
    check_schemes(claims, subject.mechanism, "written")
    return Certificate(SCHEMA, answer.case, version, mechanism, (), claims)
