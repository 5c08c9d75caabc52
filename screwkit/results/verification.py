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
        irreducible: Components that were shown to be no product, by number from 1 in
            the order of the certificate, those on which only limbs move behind.
        real: Components that were shown to have real postures.
        sampled: Components whose equations were not shown to hold at singular postures
            alone: only some of their postures were seen.
        sampled_conditions: Conditions that meet in the proof, where what was seen at
            some postures need not hold on other sheets, if there are any.
        wider: Components whose equations hold on all of another component, too.
    """

    name: str
    proved: bool
    components: int
    nodes: int
    reason: str = ""
    irreducible: tuple[int, ...] = ()
    real: tuple[int, ...] = ()
    sampled: tuple[int, ...] = ()
    sampled_conditions: tuple[tuple[str, ...], ...] = ()
    wider: tuple[int, ...] = ()


@dataclass(frozen=True, repr=False)
class Verification(Shown):
    """The answer of ``verify``.

    Attributes:
        accepted: Whether everything that the certificate claims was found to hold.
        reason: What does not hold; empty where it is accepted.
        assumptions: What the proofs take for granted, ``d3 > 0``.
        missing: What the certificate says nothing about: ``limb right``, ``constraint``
            or ``actuation``.
        schemes: How many actuation schemes it speaks of.
        admissible: How many of these hold the platform in general.
    """

    case: str
    title: str
    accepted: bool
    parts: tuple[VerifiedPart, ...]
    reason: str = ""
    assumptions: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    schemes: int = 0
    admissible: int = 0
