"""The section that answers `verify`: accepted or refused, and what was proved."""

from __future__ import annotations

from screwkit.algebra.names import counted
from screwkit.reports.blocks import Block, Paragraph, words
from screwkit.results.verification import Verification, VerifiedPart


def verification_blocks(answer: Verification) -> tuple[Block, ...]:
    """The whole answer."""
    if not answer.accepted:
        return (Paragraph(words(f"refused: {answer.reason}"), 1),)
    every = all(part.proved for part in answer.parts)
    said = "accepted: every list is complete" if every else "accepted, with open lists"
    lines = [Paragraph(words(said), 1)]
    lines += [Paragraph(words(_line(part)), 2) for part in answer.parts]
    if answer.assumptions:
        lines.append(Paragraph(words(f"assumed: {', '.join(answer.assumptions)}"), 1))
    return tuple(lines)


def _line(part: VerifiedPart) -> str:
    listed = counted(part.components, "component")
    if not part.components:
        listed = "no singularity"
    if part.proved:
        nodes = counted(part.nodes, "node")
        return f"{part.name}: {listed}, complete by a proof of {nodes}"
    held = "holds" if part.components == 1 else "hold"
    if not part.components:
        return f"{part.name}: not proved complete ({part.reason})"
    return f"{part.name}: {listed} {held}, not proved complete ({part.reason})"
