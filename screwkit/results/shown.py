"""Answers that show themselves; how they look is known above them alone.

What renders registers here, so that ``print(answer)`` and notebooks show what a
terminal does while no result imports a rendering.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Looks:
    """Ways to show an answer.

    Attributes:
        text: As a terminal shows it.
        html: For a notebook.
        document: As JSON, see `screwkit schema results`.
    """

    text: Callable[[Any], str]
    html: Callable[[Any], str]
    document: Callable[[Any], dict[str, Any]]


_LOOKS: list[Looks] = []


def show_by(looks: Looks) -> None:
    """Register how answers are shown."""
    _LOOKS[:] = [looks]


class Shown:
    """An answer that `print`, notebooks and JSON can show."""

    __slots__ = ()

    def __str__(self) -> str:
        """The answer as a terminal shows it."""
        return _LOOKS[0].text(self).rstrip("\n") if _LOOKS else repr(self)

    def __repr__(self) -> str:
        """Short: the kind of answer and the case."""
        name = getattr(self, "case", "")
        return f"<{type(self).__name__.lower()} of {name!r}>"

    def _repr_html_(self) -> str | None:
        """For notebooks."""
        return _LOOKS[0].html(self) if _LOOKS else None

    def to_json(self) -> dict[str, Any]:
        """The JSON document, as ``--json`` prints it.

        Raises:
            RuntimeError: If nothing that renders was imported.
        """
        if not _LOOKS:
            raise RuntimeError("import screwkit.questions or screwkit.reports first")
        return _LOOKS[0].document(self)
