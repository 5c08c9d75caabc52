"""A slice of the singular loci for print: one curve a component, told in a legend."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Final

from screwkit.reports.blocks import Math
from screwkit.reports.figures import (
    ARMS,
    BLACK,
    BLUE,
    FONT,
    ORANGE,
    Form,
    new_figure,
    written,
)
from screwkit.reports.printing import printable
from screwkit.reports.text import inline
from screwkit.results.slice import SingularSlice, SlicedComponent

_COLOURS: Final = (BLUE, "#D55E00", "#009E73", "#CC79A7", BLACK, ORANGE, ARMS[2])
_STYLES: Final = ("solid", (0, (5, 2)), (0, (1, 1.5)), (0, (5, 1, 1, 1)))
_LONGEST: Final = 240
"""Characters of an equation that a legend shows."""

Line = Sequence[tuple[float, float]]


def slice_picture(
    answer: SingularSlice, curves: Sequence[Sequence[Line]], title: str, form: Form
) -> bytes:
    """The picture as the content of a file.

    Args:
        answer: What is drawn.
        curves: For each component the segments of its curve.
        title: Of the mechanism.
        form: What kind of file.
    """
    drawn = [
        (component, own)
        for component, own in zip(answer.components, curves, strict=True)
        if own
    ]
    texts = [legend_text(component) for component, _ in drawn]
    height = 4.6 + 0.14 * sum(text.count("\n") + 1 for text in texts)
    figure = new_figure(5.0, height)
    plot = figure.add_subplot()
    plot.tick_params(labelsize=FONT - 2)
    told = [title, ", ".join(answer.fixed), answer.remark]
    lines = [line for text in told for line in textwrap.wrap(printable(text), 72)]
    plot.set_title("\n".join(lines), fontsize=FONT, parse_math=False)
    for number, (_, segments) in enumerate(drawn):
        colour = _COLOURS[number % len(_COLOURS)]
        style = _STYLES[number // len(_COLOURS) % len(_STYLES)]
        xs, ys = _joined(segments)
        plot.plot(xs, ys, color=colour, linestyle=style, linewidth=1.3)
    (low, high), (bottom, top) = answer.ranges
    plot.set_xlim(low, high)
    plot.set_ylim(bottom, top)
    if answer.units[0] == answer.units[1]:
        plot.set_aspect("equal")
    labels = [
        printable(f"{name} / {unit}" if unit else name)
        for name, unit in zip(answer.symbols, answer.units, strict=True)
    ]
    plot.set_xlabel(labels[0], fontsize=FONT, parse_math=False)
    plot.set_ylabel(labels[1], fontsize=FONT, parse_math=False)
    if drawn:
        legend = figure.legend(
            plot.get_lines(), texts, loc="outside lower left", fontsize=FONT - 2
        )
        for shown in legend.get_texts():
            shown.set_parse_math(False)
    return written(figure, form)


def legend_text(component: SlicedComponent) -> str:
    """Which locus, its equation, and what happens there."""
    equation = inline((Math(f"{component.equations[0]} = 0"),))
    if len(equation) > _LONGEST:
        size = f"{len(equation)} characters"
        equation = f"{equation[:_LONGEST]}… = 0 (the whole has {size})"
    told = f": {component.geometry}" if component.geometry else ""
    whole = printable(f"{', '.join(component.parts)}: {equation}{told}")
    return "\n".join(textwrap.wrap(whole.replace("\u00a0", " "), 78))


def _joined(segments: Sequence[Line]) -> tuple[list[float], list[float]]:
    """Coordinates of a line that is lifted between chains of segments."""
    xs: list[float] = []
    ys: list[float] = []
    for chain in chains(segments):
        xs += [*(x for x, _ in chain), float("nan")]
        ys += [*(y for _, y in chain), float("nan")]
    return xs, ys


def chains(segments: Sequence[Line]) -> list[list[tuple[float, float]]]:
    """Segments joined at common ends, so that dashes run through."""
    ends: dict[tuple[float, float], list[int]] = {}
    for number, (one, two) in enumerate(segments):
        ends.setdefault(one, []).append(number)
        ends.setdefault(two, []).append(number)
    left = dict.fromkeys(range(len(segments)))
    found = []
    while left:
        number = next(iter(left))
        del left[number]
        chain = list(segments[number])
        for _ in range(2):
            while followers := [n for n in ends[chain[-1]] if n in left]:
                del left[followers[0]]
                one, two = segments[followers[0]]
                chain.append(two if one == chain[-1] else one)
            chain.reverse()
        found.append(chain)
    return found
