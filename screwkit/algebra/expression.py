"""Expressions of the file grammar as frozen data: the common tongue of the borders.

Files, results, reports and sympy meet here.  The exact engine has its own, faster
form (`trigonometric`); an `Expression` is what a person wrote or will read.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, TypeAlias

FunctionName: TypeAlias = Literal[
    "sin", "cos", "tan", "sqrt", "asin", "acos", "atan", "atan2"
]


@dataclass(frozen=True, slots=True)
class Number:
    """An exact rational; a decimal is the rational it denotes."""

    value: Fraction


@dataclass(frozen=True, slots=True)
class Pi:
    """The constant π."""


@dataclass(frozen=True, slots=True)
class Symbol:
    """A declared name."""

    name: str


@dataclass(frozen=True, slots=True)
class Sum:
    """``terms[0] + terms[1] + …``; two terms or more, none itself a `Sum`."""

    terms: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Product:
    """``factors[0] * factors[1] * …``; two or more, none itself a `Product`.

    A number, if there is one, comes first; ``-x`` is ``Product((Number(-1), x))``.
    """

    factors: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Quotient:
    """``numerator / denominator``, the denominator not a plain number."""

    numerator: Expression
    denominator: Expression


@dataclass(frozen=True, slots=True)
class Power:
    """``base ^ exponent`` with an integer exponent other than 0 and 1."""

    base: Expression
    exponent: int


@dataclass(frozen=True, slots=True)
class Call:
    """One of the functions of the grammar applied to its arguments."""

    function: FunctionName
    arguments: tuple[Expression, ...]


Expression: TypeAlias = Number | Pi | Symbol | Sum | Product | Quotient | Power | Call

ZERO = Number(Fraction(0))
ONE = Number(Fraction(1))
