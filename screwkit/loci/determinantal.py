"""How small the parts can be of a set where limbs become dependent.

Where a matrix of m rows and n columns, of rank r in general, has less, every part of
that set has at most the codimension (m − r + 1)·(n − r + 1).  So has every part of the
set where wrenches of limbs that keep their ranks become dependent, and of the one where
passive twists do: whatever is smaller lies in a part that is not.

References: [EagonNorthcott1962]; [CoxLittleOShea] §9.4 (dimension).
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.branches import Branch
from screwkit.algebra.modular import rank
from screwkit.kinematics.assembly import loop_rows
from screwkit.kinematics.limb_parts import Parts, has_loops, motion_at


def largest_codimension(
    branch: Branch, limbs: Sequence[Parts], height: int, *, within: bool
) -> int | None:
    """Of a part of the set on a branch where limbs are dependent, at most.

    Args:
        branch: Where it is looked for.
        limbs: Parts of each.
        height: Coordinates of a twist.
        within: Look only where the limbs keep their ranks.

    Returns:
        In the whole space; None where it is not known.
    """
    if not branch.points or any(map(has_loops, limbs)):
        return None
    least: list[int] = []
    for point, prime in branch.points:
        motions = [motion_at(limb, height, point, prime) for limb in limbs]
        size = rank(loop_rows([motion.twists for motion in motions]), prime)
        equations = height * (len(limbs) - 1)
        if within:
            # Wrenches are as many as the equations that no twists fulfil of themselves.
            wrenches = sum(height - motion.dimension for motion in motions)
            span = size - equations + wrenches
            least.append((height - span + 1) * (wrenches - span + 1))
        else:
            columns = sum(map(len, limbs))
            least.append((equations - size + 1) * (columns - size + 1))
    return branch.codimension + max(least)
