"""JSON as the same tree: numbers stay text, repeated keys are refused.

`json` itself decides what is JSON; a second, simple pass over the accepted text then
finds the places.
"""

from __future__ import annotations

import json
import re
from bisect import bisect_right
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
)
from screwkit.mechanism.yaml_nodes import DEEPEST

_SPACE = re.compile(r"[ \t\r\n]*")
_BARE = re.compile(r"[-+.0-9A-Za-z]+")


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
        faults.add(None, f"nested deeper than {DEEPEST} levels")
        return None
    reader = _Places(text, faults)
    try:
        return reader.node(reader.skip(0), 0)[0]
    except RecursionError:
        faults.add(None, f"nested deeper than {DEEPEST} levels")
        return None


class _Places:
    """Walks over text that is known to be JSON."""

    def __init__(self, text: str, faults: Faults) -> None:
        self._text = text
        self._faults = faults
        self._starts = [0]
        self._starts += [match.end() for match in re.finditer("\n", text)]

    def skip(self, position: int) -> int:
        """The next position that is not white space."""
        match = _SPACE.match(self._text, position)
        assert match is not None
        return match.end()

    def node(self, position: int, depth: int) -> tuple[Node, int]:
        """The node at ``position`` and where it ends."""
        if depth > DEEPEST:
            raise RecursionError
        place = self._place(position)
        match self._text[position]:
            case "{":
                return self._mapping(position, place, depth)
            case "[":
                return self._sequence(position, place, depth)
            case '"':
                value, end = scanstring(self._text, position + 1, True)
                inner = 1 if end - position == len(value) + 2 else None
                return Scalar(value, place, quoted=True, inner=inner), end
        match = _BARE.match(self._text, position)
        assert match is not None
        value = match.group()
        if value == "null":
            self._faults.add(place, "null is not allowed; leave the key out")
            value = ""
        return Scalar(value, place), match.end()

    def _sequence(self, position: int, place: Place, depth: int) -> tuple[Node, int]:
        items: list[Node] = []
        position = self.skip(position + 1)
        while self._text[position] != "]":
            item, position = self.node(position, depth + 1)
            items.append(item)
            position = self._past_comma(position)
        return Sequence(tuple(items), place), position + 1

    def _mapping(self, position: int, place: Place, depth: int) -> tuple[Node, int]:
        entries: list[Entry] = []
        position = self.skip(position + 1)
        while self._text[position] != "}":
            key_place = self._place(position)
            key, position = scanstring(self._text, position + 1, True)
            position = self.skip(self.skip(position) + 1)
            value, position = self.node(position, depth + 1)
            entries.append(Entry(key, key_place, value))
            position = self._past_comma(position)
        return Mapping(unique_entries(entries, self._faults), place), position + 1

    def _past_comma(self, position: int) -> int:
        position = self.skip(position)
        if self._text[position] == ",":
            position = self.skip(position + 1)
        return position

    def _place(self, position: int) -> Place:
        line = bisect_right(self._starts, position)
        return Place(line, position - self._starts[line - 1] + 1)
