"""Mechanism files: from a path or a text to a checked `Mechanism`.

Whatever is wrong -- with the file, its syntax, its structure or its meaning -- ends in
one `MechanismFileError` with all faults found, each at its line and column.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

from screwkit.errors import Fault, MechanismFileError
from screwkit.mechanism.assembly import assembled
from screwkit.mechanism.json_nodes import json_tree
from screwkit.mechanism.model import Mechanism
from screwkit.mechanism.nodes import Faults, Place, Scalar, find
from screwkit.mechanism.nodes import Path as Path_
from screwkit.mechanism.reading import Outside
from screwkit.mechanism.structure import draft_of
from screwkit.mechanism.yaml_nodes import yaml_tree

LARGEST_FILE: Final = 4_000_000
"""Bytes."""


def read_mechanism(path: str | Path, outside: Outside | None = None) -> Mechanism:
    """Read a mechanism file: JSON where the name ends so, else YAML.

    Args:
        path: The file.
        outside: What is known beside the file.

    Raises:
        MechanismFileError: If it cannot be read or anything in it is wrong.
    """
    source = str(path)
    try:
        with Path(path).open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except IsADirectoryError:
        raise _refused(source, "this is a directory; name a file in it") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "no usable file name"
        raise _refused(source, f"cannot be read: {reason}") from None
    is_json = source.lower().endswith(".json")
    return mechanism_from_bytes(content, source, is_json, outside)


def mechanism_from_bytes(
    content: bytes,
    source_name: str,
    json: bool = False,
    outside: Outside | None = None,
) -> Mechanism:
    """Read a mechanism from the bytes of a file.

    Raises:
        MechanismFileError: If anything is wrong; holds all faults in file order.
    """
    if len(content) > LARGEST_FILE:
        raise _refused(source_name, f"larger than {LARGEST_FILE} bytes")
    if b"\0" in content:
        before = content[: content.index(b"\0")]
        fault = Fault(*_end_of(before), "this is a binary file, not YAML or JSON")
        raise MechanismFileError(source_name, (fault,))
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        place = _end_of(content[: error.start])
        fault = Fault(*place, "not UTF-8 text; save the file as UTF-8")
        raise MechanismFileError(source_name, (fault,)) from None
    return mechanism_from_text(text, source_name, json, outside)


def mechanism_from_text(
    text: str,
    source_name: str,
    json: bool = False,
    outside: Outside | None = None,
) -> Mechanism:
    """Read a mechanism from text.

    Args:
        text: YAML, or JSON where ``json`` says so.
        source_name: What faults call the text.
        json: Whether the text is JSON.
        outside: What is known beside the text.

    Raises:
        MechanismFileError: If anything is wrong; holds all faults in file order.
    """
    if len(text) > LARGEST_FILE:
        raise _refused(source_name, f"larger than {LARGEST_FILE} bytes")
    faults = Faults()
    root = json_tree(text, faults) if json else yaml_tree(text, faults)
    mechanism = None
    if isinstance(root, Scalar) and not root.text and not root.quoted:
        root = None
    if root is not None:
        draft = draft_of(root, faults)
        mechanism = assembled(draft, faults, outside) if draft is not None else None
    elif not faults.found:
        faults.add(Place(1, 1), "the file is empty; start it with `screwkit: 1`")
    if faults.found or mechanism is None:
        raise MechanismFileError(source_name, faults.sorted())
    return mechanism


def place_of(path: str | Path, keys: Path_) -> tuple[int, int]:
    """Line and column of an entry of a file that has been read; 0, 0 if it is gone.

    Args:
        path: The file.
        keys: From the root, names and positions.
    """
    text = Path(path).read_text("utf-8-sig")
    is_json = str(path).lower().endswith(".json")
    root = json_tree(text, Faults()) if is_json else yaml_tree(text, Faults())
    node = None if root is None else find(root, keys)
    return (0, 0) if node is None else (node.place.line, node.place.column)


def _end_of(content: bytes) -> tuple[int, int]:
    """Line and column behind the last character."""
    last = content[content.rfind(b"\n") + 1 :]
    column = len(last.decode("utf-8", errors="replace")) + 1
    return content.count(b"\n") + 1, column


def _refused(source: str, message: str) -> MechanismFileError:
    return MechanismFileError(source, (Fault(0, 0, message),))
