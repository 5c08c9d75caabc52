"""Whether weights are what they must be: symmetric and positive definite.

Decided exactly where the entries are rational at the values of the file; a weight with
roots in it is tried in floating point and refused only where it clearly fails.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Final

from screwkit.algebra.expression import Expression
from screwkit.algebra.rational_values import rational_value
from screwkit.mechanism.graph import holding_joints
from screwkit.mechanism.model import Mechanism
from screwkit.mechanism.nodes import Path
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.structure import Draft
from screwkit.mechanism.vanishing import value_at

_CLEARLY: Final = Fraction(1, 10**9)
"""Relative size beyond which floating point leaves no doubt."""


def check_weights(mechanism: Mechanism, draft: Draft, reading: Reading) -> None:
    """Faults of weights that are read, each at its key."""
    if draft.broken & {"joints", "links", "base", "platform"} or draft.lost_joints:
        return
    values = {p.name: p.value for p in mechanism.parameters if p.value is not None}
    for key, rows in mechanism.weights.items():
        path: Path = ("weights", key)
        if key == "contact_forces" and not _fits(mechanism, len(rows), path, reading):
            continue
        fault = weight_fault(rows, values)
        if fault is not None:
            place, words = fault
            reading.fault((*path, *place), words)


def _fits(mechanism: Mechanism, size: int, path: Path, reading: Reading) -> bool:
    held = holding_joints(mechanism)
    each = 3 if mechanism.space == "planar" else 6
    if size == each * len(held):
        return True
    places = f" ({', '.join(held)})" if held else ""
    reading.fault(
        path,
        f"{each * len(held)} entries are expected, not {size}: {each} for each of the "
        f"{len(held)} contacts with the platform{places}, forces before moments",
    )
    return False


def weight_fault(
    rows: Sequence[Sequence[Expression]], values: Mapping[str, Expression]
) -> tuple[Path, str] | None:
    """Where and why a matrix is no weight at these values; None where it is one.

    Args:
        rows: Of a square matrix.
        values: Of its symbols; one without a value leaves the question open.
    """
    found = [[value_at(x, values) for x in row] for row in rows]
    numbers = [[x for x in row if x is not None] for row in found]
    size = len(rows)
    if any(len(row) < size for row in numbers):
        return None
    exact = all(rational_value(x) is not None for row in numbers for x in row)
    table = [[_value(x) for x in row] for row in numbers]
    for i in range(size):
        for j in range(i):
            if _apart(table[i][j], table[j][i], exact=exact):
                return (
                    (i, j),
                    f"the weight is not symmetric: row {i + 1}, column {j + 1} differs "
                    f"from row {j + 1}, column {i + 1}",
                )
    failed = _first_bad_pivot(table, exact=exact)
    if failed is None:
        return None
    diagonal = all(not table[i][j] for i in range(size) for j in range(size) if i != j)
    if diagonal:
        return (failed,), f"entry {failed + 1} of a weight must be positive"
    return (
        (),
        f"the weight is not positive definite: its leading {failed + 1} by "
        f"{failed + 1} part has a determinant that is not positive",
    )


def _apart(a: Fraction, b: Fraction, *, exact: bool) -> bool:
    return a != b if exact else abs(a - b) > _CLEARLY * (abs(a) + abs(b))


def _first_bad_pivot(table: Sequence[Sequence[Fraction]], *, exact: bool) -> int | None:
    """The first pivot of Gaussian elimination that is not positive."""
    left = [list(row) for row in table]
    for k in range(len(left)):
        pivot = left[k][k]
        least = 0 if exact else -_CLEARLY * abs(table[k][k])
        if pivot <= least:
            return k
        if not pivot:
            return None  # rounding hides the answer
        for i in range(k + 1, len(left)):
            factor = left[i][k] / pivot
            left[i] = [x - factor * y for x, y in zip(left[i], left[k], strict=True)]
    return None


def _value(value: Expression) -> Fraction:
    """The number, or a float that is near it."""
    known = rational_value(value)
    if known is not None:
        return known
    from screwkit.algebra.batch import BatchRing  # noqa: PLC0415 -- loads numpy
    from screwkit.algebra.evaluation import evaluate  # noqa: PLC0415

    return Fraction(float(evaluate(value, BatchRing({}))))
