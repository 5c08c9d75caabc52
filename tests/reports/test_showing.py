"""Answers in Python: print shows them as the terminal does, repr in one line."""

from __future__ import annotations

import subprocess
import sys
from html import unescape

import pytest
from reports import samples

from screwkit.reports.records import to_json
from screwkit.reports.sections import answer_blocks
from screwkit.reports.text import render
from screwkit.results.shown import Shown

ANSWERS: list[Shown] = [
    samples.MOBILITY,
    samples.SCREWS,
    samples.SINGULARITIES,
    samples.SCHEMES,
    samples.ANALYSIS,
]


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda a: type(a).__name__)
def test_print_shows_what_the_terminal_shows(answer: Shown) -> None:
    text = render(answer_blocks(answer))
    assert str(answer) == text.rstrip("\n")
    html = answer._repr_html_()
    assert html is not None
    assert unescape(html.partition(">")[2].removesuffix("</pre>")) == text


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda a: type(a).__name__)
def test_repr_is_short_and_json_is_there(answer: Shown) -> None:
    assert len(repr(answer)) < 80
    assert type(answer).__name__.lower() in repr(answer)
    assert answer.to_json() == to_json(answer)  # type: ignore[arg-type]


def test_results_alone_import_no_rendering() -> None:
    """And say so, where they are asked to show themselves."""
    code = (
        "import sys; from screwkit.results.sweep import Sweep;"
        "s = Sweep('c', 't', 'i', (), (), (), None, None, None, 0, 0);"
        "assert str(s) == repr(s) == \"<sweep of 'c'>\";"
        "assert not [m for m in sys.modules if m.startswith('screwkit.reports')]"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
