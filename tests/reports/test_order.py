"""`--order linear`: text, TeX and JSON write (v; ω) and (m; f), and say so."""

from __future__ import annotations

from dataclasses import replace

import pytest
from reports import samples

import screwkit as sk
from screwkit.questions import relative_motion
from screwkit.reports.article import article
from screwkit.reports.latex import render as article_text
from screwkit.reports.verdict import in_linear_order
from screwkit.results.screws import IdentifiedScrew, LimbScrews, PlatformScrews, Screws


def every(answer: Screws) -> list[tuple[IdentifiedScrew, bool]]:
    """All screws, with whether they are wrenches."""
    found: list[tuple[IdentifiedScrew, bool]] = []
    systems: list[LimbScrews | PlatformScrews] = [*answer.limbs, answer.platform]
    for system in systems:
        found += [(twist, False) for twist in system.twists]
        found += [(wrench, True) for wrench in system.wrenches]
    added = (w.screw for w in answer.actuation_wrenches)
    return [*found, *((screw, True) for screw in added if screw is not None)]


@pytest.mark.parametrize("name", ["bennett", "five_bar", "dual_planar_3r", "3rps"])
def test_the_question_and_the_answer_turn_alike(name: str) -> None:
    case = sk.load(name)
    plain, asked = sk.screws(case), sk.screws(case, order="linear")
    assert in_linear_order(plain) == asked
    assert in_linear_order(asked) == asked
    assert asked.to_json()["order"] == "moment-direction"
    for (one, wrench), (other, _) in zip(every(plain), every(asked), strict=True):
        half = len(one.coordinates) // 2
        if len(one.coordinates) == 3:  # (ωz; vx, vy) and (fx, fy; mz)
            half = 2 if wrench else 1
        turned = (*one.coordinates[half:], *one.coordinates[:half])
        assert other.coordinates == turned
        assert replace(other, coordinates=one.coordinates) == one


def test_the_twists_of_any_body_turn_too() -> None:
    case = sk.load("five_bar")
    plain = relative_motion(case, "b2", "base")
    asked = relative_motion(case, "b2", "base", order="linear")
    assert asked.order == "moment-direction"
    for one, other in zip(plain.twists, asked.twists, strict=True):
        assert other.coordinates == (*one.coordinates[3:], *one.coordinates[:3])
    assert "twists (v; ω) and wrenches (m; f)" in str(asked)


def test_text_and_article_say_which_half_is_first() -> None:
    turned = in_linear_order(samples.SCREWS)
    assert "twists (v; ω) and wrenches (m; f)" in str(turned)
    written = article_text(article(replace(samples.ANALYSIS, screws=turned)).blocks)
    spoken = written.replace(r"\ensuremath{\omega }", "ω")
    assert "wrench (m; f) and a twist (v; ω)" in spoken
    assert "(f; m)" not in spoken.partition(r"\section{Assumptions")[2]
