"""Postures on the branches of a finite motion, and the branches that they tell of.

Points belong to one branch where dimension, loop rank and the motion type of the
platform agree; which joints rest, how the other links move and, for branches of one
dimension, where they leave the posture, tells how many there are of one look.

References: [Mueller2016], [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.branch_walk import VISIBLE, body_systems, twist_systems, walk
from screwkit.finite.exponentials import Stance
from screwkit.finite.local_dimension import Kernel
from screwkit.finite.motion_invariants import EXACT, motion_in_words, runs_straight
from screwkit.finite.posture_model import PostureModel
from screwkit.finite.spanning_forest import Forest

WALKERS = 4
"""Walks along each branch, also of those that look alike."""

PLACES = 6
"""Postures of each branch that are kept."""

INEXACT = 1e-5
"""Largest failure of an invariant on a branch that is shaky wherever one stands."""

TURNING = ("", "planar", "rotation about a fixed point", "Schönflies")
"""Motions in which one point may run along a line although the body is not shifted."""

SAME_LINE = 0.99
"""Smallest cosine between tangents of one branch of one dimension."""


@dataclass(frozen=True)
class FiniteBranch:
    """One of the finite motions that meet at a posture.

    Attributes:
        mobility: The dimension of the branch.
        instantaneous_mobility: Freedoms less loop rank at its points.
        loop_rank: Of J_c at its points.
        redundant_constraints: 6·loops − rank.
        twist_dimension: Of the platform's twist system at its points.
        motion_type: nTmR of that twist system.
        finite_type: nTmR of the twists along the branch itself, fewer where its rank
            never tells its dimension; empty where these are not known.
        couples: Dimension of the pure couples among the platform's constraint wrenches.
        motion: The finite motion of the platform in words; may be empty.
        starts: How many of the starts fell on it.
        ranks_met: The loop ranks seen on the walk along it, ascending.
        modes: How many branches look like this from outside but differ in which joints
            move, in how other links do, or, if of one dimension, in the direction in
            which they leave the posture.
        straight: Joints of the platform whose axis or centre runs along a straight
            line, where the platform moves in one way and is not merely shifted.
        places: Some postures on it.
    """

    mobility: int
    instantaneous_mobility: int
    loop_rank: int
    redundant_constraints: int
    twist_dimension: int
    motion_type: str
    finite_type: str
    couples: int
    motion: str
    starts: int
    ranks_met: tuple[int, ...] = ()
    modes: int = 1
    straight: tuple[str, ...] = ()
    places: Stance | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, eq=False)
class Point:
    """A posture on a branch: which one, and what tells the branch from others."""

    number: int
    kernel: Kernel
    dimension: int
    twists: tuple[int, ...]
    along: tuple[int, ...]
    pattern: tuple[object, ...] = ()
    leaving: int = 0

    @property
    def mode(self) -> tuple[object, ...]:
        """What tells branches of one look."""
        return self.pattern, self.leaving

    @property
    def looks(self) -> tuple[int, int, tuple[int, ...], tuple[int, ...]]:
        """What all points of one branch have in common."""
        return self.dimension, self.kernel.rank, self.twists, self.along


def branches_of(
    forest: Forest,
    stance: Stance,
    points: Sequence[Point],
    random: np.random.Generator,
    marks: Mapping[str, Array],
) -> tuple[FiniteBranch, ...]:
    """One branch for every look of the points and every motion of the platform.

    Args:
        forest: Of the mechanism.
        stance: Closed postures.
        points: What is known of them.
        random: Chooses walks.
        marks: Points of each joint of the platform at the posture of the model.
    """
    found: list[FiniteBranch] = []
    loops = len(forest.closing_joints)
    freedoms = stance.screws.shape[1]
    for looks in sorted({point.looks for point in points}, reverse=True):
        own = [point for point in points if point.looks == looks]
        dimension, rank, (twists, turning), along = looks
        walkers = _representatives(own)
        numbers = np.array([point.number for point in walkers])
        bases = [point.kernel for point in walkers]
        walked = walk(forest, stance.take(numbers), bases, dimension, random)
        exact = EXACT if dimension == freedoms - rank else INEXACT
        groups: dict[tuple[str, tuple[str, ...]], list[Point]] = {}
        for pattern in dict.fromkeys(point.mode for point in walkers):
            chosen = np.array([point.mode == pattern for point in walkers])
            words, straight = "", tuple[str, ...]()
            if forest.platform[0] and walked.taken[chosen].any():
                seen = walked.displacements[:, chosen].reshape(-1, 4, 4)
                words = motion_in_words(seen, exact)
                if dimension == 1 and words in TURNING:
                    straight = _straight(seen, marks, exact)
            alike = [point for point in own if point.mode == pattern]
            groups.setdefault((words, straight), []).extend(alike)
        found.extend(
            FiniteBranch(
                mobility=dimension,
                instantaneous_mobility=freedoms - rank,
                loop_rank=rank,
                redundant_constraints=6 * loops - rank,
                twist_dimension=twists,
                motion_type=kind_of((twists, turning)),
                finite_type=kind_of(along) if along else "",
                couples=3 - turning,
                motion=words,
                starts=len(members),
                ranks_met=walked.ranks,
                modes=len({point.mode for point in members}),
                straight=straight,
                places=stance.take(np.array([p.number for p in members[:PLACES]])),
            )
            for (words, straight), members in groups.items()
        )
    return tuple(found)


def _straight(
    displacements: Array, marks: Mapping[str, Array], tolerance: float
) -> tuple[str, ...]:
    """The marked joints that run along a straight line."""
    return tuple(
        name
        for name, points in marks.items()
        if runs_straight(displacements, points, tolerance)
    )


def marks_of(model: PostureModel) -> dict[str, Array]:
    """Points by which joints of the platform are followed: centres, or two of an axis.

    Joints without a place of their own, and joints to the base, have none.
    """
    marks = {}
    for joint in model.joints:
        ends = joint.parent, joint.child
        if model.platform not in ends or model.base in ends or not len(joint.screws):
            continue
        along, moments = joint.screws[:, :3], joint.screws[:, 3:]
        if joint.ball:
            marks[joint.name] = 0.5 * np.cross(along, moments)[:3].sum(axis=0)[None]
        elif len(along) == 1 and along.any():
            foot = np.cross(along, moments)
            marks[joint.name] = np.concatenate([foot, foot + along])
    return marks


def _representatives(points: Sequence[Point]) -> list[Point]:
    """A few points of each pattern."""
    patterns: dict[tuple[object, ...], list[Point]] = {}
    for point in points:
        patterns.setdefault(point.mode, []).append(point)
    few = 2 if points[0].dimension == 1 else WALKERS
    return [point for alike in patterns.values() for point in alike[:few]]


def directions(tangents: Array) -> list[int]:
    """Numbers that are equal for tangents of one line."""
    kept: list[Array] = []
    numbers = []
    for tangent in tangents:
        alike = [i for i, k in enumerate(kept) if abs(tangent @ k) > SAME_LINE]
        numbers.append(alike[0] if alike else len(kept))
        if not alike:
            kept.append(tangent)
    return numbers


def platform_system(
    forest: Forest, stance: Stance, number: int, basis: Array, visible: float = VISIBLE
) -> tuple[int, ...]:
    """Dimension of the platform's twist system, and of its rotations.

    Args:
        forest: Of the mechanism.
        stance: Closed postures.
        number: Which of them.
        basis: Rates that are possible there, as columns.
        visible: Size of a twist that counts.
    """
    here = stance.take(np.array([number]))
    return tuple(twist_systems(forest, here, basis[None], visible)[0].tolist())


def kind_of(system: tuple[int, ...]) -> str:
    """NTmR of a twist system's dimension and that of its rotations."""
    twists, turning = system
    return f"{twists - turning}T{turning}R"


def pattern_of(
    forest: Forest, stance: Stance, kernels: Sequence[Kernel]
) -> tuple[object, ...]:
    """Which freedoms rest, and the motion type of every link, where most moves.

    Args:
        forest: Of the mechanism.
        stance: Postures of one branch.
        kernels: At each of them.
    """
    rest, systems = np.ones(stance.screws.shape[1], dtype=bool), []
    for number, kernel in enumerate(kernels):
        rest &= np.abs(kernel.basis).max(axis=1, initial=0.0) < VISIBLE
        here = stance.take(np.array([number]))
        systems.append(
            [
                body_systems(forest, here, kernel.basis[None], node)[0]
                for node in forest.nodes.values()
            ]
        )
    most = np.max(np.array(systems), axis=0)
    return (tuple(np.flatnonzero(rest).tolist()), *map(tuple, most.tolist()))
