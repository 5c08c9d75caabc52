"""Constructors that keep expressions in the normal form their docstrings promise.

Sums and products are flat, numbers are folded, denominators rise to one quotient and a
constant denominator becomes a number factor.  Nothing else is simplified: what a
person wrote stays recognisable.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction

from screwkit.algebra.expression import (
    ONE,
    ZERO,
    Call,
    Expression,
    FunctionName,
    Number,
    Pi,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

MINUS_ONE = Number(Fraction(-1))


def add(*terms: Expression) -> Expression:
    """The sum of ``terms``; its numbers are folded where the first of them stands.

    >>> from screwkit.algebra.expression import Symbol
    >>> add(Symbol("x"), Number(Fraction(2)), Number(Fraction(-2)))
    Symbol(name='x')
    """
    constant = Fraction(0)
    place: int | None = None
    kept: list[Expression] = []
    for term in _flat_terms(terms):
        if isinstance(term, Number):
            constant += term.value
            place = len(kept) if place is None else place
        else:
            kept.append(term)
    if place is not None and constant:
        kept.insert(place, Number(constant))
    if not kept:
        return ZERO
    return kept[0] if len(kept) == 1 else Sum(tuple(kept))


def subtract(left: Expression, right: Expression) -> Expression:
    """``left - right``."""
    return add(left, negate(right))


def multiply(*factors: Expression) -> Expression:
    """The product of ``factors``: one number in front, at most one quotient around."""
    coefficient = Fraction(1)
    numerators: list[Expression] = []
    denominators: list[Expression] = []
    pending = list(reversed(factors))
    while pending:
        match pending.pop():
            case Number(value):
                coefficient *= value
            case Product(inner):
                pending.extend(reversed(inner))
            case Quotient(numerator, denominator):
                denominators.append(denominator)
                pending.append(numerator)
            case factor:
                numerators.append(factor)
    if not coefficient:
        return ZERO
    if denominators:
        above = _product(coefficient, numerators)
        return quotient(above, multiply(*denominators))
    return _product(coefficient, numerators)


def negate(operand: Expression) -> Expression:
    """``-operand``, distributed over nothing but a number."""
    return multiply(MINUS_ONE, operand)


def quotient(numerator: Expression, denominator: Expression) -> Expression:
    """``numerator / denominator``.

    Raises:
        ZeroDivisionError: If the denominator is the number zero.
    """
    if isinstance(denominator, Number):
        return multiply(Number(1 / denominator.value), numerator)
    if numerator == ZERO:
        return ZERO
    if isinstance(numerator, Quotient):
        below = multiply(numerator.denominator, denominator)
        return quotient(numerator.numerator, below)
    return Quotient(numerator, denominator)


def power(base: Expression, exponent: int) -> Expression:
    """``base ^ exponent``; a negative exponent gives a quotient.

    Raises:
        ZeroDivisionError: If zero is raised to a negative exponent.
    """
    if exponent < 0:
        return quotient(ONE, power(base, -exponent))
    if exponent == 0:
        return ONE
    if exponent == 1:
        return base
    if isinstance(base, Number):
        return Number(base.value**exponent)
    if isinstance(base, Power):
        return power(base.base, base.exponent * exponent)
    return Power(base, exponent)


def call(function: FunctionName, *arguments: Expression) -> Expression:
    """``function(arguments…)``, kept as it is written."""
    return Call(function, arguments)


def substitute(expression: Expression, values: dict[str, Expression]) -> Expression:
    """``expression`` with symbols replaced, built again in normal form.

    Raises:
        ZeroDivisionError: If a denominator becomes the number zero.
    """
    return substitution(values)(expression)


def substitution(
    values: Mapping[str, Expression],
) -> Callable[[Expression], Expression]:
    """`substitute` for many expressions: a part that they share is built once."""
    known: dict[int, tuple[Expression, Expression]] = {}

    def replaced(node: Expression) -> Expression:
        match node:
            case Number() | Pi():
                return node
            case Symbol(name):
                return values.get(name, node)
        if id(node) not in known:
            known[id(node)] = node, built(node)
        return known[id(node)][1]

    def built(node: Sum | Product | Power | Quotient | Call) -> Expression:
        match node:
            case Sum(terms):
                return add(*map(replaced, terms))
            case Product(factors):
                return multiply(*map(replaced, factors))
            case Quotient(numerator, denominator):
                return quotient(replaced(numerator), replaced(denominator))
            case Power(base, exponent):
                return power(replaced(base), exponent)
            case Call(function, arguments):
                return call(function, *map(replaced, arguments))

    return replaced


def symbols_of(expression: Expression) -> frozenset[str]:
    """The names that occur in ``expression``."""
    found: set[str] = set()
    pending = [expression]
    while pending:
        node = pending.pop()
        if isinstance(node, Symbol):
            found.add(node.name)
        pending.extend(children(node))
    return frozenset(found)


def children(expression: Expression) -> tuple[Expression, ...]:
    """The expressions directly below ``expression``."""
    match expression:
        case Sum(terms):
            return terms
        case Product(factors):
            return factors
        case Quotient(numerator, denominator):
            return (numerator, denominator)
        case Power(base, _):
            return (base,)
        case Call(_, arguments):
            return arguments
        case _:
            return ()


def _flat_terms(terms: Iterable[Expression]) -> Iterable[Expression]:
    for term in terms:
        if isinstance(term, Sum):
            yield from _flat_terms(term.terms)
        else:
            yield term


def _product(coefficient: Fraction, factors: list[Expression]) -> Expression:
    if not factors:
        return Number(coefficient)
    if coefficient != 1:
        return Product((Number(coefficient), *factors))
    return factors[0] if len(factors) == 1 else Product(tuple(factors))
