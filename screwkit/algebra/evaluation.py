"""The value of an expression in any ring.

An expression is met in two roles: as a number (a length, a coordinate) and as an
angle.  An angle is never a number here but the pair (cos, sin), so that everything
stays polynomial; that is why ``alpha: q1/2`` is refused, and ``alpha: atan(3/4)`` not.
"""

from __future__ import annotations

from fractions import Fraction

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
from screwkit.algebra.ring import Ring, S
from screwkit.errors import ExpressionError

_ONE = Number(Fraction(1))


def evaluate(expression: Expression, ring: Ring[S]) -> S:
    """The value of ``expression`` as a number.

    Raises:
        ExpressionError: For an inverse function outside an angle, or an angle that is
            not an integer combination of symbols.
    """
    match expression:
        case Number(value):
            return ring.rational(value)
        case Pi():
            return ring.symbol("pi")
        case Symbol(name):
            return ring.symbol(name)
    known = ring.known
    if known is None:
        return _composed(expression, ring)
    # A point of the file is met at every joint that it places.
    found = known.get(id(expression))
    if found is None:
        found = expression, _composed(expression, ring)
        known[id(expression)] = found
    return found[1]


def _composed(expression: Sum | Product | Power | Quotient | Call, ring: Ring[S]) -> S:
    """The value of an expression that has parts."""
    match expression:
        case Sum(terms):
            total = evaluate(terms[0], ring)
            for term in terms[1:]:
                total = total + evaluate(term, ring)
            return ring.normal(total)
        case Product(factors):
            product = evaluate(factors[0], ring)
            for factor in factors[1:]:
                product = product * evaluate(factor, ring)
            return ring.normal(product)
        case Power(base, exponent):
            raised = _power(evaluate(base, ring), abs(exponent), ring)
            if exponent > 0:
                return raised
            return ring.inverse(Power(base, -exponent), raised)
        case Quotient(numerator, denominator):
            below = ring.inverse(denominator, evaluate(denominator, ring))
            return ring.normal(evaluate(numerator, ring) * below)
        case Call(function, arguments):
            return _call(function, arguments, ring)


def _power(base: S, exponent: int, ring: Ring[S]) -> S:
    result = ring.one
    while exponent:
        if exponent & 1:
            result = ring.normal(result * base)
        base = ring.normal(base * base)
        exponent >>= 1
    return result


def _call(function: str, arguments: tuple[Expression, ...], ring: Ring[S]) -> S:
    match function:
        case "sin":
            return cosine_sine(arguments[0], ring)[1]
        case "cos":
            return cosine_sine(arguments[0], ring)[0]
        case "tan":
            cosine, sine = cosine_sine(arguments[0], ring)
            return ring.normal(sine * ring.inverse(Call("cos", arguments), cosine))
        case "sqrt":
            return ring.square_root(arguments[0], evaluate(arguments[0], ring))
        case _:
            raise ExpressionError(
                f"{function}(…) is an angle and cannot stand where a length is needed; "
                f"use it inside sin, cos or tan, or where the file asks for an angle"
            )


def cosine_sine(expression: Expression, ring: Ring[S]) -> tuple[S, S]:
    """(cos, sin) of ``expression`` as an angle in radians.

    Raises:
        ExpressionError: If it is not an integer combination of symbols, a multiple of
            π, a rational number and inverse functions.
    """
    match expression:
        case Number(value):
            return ring.radians(value)
        case Pi():
            return ring.half_turns(Fraction(1))
        case Symbol(name):
            return ring.cosine_sine(name)
        case Sum(terms):
            pair = cosine_sine(terms[0], ring)
            for term in terms[1:]:
                pair = add_angles(pair, cosine_sine(term, ring), ring)
            return pair
        case Product((Number(value), Pi())):
            return ring.half_turns(value)
        case Product((Number(value), *rest)) if value.denominator == 1:
            other = rest[0] if len(rest) == 1 else Product(tuple(rest))
            return multiply_angle(value.numerator, cosine_sine(other, ring), ring)
        case Call("atan", (argument,)):
            return _atan2(argument, _ONE, ring)
        case Call("atan2", (y, x)):
            return _atan2(y, x, ring)
        case Call("asin", (argument,)):
            return _complement(argument, ring), evaluate(argument, ring)
        case Call("acos", (argument,)):
            return evaluate(argument, ring), _complement(argument, ring)
        case _:
            raise ExpressionError(
                "an angle must be an integer combination of symbols, multiples of pi "
                "and inverse functions; declare a symbol for the half or scaled angle"
            )


def add_angles(left: tuple[S, S], right: tuple[S, S], ring: Ring[S]) -> tuple[S, S]:
    """(cos, sin) of the sum of two angles."""
    (c1, s1), (c2, s2) = left, right
    return ring.normal(c1 * c2 - s1 * s2), ring.normal(s1 * c2 + c1 * s2)


def multiply_angle(count: int, pair: tuple[S, S], ring: Ring[S]) -> tuple[S, S]:
    """(cos, sin) of an integer multiple of an angle."""
    if count < 0:
        pair = (pair[0], -pair[1])
    result = (ring.one, ring.zero)
    for _ in range(abs(count)):
        result = add_angles(result, pair, ring)
    return result


def _atan2(y: Expression, x: Expression, ring: Ring[S]) -> tuple[S, S]:
    above, below = evaluate(y, ring), evaluate(x, ring)
    square = Sum((Power(x, 2), Power(y, 2)))
    length = ring.square_root(square, ring.normal(above * above + below * below))
    shrink = ring.inverse(Call("sqrt", (square,)), length)
    return ring.normal(below * shrink), ring.normal(above * shrink)


def _complement(argument: Expression, ring: Ring[S]) -> S:
    value = evaluate(argument, ring)
    square = Sum((_ONE, Product((Number(Fraction(-1)), Power(argument, 2)))))
    return ring.square_root(square, ring.normal(ring.one - value * value))
