r"""Blocks as LaTeX: an article that a small TeX installation can set.

The output is pure ASCII and every text passes `tex.escape`, so that nothing from a
mechanism file is obeyed by TeX.  Sums may break between lines; what is longer than a
cap is summarised with a pointer to the JSON beside the report.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, assert_never

from screwkit.reports import text as plain
from screwkit.reports.blocks import (
    Bibliography,
    Block,
    Citation,
    Column,
    Condition,
    Figure,
    Formula,
    Heading,
    Listing,
    Loci,
    Loose,
    Math,
    Matrix,
    Paragraph,
    Prose,
    Reference,
    Span,
    Strong,
    Table,
    Text,
    Words,
)
from screwkit.reports.notation import factor_latex, in_latex, term_count
from screwkit.reports.tex import escape, prose, working

CAP: Final = 420
_LINE: Final = 92
_LINE_ALONE: Final = 66
_LONG_FORMULA: Final = 84
_PREAMBLE: Final = r"""\documentclass[11pt,a4paper]{article}
\usepackage{amsmath,amssymb}
\usepackage{booktabs,longtable,graphicx}
\usepackage[margin=25mm]{geometry}
\usepackage[hidelinks]{hyperref}
\newcounter{condition}
\setlength{\emergencystretch}{3em}
\setlength{\belowcaptionskip}{6pt}
\renewcommand{\topfraction}{0.9}
\renewcommand{\textfraction}{0.07}
\renewcommand{\floatpagefraction}{0.8}
\setlength{\LTcapwidth}{\linewidth}
\allowdisplaybreaks
"""
_FRAGMENT: Final = r"""% needs \usepackage{amsmath,amssymb,booktabs,longtable}
"""


@dataclass(frozen=True, slots=True)
class _Setting:
    """Where the blocks stand: in an article, or each table in a file of its own."""

    alone: bool = False


def document(
    title: str, byline: str, summary: Sequence[Block], blocks: Sequence[Block]
) -> str:
    """A whole article.

    Args:
        title: Plain text.
        byline: Plain text below the title.
        summary: Paragraphs of the abstract.
        blocks: Everything after it.
    """
    return "\n".join(
        [
            _PREAMBLE,
            rf"\title{{{escape(title)}}}",
            rf"\author{{{escape(byline)}}}",
            r"\date{}",
            r"\begin{document}",
            r"\maketitle",
            r"\begin{abstract}",
            render(summary),
            r"\end{abstract}",
            render(blocks),
            r"\end{document}",
            "",
        ]
    )


def render(blocks: Sequence[Block]) -> str:
    """Blocks for the body of an article."""
    parts: list[str] = []
    for before, block in zip((None, *blocks), blocks, strict=False):
        # A formula belongs to the paragraph before it, so that no page parts them.
        apart = "\n" if isinstance(before, Paragraph) else "\n\n"
        text = _render(block, _Setting())
        if text:
            parts.append((apart if isinstance(block, Formula) else "\n\n") + text)
    return "".join(parts).strip("\n")


def fragment(table: Table) -> str:
    """A table for someone else's article, with a comment that names the packages."""
    return _FRAGMENT + _table(table, _Setting(alone=True)) + "\n"


def inline(text: Text) -> str:
    """A text within a line."""
    return _inline(text, _Setting())


def _inline(text: Text, setting: _Setting) -> str:
    return "".join(_span(span, setting) for span in text)


def _span(span: Span, setting: _Setting) -> str:
    match span:
        case Words(text):
            return escape(text)
        case Prose(text):
            return prose(text)
        case Strong(text):
            return rf"\textbf{{{escape(text)}}}"
        case Math(text, terms):
            return _math(text, terms)
        case Loci(factors):
            return _locus(factors)
        case Loose(text):
            return f"${working(text)}$"
        case Reference(label, number):
            return escape(number) if setting.alone else rf"\ref{{{_label(label)}}}"
        case Citation(key, place):
            if setting.alone:
                return escape(f"[{key}]")
            where = f"[{{{escape(place)}}}]" if place else ""
            return rf"\cite{where}{{{_label(key)}}}"
        case _:
            assert_never(span)


