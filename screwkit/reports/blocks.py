"""What a report is made of: a closed union of frozen plain data.

`sections` and `article` make blocks, `text`, `latex` and `page` render them with one
`match` each.  A block knows neither the width of a terminal nor TeX; mathematics stays
text of the expression grammar until a renderer writes it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal, TypeAlias

from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.errors import ExpressionError
from screwkit.reports.panels import Panel


@dataclass(frozen=True, slots=True)
class Words:
    """Plain text; renderers escape it."""

    text: str


@dataclass(frozen=True, slots=True)
class Prose:
    """A sentence of an answer, in which ``q4`` or ``O1`` stand for themselves."""

    text: str


@dataclass(frozen=True, slots=True)
class Strong:
    """Text that carries the answer."""

    text: str


@dataclass(frozen=True, slots=True)
class Math:
    """An expression, a relation or a list of them, as text of the grammar.

    Attributes:
        terms: Number of terms where it is known; 0 where it is not.
    """

    text: str
    terms: int = 0


@dataclass(frozen=True, slots=True)
class Loci:
    """A product of powers of expressions: how a singular locus is written.

    Attributes:
        factors: (expression, multiplicity, number of terms or 0).
    """

    factors: tuple[tuple[str, int, int], ...]


@dataclass(frozen=True, slots=True)
class Loose:
    """A working that mixes numbers, letters and words: ``10 − rank Jc = 10 − 6``."""

    text: str


@dataclass(frozen=True, slots=True)
class Reference:
    """The number of a labelled block or condition.

    Attributes:
        number: What a renderer without cross-references prints.
    """

    label: str
    number: str


@dataclass(frozen=True, slots=True)
class Citation:
    """A pointer to an entry of `Bibliography`; ``place`` is an equation or table."""

    key: str
    place: str = ""


Span: TypeAlias = Words | Prose | Strong | Math | Loci | Loose | Reference | Citation
Text: TypeAlias = tuple[Span, ...]


@dataclass(frozen=True, slots=True)
class Heading:
    """A title; level 0 is the document's, 1 a section's, 2 a subsection's.

    Attributes:
        aside: Stands at the right margin of a terminal, in brackets elsewhere.
    """

    text: Text
    level: int = 1
    aside: Text = ()


@dataclass(frozen=True, slots=True)
class Paragraph:
    """Running text; ``indent`` counts steps of two columns in a terminal."""

    text: Text
    indent: int = 0


@dataclass(frozen=True, slots=True)
class Formula:
    """A displayed and, with a label, numbered formula."""

    body: Math | Loose
    label: str = ""


@dataclass(frozen=True, slots=True)
class Matrix:
    """A matrix of expressions with what it is called."""

    name: str
    rows: tuple[tuple[str, ...], ...]
    label: str = ""


@dataclass(frozen=True, slots=True)
class Column:
    """Head and alignment of a column; ``wrap`` columns share the width by weight."""

    head: Text
    align: Literal["left", "right", "centre", "wrap"] = "left"
    weight: float = 1.0


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of cells.

    Attributes:
        anchors: Labels of the rows, where rows can be referred to; may be empty.
        long: May run over pages.
    """

    columns: tuple[Column, ...]
    rows: tuple[tuple[Text, ...], ...]
    caption: Text = ()
    label: str = ""
    anchors: tuple[str, ...] = ()
    long: bool = False
    indent: int = 1


@dataclass(frozen=True, slots=True)
class Condition:
    """One entry of a listing: where, what then, and why.

    Attributes:
        number: As referred to; empty for unnumbered remarks.
        value: A short result, ``rank 4``.
        meaning: What then, in a few words.
        why: A sentence, beside ``meaning`` where there is room.
        details: Further lines, ``r3 cos q2 + d3 sin q2 = 0``.
    """

    number: str
    where: Text
    value: Text = ()
    meaning: Text = ()
    details: tuple[Text, ...] = ()
    why: Text = ()


@dataclass(frozen=True, slots=True)
class Listing:
    """Conditions below each other, their columns aligned."""

    items: tuple[Condition, ...]
    indent: int = 2


@dataclass(frozen=True, slots=True)
class Entry:
    """A reference: key and text."""

    key: str
    text: str


@dataclass(frozen=True, slots=True)
class Bibliography:
    """The references of a document."""

    entries: tuple[Entry, ...]


@dataclass(frozen=True, slots=True)
class Figure:
    """A picture of one or several panels.

    Attributes:
        label: Ends in the name of its file.
    """

    panels: tuple[Panel, ...]
    caption: Text
    label: str

    @property
    def name(self) -> str:
        """Of its file, without ending."""
        return self.label.rpartition(":")[2] or "figure"


Block: TypeAlias = (
    Heading | Paragraph | Formula | Matrix | Table | Listing | Figure | Bibliography
)


def words(text: str) -> Text:
    """Plain text as a `Text`; nothing for the empty string."""
    return (Words(text),) if text else ()


def prose(text: str) -> Text:
    """A sentence of an answer as a `Text`; nothing for the empty string.

    Coordinates in square brackets and pitches are set as mathematics.

    >>> prose("along [0, sqrt(3)/2]")[1:3]
    (Words(text='['), Math(text='0', terms=0))
    >>> prose("pitch -0.25")[1]
    Words(text='−0.25')
    """
    spans: list[Span] = []
    for part in _WRITTEN.split(text):
        spans += _as_mathematics(part) or ((Prose(part),) if part else ())
    return tuple(spans)


_WRITTEN = re.compile(r"(\[[^\[\]]*\]|(?<=\bpitch )-?(?:\d|sqrt)[^\s,;]*)")
_DECIMAL = re.compile(r"-?\d+\.\d+")
_SHORT = 40


def _as_mathematics(part: str) -> Text:
    """``[x, y, z]`` or a number as spans; nothing where it is neither."""
    vector = part.startswith("[")
    if not vector and not _WRITTEN.fullmatch(f"pitch {part}", len("pitch ")):
        return ()
    entries = part[1:-1].split(", ") if vector else [part]
    try:
        for entry in entries:
            parse(entry, limits=RESULT_LIMITS)
    except ExpressionError:
        return ()
    if not vector:
        return (_number(part),)
    space = "\u00a0" if len(part) < _SHORT else " "
    spans: list[Span] = [Words("[")]
    for entry in entries:
        spans += [_number(entry), Words(f",{space}")]
    return (*spans[:-1], Words("]"))


def _number(text: str) -> Span:
    """Exact, and then mathematics; a decimal is rounded and stays as it is."""
    if _DECIMAL.fullmatch(text):
        return Words(text.replace("-", "−"))
    return Math(text)


def math(text: str, terms: int = 0) -> Text:
    """An expression or relation as a `Text`; nothing for the empty string."""
    return (Math(text, terms),) if text else ()


def joined(parts: tuple[Text, ...] | list[Text], separator: str = ", ") -> Text:
    """Texts after each other with plain text between them."""
    spans: list[Span] = []
    for part in parts:
        if not part:
            continue
        if spans:
            spans.append(Words(separator))
        spans.extend(part)
    return tuple(spans)
