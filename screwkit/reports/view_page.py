"""A view as one page that loads nothing: the picture, and the same in tables.

The shapes are data beside a script that turns and paints them; text of a file is
escaped where it is markup and painted, never parsed, where it is not.  The policy of
the page forbids every fetch and every script but this one.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterable, Sequence
from html import escape
from importlib import resources
from typing import Final

from screwkit.reports.about_view import notes_of, platform_line, posture_lines
from screwkit.reports.decimals import decimal
from screwkit.reports.view_shapes import items_of, middle_of, screw_names
from screwkit.reports.view_strokes import item_data
from screwkit.results.scene import Point, Scene
from screwkit.results.view import JointNote, PlacedScrew, View

ENDINGS: Final = (".html", ".htm")
_GROUPS: Final = (
    ("links", "bodies"),
    ("joints", "joints"),
    ("link names", "names of bodies"),
    ("joint names", "names of joints"),
    ("frame", "frame of the base"),
    ("twists", "twists of the platform"),
    ("wrenches", "constraint wrenches"),
)
_ROUNDING: Final = 1e-12
_HIDDEN: Final = ("twists",)
_STYLE: Final = """
body{font:15px/1.45 system-ui,sans-serif;margin:0;color:#111;background:#fff}
header,section{padding:.4rem 1rem}
h1{font-size:1.2rem;margin:.3rem 0}
h2{font-size:1rem;margin:.8rem 0 .2rem}
p{margin:.2rem 0}
label{margin-right:.9rem;white-space:nowrap}
canvas{display:block;width:100%;height:70vh;touch-action:none;cursor:grab;
border-top:1px solid #ccc;border-bottom:1px solid #ccc}
table{border-collapse:collapse}
td,th{padding:.1rem .8rem .1rem 0;text-align:left;vertical-align:top}
th{border-bottom:1px solid #888}
.hint{color:#555}
.t{color:#00694d}.w{color:#a93226}
"""


def view_page(answer: View) -> str:
    """The whole page."""
    script = resources.files("screwkit.reports").joinpath("view.js").read_text("utf-8")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = (
        f"default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    )
    title = answer.title or answer.case
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head>\n<body>\n"
        f"{_header(answer, title)}\n"
        f'<canvas id="picture" tabindex="0" role="img" '
        f'aria-label="{escape(title)}"></canvas>\n'
        f"<section>{_screws(answer)}{_joints(answer)}{_links(answer)}</section>\n"
        f'<script type="application/json" id="shapes">{_data(answer)}</script>\n'
        f"<script>{script}</script>\n</body></html>\n"
    )


def _header(answer: View, title: str) -> str:
    lines = [platform_line(answer), *posture_lines(answer), *notes_of(answer)]
    said = "".join(f"<p>{escape(line)}</p>" for line in lines)
    boxes = "".join(
        f'<label><input type="checkbox" data-group="{group}"'
        f"{'' if group in _HIDDEN else ' checked'}> {words}</label>"
        for group, words in _GROUPS
    )
    views = "".join(
        f'<button type="button" data-view="{name}">{name}</button> '
        for name in ("oblique", "front", "side", "top")
    )
    return (
        f"<header><h1>{escape(title)}</h1>{said}<p>{boxes}</p><p>{views}"
        '<label>size of joints <input type="range" id="marks" min="-2" max="2" '
        'step="0.1" value="0"></label></p>'
        '<p class="hint">Drag to turn, with shift or the right button to move; scroll '
        "or pinch to zoom; arrow keys, + and − do the same. Filled joints are "
        "actuated, open ones passive. Lines are forces, double arrows couples; dashed "
        "lines are axes of rotation.</p></header>"
    )


def _screws(answer: View) -> str:
    found = ""
    for head, letter, screws in (
        (f"Twists of {answer.platform}", "t", answer.twists),
        (f"Constraint wrenches of {answer.platform}", "w", answer.wrenches),
    ):
        if screws:
            names = screw_names(screws, letter)
            rows = [
                (name, screw.description, *_numbers(screw, answer.scene))
                for name, screw in zip(names, screws, strict=True)
            ]
            heads = ("", "", "direction", "through the point", "pitch")
            found += f"<h2>{escape(head)}</h2>{_table(heads, rows, letter)}"
    return found


def _numbers(screw: PlacedScrew, scene: Scene) -> tuple[str, str, str]:
    point = "anywhere"
    if screw.point is not None:
        unit = f" {scene.unit}" if scene.unit else ""
        point = f"{_triple(screw.point, scene.size)}{unit}"
    pitch = "" if screw.pitch is None else decimal(screw.pitch)
    return _triple(screw.direction, 1.0), point, pitch


def _triple(values: Point, size: float) -> str:
    """Coordinates that are nothing but rounding are shown as 0."""
    shown = (0.0 if abs(value) < _ROUNDING * size else value for value in values)
    return f"({', '.join(decimal(value, 5) for value in shown)})"


def _joints(answer: View) -> str:
    driven = {f.label for f in answer.freedoms if f.actuated}
    own: dict[str, list[str]] = {}
    for freedom in answer.freedoms:
        own.setdefault(freedom.joint, []).append(freedom.label)

    def state(note: JointNote) -> str:
        return ", ".join(label for label in own.get(note.name, ()) if label in driven)

    rows = [
        (note.name, note.words, note.parent, note.child, state(note))
        for note in answer.joints
    ]
    heads = ("joint", "kind", "parent", "child", "actuated")
    return f"<h2>Joints and contacts</h2>{_table(heads, rows)}" if rows else ""


def _links(answer: View) -> str:
    roles = {answer.platform: "platform", answer.base: "base"}
    rows = [(link, roles.get(link, "")) for link in answer.links]
    return f"<h2>Bodies</h2>{_table(('body', ''), rows)}"


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]], kind: str = "") -> str:
    head = "".join(f"<th>{escape(text)}</th>" for text in heads)
    mark = f' class="{kind}"' if kind else ""
    body = "".join(
        f"<tr{mark}>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>"
        for row in rows
    )
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _data(answer: View) -> str:
    """The shapes as JSON in which nothing can end the element that holds it."""
    data = {
        "middle": middle_of(answer.scene),
        "size": answer.scene.size,
        "planar": answer.scene.planar,
        "items": [item_data(item) for item in items_of(answer)],
    }
    content = json.dumps(data, separators=(",", ":"))
    for sign in "<>&":
        content = content.replace(sign, f"\\u{ord(sign):04x}")
    return content
