r"""Expressions and relations as people write them, in Unicode and in TeX.

`r3*cos(q2) + d3*sin(q2)` becomes ``r3 cos q2 + d3 sin q2`` or
``r_{3}\cos q_{2} + d_{3}\sin q_{2}``; ``q6 = q1 (mod pi)`` becomes
``q6 = q1 (mod π)``.  Text that the grammar does not know is shown as it stands,
escaped; nothing is evaluated.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import lru_cache
from typing import assert_never

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
from screwkit.reports.spelling import (
    ATOM,
    LATEX,
    PREFIX,
    PRODUCT,
    SUM,
    TEX_FUNCTIONS,
    UNICODE,
    Style,
)


def expression_unicode(expression: Expression) -> str:
    """An expression for the terminal."""
    return _write(expression, UNICODE)[0]


def expression_latex(expression: Expression) -> str:
    """An expression in TeX's mathematics, without dollar signs."""
    return _write(expression, LATEX)[0]


@lru_cache(maxsize=4096)
def in_unicode(text: str) -> str:
    """An expression, relation or list of relations for the terminal.

    >>> in_unicode("r3*cos(q2) + d3*sin(q2)")
    'r3 cos q2 + d3 sin q2'
    >>> in_unicode("q6 = q1 (mod pi)")
    'q6 = q1 (mod π)'
    """
    return _relations(text, UNICODE)


@lru_cache(maxsize=4096)
def in_latex(text: str) -> str:
    r"""An expression, relation or list of relations in TeX's mathematics.

    >>> print(in_latex("q2 = atan(-r3/d3)"))
    q_{2} = \operatorname{atan}\frac{-r_{3}}{d_{3}}
    """
    return _relations(text, LATEX)


def is_mathematics(text: str) -> bool:
    """Whether a text is an expression or a relation, and not a sentence.

    >>> is_mathematics("q2 = atan(-r3/d3)"), is_mathematics("three (of 9)")
    (True, False)
    """
    from screwkit.algebra.parse import parse  # noqa: PLC0415

    bare = _MODULO.sub("", text)
    try:
        for side in re.split(r"!=|<=|>=|[=<>≠≤≥]", bare):
            parse(side)
    except ExpressionError:
        return False
    return True


def factor_unicode(text: str, power: int, alone: bool) -> str:
    """A factor of a locus for the terminal; a sum in brackets unless it is alone.

    >>> factor_unicode("sin(q6 - q1)", 2, False)
    'sin²(q6 − q1)'
    """
    return _factor(text, power, alone, UNICODE)


def factor_latex(text: str, power: int, alone: bool) -> str:
    """A factor of a locus in TeX's mathematics."""
    return _factor(text, power, alone, LATEX)


def _factor(text: str, power: int, alone: bool, style: Style) -> str:
    from screwkit.algebra.parse import parse  # noqa: PLC0415

    try:
        expression = parse(text)
    except ExpressionError:
        return style.words(f"({text})" + (f"^{power}" if power > 1 else ""))
    whole = Power(expression, power) if power > 1 else expression
    body, level = _write(whole, style)
    return body if level > PRODUCT or alone else f"({body})"


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


_STACKED_WIDTH = 18
_UNSEEN = re.compile(r"\\[A-Za-z]+|\\.|[{}_^ ]")
_OPERATOR = re.compile(r"!=|<=|>=|[=<>≠≤≥,]|\b(?:and|or)\b")
_MODULO = re.compile(r"\s*\(mod\s+([^()]+)\)")


def _relations(text: str, style: Style) -> str:
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


def _side(text: str, style: Style) -> str:
    """One side of a relation; text outside the grammar as words."""
    from screwkit.algebra.parse import parse  # noqa: PLC0415 -- only where it is needed

    text = text.strip()
    if not text:
        return ""
    sign = ""
    if text[0] == "±":
        sign, text = style.plus_minus, text[1:]
    try:
        return sign + _write(parse(text), style)[0]
    except ExpressionError:
        return sign + style.words(text)


def _write(expression: Expression, style: Style) -> tuple[str, int]:
    """The text of an expression and how tightly it binds."""
    match expression:
        case Number(value):
            return _number(value, style)
        case Pi():
            return style.pi, ATOM
        case Symbol(name):
            return style.name(name), ATOM
        case Sum(terms):
            return _sum(terms, style), SUM
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


def _number(value: Fraction, style: Style) -> tuple[str, int]:
    sign = style.minus if value < 0 else ""
    top, bottom = str(abs(value.numerator)), value.denominator
    if bottom == 1:
        return sign + top, PRODUCT if sign else ATOM
    text, level = style.fraction(top, str(bottom))
    return sign + text, PRODUCT if sign else level


def _sum(terms: tuple[Expression, ...], style: Style) -> str:
    text = ""
    for term in terms:
        positive = _negated(term)
        sign = "+" if positive is None else style.minus
        body, level = _write(term if positive is None else positive, style)
        if level == SUM:
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


def _product(factors: tuple[Expression, ...], style: Style) -> tuple[str, int]:
    positive = _negated(Product(factors))
    if positive is not None:
        text, level = _write(positive, style)
        return style.minus + (f"({text})" if level == SUM else text), PRODUCT
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
        if level <= PRODUCT:
            body = f"({body})"
        text = style.times(text, body) if text else body
    return text, PRODUCT


def _quotient(
    numerator: Expression, denominator: Expression, style: Style
) -> tuple[str, int]:
    top, top_level = _write(numerator, style)
    bottom, bottom_level = _write(denominator, style)
    if style.stacked and max(_printed(top), _printed(bottom)) <= _STACKED_WIDTH:
        return style.fraction(top, bottom)
    if top_level == SUM:
        top = f"({top})"
    if bottom_level != ATOM:
        bottom = f"({bottom})"
    return style.slanted(top, bottom)


def _printed(formula: str) -> int:
    """About how many characters of a formula are seen."""
    return len(_UNSEEN.sub("", re.sub(r"\\(sin|cos|tan|sqrt)\b", "abc", formula)))


def _power(base: Expression, exponent: int, style: Style) -> tuple[str, int]:
    match base:
        case Call(("sin" | "cos" | "tan") as function, (argument,)) if exponent > 0:
            head = style.raised(style.function(function), exponent)
            return style.applied(head, _argument(argument, style)), PREFIX
        case _:
            body, level = _write(base, style)
            if level != ATOM or isinstance(base, Power):
                body = f"({body})"
            return style.raised(body, exponent), ATOM


def _call(
    function: str, arguments: tuple[Expression, ...], style: Style
) -> tuple[str, int]:
    if function == "sqrt":
        return style.root(*_write(arguments[0], style))
    head = style.function(function)
    if function in TEX_FUNCTIONS:
        return style.applied(head, _argument(arguments[0], style)), PREFIX
    if style.stacked and len(arguments) == 1:
        stacked = _stacked(arguments[0])
        body, level = _write(stacked, style) if stacked is not None else ("", SUM)
        if level >= PREFIX:
            return style.applied(head, body), PREFIX
    inside = ", ".join(_write(argument, style)[0] for argument in arguments)
    return f"{head}({inside})", PREFIX


def _stacked(argument: Expression) -> Quotient | None:
    """The argument as one fraction, its sign in the numerator; None if it is none."""
    match argument:
        case Quotient():
            return argument
        case Product((Number(value), Quotient(top, bottom))) if value == -1:
            return Quotient(Product((Number(value), top)), bottom)
        case _:
            return None


def _argument(argument: Expression, style: Style) -> str:
    text, level = _write(argument, style)
    return text if level == ATOM else f"({text})"
