"""How a declared name is written: digits as subscripts, Greek names as Greek letters.

The terminal keeps names as the reader typed them but for Greek letters (``phi1`` is
``φ1``); TeX gets true subscripts.  Names come from files, so every character of one is
either mapped or escaped.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Final

_GREEK_LOWER: Final = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho "
    "sigma tau upsilon phi chi psi omega"
)
_GREEK_UPPER: Final = "Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega"
_LETTERS: Final = dict(
    zip(
        (_GREEK_LOWER + " " + _GREEK_UPPER).split(),
        "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΥΦΨΩ",
        strict=True,
    )
)
GREEK_TO_NAME: Final = {letter: name for name, letter in _LETTERS.items()}

_NAME = re.compile(r"([A-Za-z]+)(\d*)(.*)", re.DOTALL)


@cache
def unicode_name(name: str) -> str:
    """A name for the terminal.

    >>> unicode_name("r3"), unicode_name("phi1"), unicode_name("q3_1")
    ('r3', 'φ1', 'q3_1')
    """
    match = _NAME.fullmatch(name)
    if match is None or match[1] not in _LETTERS:
        return name
    return _LETTERS[match[1]] + match[2] + match[3]


@cache
def latex_name(name: str) -> str:
    r"""A name in TeX's mathematics.

    >>> print(latex_name("r3"), latex_name("theta12"), latex_name("q3_1"))
    r_{3} \theta_{12} q_{3,1}
    >>> print(latex_name("width"), latex_name("e_right"), latex_name("qA1"))
    \mathit{width} e_{\mathrm{right}} q_{A1}
    """
    head, *tail = name.split("_")
    match = _NAME.fullmatch(head)
    if match is None or not re.fullmatch(r"[A-Za-z0-9]*", match[3]):
        return rf"\mathit{{{_harmless(name)}}}"
    stem, digits, rest = match.groups()
    if re.fullmatch(r"[a-z][A-Z]", stem) and not rest:
        stem, digits = stem[0], stem[1] + digits
    if rest:
        stem, digits = head, ""
    if stem in _LETTERS:
        letter = "\\" + stem
    else:
        letter = stem if len(stem) == 1 else rf"\mathit{{{stem}}}"
    marks = [digits] if digits else []
    for part in tail:
        if part in _LETTERS:
            marks.append("\\" + part)
        elif part.isdecimal() or len(part) == 1:
            marks.append(_harmless(part))
        elif part:
            marks.append(rf"\mathrm{{{_harmless(part)}}}")
    return f"{letter}_{{{','.join(marks)}}}" if marks else letter


def _harmless(text: str) -> str:
    """Letters and digits only; anything else has no place in a name."""
    return re.sub(r"[^A-Za-z0-9]", "", text) or "?"
