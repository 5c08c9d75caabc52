"""The only door to matplotlib: an empty figure, and its content as a file.

Files are the same for the same picture: no dates, no random identifiers.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any, Final, Literal, TypeAlias

from screwkit.results.scene import Point

Form: TypeAlias = Literal["pdf", "svg", "png"]
FORMS: Final[dict[str, Form]] = {".pdf": "pdf", ".svg": "svg", ".png": "png"}
"""By the ending of a file."""

BLACK: Final = "#000000"
GREY: Final = "#666666"
BLUE: Final = "#0072B2"
ORANGE: Final = "#E69F00"
ARMS: Final = ("#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442")
PLATFORM: Final = "#BFD7EA"
FONT: Final = 8


def new_figure(width: float, height: float) -> Any:
    """An empty figure of a size in inches, that opens no window."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: PLC0415
    from matplotlib.figure import Figure  # noqa: PLC0415

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def polygon_in_space(points: Sequence[Point], face: str, edge: str) -> Any:
    """A filled polygon for three-dimensional axes."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: PLC0415

    return Poly3DCollection(
        [list(points)], facecolor=face, edgecolor=edge, linewidth=1.0, alpha=0.5
    )


def written(figure: Any, form: Form) -> bytes:
    """The content of a file with that figure."""
    import matplotlib as mpl  # noqa: PLC0415

    content = io.BytesIO()
    settings = {"svg.hashsalt": "screwkit", "svg.fonttype": "path", "pdf.fonttype": 42}
    dates: dict[str, dict[str, None]] = {
        "pdf": {"CreationDate": None, "ModDate": None},
        "svg": {"Date": None},
        "png": {},
    }
    with mpl.rc_context(settings):
        figure.savefig(content, format=form, dpi=160, metadata=dates[form])
    return content.getvalue()
