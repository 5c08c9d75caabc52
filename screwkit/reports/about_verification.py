"""The section that answers `verify`: accepted or refused, and what was proved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from screwkit.algebra.names import counted
from screwkit.reports.blocks import Block, Paragraph, words
from screwkit.results.verification import Verification, VerifiedPart

NOT_ALONE = "not shown that its equations hold at singular postures alone"


def verification_blocks(answer: Verification) -> tuple[Block, ...]:
    """The whole answer."""
    if not answer.accepted:
        return (Paragraph(words(f"refused: {answer.reason}"), 1),)
    every = all(part.proved for part in answer.parts) and not answer.missing
    said = "accepted: every list is complete" if every else "accepted, with open lists"
    if every and any(part.sampled_conditions for part in answer.parts):
        said = "accepted: every list is complete, with the reservation below"
    if any(part.sampled for part in answer.parts):
        said += "; not every component is certified"
    if answer.schemes and not answer.parts:
        said = "accepted"
    lines = [Paragraph(words(said), 1)]
    if answer.schemes:
        left = answer.schemes - answer.admissible
        counts = f"{answer.admissible} admissible, {left} not"
        told = f"{counted(answer.schemes, 'scheme')}: {counts}"
        lines.append(Paragraph(words(told), 2))
    for part in answer.parts:
        lines.append(Paragraph(words(_line(part)), 2))
        lines += [Paragraph(words(text), 3) for text in _remarks(part)]
    if answer.missing:
        named = ", ".join(answer.missing)
        lines.append(Paragraph(words(f"nothing is said of: {named}"), 2))
    if answer.assumptions:
        lines.append(Paragraph(words(f"assumed: {', '.join(answer.assumptions)}"), 1))
    return tuple(lines)


def _remarks(part: VerifiedPart) -> Iterator[str]:
    """What was not shown."""
    if part.sampled:
        yield f"{NOT_ALONE}: {_named(part.sampled)}"
    if part.wider:
        named = _named(part.wider)
        yield f"equations that hold on all of another component too: {named}"
    every = range(1, part.components + 1)
    for text, shown in (
        ("not shown to be irreducible", part.irreducible),
        ("no real posture shown", part.real),
    ):
        left = tuple(number for number in every if number not in shown)
        if left:
            yield f"{text}: {_named(left)}"


def _named(numbers: Sequence[int]) -> str:
    listed = ", ".join(map(str, numbers))
    return f"component{'s' if len(numbers) > 1 else ''} {listed}"


def _line(part: VerifiedPart) -> str:
    listed = counted(part.components, "component")
    if not part.components:
        listed = "no singularity"
    if part.proved:
        nodes = counted(part.nodes, "node")
        said = f"{part.name}: {listed}, complete by a proof of {nodes}"
        met = len(part.sampled_conditions)
        if met:
            where = counted(met, "of them", "of them")
            said += f", if sheets that were not seen at {where} are like those seen"
        return said
    held = "holds" if part.components == 1 else "hold"
    if not part.components:
        return f"{part.name}: not proved complete ({part.reason})"
    return f"{part.name}: {listed} {held}, not proved complete ({part.reason})"
