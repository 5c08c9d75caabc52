"""Blocks as one self-contained HTML page; everything is escaped, nothing is loaded."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Final, assert_never

from screwkit.reports import text as plain
from screwkit.reports.blocks import (
    Bibliography,
    Block,
    Citation,
    Figure,
    Formula,
    Heading,
    Listing,
    Matrix,
    Paragraph,
    Reference,
    Span,
    Strong,
    Table,
    Text,
)
from screwkit.reports.panels import Panel

_STYLE: Final = """
body{font:16px/1.5 Georgia,serif;max-width:60rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse;margin:1rem 0}
table{border-top:2px solid;border-bottom:2px solid}
caption{text-align:left;font-style:italic;padding:.3rem 0}
th{border-bottom:1px solid;text-align:left}
td,th{padding:.2rem .8rem;vertical-align:top}
.formula{text-align:center;font-style:italic}.byline{color:#555}
"""


def document(
    title: str, byline: str, summary: Sequence[Block], blocks: Sequence[Block]
) -> str:
    """A whole page."""
    body = "\n".join(map(_render, (*summary, *blocks)))
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
        "style-src 'unsafe-inline'\">"
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head><body>\n"
        f'<h1>{escape(title)}</h1><p class="byline">{escape(byline)}</p>\n'
        f"{body}\n</body></html>\n"
    )


def _inline(text: Text) -> str:
    return "".join(map(_span, text))


def _span(span: Span) -> str:
    shown = escape(plain.inline((span,)))
    if isinstance(span, Strong):
        return f"<strong>{shown}</strong>"
    if isinstance(span, Reference):
        return f'<a href="#{escape(span.label)}">{shown}</a>'
    if isinstance(span, Citation):
        return f'<a href="#{escape(span.key)}">{shown}</a>'
    return shown


def _render(block: Block) -> str:
    match block:
        case Heading(text, level, aside):
            size = min(level + 1, 6)
            more = f" <small>{_inline(aside)}</small>" if aside else ""
            return f"<h{size}>{_inline(text)}{more}</h{size}>"
        case Paragraph(text, _):
            return f"<p>{_inline(text)}</p>"
        case Formula(body, label):
            number = f' id="{escape(label)}"' if label else ""
            return f'<p class="formula"{number}>{_inline((body,))}</p>'
        case Matrix() | Listing():
            return f"<pre>{escape(plain.render((block,)))}</pre>"
        case Table():
            return _table(block)
        case Figure(panels, caption, label):
            drawn = _svg(panels)
            return (
                f'<figure id="{escape(label)}">{drawn}'
                f"<figcaption>{_inline(caption)}</figcaption></figure>"
            )
        case Bibliography(entries):
            items = "".join(
                f'<li id="{escape(entry.key)}">[{escape(entry.key)}] '
                f"{escape(entry.text)}</li>"
                for entry in entries
            )
            return f"<h2>References</h2><ul>{items}</ul>"
        case _:
            assert_never(block)


def _svg(panels: Sequence[Panel]) -> str:
    """The picture as an element of the page."""
    from screwkit.reports.draw_print import picture  # noqa: PLC0415 -- heavy

    content = picture(panels, "svg").decode()
    return content[content.index("<svg") :]


def _table(table: Table) -> str:
    caption = f"<caption>{_inline(table.caption)}</caption>" if table.caption else ""
    heads = "".join(f"<th>{_inline(column.head)}</th>" for column in table.columns)
    rows = []
    for index, row in enumerate(table.rows):
        anchor = table.anchors[index] if index < len(table.anchors) else ""
        mark = f' id="{escape(anchor)}"' if anchor else ""
        cells = "".join(f"<td>{_inline(cell)}</td>" for cell in row)
        rows.append(f"<tr{mark}>{cells}</tr>")
    label = f' id="{escape(table.label)}"' if table.label else ""
    return (
        f"<table{label}>{caption}<thead><tr>{heads}</tr></thead>"
        f"<tbody>{''.join(rows)}</tbody></table>"
    )
