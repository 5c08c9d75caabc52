"""A strict reader of YAML: no aliases, anchors, tags or repeated keys.

Every scalar stays text; events of a parser, libyaml's where there is one, become nodes.
An item that YAML cut at a comma inside parentheses (``[atan2(y, x), 0, 0]``) is put
together again and reported with the right spelling: it causes no further faults.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from typing import Any, Final, TypeGuard

import yaml

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

DEEPEST: Final = 50

_FAST: Final[Any] = (
    import_module("yaml.cyaml").CParser if yaml.__with_libyaml__ else None
)
"""libyaml, some ten times as fast; PyYAML's own parser explains what is no YAML."""
_READ_OTHERWISE: Final = re.compile("[\t?!\ufeff]|[|>]#")
"""Where the two parsers differ: tabs, keys after a question mark, tags, stray marks."""


_ANYTHING: Final = "0"
"""Stands for what an alias refers to: an expression, a coordinate and a name."""


class TooDeepError(Exception):
    """Something is nested too deeply to be read; `place` says where."""

    def __init__(self, place: Place) -> None:
        self.place = place
        super().__init__(f"nested deeper than {DEEPEST} levels")


class _UnsureError(Exception):
    """libyaml places an empty value elsewhere than PyYAML, which decides."""


def yaml_tree(text: str, faults: Faults) -> Node | None:
    """Read YAML; what is wrong goes to ``faults``.

    Returns:
        The tree, or None where the text is no YAML at all.
    """
    try:
        if _FAST is not None and not _READ_OTHERWISE.search(text):
            found = Faults()
            with suppress(yaml.YAMLError, UnicodeError, _UnsureError):
                root = _Composer(_FAST(text), found).document()
                faults.found += found.found
                faults.settled |= found.settled
                return root
        return _Composer(yaml.SafeLoader(text), faults).document()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        faults.add(_place(mark) if mark else None, _explained(error))
    except yaml.reader.ReaderError as error:
        before = text[: error.position]
        line = before.count("\n") + 1
        place = Place(line, error.position - (before.rfind("\n") + 1) + 1)
        faults.add(place, "a character that is not printable stands here")
    except TooDeepError as error:
        faults.add(error.place, f"nested deeper than {DEEPEST} levels")
    return None


class _Composer:
    """Makes nodes of events, refusing aliases, anchors and tags as it goes."""

    def __init__(self, parser: Any, faults: Faults) -> None:
        self._next: Callable[[], Any] = parser.get_event
        self._exact = isinstance(parser, yaml.SafeLoader)
        self._faults = faults

    def document(self) -> Node | None:
        """The only document; None where there is none, or another."""
        self._next()
        if isinstance(self._next(), yaml.StreamEndEvent):
            return None
        root = self._node(self._next(), 0)
        self._next()
        event = self._next()
        if isinstance(event, yaml.StreamEndEvent):
            return root
        self._faults.add(
            _place(event.start_mark),
            "a second document starts here; a file holds one mechanism",
        )
        return None

    def _node(self, event: Any, depth: int) -> Node:
        place = _place(event.start_mark)
        if isinstance(event, yaml.AliasEvent):
            self._faults.settle(
                place, f"aliases are not allowed (*{event.anchor}); write it out"
            )
            return Scalar(_ANYTHING, place, inner=None)
        if event.anchor is not None:
            self._faults.add(place, f"anchors are not allowed (&{event.anchor})")
        if event.tag is not None:
            self._faults.settle(
                place, f"tags are not allowed ({event.tag!r}); every scalar is text"
            )
        if depth >= DEEPEST:
            raise TooDeepError(place)
        if isinstance(event, yaml.ScalarEvent):
            return _scalar(event, place, self._faults)
        if isinstance(event, yaml.SequenceStartEvent):
            return self._sequence(event, place, depth)
        return self._mapping(event, place, depth)

    def _sequence(self, start: Any, place: Place, depth: int) -> Sequence:
        items: list[Node] = []
        event = self._next()
        while not isinstance(event, yaml.SequenceEndEvent):
            items.append(self._node(event, depth + 1))
            event = self._next()
        if start.flow_style:
            items = _mended_items(items, self._faults)
        return Sequence(tuple(items), place)

    def _mapping(self, start: Any, place: Place, depth: int) -> Mapping:
        entries: list[Entry] = []
        event = self._next()
        while not isinstance(event, yaml.MappingEndEvent):
            key = self._node(event, depth + 1)
            value = self._node(self._next(), depth + 1)
            if start.flow_style and not self._exact and _is_empty(value):
                raise _UnsureError
            if isinstance(key, Scalar):
                entries.append(Entry(key.text, key.place, value))
            else:
                self._faults.add(key.place, "a key is text, not a list or a mapping")
            event = self._next()
        if start.flow_style:
            entries = _mended_entries(entries, self._faults)
        return Mapping(unique_entries(entries, self._faults), place)


