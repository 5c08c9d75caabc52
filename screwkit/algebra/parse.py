"""Text of the file grammar to expressions, without ever evaluating anything.

The tokens are checked first; Python's own parser then only groups them (`ast.parse` on
placeholders, so that no text of a file reaches it), and a white list of node types
turns the groups into expressions.  Numbers are exact: they are read from the source.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Mapping
from fractions import Fraction
from typing import Final, TypeAlias, cast

from screwkit.algebra.expression import (
    Expression,
    FunctionName,
    Number,
    Pi,
    Product,
    Sum,
    Symbol,
)
from screwkit.algebra.expression_building import (
    add,
    call,
    children,
    multiply,
    negate,
    power,
    quotient,
)
from screwkit.algebra.limits import (
    FILE_LIMITS,
    Limits,
    bits,
    leaves,
    stacked,
)
from screwkit.algebra.names import (
    SCALAR_FUNCTIONS,
    VECTOR_FUNCTIONS,
    did_you_mean,
    shown,
    why_no_symbol,
)
from screwkit.algebra.tokens import Token, tokens_of
from screwkit.algebra.vector_expression import (
    VectorExpression,
    add_vectors,
    cross,
    dot,
    negate_vector,
    scale_vector,
)
from screwkit.errors import ExpressionError

_Value: TypeAlias = Expression | VectorExpression
_FUNCTIONS: Final = SCALAR_FUNCTIONS | VECTOR_FUNCTIONS


def parse(
    text: str,
    names: Collection[str] | None = None,
    *,
    vectors: Mapping[str, VectorExpression] | None = None,
    limits: Limits = FILE_LIMITS,
) -> Expression:
    """Read a scalar expression.

    Args:
        text: For instance ``r3*cos(q2) + d3*sin(q2)``.
        names: The declared symbols; None allows every name that may be declared.
        vectors: Named vectors, for ``dot(u, w)``.
        limits: What is refused as too large.

    Raises:
        ExpressionError: If the text is not of the grammar, too large, divides by
            zero, uses an undeclared name, or is a vector.
    """
    reader = _Reader(text, names, vectors or {}, limits)
    value = reader.read()
    if isinstance(value, tuple):
        raise ExpressionError("a number is expected here, but this is a vector")
    return value


def parse_vector(
    text: str,
    names: Collection[str] | None = None,
    *,
    vectors: Mapping[str, VectorExpression],
    limits: Limits = FILE_LIMITS,
) -> VectorExpression:
    """Read a vector expression: ``B1 - A1``, ``cross(u, w)``, ``-2*u + w/3``.

    Args:
        text: What is written.
        names: The declared symbols; None allows every name that may be declared.
        vectors: The named points and vectors, in coordinates.
        limits: What is refused as too large.

    Raises:
        ExpressionError: As for `parse`, and if the text is a scalar.
    """
    value = _Reader(text, names, vectors, limits).read()
    if not isinstance(value, tuple):
        raise ExpressionError(
            "a vector is expected here, but this is a number; "
            "write [x, y, z] or combine named points and vectors"
        )
    return value


class _Reader:
    """One text on its way to a value; positions are those of the text."""

    def __init__(
        self,
        text: str,
        names: Collection[str] | None,
        vectors: Mapping[str, VectorExpression],
        limits: Limits,
    ) -> None:
        if len(text) > limits.length:
            raise ExpressionError(
                f"the expression has {len(text)} characters; {limits.length} are "
                f"allowed"
            )
        self._names = names
        self._vectors = vectors
        self._limits = limits
        self._tokens: dict[int, Token] = {}
        pieces: list[str] = []
        column = 0
        for token in tokens_of(text, limits.depth):
            piece = _PLACEHOLDERS.get(token.kind) or _OPERATORS[token.text]
            self._tokens[column] = token
            pieces.append(piece)
            column += len(piece) + 1
        self._source = " ".join(pieces)

    def read(self) -> _Value:
        """The value of the whole text."""
        try:
            tree = ast.parse(self._source, mode="eval")
            return self._value(tree.body, 0)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise ExpressionError(
                "the expression has too many terms to be read"
            ) from None

    def _value(self, node: ast.expr, depth: int) -> _Value:
        if depth > self._limits.depth:
            raise self._error(node, f"nested deeper than {self._limits.depth}")
        match node:
            case ast.Constant():
                return self._number(node)
            case ast.Name():
                return self._name(node)
            case ast.UnaryOp(op=ast.UAdd() | ast.USub(), operand=operand):
                value = self._value(operand, depth + 1)
                if isinstance(node.op, ast.UAdd):
                    return value
                return (
                    negate_vector(value) if isinstance(value, tuple) else negate(value)
                )
            case ast.BinOp(op=ast.Add() | ast.Sub()):
                return self._sum(node, depth)
            case ast.BinOp(op=ast.Mult() | ast.Div()):
                return self._product(node, depth)
            case ast.BinOp(op=ast.Pow()):
                return self._power(node, depth)
            case ast.Call(func=ast.Name(), keywords=[]):
                return self._call(node, depth)
        raise self._error(node, "this is not in the grammar")

    def _number(self, node: ast.Constant) -> Expression:
        token = self._token(node)
        mantissa, _, shift = token.text.lower().partition("e")
        digits = sum(character.isdigit() for character in mantissa)
        # The length comes first: a long exponent must not be turned into an integer.
        if (
            digits > self._limits.digits
            or len(shift) > 4
            or abs(int(shift or 0)) > self._limits.digits
        ):
            raise self._error(
                node,
                f"{shown(token.text)} has more than {self._limits.digits} digits",
            )
        return Number(Fraction(token.text))

    def _name(self, node: ast.Name) -> _Value:
        name = self._token(node).text
        if name == "pi":
            return Pi()
        if name in _FUNCTIONS:
            raise self._error(node, f"{name!r} is a function: write {name}(…)")
        if name in self._vectors:
            return self._vectors[name]
        if self._names is None:
            if reason := why_no_symbol(name):
                raise self._error(node, reason)
        elif name not in self._names:
            known = {*self._names, *self._vectors, "pi"}
            raise self._error(
                node, f"unknown name {shown(name)}{did_you_mean(name, known)}"
            )
        return Symbol(name)

    def _sum(self, node: ast.BinOp, depth: int) -> _Value:
        terms = []
        for operator, operand in _chain(node, (ast.Add, ast.Sub)):
            value = self._value(operand, depth + 1)
            if isinstance(operator, ast.Sub):
                value = (
                    negate_vector(value) if isinstance(value, tuple) else negate(value)
                )
            terms.append(value)
        if all(isinstance(term, tuple) for term in terms):
            return self._guarded_vector(node, add_vectors(*_vectors(terms)))
        if any(isinstance(term, tuple) for term in terms):
            raise self._error(node, "a number and a vector cannot be added")
        return self._guarded(node, add(*_scalars(terms)))

    def _product(self, node: ast.BinOp, depth: int) -> _Value:
        above: list[Expression] = []
        below: list[Expression] = []
        vector: VectorExpression | None = None
        for operator, operand in _chain(node, (ast.Mult, ast.Div)):
            value = self._value(operand, depth + 1)
            if isinstance(operator, ast.Div):
                if isinstance(value, tuple):
                    raise self._error(operand, "nothing can be divided by a vector")
                if isinstance(value, Number):
                    above.append(self._inverse(operand, value))
                else:
                    below.append(value)
            elif not isinstance(value, tuple):
                above.append(value)
            elif vector is None:
                vector = value
            else:
                raise self._error(
                    operand, "two vectors: write dot(a, b) or cross(a, b)"
                )
        factor = multiply(*above)
        if below:
            factor = quotient(factor, multiply(*below))
        if vector is None:
            return self._guarded(node, factor)
        return self._guarded_vector(node, scale_vector(factor, vector))

    def _inverse(self, node: ast.expr, value: Number) -> Expression:
        if not value.value:
            raise self._error(node, "division by zero")
        return Number(1 / value.value)

    def _power(self, node: ast.BinOp, depth: int) -> Expression:
        base = self._value(node.left, depth + 1)
        exponent = self._value(node.right, depth + 1)
        if isinstance(base, tuple):
            raise self._error(node.left, "a vector has no powers: write dot(a, a)")
        if not isinstance(exponent, Number) or exponent.value.denominator != 1:
            raise self._error(
                node.right, "an exponent is an integer; for roots write sqrt(x)"
            )
        size = exponent.value.numerator
        if stacked(base) * abs(size) > self._limits.exponent:
            raise self._error(
                node.right,
                f"exponents, stacked ones multiplied, go up to {self._limits.exponent}",
            )
        if isinstance(base, Number):
            if size < 0:
                self._inverse(node.left, base)
            if bits(base.value) * abs(size) > 2 * self._limits.bits:
                raise self._too_many_bits(node)
        return self._guarded(node, power(base, size))

    def _call(self, node: ast.Call, depth: int) -> _Value:
        name = self._token(node.func).text
        arity = _FUNCTIONS.get(name)
        if arity is None:
            raise self._error(node.func, self._no_function(name))
        if len(node.args) != arity:
            raise self._error(
                node.func, f"{name} takes {_counted(arity)}, not {len(node.args)}"
            )
        values = [self._value(argument, depth + 1) for argument in node.args]
        if name in VECTOR_FUNCTIONS:
            if not all(isinstance(value, tuple) for value in values):
                raise self._error(node.func, f"{name} takes two vectors")
            left, right = _vectors(values)
            if name == "dot":
                product = dot(left, right)
                self._check_size(node, leaves(product))
                return self._guarded(node, product)
            return self._guarded_vector(node, cross(left, right))
        if any(isinstance(value, tuple) for value in values):
            raise self._error(node.func, f"{name} takes numbers, not vectors")
        arguments = _scalars(values)
        self._check_domain(node, name, arguments)
        return call(cast(FunctionName, name), *arguments)

    def _no_function(self, name: str) -> str:
        if self._names is not None and name in self._names:
            return f"{name!r} is no function; write {name}*(…) for a product"
        allowed = ", ".join(_FUNCTIONS)
        return (
            f"unknown function {shown(name)}{did_you_mean(name, _FUNCTIONS)}; "
            f"allowed: {allowed}"
        )

    def _check_domain(
        self, node: ast.Call, name: str, arguments: list[Expression]
    ) -> None:
        first = arguments[0]
        if not isinstance(first, Number):
            return
        if name == "sqrt" and first.value < 0:
            raise self._error(node.func, "the root of a negative number is not real")
        if name in {"asin", "acos"} and abs(first.value) > 1:
            raise self._error(
                node.func, f"{name} takes numbers from -1 to 1, not {first.value}"
            )
        if name == "atan2" and not first.value and arguments[1] == first:
            raise self._error(node.func, "atan2(0, 0) has no value")

    def _guarded(self, node: ast.expr, value: Expression) -> Expression:
        parts = children(value) if isinstance(value, Sum | Product) else (value,)
        for part in parts:
            if isinstance(part, Number) and bits(part.value) > self._limits.bits:
                raise self._too_many_bits(node)
        return value

    def _guarded_vector(
        self, node: ast.expr, value: VectorExpression
    ) -> VectorExpression:
        for coordinate in value:
            self._guarded(node, coordinate)
        self._check_size(node, sum(leaves(coordinate) for coordinate in value))
        return value

    def _check_size(self, node: ast.expr, leaves: int) -> None:
        if leaves > self._limits.leaves:
            raise self._error(node, "products of vectors grow too large here")

    def _too_many_bits(self, node: ast.expr) -> ExpressionError:
        return self._error(
            node, f"a constant folds to more than {self._limits.bits} bits"
        )

    def _token(self, node: ast.expr) -> Token:
        return self._tokens[node.col_offset]

    def _error(self, node: ast.expr, message: str) -> ExpressionError:
        return ExpressionError(message, self._token(node).position)


_PLACEHOLDERS: Final = {"number": "1", "name": "n"}
_OPERATORS: Final = {
    **{symbol: symbol for symbol in ("+", "-", "*", "/", "**", "(", ")", ",")},
    "^": "**",
}


def _chain(
    node: ast.BinOp, operators: tuple[type[ast.operator], ...]
) -> list[tuple[ast.operator | None, ast.expr]]:
    """The operands of ``a ∘ b ∘ c`` from the left, each with the operator before it.

    A loop, because a sum of a thousand terms is a tree a thousand deep.
    """
    links: list[tuple[ast.operator | None, ast.expr]] = []
    left: ast.expr = node
    while isinstance(left, ast.BinOp) and isinstance(left.op, operators):
        links.append((left.op, left.right))
        left = left.left
    links.append((None, left))
    return links[::-1]


def _vectors(values: list[_Value]) -> list[VectorExpression]:
    return [value for value in values if isinstance(value, tuple)]


def _scalars(values: list[_Value]) -> list[Expression]:
    return [value for value in values if not isinstance(value, tuple)]


def _counted(arity: int) -> str:
    return "one argument" if arity == 1 else f"{arity} arguments"
