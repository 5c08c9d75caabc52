"""How long work says what it is doing: a stage and its size, nothing more."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Progress: TypeAlias = Callable[[str, str], None]


def silent(stage: str, size: str) -> None:
    """Say nothing."""
