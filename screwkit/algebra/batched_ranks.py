"""Ranks of many small integer matrices at once, exact modulo a 31-bit prime.

Elimination without division runs over the whole stack in numpy; products of two
residues fit in 64 bits.  A rank found is a lower bound of the true one, and the true
one with probability above 1 − degree/2³⁰; whoever needs more confirms the deficient.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

BITS: Final = 31  # of the prime; 64-bit products leave no room for more


def batched_ranks(
    rows: Sequence[Sequence[int]], choices: Sequence[Sequence[int]], prime: int
) -> NDArray[np.int64]:
    """Ranks of the matrices made of these choices of rows.

    Args:
        rows: Residues, all of one length.
        choices: Row numbers, all choices of one length.
        prime: Below 2³¹.
    """
    stack = np.array(rows, dtype=np.int64)[np.array(choices, dtype=np.intp)]
    if stack.shape[1] > stack.shape[2]:
        stack = np.ascontiguousarray(stack.transpose(0, 2, 1))
    count, height, width = stack.shape
    each = np.arange(count)
    lines = np.arange(height)
    found = np.zeros(count, dtype=np.int64)
    for column in range(width):
        here = np.minimum(found, height - 1)
        usable = (stack[:, :, column] != 0) & (lines >= found[:, None])
        pivots = usable.any(axis=1)
        chosen = np.where(pivots, usable.argmax(axis=1), here)
        pivot = stack[each, chosen].copy()
        stack[each, chosen] = stack[each, here]
        stack[each, here] = pivot
        below = (lines > here[:, None]) & pivots[:, None]
        lead = np.where(below, pivot[:, column, None], 1)
        taken = np.where(below, stack[:, :, column], 0)
        right = stack[:, :, column:]
        right *= lead[:, :, None]
        right %= prime
        right -= taken[:, :, None] * pivot[:, None, column:] % prime
        right %= prime
        found += pivots & (found < height)
    return found
