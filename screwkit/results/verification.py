"""What `verify` answers: whether a certificate holds, part by part."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.shown import Shown


@dataclass(frozen=True)
class VerifiedPart:
    """One list of components of a certificate.

    Attributes:
        name: ``limb right``, ``constraint``, ``actuation with 1, 2 locked``.
        proved: Whether it carries a proof that the list is complete; the proof holds
            where the certificate is accepted.
        components: How many it lists.
        nodes: Of the proof.
        reason: Why there is no proof.
    """

    name: str
    proved: bool
    components: int
    nodes: int
    reason: str = ""


@dataclass(frozen=True, repr=False)
class Verification(Shown):
    """The answer of ``verify``.

    Attributes:
        accepted: Whether everything that the certificate claims was found to hold.
        reason: What does not hold; empty where it is accepted.
        assumptions: What the proofs take for granted, ``d3 > 0``.
    """

    case: str
    title: str
    accepted: bool
    parts: tuple[VerifiedPart, ...]
    reason: str = ""
    assumptions: tuple[str, ...] = ()
