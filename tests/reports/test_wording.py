"""Sentences of reports, read aloud: agreement, names said once, coordinates."""

from __future__ import annotations

from dataclasses import replace

import pytest
from reports import samples

import screwkit as sk
from screwkit.algebra.names import limb_called
from screwkit.reports.about_screws import actuation_listing
from screwkit.reports.article_mechanism import mechanism_section
from screwkit.reports.blocks import Math, Paragraph, Prose, Words, prose
from screwkit.reports.latex import inline as in_latex
from screwkit.reports.latex import render as article_text
from screwkit.reports.tex import escape
from screwkit.reports.text import render
from screwkit.results.analysis import Description


def introduction(**changes: object) -> str:
    description: Description = replace(samples.DESCRIPTION, **changes)  # type: ignore[arg-type]
    paragraph = next(
        b for b in mechanism_section(description) if isinstance(b, Paragraph)
    )
    return " ".join(render((paragraph,)).split())


@pytest.mark.parametrize(
    ("limbs", "expected"),
    [
        ((("limb_1", ("A",)),), "Its limb is limb 1 with joint A."),
        (
            (("limb_1", ("A", "B")), ("right", ("C",))),
            "Its limbs are limb 1 with joints A, B; limb right with joint C.",
        ),
    ],
)
def test_one_limb_is_and_two_limbs_are(
    limbs: tuple[tuple[str, tuple[str, ...]], ...], expected: str
) -> None:
    assert expected in introduction(limbs=limbs)


@pytest.mark.parametrize(
    ("base", "platform", "expected"),
    [
        ("base", "platform", "one is the base, another the platform"),
        ("torso", "object", "torso is the base, object the platform"),
        ("frame", "platform", "frame is the base, one the platform"),
        ("L", "L", "L is both base and platform"),
    ],
)
def test_base_and_platform_are_named_once(
    base: str, platform: str, expected: str
) -> None:
    assert f"; {expected}." in introduction(base=base, platform=platform)


def test_no_limb_is_called_limb_twice() -> None:
    for name in ("limb_1", "limb2", "Limb3", "right"):
        assert limb_called(name).lower().count("limb") == 1
    text = str(sk.screws(sk.load("3rps"))).lower()
    assert "limb limb" not in text


def test_coordinates_in_sentences_are_mathematics() -> None:
    spans = prose("about the line through [-1/2, sqrt(3)/2, a] along it")
    assert [s.text for s in spans if isinstance(s, Math)] == ["-1/2", "sqrt(3)/2", "a"]
    assert r"\sqrt{3}" in in_latex(spans)
    assert "sqrt" not in render((Paragraph(spans),))


@pytest.mark.parametrize("name", ["a*b", "a - b", "q_1 x", "bar^2", "S*q2", "x1^y2"])
def test_names_in_sentences_stay_as_they_are_written(name: str) -> None:
    """A joint may be called anything: what looks like a formula in it is none."""
    spans = prose(f"a rotation about [1, 0, 0] at joint {name}")
    assert render((Paragraph(spans),)).rstrip().endswith(f"at joint {name}")
    assert in_latex(spans).endswith(f"at joint {escape(name)}")


def test_brackets_that_hold_no_vector_stay_as_they_are() -> None:
    assert prose("[a function of a, b]") == (Prose("[a function of a, b]"),)
    assert prose("see [1, (5") == (Prose("see [1, (5"),)


def test_pitches_are_numbers_like_coordinates() -> None:
    assert prose("a wrench of pitch -2 carried")[1] == Math("-2")
    assert prose("of pitch sqrt(3)/2")[1] == Math("sqrt(3)/2")
    assert prose("of equal pitch of all") == (Prose("of equal pitch of all"),)
    assert prose("-2 is left") == (Prose("-2 is left"),)


def test_coordinates_are_not_parted_by_the_end_of_a_line() -> None:
    words = "the platform of the mechanism rotates about the line through "
    for pad in range(20):
        text = render((Paragraph((*prose(words + "x" * pad + " [10, 0, 3] twice"),)),))
        assert "[10, 0, 3]" in text


def test_an_option_keeps_its_two_hyphens_in_tex() -> None:
    assert escape("give a length with --length") == "give a length with -{}-length"
    assert escape("1–2") == "1--2"
    assert "-{}-length" in article_text((Paragraph((Words("with --length"),)),))


def test_idle_freedoms_in_a_row_take_one_line() -> None:
    """Each limb of the Delta robot with ball joints has twelve of them."""
    answer = sk.screws(sk.load("delta_ss"))
    idle = [w for w in answer.actuation_wrenches if w.screw is None]
    assert len(idle) == 36
    listing = actuation_listing(answer.actuation_wrenches, answer.order)
    assert len(listing.items) == len(answer.actuation_wrenches) - 36 + 3
    assert "Sa1p:0 … Sb1m:2" in {item.number for item in listing.items}
