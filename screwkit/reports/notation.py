"""Expressions and relations as people write them, in Unicode and in TeX.

`r3*cos(q2) + d3*sin(q2)` becomes ``r3 cos q2 + d3 sin q2`` or
``r_{3}\\cos q_{2} + d_{3}\\sin q_{2}``; ``q6 = q1 (mod pi)`` becomes
``q6 = q1 (mod π)``.  Text that the grammar does not know is shown as it stands,
escaped; nothing is evaluated.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Final, Protocol, assert_never

from screwkit.algebra.expression import (
    Call,
    Expression,
    Number,
    Pi,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from screwkit.errors import ExpressionError
from screwkit.reports.names import latex_name, unicode_name
from screwkit.reports.tex import escape

_SUM, _PRODUCT, _PREFIX, _ATOM = range(4)
SUPERSCRIPTS: Final = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_TEX_FUNCTIONS: Final = {"sin": r"\sin", "cos": r"\cos", "tan": r"\tan"}


class _Style(Protocol):
    """The spelling of one medium; structure and brackets are common to all."""

    minus: str
    pi: str

    def name(self, name: str) -> str: ...
    def fraction(self, top: str, bottom: str) -> tuple[str, int]: ...
    def function(self, name: str) -> str: ...
    def raised(self, base: str, exponent: int) -> str: ...
    def applied(self, head: str, argument: str) -> str: ...
    def times(self, left: str, right: str) -> str: ...
    def root(self, inside: str, level: int) -> tuple[str, int]: ...
    def relation(self, sign: str) -> str: ...
    def modulo(self, period: str) -> str: ...
    def words(self, text: str) -> str: ...


@dataclass(frozen=True, slots=True)
class _Unicode:
    minus: str = "−"
    pi: str = "π"
    stacked: bool = False

    def name(self, name: str) -> str:
        return unicode_name(name)

    def fraction(self, top: str, bottom: str) -> tuple[str, int]:
        return f"{top}/{bottom}", _PRODUCT

    def function(self, name: str) -> str:
        return name

    def raised(self, base: str, exponent: int) -> str:
        return base + str(exponent).translate(SUPERSCRIPTS)

    def applied(self, head: str, argument: str) -> str:
        return f"{head}{argument}" if argument.startswith("(") else f"{head} {argument}"

    def times(self, left: str, right: str) -> str:
        return f"{left} · {right}" if right.startswith("(") else f"{left} {right}"

    def root(self, inside: str, level: int) -> tuple[str, int]:
        return (f"√{inside}" if level == _ATOM else f"√({inside})"), _ATOM

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
    stacked: bool = True

    def name(self, name: str) -> str:
        return latex_name(name)

    def fraction(self, top: str, bottom: str) -> tuple[str, int]:
        return rf"\frac{{{top}}}{{{bottom}}}", _PREFIX

    def function(self, name: str) -> str:
        return _TEX_FUNCTIONS.get(name, rf"\operatorname{{{name}}}")

    def raised(self, base: str, exponent: int) -> str:
        return f"{base}^{{{exponent}}}"

    def applied(self, head: str, argument: str) -> str:
        return f"{head}{argument}" if argument[0] in "(\\" else f"{head} {argument}"

    def times(self, left: str, right: str) -> str:
        gap = r"\," if right.startswith("(") or left[-1].isdigit() else ""
        return f"{left}{gap}{' ' if left[-1].isalpha() else ''}{right}"

    def root(self, inside: str, level: int) -> tuple[str, int]:
        return rf"\sqrt{{{inside}}}", _ATOM

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


_UNICODE: Final = _Unicode()
_LATEX: Final = _Latex()


def expression_unicode(expression: Expression) -> str:
    """An expression for the terminal."""
    return _write(expression, _UNICODE)[0]


def expression_latex(expression: Expression) -> str:
    """An expression in TeX's mathematics, without dollar signs."""
    return _write(expression, _LATEX)[0]


@lru_cache(maxsize=4096)
def in_unicode(text: str) -> str:
    """An expression, relation or list of relations for the terminal.

    >>> in_unicode("r3*cos(q2) + d3*sin(q2)")
    'r3 cos q2 + d3 sin q2'
    >>> in_unicode("q6 = q1 (mod pi)")
    'q6 = q1 (mod π)'
    """
    return _relations(text, _UNICODE)