def _label(text: str) -> str:
    """A label TeX accepts; labels are the package's own, this is a second lock."""
    return re.sub(r"[^A-Za-z0-9:.-]", "-", text)


def _math(text: str, terms: int) -> str:
    if len(text) > CAP:
        return rf"($\,${terms or term_count(text)} terms, in the JSON$\,$)"
    return f"${_breakable(in_latex(text))}$"


def _locus(factors: tuple[tuple[str, int, int], ...]) -> str:
    written: list[str] = []
    for text, power, terms in factors:
        if len(text) > CAP:
            mark = f"^{{{power}}}" if power > 1 else ""
            body = rf"(\text{{{terms or term_count(text)} terms}}){mark}"
        else:
            body = _breakable(factor_latex(text, power, len(factors) == 1))
        written.append(body)
    return "$" + r" \cdot ".join(written) + "$"


def _breakable(formula: str) -> str:
    """Long products may break before a function, though rather at a plus sign."""
    if len(formula) < 60:
        return formula
    return re.sub(r"(?<=[}\w)])\\(sin|cos)\b", r"\\penalty900\\\1", formula)


def _render(block: Block, setting: _Setting) -> str:
    match block:
        case Heading(text, level, aside):
            return _heading(text, level, aside, setting)
        case Paragraph(text, _):
            return _inline(text, setting)
        case Formula(body, label):
            return _formula(body, label)
        case Matrix(name, rows, label):
            return _matrix(name, rows, label)
        case Table():
            return _table(block, setting)
        case Listing(items, _):
            return _listing(items, setting)
        case Figure():
            return _figure(block, setting)
        case Bibliography(entries):
            entry_lines = [
                rf"\bibitem{{{_label(entry.key)}}} {escape(entry.text)}"
                for entry in entries
            ]
            listed = "\n".join(entry_lines)
            return (
                f"\\begin{{thebibliography}}{{99}}\n{listed}\n\\end{{thebibliography}}"
            )
        case _:
            assert_never(block)


def _figure(figure: Figure, setting: _Setting) -> str:
    """A floating figure; its file stands in ``figs``."""
    width = "0.6" if len(figure.panels) == 1 else "0.98"
    return "\n".join(
        [
            r"\begin{figure}[htbp]",
            r"\centering",
            rf"\includegraphics[width={width}\linewidth]{{figs/{figure.name}.pdf}}",
            rf"\caption{{{_inline(figure.caption, setting)}}}",
            rf"\label{{{_label(figure.label)}}}",
            r"\end{figure}",
        ]
    )


def _heading(text: Text, level: int, aside: Text, setting: _Setting) -> str:
    command = {0: "section*", 1: "section", 2: "subsection"}.get(level, "paragraph")
    title = _inline(text, setting)
    if aside:
        title += f" ({_inline(aside, setting)})"
    shown = escape(plain.inline(text))
    head = rf"\texorpdfstring{{{title}}}{{{shown}}}" if "$" in title else title
    return rf"\{command}{{{head}}}"


def _formula(body: Math | Loose, label: str) -> str:
    match body:
        case Math(text, _):
            written = in_latex(text)
        case Loose(text):
            written = working(text)
        case _ as never:
            assert_never(never)
    if len(text) > _LONG_FORMULA:
        written = (
            rf"\parbox{{0.85\linewidth}}{{\raggedright $\displaystyle {written}$}}"
        )
    if not label:
        return f"\\[\n{written}\n\\]"
    return (
        f"\\begin{{equation}}\\label{{{_label(label)}}}\n{written}\n\\end{{equation}}"
    )


def _matrix(name: str, rows: tuple[tuple[str, ...], ...], label: str) -> str:
    body = r" \\ ".join(" & ".join(in_latex(cell) for cell in row) for row in rows)
    written = f"{working(name)} = \\begin{{bmatrix}} {body} \\end{{bmatrix}}"
    if not label:
        return f"\\[\n{written}\n\\]"
    return (
        f"\\begin{{equation}}\\label{{{_label(label)}}}\n{written}\n\\end{{equation}}"
    )


