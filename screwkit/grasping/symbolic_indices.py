"""Indices in symbols: the polynomial whose roots are the values, where it is short.

On the basis of coordinated motions the index is stationary where a determinant
vanishes that is polynomial in the value x and in the symbols of the file:

    det [x M_qq − N_uu   x M_qr   N_ui]
        [x M_rq          x M_rr   0   ]  =  0,
        [N_iu            0       −N_ii]

with the actuated part in the metric of the rates, the object's in that of twists, r
redundant and i indeterminate motions: their Schur complements are the least values.

References: [BicchiPrattichizzo] eqs. (12), (13).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Final

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.minors import determinant
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.grasping.matrices import GraspMatrices
from screwkit.grasping.partition import Blocks
from screwkit.grasping.symbolic_blocks import VALUE, GraspFamily, Vector
from screwkit.mechanism.model import Mechanism
from screwkit.screw.nullspace import shortened

MOST: Final = 2
"""Coordinated motions up to which it is tried."""

TERMS: Final = 24
"""Terms of the whole polynomial up to which it counts as short."""

_VALUE_NAMES: Final = ("x", "lambda", *(f"lambda{k}" for k in range(1, 1000)))
"""From these the value takes the first that is no symbol."""

ENTRIES: Final = 60
"""Terms of the basis vectors together up to which it is tried."""


def value_name(names: Collection[str]) -> str:
    """What the value is called in a polynomial beside symbols of these names.

    >>> value_name(["L"]), value_name(["x", "y"])
    ('x', 'lambda')
    """
    return next(name for name in _VALUE_NAMES if name not in names)


def kinematic_polynomial(family: GraspFamily, called: str) -> str:
    """The polynomial of the kinematic index, or an empty text.

    Args:
        family: The grasp with its symbols; weights may contain them.
        called: The name of the value, which is none of the symbols.
    """
    mechanism, blocks = family.mechanism, family.blocks
    count = blocks.dimension("apo_c") + blocks.dimension("ao_c")
    if not 0 < count <= MOST:
        return ""
    (ring, matrices), vectors = family.matrices, family.vectors
    if any(vector is None for own in vectors.values() for vector in own):
        return ""
    system = _determinant(mechanism, ring, matrices, vectors, blocks)
    if system is None:
        return ""
    index = ring.symbol_indices()[ring.symbols.index(VALUE)]
    coefficients = _by_power(ring, system, index)
    coefficients = list(shortened(ring, coefficients[::-1]))[::-1]
    while coefficients and coefficients[0] == 0:
        coefficients = coefficients[1:]
    if sum(len(c) for c in coefficients) > TERMS:
        return ""
    return _written(ring, coefficients, called)


def _determinant(
    mechanism: Mechanism,
    ring: TrigonometricRing,
    matrices: GraspMatrices[Polynomial],
    vectors: Mapping[str, Sequence[Vector | None]],
    blocks: Blocks,
) -> Polynomial | None:
    def part(names: Sequence[str], where: slice) -> list[Vector]:
        return [v[where] for name in names for v in vectors[name] if v is not None]

    rates = slice(0, blocks.actuated)
    twist = slice(blocks.actuated + blocks.passive, None)
    moving = ("apo_c", "ao_c")
    q, r = part(moving, rates), part(("a_r", "ap_c"), rates)
    u, i = part(moving, twist), part(("po_i", "o_i"), twist)
    if sum(len(x) for v in (*q, *r, *u, *i) for x in v) > ENTRIES:
        return None
    metric_q = _rates_metric(mechanism, ring, matrices)
    metric_u = _metric(mechanism, ring, "twist", matrices.twist_size)
    if metric_q is None:
        return None
    x = ring.symbol(VALUE)
    sizes = len(q), len(r), len(i)
    total = sum(sizes)
    table = [[ring.zero] * total for _ in range(total)]
    first = [*q, *r]
    for a, left in enumerate(first):
        for b, right in enumerate(first):
            table[a][b] = x * _form(ring, left, metric_q, right)
    second = [*u, *i]
    place = [*range(sizes[0]), *range(sizes[0] + sizes[1], total)]
    for a, left in enumerate(second):
        for b, right in enumerate(second):
            value = _form(ring, left, metric_u, right)
            sign = 1 if (a < sizes[0]) != (b < sizes[0]) else -1
            row, column = place[a], place[b]
            table[row][column] = ring.normal(table[row][column] + sign * value)
    columns = [[row[k] for row in table] for k in range(total)]
    found: Polynomial = determinant(ring, columns)
    return found


def _form(
    ring: TrigonometricRing,
    left: Vector,
    metric: Sequence[Sequence[Polynomial]],
    right: Vector,
) -> Polynomial:
    total = ring.zero
    for a, row in zip(left, metric, strict=True):
        if a == 0:
            continue
        for weight, b in zip(row, right, strict=True):
            if weight != 0 and b != 0:
                total = total + ring.normal(a * weight) * b
    return ring.normal(total)


def _metric(
    mechanism: Mechanism, ring: TrigonometricRing, key: str, size: int
) -> list[list[Polynomial]]:
    if key not in mechanism.weights:
        return [
            [ring.one if i == j else ring.zero for j in range(size)]
            for i in range(size)
        ]
    return [[evaluate(x, ring) for x in row] for row in mechanism.weights[key]]


def _rates_metric(
    mechanism: Mechanism, ring: TrigonometricRing, matrices: GraspMatrices[Polynomial]
) -> list[list[Polynomial]] | None:
    """The weight of rates about axes as written; None where it needs roots."""
    size = len(matrices.actuated)
    metric = _metric(mechanism, ring, "rates", size)
    squares = matrices.strokes[:size]
    if all(square == ring.one for square in squares):
        return metric
    if any(metric[i][j] != 0 for i in range(size) for j in range(size) if i != j):
        return None
    for k, square in enumerate(squares):
        metric[k][k] = ring.normal(metric[k][k] * square)
    return metric


def _by_power(
    ring: TrigonometricRing, value: Polynomial, index: int
) -> list[Polynomial]:
    """Coefficients of the powers of one generator, constant term first."""
    degree = value.degrees()[index]
    found: list[dict[tuple[int, ...], object]] = [{} for _ in range(degree + 1)]
    for exponents, coefficient in value.to_dict().items():
        key = tuple(int(e) for e in exponents)
        rest = (*key[:index], 0, *key[index + 1 :])
        found[key[index]][rest] = coefficient
    return [ring.context.from_dict(terms) for terms in found]


def _written(
    ring: TrigonometricRing, coefficients: Sequence[Polynomial], called: str
) -> str:
    parts: list[tuple[str, str]] = []
    for power in range(len(coefficients) - 1, -1, -1):
        value = coefficients[power]
        if value == 0:
            continue
        written = text(ring, value)
        variable = "" if not power else called if power == 1 else f"{called}^{power}"
        sign = "+"
        if len(value) == 1 and written.startswith("-"):
            sign, written = "-", written[1:]
        if variable:
            if len(value) > 1:
                written = f"({written})*{variable}"
            else:
                written = variable if written == "1" else f"{written}*{variable}"
        elif len(value) > 1 and parts:
            written = f"({written})"
        parts.append((sign, written))
    (leading, first), *rest = parts
    start = first if leading == "+" else f"-{first}"
    return start + "".join(f" {sign} {written}" for sign, written in rest)