def _explained(error: yaml.MarkedYAMLError) -> str:
    problem = error.problem or "cannot be read"
    if "'\\t'" in problem:
        return "a tab stands where spaces are needed"
    if problem == "mapping values are not allowed here":
        problem += "; a text with a colon and a space in it needs quotes"
    if problem.startswith("expected ',' or") and problem.endswith("got '['"):
        problem += (
            "; coordinates cannot stand in an expression: name the vector, "
            "u: [x, y, z], and write P + u"
        )
    context = f" ({error.context})" if error.context else ""
    return f"not readable as YAML: {problem}{context}"


def _place(mark: Any) -> Place:
    return Place(mark.line + 1, mark.column + 1)


def _scalar(event: Any, place: Place, faults: Faults) -> Scalar:
    text, style = whole(event.value, place, faults), event.style
    end = event.end_mark
    # Plain (no style) or quoted; a block scalar (| or >) is as deliberate as quotes.
    quotes = 1 if style in {"'", '"'} else 0
    runs_together = (
        (quotes or not style)
        and place.line == end.line + 1
        and end.column + 1 - place.column == len(text) + 2 * quotes
    )
    return Scalar(text, place, bool(style), quotes if runs_together else None)


def _opened(node: Node) -> int:
    """How many more parentheses an unquoted scalar opens than it closes."""
    if not isinstance(node, Scalar) or node.quoted:
        return 0
    return node.text.count("(") - node.text.count(")")


def _mended_items(items: list[Node], faults: Faults) -> list[Node]:
    mended: list[Node] = []
    position = 0
    while position < len(items):
        first = items[position]
        balance = _opened(first)
        end = position + 1
        while balance > 0 and end < len(items) and isinstance(items[end], Scalar):
            balance += _opened(items[end])
            end += 1
        if isinstance(first, Scalar) and balance == 0 and end > position + 1:
            texts = [piece.text for piece in items[position:end] if _is_scalar(piece)]
            mended.append(_joined(first, texts, faults))
            position = end
        else:
            mended.append(first)
            position += 1
    return mended


def _mended_entries(entries: list[Entry], faults: Faults) -> list[Entry]:
    """Join ``{at: cross(u, w)}``, which YAML reads as two keys."""
    mended: list[Entry] = []
    position = 0
    while position < len(entries):
        entry = entries[position]
        balance = _opened(entry.value)
        end = position + 1
        while balance > 0 and end < len(entries) and _is_empty(entries[end].value):
            balance += entries[end].key.count("(") - entries[end].key.count(")")
            end += 1
        if isinstance(entry.value, Scalar) and balance == 0 and end > position + 1:
            texts = [entry.value.text, *(e.key for e in entries[position + 1 : end])]
            joined = _joined(entry.value, texts, faults)
            mended.append(Entry(entry.key, entry.key_place, joined))
            position = end
        else:
            mended.append(entry)
            position += 1
    return mended


def _joined(first: Scalar, texts: list[str], faults: Faults) -> Scalar:
    text = ", ".join(texts)
    faults.add(
        first.place,
        f"{texts[0]!r} has an open parenthesis because YAML splits at commas; "
        f'write commas inside quotes: "{text}"',
    )
    return Scalar(text, first.place, quoted=False, inner=None)


def _is_scalar(node: Node) -> TypeGuard[Scalar]:
    return isinstance(node, Scalar)


def _is_empty(node: Node) -> bool:
    return isinstance(node, Scalar) and not node.text and not node.quoted
