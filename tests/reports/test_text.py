"""Answers in the terminal: the facts are there, aligned, within the width."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import pytest
from reports import samples

from screwkit.reports.blocks import (
    Bibliography,
    Block,
    Citation,
    Column,
    Condition,
    Entry,
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
    Strong,
    Table,
    Words,
    math,
    words,
)
from screwkit.reports.printing import for_terminal, printable, strong
from screwkit.reports.sections import CaseEntry, CaseList, answer_blocks
from screwkit.reports.text import Page, inline, render
from screwkit.results.singularities import Component
from screwkit.results.solution import Solution

EVERY = [
    samples.MOBILITY,
    samples.SCREWS,
    samples.SINGULARITIES,
    samples.SCHEMES,
    samples.ANALYSIS,
    samples.REFUSED,
]


def shown(result: Any, **page: Any) -> str:
    return render(answer_blocks(result), Page(**page))


@pytest.mark.parametrize("result", EVERY, ids=lambda r: type(r).__name__)
def test_lines_fit_and_carry_no_control_characters(result: Any) -> None:
    for line in shown(result).splitlines():
        assert len(line) <= 100
        assert line == line.rstrip()
        assert line.isprintable()


def test_mobility_answers_first() -> None:
    lines = shown(samples.MOBILITY).splitlines()
    assert lines[0].split("  ")[0] == samples.TITLE
    assert lines[0].endswith("nao_t14")
    assert lines[3] == "  the object has 4 freedoms: 1T3R, in general"
    text = "\n".join(lines)
    assert "Moroskine         10 − rank Jc = 10 − 6" in text
    assert "q6 = q1 (mod π)                           1T3R   they meet" in text
    assert "2T2R   they are parallel" in text


def test_singularities_are_numbered_through_and_refer_to_each_other() -> None:
    text = shown(samples.SINGULARITIES)
    assert "1  q4 = 0, π                  rank 4   axes 3 and 5 are one line" in text
    assert "r3 cos q2 + d3 sin q2 = 0" in text
    assert "1 and 2 with cos q3 = 0:  rank 3" in text
    assert "5  2 and 4" in text
    assert "7  4 with q4 = 0, π; q3 = ±π/2" in text
    assert "11  q2 = atan(−r3/d3) (mod π)" in text
    assert "see 2" in text
    assert "undecided whether this is all" in text
    assert "idle only (the object stays fixed): q9 = 0, π" in text


def test_parts_of_an_unfinished_answer_can_be_shown() -> None:
    answer = samples.SINGULARITIES
    assert answer.actuation is not None
    assert "2  q2 = atan(−r3/d3) (mod π)" in shown(answer.limb[0])
    assert "q9 = 0, π; q8 = ±π/2" in shown(answer.constraint)
    assert "B in the plane of axes 4 and 5" in shown(answer.actuation)


def test_schemes_give_counts_reasons_and_products() -> None:
    text = shown(samples.SCHEMES)
    assert "210 ways to actuate 4 freedoms: 139 admissible; of the 100" in text
    assert "cos(q6 − q1) · sin q4 · (r3 cos q2 + d3 sin q2)²" in text
    assert "(60 terms, see --json)" in " ".join(text.split())
    assert "q59" not in text


def test_an_inadmissible_declaration_says_why() -> None:
    actuation = samples.SINGULARITIES.actuation
    assert actuation is not None
    refused = replace(
        actuation, admissible=False, components=(), witness="all forces meet A B"
    )
    text = shown(replace(samples.SINGULARITIES, actuation=refused))
    assert "not admissible, it always can: all forces meet A B" in text


def test_special_values_are_pointed_out() -> None:
    values = samples.MOBILITY.at_values
    assert values is not None
    special = replace(values, differences=("loop rank 5, not 6: axes 3 and 5 meet",))
    text = shown(replace(samples.MOBILITY, at_values=special))
    assert "at the values of the file: loop rank 5, not 6" in text


def test_undecided_says_why() -> None:
    assert shown(samples.REFUSED).startswith("  undecided: expanding 6 wrenches")


def test_bold_is_only_on_request() -> None:
    assert "\x1b" not in shown(samples.MOBILITY)
    assert "\x1b[1m1T3R" in shown(samples.MOBILITY, bold=True)


def test_the_list_of_cases_is_a_table() -> None:
    entry = CaseEntry("bennett", "Bennett linkage", "Bennett 1903", 4, 1)
    head, row = shown(CaseList((entry,))).splitlines()
    assert head.split() == ["case", "joints", "loops", "title", "source"]
    assert row.split()[:3] == ["bennett", "4", "1"]


def many(number: int) -> Any:
    """The sample with a long list of constraint singularities, the deepest first."""
    components = tuple(
        Component(
            ("sin(q4)", f"cos(q{k} - q1)", f"r3*cos(q{k}) + d3*sin(q{k}) - r1"),
            5 - k * 3 // number,
            (),
            5,
            "the common point of axes 3, 4 and 5 lies in the plane of axes 6 and 7",
            platform_freedom=3,
            mobility=5,
            solved=(
                Solution("q4", ("0", "pi"), "pi"),
                Solution(f"q{k}", ("q1 + pi/2", "q1 - pi/2"), "pi"),
                Solution(f"q{k}", (f"2*atan2(r1*d3*cos(q{k}), r3*sin(q{k}))",), "2*pi"),
            ),
        )
        for k in range(number)
    )
    answer = samples.SINGULARITIES
    return replace(answer, constraint=replace(answer.constraint, components=components))


def test_long_lists_show_the_simplest_and_count_the_others() -> None:
    text = shown(many(30))
    assert "… 18 more, of codimension 4 and 5 (--all, --json)" in text
    section = text.partition("CONSTRAINT")[2].partition("ACTUATION")[0]
    numbers = [int(n) for n in re.findall(r"^ +(\d+)  4?", section, re.MULTILINE)]
    assert numbers == sorted(numbers)
    full = render(answer_blocks(many(30), every=True))
    assert "more, of codimension" not in full
    assert full.count("object 3 freedoms") - text.count("object 3 freedoms") == 18


def test_conditions_never_break_inside_a_value() -> None:
    for width in (80, 100):
        text = shown(many(12), width=width)
        for k in range(12):
            assert f"q{k} = 2 atan2(r1 d3 cos q{k}, r3 sin q{k}) (mod 2π)" in text
            assert f"q{k} = q1 + π/2 (mod π)" in text
        assert max(map(len, text.splitlines())) <= max(width, 100)


def test_short_polynomials_are_shown_in_full_and_long_ones_counted() -> None:
    term = "upper_arm*lower_arm*cos(q1 + q2)*sin(q3 + q4)*cos(q5 + q6)"
    short, long = " + ".join([term] * 5), " + ".join([term] * 9)
    assert "terms" not in inline(math(f"{short} = 0"))
    assert inline(math(f"{long} = 0")) == "(9 terms, see --json) = 0"


def test_a_screw_is_said_in_words_without_its_kind_twice() -> None:
    wrench = replace(
        samples.SCREWS.platform.wrenches[0], description="force along axis 1"
    )
    platform = replace(samples.SCREWS.platform, wrenches=(wrench,))
    text = shown(replace(samples.SCREWS, platform=platform))
    assert "force  along axis 1" in text
    assert "force along" not in text


EVIL = "a\x1b[31m\r\u202eb\ufdd0\x07"


E = words(EVIL)


@pytest.mark.parametrize(
    "block",
    [
        Heading((Words(EVIL), Strong(EVIL)), 1, E),
        Paragraph((Prose(EVIL), Loose(EVIL), Reference("x", EVIL), Citation(EVIL))),
        Paragraph((Citation("x", EVIL), Math(EVIL), Loci(((EVIL, 2, 0),)))),
        Formula(Loose(EVIL)),
        Matrix(EVIL, ((EVIL, "0"),)),
        Table((Column(E),), ((E,),), E),
        Listing((Condition(EVIL, E, E, E, (E,), E),)),
        Figure((), E, EVIL),
        Bibliography((Entry(EVIL, EVIL),)),
    ],
    ids=lambda block: type(block).__name__,
)
@pytest.mark.parametrize("bold", [False, True])
def test_no_block_lets_text_command_the_terminal(block: Block, bold: bool) -> None:
    text = render([block], Page(bold=bold))
    assert "b" in text
    if bold:
        text = text.replace("\x1b[1m", "").replace("\x1b[0m", "")
    assert all(character.isprintable() for character in text.replace("\n", ""))


def test_what_a_renderer_forgets_is_stopped_at_the_end() -> None:
    assert for_terminal(f"{EVIL}\n") == "a [31m  b\x1b[1m \n"
    assert for_terminal(strong(printable(EVIL))) == "\x1b[1ma [31m  b  \x1b[0m"
