"""The section that answers `sweep`: extremes, and where the index is lost."""

from __future__ import annotations

from screwkit.reports.blocks import Block, Column, Paragraph, Table, Text, words
from screwkit.reports.decimals import decimal
from screwkit.results.sweep import Extremum, Sweep


def sweep_blocks(answer: Sweep) -> tuple[Block, ...]:
    """The whole answer."""
    ranges = ", ".join(
        f"{name} from {decimal(low)} to {decimal(high)}"
        for name, (low, high) in zip(answer.vary, answer.ranges, strict=True)
    )
    shape = " × ".join(str(count) for count in answer.shape)
    points = f"{shape} point" if shape == "1" else f"{shape} points"
    blocks: list[Block] = [Paragraph(words(f"{answer.index} at {points}: {ranges}"), 1)]
    rows: list[tuple[Text, ...]] = []
    for name, extremum in (
        ("least", answer.least),
        ("greatest", answer.greatest),
        ("best, refined", answer.best),
    ):
        if extremum is not None:
            rows.append(_row(name, extremum))
    if rows:
        columns = (
            Column(()),
            Column(words(answer.index), "right"),
            *(Column(words(name), "right") for name in answer.vary),
        )
        blocks.append(Table(columns, tuple(rows)))
    else:
        blocks.append(Paragraph(words("nowhere a finite value"), 1))
    for count, what in (
        (answer.singular, "infinite: the actuators do not hold the platform there"),
        (answer.undefined, "without a posture"),
    ):
        if count:
            share = "1 point is" if count == 1 else f"{count} points are"
            blocks.append(Paragraph(words(f"{share} {what}"), 1))
    if answer.file:
        blocks.append(Paragraph(words(f"wrote {answer.file}"), 1))
    return tuple(blocks)


def _row(name: str, extremum: Extremum) -> tuple[Text, ...]:
    return (
        words(name),
        words(decimal(extremum.value, 8)),
        *(words(decimal(value, 8)) for value in extremum.values),
    )
