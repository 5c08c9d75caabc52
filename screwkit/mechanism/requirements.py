"""What a file's expressions must fulfil: axes that are not zero, divisors, real roots.

A requirement is tried twice: for all values of the symbols when it is read, and at the
values of the file and of its variants once they are known.  Only what provably fails
is a fault; a symbol without value leaves open what contains it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from screwkit.algebra.expression import ONE, Call, Expression, Number, Quotient, Symbol
from screwkit.algebra.expression_building import (
    call,
    children,
    power,
    subtract,
    symbols_of,
)
from screwkit.algebra.names import shown
from screwkit.algebra.text import expression_text
from screwkit.mechanism.vanishing import is_negative, is_zero, is_zero_at, value_at


@dataclass(frozen=True)
class Requirement:
    """Not all entries are zero; or, for roots, the one entry is not negative.

    Attributes:
        words: What is wrong where it fails.
        advice: What to write instead.
    """

    entries: tuple[Expression, ...]
    words: str
    advice: str = ""
    negative: bool = False

    @property
    def symbols(self) -> frozenset[str]:
        """The symbols on which it depends."""
        return frozenset().union(*map(symbols_of, self.entries))

    @property
    def fails(self) -> bool:
        """Whether it fails for all values of the symbols."""
        if self.negative:
            return not self.symbols and is_negative(self.entries[0])
        return all(is_zero(entry) for entry in self.entries)

    def fails_at(self, values: Mapping[str, Expression]) -> bool:
        """Whether it fails at these values."""
        try:
            if self.negative:
                closed = value_at(self.entries[0], values)
                return closed is not None and is_negative(closed)
            return all(is_zero_at(entry, values) for entry in self.entries)
        except ZeroDivisionError:
            return False  # a requirement of its own

    def message(self, where: str = "") -> str:
        """The fault in words; ``where`` says at which values."""
        advice = f"; {self.advice}" if self.advice else ""
        return f"{self.words}{where}{advice}"


def nonzero(entries: Iterable[Expression], words: str, advice: str) -> Requirement:
    """Something that must not vanish, such as an axis."""
    return Requirement(tuple(entries), words, advice)


def requirements_of(expression: Expression) -> Iterator[Requirement]:
    """What makes ``expression`` a real number: its divisors, roots and arguments."""
    pending = [expression]
    while pending:
        node = pending.pop()
        if isinstance(node, Number | Symbol):
            continue
        pending.extend(children(node))
        match node:
            case Quotient(_, divisor):
                words = f"division by zero: {_text(divisor)} is 0"
                yield Requirement((divisor,), words)
            case Call("tan", (angle,)):
                words = f"{_text(node)} is infinite"
                yield Requirement((call("cos", angle),), words)
            case Call("sqrt", (radicand,)):
                words = f"the root of a negative number, {_text(node)}, is not real"
                yield Requirement((radicand,), words, negative=True)
            case Call("asin" | "acos" as name, (sine,)):
                rest = subtract(ONE, power(sine, 2))
                words = f"{name} takes numbers from -1 to 1; {_text(sine)} is outside"
                yield Requirement((rest,), words, negative=True)
            case Call("atan2", arguments):
                yield Requirement(arguments, f"{_text(node)} is atan2(0, 0)")


def _text(expression: Expression) -> str:
    return shown(expression_text(expression))
