"""Whether a branch lies in a known set, proved; and what of it may not.

An equation of the set vanishes on all zeros of the pending conditions where a multiple
of it is a sum of multiples of them, and what it is multiplied with does not vanish.
The zeros of that multiplier are left over.

References: [CoxLittleOShea] §4.4 (ideal quotients), §6.5 (pseudo-division).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from screwkit.algebra.branches import Branch
from screwkit.algebra.division import Divisor
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.points import residue
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.sums_of_conditions import multiplier
from screwkit.algebra.trigonometric import Polynomial


def left_over(
    branch: Branch, known: Iterable[Sequence[Polynomial]]
) -> list[list[Polynomial]] | None:
    """Systems at whose zeros a branch may leave a known set, which holds the rest.

    Args:
        branch: Its points lie in each of these sets.
        known: Equations of each set, in the generators of the whole ring.

    Returns:
        Multipliers, with the pending conditions, in the generators left on the branch;
        an empty list where nothing is left over; None where that was not found.
    """
    values = [v for p in branch.pending for v in (p.value, *p.beside) if v != 0]
    layout = Layout.of(branch.ring)
    halves = HalfAngles(branch.ring, layout)
    divisors = [Divisor(value, branch.ring, halves, layout) for value in values]

    def is_there(value: Polynomial) -> bool:
        return bool(branch.points) and all(
            residue(value, *point) for point in branch.points
        )

    for equations in known:
        multipliers = []
        for equation in equations:
            value = branch.value(equation)
            if value == 0 or any(d.divide(value) is not None for d in divisors):
                continue
            found = multiplier(branch.ring, value, values, is_there)
            if found is None:
                break
            if not found.is_constant():
                multipliers.append(found)
        else:
            return [[one, *values] for one in multipliers]
    return None
