"""A closed posture of a table that places a body twice: at 0, near 0, or anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from screwkit.errors import UndecidedError
from screwkit.finite.exponentials import stance_of
from screwkit.finite.local_dimension import (
    EXACT_CUT,
    Kernel,
    is_regular,
    unclear_rank,
)
from screwkit.finite.loop_split import split_at
from screwkit.finite.posture_model import posture_model, scaled
from screwkit.finite.spanning_forest import forest_of
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
    def refusal(self) -> str:
        """Why it is of no use; empty where it is closed."""
        if self.closed:
            return ""
        return (
            f"no closed posture was found: joint {self.joint!r} misses its body by "
            f"{self.miss:.2g} at best"
        )

    @property
    def at_zero(self) -> bool:
        """Whether all joint variables are 0."""
        return not any(self.values.values())


def closed_posture(mechanism: Mechanism) -> TableClosure:
    """The posture at 0 if it is closed, else a closed one if any is found.

    Of those found the first that is regular is taken: closed postures around it fill
    all dimensions of its rates, so that ranks there are those of its motion.

    Args:
        mechanism: An ``mdh`` mechanism whose symbols all have values.

    Raises:
        UnknownNameError: If a symbol has no value.
    """
    names = mechanism.joint_variables
    best = _at(mechanism, dict.fromkeys(names, 0.0))
    if best.closed:
        return best
    random = np.random.default_rng(0)
    for number in range(STARTS + 1):
        start = np.zeros(len(names))
        if number:
            start = random.uniform(-np.pi, np.pi, len(names))
        guess = dict(zip(names, map(float, start), strict=True))
        try:
            found = _at(mechanism, close_table(mechanism, guess))
            if _is_regular(mechanism, found):
                return found
        except (UndecidedError, np.linalg.LinAlgError):
            found = _at(mechanism, guess)
        if not best.closed:
            best = min(best, found, key=lambda closure: closure.miss)
    return best


def _is_regular(mechanism: Mechanism, found: TableClosure) -> bool:
    model = scaled(posture_model(mechanism, found.values))
    forest = forest_of(model)
    stance = stance_of(model, forest)
    split, values = split_at(forest, stance, cut=float(np.sqrt(np.prod(EXACT_CUT))))
    if unclear_rank(values[0]):
        return False
    kernel = Kernel(split, split.right[0, :, split.rank :])
    return is_regular(forest, stance, kernel, np.random.default_rng(0))


def _at(mechanism: Mechanism, values: Mapping[str, float]) -> TableClosure:
    misses = table_misses(mechanism, ring_at(mechanism, values))
    sizes = {name: float(np.abs(miss).max()) for name, miss in misses.items()}
    worst = max(sizes, key=sizes.__getitem__)
    return TableClosure(values, sizes[worst], worst)
