"""The text of a file as a tree in which everything knows its place.

Both readers, of YAML and of JSON, make the same three kinds of node; every scalar is
text, so that no ``no`` becomes false and no 0.1 becomes a float.  Places outlive the
validation: a fault found later still names its line and column.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

from screwkit.errors import Fault

Path: TypeAlias = tuple[str | int, ...]


class Place(NamedTuple):
    """Line and column, from 1."""

    line: int
    column: int


class Scalar(NamedTuple):
    """A piece of text.

    Attributes:
        quoted: Whether the file quotes it; a quoted claim stays text.
        inner: Columns from ``place`` to the first character, or None where
            characters and columns do not run together (escapes, several lines).
    """

    text: str
    place: Place
    quoted: bool = False
    inner: int | None = 0


@dataclass(frozen=True, slots=True)
class Sequence:
    """A list."""

    items: tuple[Node, ...]
    place: Place


class Entry(NamedTuple):
    """A key with its value."""

    key: str
    key_place: Place
    value: Node


@dataclass(frozen=True, slots=True)
class Mapping:
    """A mapping; its keys are unique."""

    entries: tuple[Entry, ...]
    place: Place

    def get(self, key: str) -> Node | None:
        """The value under ``key``."""
        return next((e.value for e in self.entries if e.key == key), None)


Node: TypeAlias = Scalar | Sequence | Mapping


@dataclass
class Faults:
    """The faults met so far; the only thing here that changes.

    Attributes:
        settled: Where a node could not be read: what follows from it is no other fault.
    """

    found: list[Fault] = field(default_factory=list)
    settled: set[Place] = field(default_factory=set)

    def add(self, place: Place | None, message: str) -> None:
        """Note a fault at ``place``."""
        if place in self.settled:
            return
        line, column = (place.line, place.column) if place else (0, 0)
        self.found.append(Fault(line, column, message))

    def settle(self, place: Place, message: str) -> None:
        """Note the one fault of a node that could not be read."""
        self.add(place, message)
        self.settled.add(place)

    def sorted(self) -> tuple[Fault, ...]:
        """All faults by place, each once."""
        unique = dict.fromkeys(self.found)
        return tuple(sorted(unique, key=lambda fault: (fault.line, fault.column)))


def whole(text: str, place: Place, faults: Faults) -> str:
    """The text, if it has no half of a character, such as an escape can write."""
    if not text.isascii() and any("\ud800" <= c <= "\udfff" for c in text):
        faults.settle(
            place, "half of a character stands here (a surrogate); write it whole"
        )
        return "0"
    return text


def plain(node: Node) -> Any:
    """The tree as dicts, lists and text, for the models."""
    match node:
        case Scalar(text):
            return text
        case Sequence(items):
            return [plain(item) for item in items]
        case Mapping(entries):
            return {entry.key: plain(entry.value) for entry in entries}


def find(root: Node, path: Path) -> Node | None:
    """The node at ``path``; None where the file has none."""
    node: Node | None = root
    for step in path:
        if isinstance(node, Mapping) and isinstance(step, str):
            node = node.get(step)
        elif isinstance(node, Sequence) and isinstance(step, int):
            node = node.items[step] if step < len(node.items) else None
        else:
            return None
    return node


def place_of(root: Node, path: Path, offset: int | None = None) -> Place:
    """The place of the deepest node on ``path`` that the file has.

    Args:
        root: The whole file.
        path: Keys and positions from the top.
        offset: Characters into the text of the scalar there; None for the scalar
            itself, with its quotes.
    """
    deepest = root
    for length in range(len(path), 0, -1):
        node = find(root, path[:length])
        if node is not None:
            deepest = node
            break
    if isinstance(deepest, Scalar) and deepest.inner is not None and offset is not None:
        start = deepest.place
        return Place(start.line, start.column + deepest.inner + offset)
    return deepest.place


def key_place_of(root: Node, path: Path) -> Place:
    """The place of the key that ends ``path``, or of what holds it."""
    holder = find(root, path[:-1])
    if isinstance(holder, Mapping):
        for entry in holder.entries:
            if entry.key == path[-1]:
                return entry.key_place
    return place_of(root, path)


def unique_entries(entries: Iterable[Entry], faults: Faults) -> tuple[Entry, ...]:
    """The entries with the first of equal keys; the others are faults."""
    first: dict[str, Entry] = {}
    for entry in entries:
        if entry.key in first:
            line = first[entry.key].key_place.line
            faults.add(
                entry.key_place,
                f"the key {entry.key!r} stands here again (first in line {line})",
            )
        else:
            first[entry.key] = entry
    return tuple(first.values())
