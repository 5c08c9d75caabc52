"""What a file calls a joint stays as it is written, though it looks like a symbol."""

from __future__ import annotations

from dataclasses import replace

from reports import samples

from screwkit.reports import latex
from screwkit.reports.article import article
from screwkit.reports.blocks import Column, Listing, Paragraph, Table, prose
from screwkit.reports.blocks import Condition as Item
from screwkit.reports.bundle import latex_source
from screwkit.reports.given_names import given_names, with_given_names

SENTENCE = "b1 relative to k22 is guided where sin q2 = 0 and r3 = 1, not k2."


def test_names_have_no_subscripts_and_symbols_do() -> None:
    texts = (
        Paragraph(prose(SENTENCE)),
        Table((Column(prose("b1")),), ((prose(SENTENCE),),)),
        Listing((Item("", prose("k22"), why=prose(SENTENCE)),)),
    )
    plain = latex.render(texts)
    assert "$b_{1}$" in plain
    assert "$k_{22}$" in plain
    shown = latex.render(with_given_names(texts, {"b1", "k22"}))
    assert "b_{1}" not in shown
    assert "k_{22}" not in shown
    assert shown.count("b1 relative to k22 is guided") == 3
    assert shown.count(r"where $\sin q_{2}$ = 0 and $r_{3}$ = 1") == 3


def test_a_joint_called_like_a_symbol_is_left_to_it() -> None:
    rows = (
        replace(samples.DESCRIPTION.rows[0], joint="b1", antecedent="k22"),
        replace(samples.DESCRIPTION.rows[1], joint="r3", variable="q2"),
        replace(samples.DESCRIPTION.rows[2], joint="q2"),
    )
    values = (("r3", "0.105", ""),)
    named = replace(samples.DESCRIPTION, rows=rows, values=values, limbs=())
    assert given_names(named) == {"b1", "k22"}


def test_reports_write_names_as_the_file_does() -> None:
    rows = tuple(replace(row, joint="k22") for row in samples.DESCRIPTION.rows[:1])
    description = replace(samples.DESCRIPTION, rows=rows)
    claim = replace(samples.ANALYSIS.claims[0], source="Fig. 2 turns k22 by r3")
    analysis = replace(samples.ANALYSIS, description=description, claims=(claim,))
    source = latex_source(article(analysis))
    assert r"turns k22 by $r_{3}$" in source
