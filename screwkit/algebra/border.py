"""The border to sympy: the only module that imports it, and only when asked.

Results leave as sympy expressions over real symbols (positive ones where the file says
so); what a caller hands in is taken through a white list of node types and becomes an
expression of the grammar, so nothing is evaluated on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, TypeAlias, cast

from screwkit.algebra.angles import Form, merged
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.expression import (
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
from screwkit.algebra.expression_building import add, call, multiply, power
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.names import SCALAR_FUNCTIONS, why_no_symbol
from screwkit.algebra.parse import parse
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.errors import ExpressionError

Sympy: TypeAlias = Any  # sympy.Expr or sympy.Matrix, which have no type stubs

DEEPEST = 200  # nested nodes taken from sympy
PLAIN = Assumptions()


def sympy_symbol(name: str, assumptions: Assumptions = PLAIN) -> Sympy:
    """The symbol as it stands in every result: real, positive where declared so."""
    import sympy  # noqa: PLC0415

    if name in assumptions.positive:
        return sympy.Symbol(name, positive=True)
    if name in assumptions.nonzero:
        return sympy.Symbol(name, real=True, nonzero=True)
    return sympy.Symbol(name, real=True)


def text_to_sympy(text: str, assumptions: Assumptions = PLAIN) -> Sympy:
    """A string of a result as a sympy expression.

    Raises:
        ExpressionError: If the text is not of the grammar.
    """
    return to_sympy(parse(text, limits=RESULT_LIMITS), assumptions)


def to_sympy(expression: Expression, assumptions: Assumptions = PLAIN) -> Sympy:
    """An expression of the grammar in sympy."""
    import sympy  # noqa: PLC0415

    def converted(node: Expression) -> Sympy:
        match node:
            case Number(value):
                return sympy.Rational(value.numerator, value.denominator)
            case Pi():
                return sympy.pi
            case Symbol(name):
                return sympy_symbol(name, assumptions)
            case Sum(terms):
                return sympy.Add(*map(converted, terms))
            case Product(factors):
                return sympy.Mul(*map(converted, factors))
            case Quotient(above, below):
                return converted(above) / converted(below)
            case Power(base, exponent):
                return converted(base) ** exponent
            case Call(function, arguments):
                return getattr(sympy, function)(*map(converted, arguments))

    return converted(expression)


def polynomial_to_sympy(
    ring: TrigonometricRing,
    polynomial: Polynomial,
    assumptions: Assumptions = PLAIN,
    *,
    merge_angles: bool = True,
) -> Sympy:
    """A polynomial of the exact ring in sympy, term by term.

    Args:
        ring: Of the polynomial.
        polynomial: In normal form.
        assumptions: What is known of the symbols.
        merge_angles: Write sums of angles where that takes fewer terms, as texts do;
            otherwise in the basis angles of the ring.
    """
    forms: Sequence[Form] = ring.basis
    exchanged: frozenset[int] = frozenset()
    if merge_angles and not polynomial.is_constant():
        short = merged(ring, polynomial)
        polynomial, forms, exchanged = short.polynomial, short.forms, short.exchanged
    return _summed(polynomial, _generators(ring, forms, exchanged, assumptions))


def columns_to_sympy(
    ring: TrigonometricRing,
    columns: Sequence[Sequence[Polynomial]],
    height: int,
    assumptions: Assumptions = PLAIN,
) -> Sympy:
    """Columns of polynomials as a sympy matrix of ``height`` rows."""
    import sympy  # noqa: PLC0415

    return sympy.Matrix(
        height,
        len(columns),
        lambda i, j: polynomial_to_sympy(ring, columns[int(j)][int(i)], assumptions),
    )


def latex_of(value: Sympy) -> str:
    """LaTeX of a sympy expression or matrix."""
    import sympy  # noqa: PLC0415

    return str(sympy.latex(value))


def from_sympy(value: Sympy) -> Expression:
    """A sympy expression as an expression of the grammar.

    Floats become the rationals that their decimal digits denote.

    Raises:
        ExpressionError: If it contains anything but numbers, symbols with names of the
            grammar, pi, + − · /, integer powers, square roots and the functions of the
            grammar.
    """
    return _taken(value, 0)


def _taken(value: Sympy, depth: int) -> Expression:
    import sympy  # noqa: PLC0415

    if depth > DEEPEST:
        raise ExpressionError(f"nested more than {DEEPEST} deep")
    if isinstance(value, int | Fraction) and not isinstance(value, bool):
        return Number(Fraction(value))
    if not isinstance(value, sympy.Expr):
        raise ExpressionError(f"a sympy expression is expected, not {value!r:.60}")

    def inner() -> list[Expression]:
        return [_taken(argument, depth + 1) for argument in value.args]

    if isinstance(value, sympy.Rational) and value.is_finite:
        return Number(Fraction(int(value.p), int(value.q)))
    if isinstance(value, sympy.Float) and value.is_finite:
        return Number(Fraction(str(value)))
    if value is sympy.pi:
        return Pi()
    if type(value) is sympy.Symbol:
        reason = why_no_symbol(value.name)
        if reason:
            raise ExpressionError(reason)
        return Symbol(value.name)
    if type(value) is sympy.Add:
        return add(*inner())
    if type(value) is sympy.Mul:
        return multiply(*inner())
    if type(value) is sympy.Pow:
        return _power(value, depth)
    name = type(value).__name__
    if name in SCALAR_FUNCTIONS and type(value) is getattr(sympy, name):
        return call(cast(FunctionName, name), *inner())
    raise ExpressionError(f"{name} is not of the expression grammar: {value!s:.60}")


def _power(value: Sympy, depth: int) -> Expression:
    exponent = value.exp
    base = _taken(value.base, depth + 1)
    if exponent.is_Integer:
        return power(base, int(exponent))
    if exponent.is_Rational and int(exponent.q) == 2:
        return power(call("sqrt", base), int(exponent.p))
    raise ExpressionError(f"the exponent {exponent!s:.60} is no integer")


def _generators(
    ring: TrigonometricRing,
    forms: Sequence[Form],
    exchanged: frozenset[int],
    assumptions: Assumptions,
) -> Callable[[int], Sympy]:
    """What a generator of the ring is in sympy, made when first needed."""
    import sympy  # noqa: PLC0415

    known: dict[int, Sympy] = {}
    places: dict[int, tuple[int, Any]] = {}
    for i in range(len(ring.basis)):
        sine, cosine = ring.sine_index(i), ring.cosine_index(i)
        if i in exchanged:
            sine, cosine = cosine, sine
        places[sine], places[cosine] = (i, sympy.sin), (i, sympy.cos)
    names = dict(zip(ring.symbol_indices(), ring.symbols, strict=True))

    def made(place: int) -> Sympy:
        if place in places:
            number, function = places[place]
            return function(_angle(forms[number], assumptions))
        if place in names:
            return sympy_symbol(names[place], assumptions)
        name = ring.names[place]
        if name in ring.constant_generators:
            return text_to_sympy(ring.constant_generators[name])
        extension = next(e for e in ring.extensions if e.name == name)
        inside = to_sympy(extension.of, assumptions)
        return sympy.sqrt(inside) if extension.kind == "root" else 1 / inside

    def generator(place: int) -> Sympy:
        if place not in known:
            known[place] = made(place)
        return known[place]

    return generator


def _angle(form: Form, assumptions: Assumptions) -> Sympy:
    import sympy  # noqa: PLC0415

    terms = []
    for name, count in form:
        try:
            constant = Fraction(name)  # a rational number of radians
        except ValueError:
            terms.append(count * sympy_symbol(name, assumptions))
        else:
            terms.append(
                count * sympy.Rational(constant.numerator, constant.denominator)
            )
    return sympy.Add(*terms)


def _summed(polynomial: Polynomial, generator: Callable[[int], Sympy]) -> Sympy:
    import sympy  # noqa: PLC0415

    terms = []
    for exponents, coefficient in polynomial.to_dict().items():
        factors = [sympy.Rational(int(coefficient.p), int(coefficient.q))]
        factors += [generator(i) ** int(e) for i, e in enumerate(exponents) if e]
        terms.append(sympy.Mul(*factors))
    return sympy.Add(*terms)
