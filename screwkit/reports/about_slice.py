"""What is said of a slice of the singular loci beside its picture."""

from __future__ import annotations

from screwkit.reports.blocks import (
    Block,
    Heading,
    Paragraph,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.decimals import decimal
from screwkit.results.slice import SingularSlice


def slice_blocks(answer: SingularSlice) -> tuple[Block, ...]:
    """What varies, what is fixed, what is drawn and what is not."""
    ranges = ", ".join(
        f"{name} from {decimal(low)} to {decimal(high)}{f' {unit}' if unit else ''}"
        for name, (low, high), unit in zip(
            answer.symbols, answer.ranges, answer.units, strict=True
        )
    )
    blocks: list[Block] = [
        Heading(words("SLICE"), 1),
        Paragraph(words(ranges), 1),
    ]
    if answer.fixed:
        blocks.append(Paragraph(words(f"at {', '.join(answer.fixed)}"), 1))
    if answer.remark:
        blocks.append(Paragraph(prose(answer.remark), 1))
    drawn = sum(not component.note for component in answer.components)
    curves = "1 curve is" if drawn == 1 else f"{drawn} curves are"
    steps = " × ".join(str(count) for count in answer.shape)
    blocks.append(
        Paragraph(words(f"{curves} drawn, found on a grid of {steps} points"), 1)
    )
    for component in answer.components:
        if component.note:
            equations = joined([math(f"{text} = 0") for text in component.equations])
            blocks.append(
                Paragraph(
                    (*words("not drawn: "), *equations, *words(f": {component.note}")),
                    1,
                )
            )
    if answer.file:
        blocks.append(Paragraph(words(f"wrote {answer.file}"), 1))
    return tuple(blocks)
