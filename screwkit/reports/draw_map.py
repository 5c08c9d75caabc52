"""Maps of an index for print: a curve over one symbol, level lines over two.

References: [BicchiPrattichizzo] Fig. 10.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from screwkit.errors import ScrewkitError
from screwkit.reports.figures import BLUE, FONT, ORANGE, Form, new_figure, written
from screwkit.reports.printing import printable

LEVELS = 24
"""Level lines of a map."""


def map_picture(
    names: Sequence[str],
    axes: Sequence[Sequence[float]],
    values: Sequence[float] | Sequence[Sequence[float]],
    index: str,
    form: Form,
    best: Sequence[float] = (),
) -> bytes:
    """The picture of a grid of one or two symbols, as the content of a file.

    Args:
        names: Of the symbols.
        axes: Their values.
        values: Of the index, in the shape of the grid.
        index: What it is called.
        form: What kind of file.
        best: A point to be marked.

    Raises:
        ScrewkitError: If more than two symbols are varied.
    """
    if len(names) > 2:
        raise ScrewkitError(
            f"a map shows one or two symbols, not {len(names)}; write .npz or .csv"
        )
    figure = new_figure(4.6, 3.6)
    plot = figure.add_subplot()
    plot.tick_params(labelsize=FONT - 2)
    if len(names) == 1:
        plot.plot(axes[0], values, color=BLUE, linewidth=1.4)
        plot.set_ylabel(printable(index), fontsize=FONT, parse_math=False)
    else:
        low, high = _bounds([x for row in values for x in row])  # type: ignore[union-attr]
        turned = [
            [min(max(x, low), high) if math.isfinite(x) else high for x in row]
            for row in zip(*values, strict=True)
        ]
        shaded = plot.contourf(axes[0], axes[1], turned, levels=LEVELS, cmap="viridis")
        plot.contour(
            axes[0], axes[1], turned, levels=LEVELS, colors="white", linewidths=0.2
        )
        bar = figure.colorbar(shaded, ax=plot)
        bar.ax.tick_params(labelsize=FONT - 2)
        bar.set_label(printable(index), fontsize=FONT, parse_math=False)
        plot.set_ylabel(printable(names[1]), fontsize=FONT, parse_math=False)
    plot.set_xlabel(printable(names[0]), fontsize=FONT, parse_math=False)
    if len(best) == 2:
        plot.plot([best[0]], [best[1]], "o", color=ORANGE, markersize=6)
    return written(figure, form)


def _bounds(values: Sequence[float]) -> tuple[float, float]:
    """Between which values a map is shaded: all but the most extreme tenth."""
    finite = sorted(x for x in values if math.isfinite(x))
    if not finite:
        return 0.0, 1.0
    low, high = finite[0], finite[int(0.9 * (len(finite) - 1))]
    return (low, high) if high > low else (low, low + 1.0)
