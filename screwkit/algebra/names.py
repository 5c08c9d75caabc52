"""Which names a file may use, and the nearest right one for a wrong one.

Symbols are plain ASCII identifiers of bounded length that do not hide a function of
the grammar.  Python's keywords mean nothing here: ``lambda`` is a good name.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from difflib import get_close_matches
from typing import Final

LONGEST_SYMBOL: Final = 32
SCALAR_FUNCTIONS: Final = {
    "sin": 1,
    "cos": 1,
    "tan": 1,
    "sqrt": 1,
    "asin": 1,
    "acos": 1,
    "atan": 1,
    "atan2": 2,
}
"""Functions of the grammar and how many arguments each takes."""
VECTOR_FUNCTIONS: Final = {"cross": 2, "dot": 2}
RESERVED: Final = frozenset({"pi", *SCALAR_FUNCTIONS, *VECTOR_FUNCTIONS})

_SYMBOL = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def is_symbol(name: str) -> bool:
    """Whether a file may declare ``name`` as a symbol."""
    return why_no_symbol(name) is None


def why_no_symbol(name: str) -> str | None:
    """Why ``name`` cannot be declared as a symbol; None where it can.

    >>> why_no_symbol("lambda")
    >>> why_no_symbol("sin")
    "'sin' is a function or constant of the grammar"
    """
    if name in RESERVED:
        return f"{name!r} is a function or constant of the grammar"
    if not _SYMBOL.fullmatch(name):
        return f"{shown(name)} is no symbol: a letter, then letters, digits and _"
    if len(name) > LONGEST_SYMBOL:
        return f"{shown(name)} is longer than {LONGEST_SYMBOL} characters"
    return None


def shown(text: str, limit: int = 40) -> str:
    """``text`` in quotes, on one line and cut to a readable length."""
    cut = text if len(text) <= limit else text[: limit - 1] + "…"
    return repr(cut)


def counted(number: int, noun: str, plural: str = "") -> str:
    """A number with its noun.

    >>> counted(1, "loop"), counted(3, "loop"), counted(0, "freedom")
    ('1 loop', '3 loops', 'no freedom')
    """
    if number == 0:
        return f"no {noun}"
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


def limb_called(name: str) -> str:
    """A limb in a sentence, whether or not its name says that it is one.

    >>> limb_called("limb_3"), limb_called("limb2"), limb_called("left")
    ('limb 3', 'limb2', 'limb left')
    """
    if name.lower().startswith("limb"):
        return name.replace("_", " ")
    return f"limb {name}"


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """`` (did you mean 'x'?)`` for the nearest known name, or nothing.

    >>> did_you_mean("revolve", ["revolute", "prismatic"])
    " (did you mean 'revolute'?)"
    >>> did_you_mean("xyz", ["revolute"])
    ''
    """
    candidates = sorted({option for option in known if option != name})
    near = get_close_matches(name[:80], candidates, n=1, cutoff=0.5)
    if not near:
        folded = {option.casefold(): option for option in candidates}
        near = [folded[name.casefold()]] if name.casefold() in folded else []
    return f" (did you mean {near[0]!r}?)" if near else ""


_SOME = 12
"""Names up to which a message lists them all."""


def left_or_meant(name: str, known: Collection[str], given: Collection[str]) -> str:
    """Of a name that is not left: that it has its value, or which was meant.

    >>> left_or_meant("a", ["b"], ["a"]), left_or_meant("a", ["ab"], [])
    ("; 'a' has been given a value already", " (did you mean 'ab'?)")
    """
    if name in given:
        return f"; {name!r} has been given a value already"
    return meant_or_all(name, known)


def meant_or_all(name: str, known: Collection[str]) -> str:
    """The nearest known name, or which there are where none is near.

    >>> meant_or_all("anckle", ["ankle", "knee"])
    " (did you mean 'ankle'?)"
    >>> meant_or_all("Z", ["A", "B"]), meant_or_all("Z", ["A"]), meant_or_all("Z", [])
    ('; there are A, B', '; there is only A', '; there is none')
    """
    hint = did_you_mean(name, known)
    if hint or not known:
        return hint or "; there is none"
    if len(known) == 1:
        return f"; there is only {next(iter(known))}"
    more = ", …" if len(known) > _SOME else ""
    return f"; there are {', '.join([*known][:_SOME])}{more}"
