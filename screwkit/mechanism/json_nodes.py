"""JSON as the same tree: numbers stay text, repeated keys are refused.

`json` itself decides what is JSON; a second, simple pass over the accepted text then
finds the places.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from json.decoder import scanstring  # type: ignore[attr-defined]

from screwkit.mechanism.nodes import (
    Entry,
    Faults,
    Mapping,
    Node,
    Place,
    Scalar,
    Sequence,
    unique_entries,
    whole,
)
from screwkit.mechanism.yaml_nodes import DEEPEST, TooDeepError

_PIECE = re.compile(
    r"""[ \t\r\n]*
        (?: (?P<text>"[^"\\]*(?:\\.[^"\\]*)*")
          | (?P<bracket>[\[\]{}])
          | (?P<bare>[-+.0-9A-Za-z]+) )
        [ \t\r\n]*[,:]?""",
    re.VERBOSE,
)
"""A value, a key or a bracket, with the comma or colon behind it."""


def json_tree(text: str, faults: Faults) -> Node | None:
    """Read JSON; what is wrong goes to ``faults``.

    Returns:
        The tree, or None where the text is no JSON at all.
    """
    try:
        # Numbers as text: a float would lose that 0.1 is 1/10, and the length of an
        # integer is for the expression grammar to judge.
        json.loads(text, parse_int=str, parse_float=str, parse_constant=str)
    except json.JSONDecodeError as error:
        place = Place(error.lineno, error.colno)
        faults.add(place, f"not readable as JSON: {error.msg}")
        return None
    except RecursionError:
        pass  # deeper than what is read here, which tells the place
    try:
        return _Reader(text, faults).root()
    except TooDeepError as error:
        faults.add(error.place, f"nested deeper than {DEEPEST} levels")
        return None


@dataclass(slots=True)
class _Open:
    """A list or a mapping that is being read."""

    place: Place
    items: list[Node] | None
    entries: list[Entry]
    key: tuple[str, Place] | None = None


class _Reader:
    """Walks once over text that is known to be JSON."""

    def __init__(self, text: str, faults: Faults) -> None:
        self._text = text
        self._faults = faults
        self._line, self._start, self._last = 1, 0, 0
        self._open: list[_Open] = []

    def root(self) -> Node:
        """The node of the whole text.

        Raises:
            TooDeepError: If the text is nested too deeply.
        """
        for match in _PIECE.finditer(self._text):
            node = self._read(match)
            if node is None:
                continue
            if not self._open:
                return node
            holder = self._open[-1]
            if holder.items is not None:
                holder.items.append(node)
            elif holder.key is not None:
                holder.entries.append(Entry(*holder.key, node))
                holder.key = None
        raise AssertionError("the text is no JSON")

    def _read(self, match: re.Match[str]) -> Node | None:
        """The node that is complete with this piece, if one is."""
        kind = match.lastgroup
        assert kind is not None
        piece = match[kind]
        place = self._place(match.start(kind))
        if piece in {"]", "}"}:
            return self._closed(self._open.pop())
        holder = self._open[-1] if self._open else None
        if holder is not None and holder.items is None and holder.key is None:
            holder.key = (self._string(piece, place), place)
            return None
        if len(self._open) > DEEPEST:
            raise TooDeepError(place)
        if kind == "bracket":
            self._open.append(_Open(place, [] if piece == "[" else None, []))
            return None
        if kind == "text":
            return Scalar(
                self._string(piece, place), place, True, None if "\\" in piece else 1
            )
        if piece == "null":
            self._faults.add(place, "null is not allowed; leave the key out")
            piece = ""
        return Scalar(piece, place)

    def _closed(self, done: _Open) -> Node:
        if done.items is not None:
            return Sequence(tuple(done.items), done.place)
        return Mapping(unique_entries(done.entries, self._faults), done.place)

    def _string(self, piece: str, place: Place) -> str:
        text = str(scanstring(piece, 1, True)[0]) if "\\" in piece else piece[1:-1]
        return whole(text, place, self._faults)

    def _place(self, position: int) -> Place:
        """The place of a position, none of which lies before the last one asked for."""
        passed = self._text.count("\n", self._last, position)
        if passed:
            self._line += passed
            self._start = self._text.rfind("\n", self._last, position) + 1
        self._last = position
        return Place(self._line, position - self._start + 1)
