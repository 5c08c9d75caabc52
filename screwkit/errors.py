"""What a caller may meet: one tree of exceptions, each saying what to do next.

``ValueError`` and ``TypeError`` stay for a programmer's mistake.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

EXIT_DONE: Final = 0
EXIT_NEGATIVE: Final = 1
EXIT_USAGE: Final = 2
EXIT_FILE: Final = 3
EXIT_TIMEOUT: Final = 4
EXIT_TOOL: Final = 5
EXIT_INTERRUPTED: Final = 130


class ScrewkitError(Exception):
    """Base of everything that screwkit raises on purpose."""


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong in a file.

    Attributes:
        line: From 1; 0 where the fault has no place.
        column: From 1.
        message: What was found, what is allowed, and the nearest right name.
    """

    line: int
    column: int
    message: str

    def located_in(self, source: str) -> str:
        """The fault as ``source:line:column  message``."""
        place = f"{source}:{self.line}:{self.column}" if self.line else source
        return f"{place}  {self.message}"


class MechanismFileError(ScrewkitError):
    """A mechanism file is wrong; holds all its faults at once, in file order."""

    def __init__(self, source: str, faults: tuple[Fault, ...]) -> None:
        self.source = source
        self.faults = faults
        super().__init__("\n".join(fault.located_in(source) for fault in faults))


class ExpressionError(ScrewkitError):
    """A text is no expression of the grammar.

    Attributes:
        position: Offset from 0 in the text at which the cause stands.
    """

    def __init__(self, message: str, position: int = 0) -> None:
        self.position = position
        super().__init__(message)


class UnknownCaseError(ScrewkitError):
    """A name is neither a file nor a bundled case."""


class UnknownNameError(ScrewkitError):
    """A joint, symbol or limb that the mechanism does not have was named."""


class UnfitValueError(ScrewkitError):
    """A value given from outside contradicts what the file demands of its symbols."""


class UndecidedError(ScrewkitError):
    """The question is open; the message says why and what would help."""


class TooLargeError(UndecidedError):
    """An exact computation was refused before it was attempted: it would not fit."""


class FrameMismatchError(ScrewkitError):
    """Two screws expressed in different frames were combined."""

    def __init__(self, left: str, right: str) -> None:
        self.left = left
        self.right = right
        super().__init__(
            f"cannot combine a screw in frame {left!r} with one in frame {right!r}; "
            f"move one of them first"
        )


class MissingToolError(ScrewkitError):
    """A program that the answer needs is not installed; the message names it."""


class UnwritableError(ScrewkitError):
    """A file cannot be written."""

    def __init__(self, path: object, error: OSError) -> None:
        reason = (error.strerror or str(error)).lower()
        super().__init__(f"cannot write {path}: {reason}")


class OutputError(UnwritableError):
    """Standard output takes nothing more."""

    def __init__(self, error: OSError) -> None:
        super().__init__("to standard output", error)
