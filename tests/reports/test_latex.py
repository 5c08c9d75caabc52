"""The article: safe, self-consistent, and set by TeX without a complaint."""

from __future__ import annotations

import os
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from reports import samples

from screwkit.errors import MissingToolError
from screwkit.reports import latex, typeset
from screwkit.reports.article import article
from screwkit.reports.article_schemes import schemes_table
from screwkit.reports.bundle import latex_source, write_html, write_pdf
from screwkit.results.analysis import Analysis

HOSTILE = r"\input{/etc/passwd} $^%&_#{}~\ \end{document} <b>&amp;"

needs_tex = pytest.mark.skipif(
    shutil.which("pdflatex") is None, reason="TeX is not installed"
)


def hostile() -> Analysis:
    """The sample with hostile text wherever a file can put any."""
    description = replace(
        samples.DESCRIPTION,
        title=HOSTILE,
        source=HOSTILE,
        units=HOSTILE,
        base=HOSTILE,
        rows=tuple(
            replace(row, joint=HOSTILE, antecedent="[x]")
            for row in samples.DESCRIPTION.rows[:2]
        ),
        limbs=((HOSTILE, (HOSTILE,)),),
    )
    return replace(
        samples.ANALYSIS, case=HOSTILE, title=HOSTILE, description=description
    )


def test_labels_and_references_agree() -> None:
    source = latex_source(article(samples.ANALYSIS))
    labels = re.findall(r"\\label\{([^}]*)\}", source)
    assert len(labels) == len(set(labels))
    assert set(re.findall(r"\\ref\{([^}]*)\}", source)) <= set(labels)
    cited = set(re.findall(r"\\cite(?:\[[^]]*\])?\{([^}]*)\}", source))
    assert cited
    assert cited <= set(re.findall(r"\\bibitem\{([^}]*)\}", source))


def test_only_small_packages_and_ascii() -> None:
    source = latex_source(article(samples.ANALYSIS))
    assert source.isascii()
    used = re.findall(r"\\usepackage(?:\[[^]]*\])?\{([^}]*)\}", source)
    allowed = {"amsmath", "amssymb", "booktabs", "longtable"}
    allowed |= {"geometry", "graphicx", "hyperref"}
    assert {name for group in used for name in group.split(",")} <= allowed


def test_the_tables_say_what_the_paper_says() -> None:
    source = latex_source(article(samples.ANALYSIS))
    assert r"3 & 2 & 0 & $0$ & $0$ & $\frac{\pi}{2}$ & $-d_{3}$ & $q_{3}$" in source
    assert r"\operatorname{atan}\frac{-r_{3}}{d_{3}}" in source
    assert r"\sin q_{4} = 0" in source
    assert "60 terms" in source
    assert r"\cos q_{59}" not in source


def test_hostile_text_is_only_text() -> None:
    source = latex_source(article(hostile()))
    assert "\\input{" not in source
    assert source.count(r"\end{document}") == 1
    assert r"\textbackslash{}input\{/etc/passwd\}" in source


def test_undecided_parts_are_sections() -> None:
    analysis = replace(
        samples.ANALYSIS,
        mobility=samples.REFUSED,
        screws=samples.REFUSED,
        singularities=samples.REFUSED,
        schemes=samples.REFUSED,
        manipulability=samples.REFUSED,
        claims=(),
    )
    source = latex_source(article(analysis))
    assert source.count(r"\textbf{Undecided}") == 5


def test_a_fragment_stands_alone() -> None:
    text = latex.fragment(schemes_table(samples.SCHEMES, shown=None))
    assert text.startswith("% needs \\usepackage{")
    assert r"\ref" not in text
    assert r"\begin{longtable}" in text


@needs_tex
def test_tex_sets_the_article_without_overfull_boxes() -> None:
    pdf, log = typeset.typeset(latex_source(article(samples.ANALYSIS)))
    assert pdf.startswith(b"%PDF")
    assert "Overfull" not in log
    assert "undefined" not in log


@needs_tex
def test_tex_sets_hostile_titles_and_fragments() -> None:
    written = article(hostile())
    tables = "".join(latex.fragment(table) for table in written.tables)
    source = latex_source(written).replace(r"\end{document}", "")
    pdf, log = typeset.typeset(source + tables + r"\end{document}")
    assert pdf.startswith(b"%PDF")
    assert "/etc/passwd" not in log


@needs_tex
def test_tex_cannot_read_outside_its_folder() -> None:
    body = r"\documentclass{article}\begin{document}\input{/etc/hostname}\end{document}"
    with pytest.raises(typeset.TypesettingError, match="line 1"):
        typeset.typeset(body)


@needs_tex
def test_endless_tex_is_stopped_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    endless = r"\documentclass{article}\begin{document}\def\x{\x}\x\end{document}"
    with pytest.raises(typeset.TypesettingError, match=r"longer than 1\.5 s"):
        typeset.typeset(endless, seconds=1.5)
    assert not list(tmp_path.iterdir())


def test_without_tex_the_source_is_written_and_the_cure_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", os.devnull)
    with pytest.raises(
        MissingToolError, match=r"^wrote .*/report\.tex, .* apt-get inst"
    ):
        write_pdf(samples.ANALYSIS, tmp_path / "report.pdf")
    assert (tmp_path / "report.tex").exists()
    assert not (tmp_path / "report.pdf").exists()
    with pytest.raises(MissingToolError, match="pdflatex is not installed"):
        typeset.typeset("")


def test_a_page_escapes_everything(tmp_path: Path) -> None:
    write_html(hostile(), tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "<b>" not in page
    assert "&lt;b&gt;&amp;amp;" in page
    assert "<script" not in page
    assert "http://" not in page
