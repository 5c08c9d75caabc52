"""What whoever checks a certificate has seen beyond what it claims."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.certificates.records import Part


@dataclass(frozen=True)
class Findings:
    """What was seen of a part beyond what it claims.

    Attributes:
        irreducible: Equations of components that were shown to be no product.
        real: Equations of components that were shown to have real postures.
        sampled_components: Equations of components that were not shown to hold at
            singular postures alone: they were seen at some of their postures.
        sampled_conditions: Conditions that meet in the proof, where what was seen at
            some postures need not hold on other sheets, if there are any.
        wider_components: Equations of components that hold on all of another one, too.
    """

    irreducible: tuple[tuple[str, ...], ...] = ()
    real: tuple[tuple[str, ...], ...] = ()
    sampled_components: tuple[tuple[str, ...], ...] = ()
    sampled_conditions: tuple[tuple[str, ...], ...] = ()
    wider_components: tuple[tuple[str, ...], ...] = ()


def name_of(part: Part) -> str:
    """What a part is about, in words."""
    if part.question == "limb":
        return f"limb {part.limb}"
    if part.locked:
        return f"{part.question} with {', '.join(part.locked)} locked"
    return part.question
