"""Mathematics as people write it, in Unicode and in TeX."""

from __future__ import annotations

import pytest

from screwkit.reports.notation import factor_latex, in_latex, in_unicode, term_count
from screwkit.reports.tex import escape, prose, working

EXAMPLES = [
    (
        "r3*cos(q2) + d3*sin(q2)",
        "r3 cos q2 + d3 sin q2",
        r"r_{3}\cos q_{2} + d_{3}\sin q_{2}",
    ),
    ("q6 = q1 (mod pi)", "q6 = q1 (mod π)", None),
    ("q4 = 0, pi", "q4 = 0, π", r"q_{4} = 0,\; \pi"),
    ("q3 = ±pi/2", "q3 = ±π/2", r"q_{3} = \pm \frac{\pi}{2}"),
    (
        "q2 = atan(-r3/d3)",
        "q2 = atan(−r3/d3)",
        r"q_{2} = \operatorname{atan}\frac{-r_{3}}{d_{3}}",
    ),
    ("cos(q2)^2", "cos² q2", r"\cos^{2} q_{2}"),
    ("(a + b)^2", "(a + b)²", "(a + b)^{2}"),
    ("-x*sin(q1)", "−x sin q1", r"-x\sin q_{1}"),
    ("a - (b - c)", None, None),
    ("cos(q2)*r3", "r3 cos q2", r"r_{3}\cos q_{2}"),
    ("sin(q1)*(a + b)", "sin q1 · (a + b)", r"\sin q_{1}\,(a + b)"),
    ("2*atan(d3/r3)", "2 atan(d3/r3)", None),
    ("alpha + phi1", "α + φ1", r"\alpha + \phi_{1}"),
    ("sqrt(a^2 + b)", "√(a² + b)", r"\sqrt{a^{2} + b}"),
    ("d3 > 0", "d3 > 0", "d_{3} > 0"),
    ("q12_3", "q12_3", "q_{12,3}"),
]


@pytest.mark.parametrize(("text", "unicode", "latex"), EXAMPLES)
def test_examples(text: str, unicode: str | None, latex: str | None) -> None:
    assert unicode is None or in_unicode(text) == unicode
    assert latex is None or in_latex(text) == latex
    assert in_latex(text).isascii()


def test_subtracting_a_sum_keeps_its_brackets() -> None:
    assert in_unicode("a - (b - c)") in ("a − (b − c)", "a − b + c")


def test_text_outside_the_grammar_is_shown_escaped() -> None:
    assert in_unicode("A in plane {1,2}") == "A in plane {1, 2}"
    assert r"\input" not in in_latex(r"\input{x}").replace(r"\textbackslash{}", "")


def test_a_factor_of_a_product_has_brackets() -> None:
    assert factor_latex("a + b", 2, False) == "(a + b)^{2}"
    assert factor_latex("a + b", 1, False) == "(a + b)"
    assert factor_latex("a + b", 1, True) == "a + b"


def test_terms_are_counted_at_the_top_only() -> None:
    assert term_count("-a + b*(c - d) - e^-1") == 3


@pytest.mark.parametrize("special", list('\\{}$&%#_^~<>|"`'))
def test_every_special_is_spelt_out(special: str) -> None:
    written = escape(f"a{special}b")
    assert written != f"a{special}b"
    assert written.isascii()


HOSTILE = [
    r"\input{/etc/passwd}",
    r"$^%&_#{}~\ ",
    r"\end{document}\def\x{\x}\x",
    "\\write18{touch x}",
    "q4 \\immediate",
    "名前 ẞ ﷽ \x07 \x1b[31m",
    "^^5cinput",
]


@pytest.mark.parametrize("text", HOSTILE)
def test_no_command_survives(text: str) -> None:
    for write in (escape, prose, working, in_latex):
        written = write(text)
        assert written.isascii()
        for command in ("input", "end", "def", "write", "immediate", "x"):
            assert f"\\{command}{{" not in written.replace("\\textbackslash{}", "")
        assert "^^" not in written


def test_a_working_is_mathematics() -> None:
    text = "10 − (5 + 5) + dim(E_right ∩ E_left)"
    assert working(text) == (
        r"10 - ( 5 + 5 ) + \operatorname{dim} ( E_{\mathrm{right}} "
        r"\cap  E_{\mathrm{left}} )"
    )


def test_names_in_sentences_get_their_subscripts() -> None:
    assert prose("± sin q4 on O1 A") == (r"\ensuremath{\pm } $\sin q_{4}$ on $O_{1}$ A")


def test_a_working_may_use_plain_signs() -> None:
    assert working("6 - dim(W_a + W_b)") == working("6 − dim(W_a + W_b)")
