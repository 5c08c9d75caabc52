"""What may reach a terminal: text without characters that a terminal would obey.

Names, titles and messages hold text of files and of arguments.  Whatever is printed
goes through `for_terminal` last, so that no path can be forgotten; emphasis is marked
by characters that text cannot hold and becomes escape sequences only there.
"""

from __future__ import annotations

from typing import Final

HARD_SPACE: Final = "\u00a0"
_BOLD, _PLAIN = "\ufdd0", "\ufdd1"
"""Noncharacters of Unicode, which `printable` takes out of every text."""
_SEQUENCES: Final = {_BOLD: "\x1b[1m", _PLAIN: "\x1b[0m", HARD_SPACE: " ", "\n": "\n"}


def printable(text: str) -> str:
    """Text on one line without control characters; hard spaces stay until the end."""
    return "".join(c if c.isprintable() or c == HARD_SPACE else " " for c in text)


def strong(text: str) -> str:
    """Printable text that `for_terminal` sets in bold."""
    return f"{_BOLD}{text}{_PLAIN}"


def for_terminal(text: str) -> str:
    """Lines as they are printed: nothing in them but the sequences of `strong`."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else _SEQUENCES.get(c, " ") for c in text)
