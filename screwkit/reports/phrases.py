"""Small turns of phrase that several sections share: counts, lists, freedoms."""

from __future__ import annotations

from collections.abc import Iterable

from screwkit.reports.blocks import Math, Span, Text, Words


def platform_called(name: str) -> str:
    """The platform by the reader's own name, where that reads as a word.

    >>> platform_called("object"), platform_called("p7"), platform_called("")
    ('the object', 'the platform', 'the platform')
    """
    reads = len(name) > 2 and name.isalpha() and name.islower()
    return f"the {name}" if reads else "the platform"


def signed(number: int | None) -> str:
    """An integer with a true minus sign; a dash for None."""
    return "–" if number is None else str(number).replace("-", "−")


def capital(text: str) -> str:
    """With a capital first letter."""
    return text[:1].upper() + text[1:]


def listed(names: Iterable[str]) -> str:
    """Names of freedoms as they are typed: ``1 2 3 7``."""
    return " ".join(names)


def tuple_of(coordinates: tuple[str, ...], split: int = 0) -> Text:
    """Coordinates in brackets, a semicolon after the first ``split`` of them."""
    spans: list[Span] = [Words("(")]
    for index, coordinate in enumerate(coordinates):
        if index:
            spans.append(Words("; " if index == split else ", "))
        spans.append(Math(coordinate))
    return (*spans, Words(")"))
