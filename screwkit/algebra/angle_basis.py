"""Basis angles: integer combinations of declared angles, and the way back."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

AngleForm: TypeAlias = tuple[tuple[str, int], ...]


def inverse_forms(
    basis: Sequence[AngleForm],
) -> dict[str, list[tuple[int, int]]]:
    """Each declared angle as an integer combination of basis angles.

    Raises:
        ValueError: If the basis is not unimodular.
    """
    names = sorted({name for form in basis for name, _ in form})
    if len(names) != len(basis):
        raise ValueError("an angle basis needs as many forms as angles")
    column = {name: i for i, name in enumerate(names)}
    size = len(names)
    rows = [
        [Fraction(0)] * size + [Fraction(int(i == j)) for j in range(size)]
        for i in range(size)
    ]
    for i, form in enumerate(basis):
        for name, count in form:
            rows[i][column[name]] += count
    for pivot in range(size):
        chosen = next((r for r in range(pivot, size) if rows[r][pivot]), None)
        if chosen is None:
            raise ValueError("an angle basis must be unimodular")
        rows[pivot], rows[chosen] = rows[chosen], rows[pivot]
        scale = rows[pivot][pivot]
        rows[pivot] = [value / scale for value in rows[pivot]]
        for r in range(size):
            if r != pivot and rows[r][pivot]:
                factor = rows[r][pivot]
                rows[r] = [
                    a - factor * b for a, b in zip(rows[r], rows[pivot], strict=True)
                ]
    result: dict[str, list[tuple[int, int]]] = {}
    for name, i in column.items():
        combination = rows[i][size:]
        if any(value.denominator != 1 for value in combination):
            raise ValueError("an angle basis must be unimodular")
        result[name] = [(j, int(v)) for j, v in enumerate(combination) if v]
    return result
