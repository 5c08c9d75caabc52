"""Sheets on which all limbs have the same twists up to sign: one of each is searched.

A condition that is solved may have two sheets, θ = 0 and θ = π.  Where the other
conditions and the twists of all limbs are the same on both, up to sign, everything
about them is the same.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.limb_parts import Parts, columns_of


@dataclass
class AlikeSheets:
    """Branches that were searched, and the sheets that are like them.

    Attributes:
        signatures: The first branch of each kind.
        alike: It, and another one of its kind.
    """

    signatures: dict[str, Branch] = field(default_factory=dict)
    alike: list[tuple[Branch, Branch]] = field(default_factory=list)

    def has_like(
        self, branch: Branch, limbs: Sequence[Parts], elsewhere: Collection[str]
    ) -> bool:
        """Whether a branch is like one that was asked about before.

        Args:
            branch: A sheet of some conditions.
            limbs: Parts of each limb.
            elsewhere: Equations of the sets on it that are left to other searches: the
                same branch with fewer of them has not been searched.
        """
        conditions = sorted(str(condition) for condition in branch.conditions)
        columns = [
            [str(_up_to_sign(branch.column(column))) for column in columns_of(limb)]
            for limb in limbs
        ]
        pending = [str(p.value) for p in branch.pending]
        signature = f"{conditions}{columns}{pending}{sorted(elsewhere)}"
        other = self.signatures.setdefault(signature, branch)
        if other is branch:
            return False
        self.alike.append((other, branch))
        return True

    def others(self, branches: Sequence[Branch]) -> list[Branch]:
        """Branches again, below the sheets that were not searched."""
        copies: list[Branch] = []
        waiting = list(branches)
        while waiting:
            branch = waiting.pop()
            for searched, other in self.alike:
                depth = len(searched.steps)
                if branch.steps[:depth] == searched.steps:
                    steps = (*other.steps, *branch.steps[depth:])
                    copy = replace(branch, steps=steps)
                    if not any(copy.steps == known.steps for known in copies):
                        copies.append(copy)
                        waiting.append(copy)
        return copies


def _up_to_sign(column: Sequence[Polynomial]) -> list[Polynomial]:
    for entry in column:
        if entry != 0:
            if entry.coeffs()[0] < 0:
                return [-value for value in column]
            break
    return list(column)
