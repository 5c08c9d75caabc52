"""The refusal of an answer: an open question says why it is open."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Undecided:
    """An open question: why, and what would help."""

    reason: str
    status: str = "undecided"
