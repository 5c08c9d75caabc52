"""How the passive joints of a grasp are eliminated at every posture alike.

Rows fall into groups that share passive joints, one for each limb as a rule.  Which
columns are independent and how large every rank is follows from an exact point; at a
posture where less holds, a pivot becomes small and the posture is looked at singly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.modular import independent
from screwkit.grasping.exact_grasp import ExactGrasp, Ranks


@dataclass(frozen=True)
class Group:
    """Rows that share passive joints.

    Attributes:
        rows: Numbers of the rows.
        passive: Numbers of independent passive columns, at most as many.
        actuated: Numbers of the actuated columns that touch them.
    """

    rows: tuple[int, ...]
    passive: tuple[int, ...]
    actuated: tuple[int, ...]


@dataclass(frozen=True)
class Plan:
    """The groups, and the ranks that are generic.

    Attributes:
        driven, moved, both: Ranks of J_a, of Gᵀ and of both together when passive
            joints are eliminated.
    """

    groups: tuple[Group, ...]
    ranks: Ranks
    driven: int
    moved: int
    both: int

    @property
    def coordinated(self) -> int:
        """How many finite values there are."""
        return self.driven + self.moved - self.both


def plan_of(grasp: ExactGrasp) -> Plan:
    """The plan for postures like that of an exact point."""
    split, ranks = grasp.actuated, grasp.ranks
    touching = [
        frozenset(i - split for i, x in enumerate(row) if x and i >= split)
        for row in grasp.j
    ]
    groups = []
    for rows in _together(touching):
        columns = sorted(frozenset().union(*(touching[r] for r in rows)))
        lines = [[grasp.j[r][split + c] for r in rows] for c in columns]
        chosen = tuple(columns[i] for i in independent(lines, grasp.prime))
        actuated = tuple(c for c in range(split) if any(grasp.j[r][c] for r in rows))
        groups.append(Group(tuple(rows), chosen, actuated))
    return plan_with(ranks, tuple(groups))


def plan_with(ranks: Ranks, groups: tuple[Group, ...] = ()) -> Plan:
    """The plan of given ranks; without groups it serves single postures alone."""
    return Plan(
        groups,
        ranks,
        ranks.ap - ranks.p,
        ranks.po - ranks.p,
        ranks.apo - ranks.p,
    )


def _together(touching: list[frozenset[int]]) -> list[list[int]]:
    """Rows joined where they share a column; rows without one stand alone."""
    groups: list[tuple[set[int], list[int]]] = []
    for number, columns in enumerate(touching):
        joined = [group for group in groups if group[0] & columns]
        merged = set(columns).union(*(group[0] for group in joined))
        rows = sorted([number, *(r for group in joined for r in group[1])])
        groups = [group for group in groups if group not in joined]
        groups.append((merged, rows))
    return sorted(rows for _, rows in groups)


def mixing(size: int) -> Array:
    """A fixed orthogonal matrix without zeros: it makes the first rows generic."""
    random = np.random.default_rng(size)
    return np.asarray(np.linalg.qr(random.normal(size=(size, size)))[0])
