"""A closed posture of a table that places a body twice: at 0, near 0, or anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from screwkit.errors import UndecidedError
from screwkit.finite.table_closure import OPEN, close_table, table_misses
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.model import Mechanism

STARTS = 24
"""Random postures from which a closed one is searched."""


@dataclass(frozen=True)
class TableClosure:
    """A posture of a table.

    Attributes:
        values: By joint variable, in radians and file lengths.
        miss: The largest difference of the two places of a body.
        joint: The row that misses most.
    """

    values: Mapping[str, float]
    miss: float
    joint: str

    @property
    def closed(self) -> bool:
        """Whether every body is where all its rows put it."""
        return self.miss <= OPEN

    @property
    def at_zero(self) -> bool:
        """Whether all joint variables are 0."""
        return not any(self.values.values())


def closed_posture(mechanism: Mechanism) -> TableClosure:
    """The posture at 0 if it is closed, else a closed one if any is found.

    Args:
        mechanism: An ``mdh`` mechanism whose symbols all have values.

    Raises:
        UnknownNameError: If a symbol has no value.
    """
    names = mechanism.joint_variables
    best = _at(mechanism, dict.fromkeys(names, 0.0))
    random = np.random.default_rng(0)
    for number in range(STARTS + 1):
        if best.closed:
            break
        start = np.zeros(len(names))
        if number:
            start = random.uniform(-np.pi, np.pi, len(names))
        guess = dict(zip(names, map(float, start), strict=True))
        try:
            return _at(mechanism, close_table(mechanism, guess))
        except (UndecidedError, np.linalg.LinAlgError):
            best = min(best, _at(mechanism, guess), key=lambda found: found.miss)
    return best


def _at(mechanism: Mechanism, values: Mapping[str, float]) -> TableClosure:
    misses = table_misses(mechanism, ring_at(mechanism, values))
    sizes = {name: float(np.abs(miss).max()) for name, miss in misses.items()}
    worst = max(sizes, key=sizes.__getitem__)
    return TableClosure(values, sizes[worst], worst)