@lru_cache(maxsize=4096)
def in_latex(text: str) -> str:
    r"""An expression, relation or list of relations in TeX's mathematics.

    >>> print(in_latex("q2 = atan(-r3/d3)"))
    q_{2} = \operatorname{atan}\frac{-r_{3}}{d_{3}}
    """
    return _relations(text, _LATEX)


def factor_unicode(text: str, power: int, alone: bool) -> str:
    """A factor of a locus for the terminal; a sum in brackets unless it is alone.

    >>> factor_unicode("sin(q6 - q1)", 2, False)
    'sin²(q6 − q1)'
    """
    return _factor(text, power, alone, _UNICODE)


def factor_latex(text: str, power: int, alone: bool) -> str:
    """A factor of a locus in TeX's mathematics."""
    return _factor(text, power, alone, _LATEX)


def _factor(text: str, power: int, alone: bool, style: _Style) -> str:
    from screwkit.algebra.parse import parse  # noqa: PLC0415

    try:
        expression = parse(text)
    except ExpressionError:
        return style.words(f"({text})" + (f"^{power}" if power > 1 else ""))
    whole = Power(expression, power) if power > 1 else expression
    body, level = _write(whole, style)
    return body if level > _PRODUCT or alone else f"({body})"


def term_count(text: str) -> int:
    """Number of summands at the top of an expression's text, without parsing it.

    >>> term_count("r3*cos(q2) + d3*sin(q2 - q1)")
    2
    """
    depth, terms, before = 0, 1, ""
    for character in text.strip():
        if character == "(":
            depth += 1
        elif character == ")":
            depth -= 1
        elif character in "+-" and depth == 0 and before not in ("", "*", "/", "^"):
            terms += 1
        if not character.isspace():
            before = character
    return terms


_OPERATOR = re.compile(r"!=|<=|>=|[=<>≠≤≥,]|\b(?:and|or)\b")
_MODULO = re.compile(r"\s*\(mod\s+([^()]+)\)")


def _relations(text: str, style: _Style) -> str:
    written: list[str] = []
    depth, start, at = 0, 0, 0
    while at < len(text):
        modulo = _MODULO.match(text, at) if depth == 0 else None
        operator = _OPERATOR.match(text, at) if depth == 0 else None
        if modulo is not None:
            written.append(_side(text[start:at], style))
            written.append(style.modulo(_side(modulo[1], style)))
            at = start = modulo.end()
        elif operator is not None:
            written.append(_side(text[start:at], style))
            written.append(style.relation(operator[0]))
            at = start = operator.end()
        else:
            depth += (text[at] == "(") - (text[at] == ")")
            at += 1
    written.append(_side(text[start:], style))
    return "".join(written)


def _side(text: str, style: _Style) -> str:
    """One side of a relation; text outside the grammar as words."""
    from screwkit.algebra.parse import parse  # noqa: PLC0415 -- only where it is needed

    text = text.strip()
    if not text:
        return ""
    sign = ""
    if text[0] == "±":
        sign, text = (r"\pm " if style is _LATEX else "±"), text[1:]
    try:
        return sign + _write(parse(text), style)[0]
    except ExpressionError:
        return sign + style.words(text)


def _write(expression: Expression, style: _Style) -> tuple[str, int]:
    """The text of an expression and how tightly it binds."""
    match expression:
        case Number(value):
            return _number(value, style)
        case Pi():
            return style.pi, _ATOM
        case Symbol(name):
            return style.name(name), _ATOM
        case Sum(terms):
            return _sum(terms, style), _SUM
        case Product(factors):
            return _product(factors, style)
        case Quotient(numerator, denominator):
            return _quotient(numerator, denominator, style)
        case Power(base, exponent):
            return _power(base, exponent, style)
        case Call(function, arguments):
            return _call(function, arguments, style)
        case _:
            assert_never(expression)


def _number(value: Fraction, style: _Style) -> tuple[str, int]:
    sign = style.minus if value < 0 else ""
    top, bottom = str(abs(value.numerator)), value.denominator
    if bottom == 1:
        return sign + top, _PRODUCT if sign else _ATOM
    text, level = style.fraction(top, str(bottom))
    return sign + text, _PRODUCT if sign else level


