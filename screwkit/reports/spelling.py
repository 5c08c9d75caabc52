"""How one medium spells what all mathematics has in common.

`notation` walks the expressions and sets the brackets; a `Style` knows how a name, a
fraction or a power looks in Unicode or in TeX, and nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Protocol

from screwkit.reports.names import latex_name, unicode_name
from screwkit.reports.tex import escape

SUM, PRODUCT, PREFIX, ATOM = range(4)
SUPERSCRIPTS: Final = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
TEX_FUNCTIONS: Final = {"sin": r"\sin", "cos": r"\cos", "tan": r"\tan"}


class Style(Protocol):
    """The spelling of one medium; structure and brackets are common to all."""

    @property
    def minus(self) -> str:
        """The sign of a negative term."""
        ...

    @property
    def pi(self) -> str:
        """The constant."""
        ...

    @property
    def plus_minus(self) -> str:
        """The sign of two values at once."""
        ...

    @property
    def stacked(self) -> bool:
        """Whether fractions stand on two lines, so that they need no brackets."""
        ...

    def name(self, name: str) -> str:
        """A declared name."""
        ...

    def fraction(self, top: str, bottom: str) -> tuple[str, int]:
        """A quotient and how tightly it binds."""
        ...

    def slanted(self, top: str, bottom: str) -> tuple[str, int]:
        """A quotient on one line, its parts bracketed where they need it."""
        ...

    def function(self, name: str) -> str:
        """The name of a function."""
        ...

    def raised(self, base: str, exponent: int) -> str:
        """A power."""
        ...

    def applied(self, head: str, argument: str) -> str:
        """A function before its argument, which has its brackets if it needs them."""
        ...

    def times(self, left: str, right: str) -> str:
        """Two factors side by side."""
        ...

    def root(self, inside: str, level: int) -> tuple[str, int]:
        """A square root and how tightly it binds."""
        ...

    def relation(self, sign: str) -> str:
        """A relation, a comma or a conjunction."""
        ...

    def modulo(self, period: str) -> str:
        """``(mod …)`` after a congruence."""
        ...

    def words(self, text: str) -> str:
        """Text that is no expression."""
        ...


@dataclass(frozen=True, slots=True)
class _Unicode:
    minus: str = "−"
    pi: str = "π"
    plus_minus: str = "±"
    stacked: bool = False

    def name(self, name: str) -> str:
        return unicode_name(name)

    def fraction(self, top: str, bottom: str) -> tuple[str, int]:
        return f"{top}/{bottom}", PRODUCT

    def slanted(self, top: str, bottom: str) -> tuple[str, int]:
        return f"{top}/{bottom}", PRODUCT

    def function(self, name: str) -> str:
        return name

    def raised(self, base: str, exponent: int) -> str:
        return base + str(exponent).translate(SUPERSCRIPTS)

    def applied(self, head: str, argument: str) -> str:
        return f"{head}{argument}" if argument.startswith("(") else f"{head} {argument}"

    def times(self, left: str, right: str) -> str:
        if right == self.pi and left.isdecimal():
            return left + right
        return f"{left} · {right}" if right.startswith("(") else f"{left} {right}"

    def root(self, inside: str, level: int) -> tuple[str, int]:
        return (f"√{inside}" if level == ATOM else f"√({inside})"), ATOM

    def relation(self, sign: str) -> str:
        return {"!=": " ≠ ", "<=": " ≤ ", ">=": " ≥ ", ",": ", "}.get(sign, f" {sign} ")

    def modulo(self, period: str) -> str:
        return f" (mod {period})"

    def words(self, text: str) -> str:
        return text


@dataclass(frozen=True, slots=True)
class _Latex:
    minus: str = "-"
    pi: str = r"\pi"
    plus_minus: str = r"\pm "
    stacked: bool = True

    def name(self, name: str) -> str:
        return latex_name(name)

    def fraction(self, top: str, bottom: str) -> tuple[str, int]:
        return rf"\frac{{{top}}}{{{bottom}}}", PREFIX

    def slanted(self, top: str, bottom: str) -> tuple[str, int]:
        return rf"{top}\big/{bottom}", PRODUCT

    def function(self, name: str) -> str:
        return TEX_FUNCTIONS.get(name, rf"\operatorname{{{name}}}")

    def raised(self, base: str, exponent: int) -> str:
        return f"{base}^{{{exponent}}}"

    def applied(self, head: str, argument: str) -> str:
        return f"{head}{argument}" if argument[0] in "(\\" else f"{head} {argument}"

    def times(self, left: str, right: str) -> str:
        gap = r"\," if right.startswith("(") or left[-1].isdigit() else ""
        apart = " " if left[-1].isalpha() and right[0].isalpha() else ""
        return f"{left}{gap}{apart}{right}"

    def root(self, inside: str, level: int) -> tuple[str, int]:
        return rf"\sqrt{{{inside}}}", ATOM

    def relation(self, sign: str) -> str:
        spelt = {
            "!=": r"\neq ",
            "≠": r"\neq ",
            "<=": r"\leq ",
            "≤": r"\leq ",
            ">=": r"\geq ",
            "≥": r"\geq ",
            ",": r",\; ",
            "and": r"\text{ and }",
            "or": r"\text{ or }",
        }
        return f" {spelt.get(sign, sign)} " if sign != "," else spelt[sign]

    def modulo(self, period: str) -> str:
        return rf"\allowbreak\ (\mathrm{{mod}}\ {period})"

    def words(self, text: str) -> str:
        return rf"\text{{{escape(text)}}}"


UNICODE: Final = _Unicode()
LATEX: Final = _Latex()
