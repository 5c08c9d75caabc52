"""A strict reader of YAML: no aliases, anchors, tags or repeated keys.

Every scalar stays text.  An item that YAML cut at a comma inside parentheses
(``[atan2(y, x), 0, 0]``) is put together again and reported with the right spelling, so
that it causes no further faults.
"""

from __future__ import annotations

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
)

DEEPEST: Final = 50


class _StrictLoader(yaml.SafeLoader):
    """Composes nodes only; refusals go to ``refused`` and reading goes on."""

    # PyYAML's own resolvers would make numbers, dates and booleans of text.
    yaml_implicit_resolvers: dict[str, Any] = {}  # noqa: RUF012  (PyYAML's name)

    def __init__(self, text: str, refused: Faults) -> None:
        super().__init__(text)
        self.refused = refused
        self.depth = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose one node, refusing aliases, anchors and tags.

        Raises:
            RecursionError: If the file is nested too deeply.
        """
        event: Any = self.peek_event()  # type: ignore[no-untyped-call]
        place = _place(event.start_mark)
        if isinstance(event, yaml.AliasEvent):
            self.get_event()  # type: ignore[no-untyped-call]
            self.refused.add(
                place, f"aliases are not allowed (*{event.anchor}); write it out"
            )
            start: Any = event.start_mark
            end: Any = event.end_mark
            return yaml.ScalarNode("", "", start, end, style="'")
        if getattr(event, "anchor", None) is not None:
            self.refused.add(place, f"anchors are not allowed (&{event.anchor})")
            event.anchor = None
        tag = getattr(event, "tag", None)
        if tag is not None:
            self.refused.add(
                place, f"tags are not allowed ({tag!r}); every scalar is text"
            )
            event.tag = None
        if self.depth >= DEEPEST:
            raise RecursionError
        self.depth += 1
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node


def yaml_tree(text: str, faults: Faults) -> Node | None:
    """Read YAML; what is wrong goes to ``faults``.

    Returns:
        The tree, or None where the text is no YAML at all.
    """
    try:
        loader = _StrictLoader(text, faults)
        root = loader.get_single_node()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        faults.add(_place(mark) if mark else None, _explained(error))
        return None
    except yaml.reader.ReaderError as error:
        before = text[: error.position]
        line = before.count("\n") + 1
        place = Place(line, error.position - (before.rfind("\n") + 1) + 1)
        faults.add(place, "a character that is not printable stands here")
        return None
    except RecursionError:
        faults.add(None, f"nested deeper than {DEEPEST} levels")
        return None
    if root is None:
        return None
    return _converted(root, faults)


def _explained(error: yaml.MarkedYAMLError) -> str:
    problem = error.problem or "cannot be read"
    if "'\\t'" in problem:
        return "a tab stands where spaces are needed"
    if "single document" in f"{error.context} {error.problem}":
        return "a second document starts here; a file holds one mechanism"
    context = f" ({error.context})" if error.context else ""
    return f"not readable as YAML: {problem}{context}"


def _place(mark: Any) -> Place:
    return Place(mark.line + 1, mark.column + 1)


def _converted(node: Any, faults: Faults) -> Node:
    place = _place(node.start_mark)
    if isinstance(node, yaml.ScalarNode):
        return _scalar(node, place)
    if isinstance(node, yaml.SequenceNode):
        items = [_converted(item, faults) for item in node.value]
        if node.flow_style:
            items = _mended_items(items, faults)
        return Sequence(tuple(items), place)
    entries = []
    for key, value in node.value:
        key_place = _place(key.start_mark)
        if not isinstance(key, yaml.ScalarNode):
            faults.add(key_place, "a key is text, not a list or a mapping")
            continue
        converted = _converted(value, faults)
        entries.append(Entry(str(key.value), key_place, converted))
    if node.flow_style:
        entries = _mended_entries(entries, faults)
    return Mapping(unique_entries(entries, faults), place)


def _scalar(node: Any, place: Place) -> Scalar:
    quoted = node.style in {"'", '"'}
    start, end = node.start_mark, node.end_mark
    inner = 1 if quoted else 0
    is_plain = node.style is None or quoted
    columns = end.column - start.column
    runs_together = start.line == end.line and columns == len(node.value) + 2 * inner
    return Scalar(
        str(node.value),
        place,
        # A block scalar (| or >) is as deliberate as quotes.
        quoted=node.style is not None,
        inner=inner if is_plain and runs_together else None,
    )


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
