"""The files of a report: the article, its tables as fragments, the answer as JSON."""

from __future__ import annotations

import json
from pathlib import Path

from screwkit.algebra.names import counted
from screwkit.errors import MissingToolError
from screwkit.reports import latex, typeset
from screwkit.reports.article import Article, article
from screwkit.reports.blocks import Figure
from screwkit.reports.output import write
from screwkit.reports.records import to_json
from screwkit.results.analysis import Analysis


def latex_source(written: Article) -> str:
    """The article as one LaTeX document."""
    return latex.document(
        written.title, written.byline, written.summary, written.blocks
    )


def write_latex(analysis: Analysis, output: Path) -> list[str]:
    """Write the article, ``fragments/*.tex`` and ``results.json``.

    Args:
        analysis: The answer.
        output: The ``.tex`` file, or a folder for ``report.tex``.
    """
    path = output if output.suffix == ".tex" else output / "report.tex"
    written = article(analysis)
    write(path, latex_source(written))
    pictures = _pictures(written)
    for file, content in pictures.items():
        write(path.parent / file, content)
    for table in written.tables:
        name = table.label.rpartition(":")[2] or "table"
        write(path.parent / "fragments" / f"{name}.tex", latex.fragment(table))
    results = path.parent / "results.json"
    write(results, json.dumps(to_json(analysis), indent=1) + "\n")
    number = len(written.tables)
    said = [f"wrote {path}, {number} tables in {path.parent / 'fragments'}, {results}"]
    if pictures:
        said.append(f"{counted(len(pictures), 'picture')} in {path.parent / 'figs'}")
    return said


def write_pdf(analysis: Analysis, output: Path) -> list[str]:
    """Write the PDF and its source beside it; without TeX the source alone.

    Raises:
        MissingToolError: If TeX is not installed; the source is written.
        TypesettingError: If TeX fails; the source is there to be looked at.
    """
    path = output if output.suffix == ".pdf" else output / "report.pdf"
    made = article(analysis)
    source, pictures = latex_source(made), _pictures(made)
    tex = path.with_suffix(".tex")
    write(tex, source)
    for file, content in pictures.items():
        write(path.parent / file, content)
    if not typeset.is_available():
        raise MissingToolError(
            f"wrote {tex}, and no PDF: pdflatex is not installed; {typeset.INSTALL}"
        )
    pdf, _ = typeset.typeset(source, files=pictures)
    write(path, pdf)
    return [f"wrote {path} and {tex}"]


def _pictures(written: Article) -> dict[str, bytes]:
    """The pictures of an article by the paths that it includes."""
    figures = [block for block in written.blocks if isinstance(block, Figure)]
    if not figures:
        return {}
    from screwkit.reports.draw_print import picture  # noqa: PLC0415 -- heavy

    return {f"figs/{each.name}.pdf": picture(each.panels) for each in figures}


def write_html(analysis: Analysis, output: Path) -> list[str]:
    """Write one self-contained page."""
    from screwkit.reports.page import document  # noqa: PLC0415

    path = output if output.suffix in (".html", ".htm") else output / "report.html"
    written = article(analysis)
    page = document(written.title, written.byline, written.summary, written.blocks)
    write(path, page)
    return [f"wrote {path}"]
