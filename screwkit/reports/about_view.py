"""The section that answers `view`: where the picture is, and what it shows."""

from __future__ import annotations

from screwkit.reports.blocks import Block, Paragraph, words
from screwkit.reports.decimals import decimal
from screwkit.results.view import View


def view_blocks(answer: View) -> tuple[Block, ...]:
    """The whole answer."""
    said = [
        f"{_counted(len(answer.links), 'body', 'bodies')}, "
        f"{_counted(len(answer.joints), 'joint', 'joints')} and contacts",
        platform_line(answer),
    ]
    said += posture_lines(answer)
    said += notes_of(answer)
    if answer.file:
        said.append(f"wrote {answer.file}: open it with a browser")
    return tuple(Paragraph(words(line), 1) for line in said)


def platform_line(answer: View) -> str:
    """How many twists and wrenches are shown."""
    if answer.undecided:
        return f"undecided: the screws of {answer.platform}: {answer.undecided}"
    twists = _counted(len(answer.twists), "twist", "twists")
    wrenches = _counted(
        len(answer.wrenches), "constraint wrench", "constraint wrenches"
    )
    return f"{answer.platform}: {twists} and {wrenches} at this posture"


def posture_lines(answer: View) -> list[str]:
    """What was given, and the values of all symbols."""
    posture = answer.posture
    pairs = zip(posture.variables, posture.values, strict=True)
    lines = [f"given: {', '.join(answer.given)}"] if answer.given else []
    if posture.variables:
        at = ", ".join(f"{name} = {decimal(value)}" for name, value in pairs)
        lines.append(f"at {at}")
    return lines


def notes_of(answer: View) -> list[str]:
    """What a reader must know of the picture."""
    notes = []
    posture = answer.posture
    if not posture.exact and not answer.undecided:
        least = "" if posture.gap is None else f" (gap {decimal(posture.gap, 1)})"
        notes.append(
            f"the posture is known in floating point alone: dimensions are counts of "
            f"singular values{least}, screws are principal ones"
        )
    lost = [joint.name for joint in answer.joints if not joint.placed]
    if lost:
        notes.append(
            f"not drawn, as nothing in the file says where they are: {', '.join(lost)}"
        )
    return notes


def _counted(number: int, one: str, many: str) -> str:
    return f"{number} {one if number == 1 else many}"