def _listing(items: tuple[Condition, ...], setting: _Setting) -> str:
    lines = []
    for item in items:
        parts = (item.where, item.value, item.meaning, item.why, *item.details)
        body = "; ".join(_inline(part, setting) for part in parts if part)
        lines.append(rf"\item[{{{escape(item.number)}}}] {body}")
    return "\\begin{itemize}\n" + "\n".join(lines) + "\n\\end{itemize}"


def _table(table: Table, setting: _Setting) -> str:
    widths = _widths(table, _LINE_ALONE if setting.alone else _LINE)
    letters = {"left": "l", "right": "r", "centre": "c"}
    spec = "".join(
        rf"p{{{width:.3f}\linewidth}}"
        if column.align == "wrap"
        else letters[column.align]
        for column, width in zip(table.columns, widths, strict=True)
    )
    head = " & ".join(_inline(column.head, setting) for column in table.columns)
    headed = any(column.head for column in table.columns)
    rows = [
        _row(row, table.columns, setting, _anchor(table, index, setting))
        for index, row in enumerate(table.rows)
    ]
    head_lines = [head + r" \\", r"\midrule"] if headed else []
    caption = _inline(table.caption, setting)
    label = rf"\label{{{_label(table.label)}}}" if table.label else ""
    if table.long:
        return _long_table(spec, caption + label, head_lines, rows, len(widths))
    lines = [
        r"\begin{table}[!htbp]",
        r"\centering",
        rf"\caption{{{caption}}}{label}" if caption else "",
        r"\small\renewcommand{\arraystretch}{1.25}",
        rf"\begin{{tabular}}{{@{{}}{spec}@{{}}}}",
        r"\toprule",
        *head_lines,
        *rows,
        r"\bottomrule",
        r"\end{tabular}",
        r"\end{table}",
    ]
    return "\n".join(filter(None, lines))


def _long_table(
    spec: str, caption: str, head: list[str], rows: list[str], columns: int
) -> str:
    lines = [
        r"{\small\renewcommand{\arraystretch}{1.25}",
        rf"\begin{{longtable}}{{@{{}}{spec}@{{}}}}",
        rf"\caption{{{caption}}}\\" if caption else "",
        r"\toprule",
        *head,
        r"\endfirsthead",
        r"\toprule",
        *head,
        r"\endhead",
        r"\midrule",
        rf"\multicolumn{{{columns}}}{{r@{{}}}}{{continued}}\\",
        r"\endfoot",
        r"\bottomrule",
        r"\endlastfoot",
        *rows,
        r"\end{longtable}}",
    ]
    return "\n".join(filter(None, lines))


def _anchor(table: Table, index: int, setting: _Setting) -> str:
    if setting.alone or index >= len(table.anchors) or not table.anchors[index]:
        return ""
    return rf"\refstepcounter{{condition}}\label{{{_label(table.anchors[index])}}}"


def _row(
    cells: tuple[Text, ...],
    columns: tuple[Column, ...],
    setting: _Setting,
    anchor: str,
) -> str:
    written = []
    for cell, column in zip(cells, columns, strict=True):
        body = _inline(cell, setting)
        if column.align == "wrap" and body:
            apart = r"\lineskiplimit2pt\lineskip3pt" if r"\frac" in body else ""
            body = rf"\raggedright{apart} {body}"
        elif body.startswith("["):
            body = "{}" + body  # else read as an argument of the row before
        written.append(body)
    return anchor + " & ".join(written) + r" \tabularnewline"


def _widths(table: Table, line: int) -> list[float]:
    """Shares of the line for the wrapping columns, after an estimate of the others."""
    fixed = 0.0
    for index, column in enumerate(table.columns):
        if column.align != "wrap":
            texts = [column.head, *(row[index] for row in table.rows)]
            fixed += max(len(plain.inline(text)) for text in texts) / line
    gaps = 2.5 / line * (len(table.columns) - 1)
    left = max(0.985 - gaps - fixed, 0.3)
    shares = sum(c.weight for c in table.columns if c.align == "wrap") or 1.0
    return [
        left * column.weight / shares if column.align == "wrap" else 0.0
        for column in table.columns
    ]
