"""Expressions on the lines of a terminal: where they break, when they are too long.

Long expressions of more than a few terms are summarised by their number, because
nobody reads two hundred of them on a screen; the JSON has them in full.
"""

from __future__ import annotations

from typing import Final

from screwkit.reports.notation import factor_unicode, in_unicode, term_count
from screwkit.reports.printing import HARD_SPACE, printable
from screwkit.reports.spelling import SUPERSCRIPTS

FEW: Final = 6
_ENDURED: Final = 4
_OPERATORS: Final = "+−·=,;<>"
_SHORT_BRACKET: Final = 48


def _is_long(text: str, terms: int, cap: int) -> bool:
    """Whether nobody would read it: long, and neither of few terms nor one product."""
    if len(text) <= cap:
        return False
    return (terms or term_count(text)) > FEW or len(text) > _ENDURED * cap


def expression(text: str, terms: int, cap: int) -> str:
    """An expression or relation of ``terms`` terms, 0 where that is not known."""
    if not _is_long(text, terms, cap):
        return _unbroken(printable(in_unicode(text)))
    body, zero, _ = text.partition(" = 0")
    number = terms or term_count(body)
    what = f"{number} terms" if number > 1 else "long"
    return f"({what}, see --json){zero}".replace(" ", HARD_SPACE)


def locus(factors: tuple[tuple[str, int, int], ...], cap: int) -> str:
    """A product of powers: (expression, multiplicity, number of terms or 0)."""
    written: list[str] = []
    for text, power, terms in factors:
        if _is_long(text, terms, cap):
            mark = str(power).translate(SUPERSCRIPTS) if power > 1 else ""
            written.append(expression(text, terms, cap) + mark)
        else:
            written.append(printable(factor_unicode(text, power, len(factors) == 1)))
    return " · ".join(map(_unbroken, written))


def _unbroken(text: str) -> str:
    """Spaces made unbreakable but for those after operators outside short brackets."""
    written: list[str] = []
    closing = -1
    for at, character in enumerate(text):
        if character == "(" and at > closing:
            end = _closing(text, at)
            closing = end if end - at < _SHORT_BRACKET else closing
        free = at > closing and at > 0 and text[at - 1] in _OPERATORS
        written.append(HARD_SPACE if character == " " and not free else character)
    return "".join(written)


def _closing(text: str, opening: int) -> int:
    """Where the bracket closes that opens there."""
    depth = 0
    for at in range(opening, len(text)):
        depth += (text[at] == "(") - (text[at] == ")")
        if depth == 0:
            return at
    return len(text)
