"""Whether an exact rank rests on the last digits of rounded numbers.

A file with decimals is taken at its word: a Bennett linkage written with ten digits is
rigid.  What its author meant shows in the singular values, which are no proof but a
reason to say so.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.exponentials import loop_jacobian, stance_of
from screwkit.finite.posture_model import posture_model, scaled
from screwkit.finite.spanning_forest import forest_of
from screwkit.mechanism.model import Mechanism

LARGEST: Final = 300
"""Freedoms beyond which singular values take too long."""

NEAR: Final = 1e-7
"""Relative size of a singular value that rounding may have left."""


def near_miss(mechanism: Mechanism, rank: int) -> str:
    """What the loops would be up to rounding; empty where the rank is clear.

    Args:
        mechanism: In numbers.
        rank: Of the loop constraint matrix at its posture, exact.
    """
    freedoms = sum(len(joint.variables) for joint in mechanism.joints)
    if not rank or freedoms > LARGEST:
        return ""
    try:
        model = scaled(posture_model(mechanism))
    except (UndecidedError, UnknownNameError):
        return ""
    forest = forest_of(model)
    matrix = loop_jacobian(forest, stance_of(model, forest))[0]
    values = np.linalg.svd(matrix, compute_uv=False)
    sizes = values / values[0]
    meant = int((sizes > NEAR).sum())
    if meant >= rank:
        return ""
    return (
        f"up to the rounding of decimals the loop rank is {meant} and the mobility "
        f"{freedoms - meant} (a singular value is {sizes[meant]:.0e} of the largest); "
        f"the answer is for the numbers as written, exact ones decide what is meant"
    )
