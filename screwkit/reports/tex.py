r"""Words and workings in TeX, with nothing in them that TeX would obey.

Every text that comes from a file passes `escape`: the ten specials are spelt out, the
Unicode letters and signs of this package are mapped to mathematics, and what pdfTeX
could not print is named by its code point.
"""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache
from typing import Final

from screwkit.reports.names import GREEK_TO_NAME, latex_name

_SPECIALS: Final = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "%": r"\%",
    "#": r"\#",
    "_": r"\_",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    # Ligatures and shorthands that would change what is read.
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"{\char34}",
    "`": r"\textasciigrave{}",
    "\n": " ",
    "\t": " ",
    "\r": " ",
}
_SIGNS: Final = {
    "−": "-",
    "±": r"\pm ",
    "∓": r"\mp ",
    "·": r"\cdot ",
    "×": r"\times ",
    "÷": r"\div ",
    "∩": r"\cap ",
    "∪": r"\cup ",
    "⊕": r"\oplus ",
    "∈": r"\in ",
    "∞": r"\infty ",
    "∧": r"\wedge ",
    "≤": r"\leq ",
    "≥": r"\geq ",
    "≠": r"\neq ",
    "≈": r"\approx ",
    "≡": r"\equiv ",
    "⊥": r"\perp ",
    "⟂": r"\perp ",
    "∥": r"\parallel ",
    "→": r"\rightarrow ",
    "←": r"\leftarrow ",
    "⇒": r"\Rightarrow ",
    "⇔": r"\Leftrightarrow ",
    "∘": r"\circ ",
    "°": r"^{\circ}",
    "√": r"\surd ",
    "∑": r"\sum ",
    "ϕ": r"\varphi ",
    "ẋ": r"\dot{x}",
    "′": "'",
    "⁻": "^{-}",
    "₋": "_{-}",
}
_TYPOGRAPHY: Final = {
    "–": "--",
    "—": "---",
    "…": r"\ldots{}",
    "’": r"\textquoteright{}",
    "‘": r"\textquoteleft{}",
    "“": r"\textquotedblleft{}",
    "”": r"\textquotedblright{}",
    "«": r"\ensuremath{\ll}",
    "»": r"\ensuremath{\gg}",
    "\u00a0": "~",
    "\u202f": r"\,",
    "\u2009": r"\,",
    "\u00ad": r"\-",
    "ß": r"\ss{}",
    "æ": r"\ae{}",
    "Æ": r"\AE{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
    "ı": r"\i{}",
}
_ACCENTS: Final = {
    "\u0300": "`",
    "\u0301": "'",
    "\u0302": "^",
    "\u0303": "~",
    "\u0308": '"',
    "\u030c": "v",
    "\u030a": "r",
    "\u0327": "c",
    "\u0304": "=",
    "\u0306": "u",
    "\u0307": ".",
    "\u030b": "H",
}
_OPERATORS: Final = frozenset({"rank", "dim", "det", "ker", "max", "min", "span"})
_TOKEN = re.compile(r"[^\W\d_]+\d*(?:_[A-Za-z0-9]+)*|\d+(?:\.\d+)?|\s+|.", re.DOTALL)


@lru_cache(maxsize=4096)
def escape(text: str) -> str:
    r"""Text for TeX's running text.

    >>> print(escape(r"50% of \input{a_b}"))
    50\% of \textbackslash{}input\{a\_b\}
    """
    # Two hyphens, as of an option, are no dash.
    parts = ("".join(map(_character, part)) for part in text.split("--"))
    return "-{}-".join(parts)


def _character(character: str) -> str:
    """One character for running text."""
    if character in _SPECIALS:
        return _SPECIALS[character]
    if " " <= character <= "~":
        return character
    if character in _TYPOGRAPHY:
        return _TYPOGRAPHY[character]
    sign = _sign(character)
    if sign is not None:
        return rf"\ensuremath{{{sign}}}"
    base, *marks = list(unicodedata.normalize("NFD", character))
    if len(marks) == 1 and marks[0] in _ACCENTS and base.isascii() and base.isalpha():
        base = {"i": r"\i{}", "j": r"\j{}"}.get(base, base)
        return rf"\{_ACCENTS[marks[0]]}{{{base}}}"
    if unicodedata.category(character).startswith("C"):
        return ""
    return f"[U+{ord(character):04X}]"


def _sign(character: str) -> str | None:
    """A mathematical character in TeX's mathematics; None for any other."""
    if character in _SIGNS:
        return _SIGNS[character]
    if character in GREEK_TO_NAME:
        return f"\\{GREEK_TO_NAME[character]} "
    plain = unicodedata.normalize("NFKC", character)
    if plain.isascii() and plain.isalnum() and plain != character:
        name = unicodedata.name(character, "")
        if "SUPERSCRIPT" in name or "MODIFIER LETTER" in name:
            return f"^{{{plain}}}"
        if "SUBSCRIPT" in name:
            return f"_{{{plain}}}"
        return plain
    return None


_LETTER = re.compile(
    r"(?<![\w.*^-])(?:(sin|cos|tan)([²³]?) )?"
    r"([A-Za-z]|[αβγδεθφψω])(\d{1,3})(?![\w.*^-])"
)


@lru_cache(maxsize=4096)
def prose(text: str) -> str:
    r"""A sentence for TeX's running text, its names such as ``q4`` with subscripts.

    >>> print(prose("sin q4 = 0 on axis 3"))
    $\sin q_{4}$ = 0 on axis 3
    """
    written: list[str] = []
    at = 0
    for match in _LETTER.finditer(text):
        function, power, letter, digits = match.groups()
        head = f"\\{function}" if function else ""
        head += {"²": "^{2}", "³": "^{3}"}.get(power or "", "") + (" " if head else "")
        stem = f"\\{GREEK_TO_NAME[letter]}" if letter in GREEK_TO_NAME else letter
        written.append(escape(text[at : match.start()]))
        written.append(f"${head}{stem}_{{{digits}}}$")
        at = match.end()
    written.append(escape(text[at:]))
    return "".join(written)


@lru_cache(maxsize=1024)
def working(text: str) -> str:
    r"""A working such as ``10 − rank Jc = 10 − 6`` in TeX's mathematics.

    >>> print(working("10 − rank Jc = 10 − 6"))
    10 - \operatorname{rank} J_{c} = 10 - 6
    """
    written: list[str] = []
    sentence: list[str] = []

    def close() -> None:
        if sentence:
            written.append(rf"\text{{ {escape(' '.join(sentence))} }}")
            sentence.clear()

    for token in _TOKEN.findall(text):
        if token.isspace():
            continue
        if _is_word(token):
            sentence.append(token)
            continue
        close()
        written.append(_symbol(token))
    close()
    return " ".join(written)


def _is_word(token: str) -> bool:
    letters = token.rstrip("0123456789")
    return (
        letters.isalpha()
        and len(letters) > 1
        and token not in _OPERATORS
        and not re.fullmatch(r"[A-Z][a-z]", token)
        and token not in GREEK_TO_NAME.values()
    )


def _symbol(token: str) -> str:
    if token in _OPERATORS:
        return rf"\operatorname{{{token}}}"
    if re.fullmatch(r"[A-Z][a-z]", token):
        return f"{token[0]}_{{{token[1]}}}"
    if token.isascii() and token[0].isalpha():
        return latex_name(token)
    if token[0].isdigit() or token in "+-=()[]/,.:;|!":
        return token
    if token in "<>":
        return token
    if token == "*":
        return r"\cdot "
    sign = _sign(token) if len(token) == 1 else None
    return sign if sign is not None else rf"\text{{{escape(token)}}}"
