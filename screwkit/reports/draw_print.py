"""Pictures for print: vector PDF and SVG, drawn by matplotlib.

Bodies are lines between their joints, closed where there are three or more, and the
platform is filled; joints that turn are
circles and sliding ones squares, filled where a motor drives them and open where they
are passive; contacts are triangles.  Nothing of a mechanism's text is ever taken as
mathematics or markup.

References: [BicchiPrattichizzo] Fig. 2 (filled and open joints).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, Final

from screwkit.reports.figures import (
    ARMS,
    BLACK,
    BLUE,
    FONT,
    GREY,
    ORANGE,
    PLATFORM,
    Form,
    new_figure,
    polygon_in_space,
    written,
)
from screwkit.reports.outlines import drawn_through
from screwkit.reports.panels import EllipseShape, Panel
from screwkit.reports.printing import printable
from screwkit.results.scene import BodyShape, JointShape, Point

_STEPS: Final = 96
_VIEW: Final = (22, -60)
_MARKS: Final = {"turns": "o", "slides": "s", "ball": "o", "contact": "^", "rigid": "x"}


def picture(panels: Sequence[Panel], form: Form = "pdf") -> bytes:
    """Panels side by side, two in a row, as the content of a file.

    Args:
        panels: One at least.
        form: What kind of file.
    """
    rows, columns = math.ceil(len(panels) / 2), min(len(panels), 2)
    figure = new_figure(3.4 * columns, 3.2 * rows)
    for number, panel in enumerate(panels, 1):
        if panel.scene.planar:
            axes = figure.add_subplot(rows, columns, number)
            _flat(axes, panel)
        else:
            axes = figure.add_subplot(rows, columns, number, projection="3d")
            _solid(axes, panel)
        letter = f"({chr(96 + number)}) " if len(panels) > 1 else ""
        axes.set_title(
            f"{letter}{panel.title}\n{panel.scale}", fontsize=FONT, parse_math=False
        )
    return written(figure, form)


# -- in the plane -------------------------------------------------------------------


def _flat(axes: Any, panel: Panel) -> None:
    scene = panel.scene
    axes.set_aspect("equal")
    axes.tick_params(labelsize=FONT - 2)
    unit = f" / {printable(scene.unit)}" if scene.unit else ""
    axes.set_xlabel(f"x{unit}", fontsize=FONT - 1, parse_math=False)
    axes.set_ylabel(f"y{unit}", fontsize=FONT - 1, parse_math=False)
    for body in scene.bodies:
        _flat_body(axes, body)
    for shape in panel.ellipses:
        _flat_ellipse(axes, shape)
    for joint in scene.joints:
        x, y, _ = joint.point
        axes.plot([x], [y], linestyle="none", zorder=4, **_mark(joint))
        axes.annotate(
            printable(joint.name),
            (x, y),
            xytext=(4, 4),
            textcoords="offset points",
            fontsize=FONT - 2,
            color=GREY,
            parse_math=False,
            zorder=5,
        )
    axes.margins(0.12)
    _legend(axes, panel)


def _flat_body(axes: Any, body: BodyShape) -> None:
    points = drawn_through(body)
    xs = [point[0] for point in points]
    ys = [point[1] for point in points]
    if body.role == "base":
        axes.plot(
            xs, ys, linestyle="none", marker="_", markersize=14, color=GREY, zorder=1
        )
        return
    if body.role == "platform" and len(points) > 2:
        axes.fill(xs, ys, facecolor=PLATFORM, edgecolor=BLUE, linewidth=1.2, zorder=1)
        return
    colour = BLUE if body.role == "platform" else BLACK
    width = 3.0 if body.role == "platform" else 1.6
    axes.plot(xs, ys, color=colour, linewidth=width, solid_capstyle="round", zorder=2)


def _flat_ellipse(axes: Any, shape: EllipseShape) -> None:
    colour, width, style = _pen(shape)
    x, y, _ = shape.centre
    points = _outline(shape.axes)
    axes.plot(
        [x + p[0] for p in points],
        [y + p[1] for p in points],
        color=colour,
        linewidth=width,
        linestyle=style,
        label=shape.label,
        zorder=3,
    )
    for vector in shape.axes:
        axes.plot(
            [x - vector[0], x + vector[0]],
            [y - vector[1], y + vector[1]],
            color=colour,
            linewidth=0.6,
            zorder=3,
        )


def _outline(axes: Sequence[Point]) -> list[Point]:
    """Points of the ellipse with these semi-axes; a segment where there is only one."""
    first = axes[0]
    second = axes[1] if len(axes) > 1 else (0.0, 0.0, 0.0)
    found = []
    for step in range(_STEPS + 1):
        angle = 2 * math.pi * step / _STEPS
        c, s = math.cos(angle), math.sin(angle)
        x, y, z = (c * a + s * b for a, b in zip(first, second, strict=True))
        found.append((x, y, z))
    return found


# -- in space -----------------------------------------------------------------------


def _solid(axes: Any, panel: Panel) -> None:
    scene = panel.scene
    axes.set_proj_type("ortho")
    axes.view_init(*_VIEW)
    axes.tick_params(labelsize=FONT - 3, pad=-2)
    for side in (axes.xaxis, axes.yaxis, axes.zaxis):
        side.set_pane_color((1.0, 1.0, 1.0, 0.0))
    axes.grid(visible=False)
    for body in scene.bodies:
        _solid_body(axes, body)
    for shape in panel.ellipses:
        _solid_ellipsoid(axes, shape)
    for joint in scene.joints:
        x, y, z = joint.point
        axes.plot([x], [y], [z], linestyle="none", **_mark(joint))
        if any(joint.direction) and joint.look in ("turns", "slides"):
            _solid_axis(axes, joint, 0.09 * scene.size)
    _equal(axes, panel)
    _legend(axes, panel)


def _solid_body(axes: Any, body: BodyShape) -> None:
    points = drawn_through(body)
    if body.role == "platform" and len(points) > 2:
        axes.add_collection3d(polygon_in_space(points[:-1], PLATFORM, BLUE))
        return
    if body.role == "base":
        xs, ys, zs = zip(*points, strict=True)
        axes.plot(xs, ys, zs, linestyle="none", marker="_", markersize=10, color=GREY)
        return
    colour = BLUE if body.role == "platform" else BLACK
    width = 2.2 if body.role == "platform" else 1.3
    for one, other in pairwise(points):
        xs, ys, zs = zip(one, other, strict=True)
        axes.plot(xs, ys, zs, color=colour, linewidth=width)


def _solid_axis(axes: Any, joint: JointShape, length: float) -> None:
    ends = [
        [
            p + sign * length * d
            for p, d in zip(joint.point, joint.direction, strict=True)
        ]
        for sign in (-1, 1)
    ]
    xs, ys, zs = zip(*ends, strict=True)
    axes.plot(xs, ys, zs, color=ORANGE, linewidth=0.8, linestyle=(0, (4, 2)))


def _solid_ellipsoid(axes: Any, shape: EllipseShape) -> None:
    """Three principal ellipses, and the axes."""
    colour, width, style = _pen(shape)
    x, y, z = shape.centre
    vectors = shape.axes
    pairs = [(i, j) for i in range(len(vectors)) for j in range(i)] or [(0, 0)]
    for number, (i, j) in enumerate(pairs):
        chosen = (vectors[i], vectors[j]) if i != j else (vectors[i],)
        points = _outline(chosen)
        axes.plot(
            [x + p[0] for p in points],
            [y + p[1] for p in points],
            [z + p[2] for p in points],
            color=colour,
            linewidth=width,
            linestyle=style,
            label=shape.label if number == 0 else None,
        )
    for vector in vectors:
        ends = [
            [c + sign * v for c, v in zip(shape.centre, vector, strict=True)]
            for sign in (-1, 1)
        ]
        xs, ys, zs = zip(*ends, strict=True)
        axes.plot(xs, ys, zs, color=colour, linewidth=0.6)


def _equal(axes: Any, panel: Panel) -> None:
    """The same scale along all axes, everything inside."""
    points = [p for body in panel.scene.bodies for p in body.points]
    for shape in panel.ellipses:
        for vector in shape.axes:
            for sign in (-1, 1):
                x, y, z = (
                    c + sign * v for c, v in zip(shape.centre, vector, strict=True)
                )
                points.append((x, y, z))
    low = [min(p[i] for p in points) for i in range(3)]
    high = [max(p[i] for p in points) for i in range(3)]
    # All in one point, as bodies without any moving joint are: any scale will do.
    half = 0.52 * (max(h - lo for h, lo in zip(high, low, strict=True)) or 1.0)
    middle = [(h + lo) / 2 for h, lo in zip(high, low, strict=True)]
    axes.set_xlim(middle[0] - half, middle[0] + half)
    axes.set_ylim(middle[1] - half, middle[1] + half)
    axes.set_zlim(middle[2] - half, middle[2] + half)
    axes.set_box_aspect((1, 1, 1))
    unit = f" / {printable(panel.scene.unit)}" if panel.scene.unit else ""
    for name in "xyz":
        label = getattr(axes, f"set_{name}label")
        label(f"{name}{unit}", fontsize=FONT - 2, labelpad=-6, parse_math=False)


# -- in both ------------------------------------------------------------------------


def _mark(joint: JointShape) -> dict[str, Any]:
    colour = BLUE if joint.look == "contact" else BLACK
    filled = joint.actuated or joint.look in ("contact", "rigid")
    return {
        "marker": _MARKS[joint.look],
        "markersize": 7 if joint.look == "ball" else 5.5,
        "markerfacecolor": colour if filled else "white",
        "markeredgecolor": colour,
        "markeredgewidth": 1.0,
    }


def _pen(shape: EllipseShape) -> tuple[str, float, Any]:
    """Colour, width and style of a line."""
    if shape.role == "system":
        return BLUE, 1.6, "solid"
    number = int(shape.role.rpartition(" ")[2])
    return ARMS[number % len(ARMS)], 1.0, (0, (5, 2))


def _legend(axes: Any, panel: Panel) -> None:
    if any(shape.label for shape in panel.ellipses):
        place = "best" if panel.scene.planar else "upper left"
        legend = axes.legend(fontsize=FONT - 2, loc=place, framealpha=0.8)
        for text in legend.get_texts():
            text.set_parse_math(False)
            text.set_text(printable(text.get_text()))