def _sum(terms: tuple[Expression, ...], style: _Style) -> str:
    text = ""
    for term in terms:
        positive = _negated(term)
        sign = "+" if positive is None else style.minus
        body, level = _write(term if positive is None else positive, style)
        if level == _SUM:
            body = f"({body})"
        if text:
            text += f" {sign} {body}"
        else:
            text = body if positive is None else style.minus + body
    return text


def _negated(term: Expression) -> Expression | None:
    """Minus the term, if it is written with a leading minus sign; else None."""
    match term:
        case Number(value) if value < 0:
            return Number(-value)
        case Product((Number(value), *rest)) if value < 0:
            if value != -1:
                return Product((Number(-value), *rest))
            return rest[0] if len(rest) == 1 else Product(tuple(rest))
        case Quotient(numerator, denominator):
            positive = _negated(numerator)
            return None if positive is None else Quotient(positive, denominator)
        case _:
            return None


def _rank(factor: Expression) -> int:
    """Numbers and letters before functions before brackets: nothing is ambiguous."""
    match factor:
        case Number():
            return 0
        case Pi() | Symbol():
            return 1
        case Power(base, _):
            return _rank(base)
        case Quotient():
            return 2
        case Call():
            return 3
        case _:
            return 4


def _product(factors: tuple[Expression, ...], style: _Style) -> tuple[str, int]:
    positive = _negated(Product(factors))
    if positive is not None:
        text, level = _write(positive, style)
        return style.minus + (f"({text})" if level == _SUM else text), _PRODUCT
    first, rest = factors[0], factors[1:]
    if isinstance(first, Number) and first.value.denominator != 1:
        top = (Number(Fraction(first.value.numerator)), *rest)
        if first.value.numerator == 1:
            top = rest
        whole = top[0] if len(top) == 1 else Product(top)
        return _quotient(whole, Number(Fraction(first.value.denominator)), style)
    text = ""
    for factor in sorted(factors, key=_rank):
        body, level = _write(factor, style)
        if level <= _PRODUCT:
            body = f"({body})"
        text = style.times(text, body) if text else body
    return text, _PRODUCT


def _quotient(
    numerator: Expression, denominator: Expression, style: _Style
) -> tuple[str, int]:
    top, top_level = _write(numerator, style)
    bottom, bottom_level = _write(denominator, style)
    if not getattr(style, "stacked", False):
        if top_level == _SUM:
            top = f"({top})"
        if bottom_level != _ATOM:
            bottom = f"({bottom})"
    return style.fraction(top, bottom)


def _power(base: Expression, exponent: int, style: _Style) -> tuple[str, int]:
    match base:
        case Call(("sin" | "cos" | "tan") as function, (argument,)) if exponent > 0:
            head = style.raised(style.function(function), exponent)
            return style.applied(head, _argument(argument, style)), _PREFIX
        case _:
            body, level = _write(base, style)
            if level != _ATOM or isinstance(base, Power):
                body = f"({body})"
            return style.raised(body, exponent), _ATOM


def _call(
    function: str, arguments: tuple[Expression, ...], style: _Style
) -> tuple[str, int]:
    if function == "sqrt":
        return style.root(*_write(arguments[0], style))
    head = style.function(function)
    if function in _TEX_FUNCTIONS:
        return style.applied(head, _argument(arguments[0], style)), _PREFIX
    if getattr(style, "stacked", False) and len(arguments) == 1:
        stacked = _stacked(arguments[0])
        if stacked is not None:
            return style.applied(head, _write(stacked, style)[0]), _PREFIX
    inside = ", ".join(_write(argument, style)[0] for argument in arguments)
    return f"{head}({inside})", _PREFIX


def _stacked(argument: Expression) -> Quotient | None:
    """The argument as one fraction, its sign in the numerator; None if it is none."""
    match argument:
        case Quotient():
            return argument
        case Product((Number(value), Quotient(top, bottom))) if value == -1:
            return Quotient(Product((Number(value), top)), bottom)
        case _:
            return None


def _argument(argument: Expression, style: _Style) -> str:
    text, level = _write(argument, style)
    return text if level == _ATOM else f"({text})"
