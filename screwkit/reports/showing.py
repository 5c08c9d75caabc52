"""How answers show themselves: what `print`, notebooks and `to_json` give.

Importing this registers it; nothing that renders is imported before an answer is shown.
"""

from __future__ import annotations

from typing import Any

from screwkit.results.shown import Looks, show_by


def _text(answer: Any) -> str:
    from screwkit.reports.sections import answer_blocks  # noqa: PLC0415
    from screwkit.reports.text import render  # noqa: PLC0415

    return render(answer_blocks(answer))


def _html(answer: Any) -> str:
    from html import escape  # noqa: PLC0415

    return f'<pre style="line-height: 1.2">{escape(_text(answer))}</pre>'


def _document(answer: Any) -> dict[str, Any]:
    from screwkit.reports.records import to_json  # noqa: PLC0415

    return to_json(answer)


show_by(Looks(_text, _html, _document))
