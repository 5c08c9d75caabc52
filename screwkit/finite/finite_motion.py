"""Full-cycle mobility by sampling: the finite motions that meet at a posture.

Where all loop equations hold on the manifold that as many of them define as the rank
says, the posture is regular and has one branch, of the dimension of the kernel.
Elsewhere starts in many directions find the branches; the dimension of each is counted
independently of the rank, and walks along it tell the motion of the platform.  A
posture that every start returns to is shaky.

References: [Mueller2016], [Hunt1978], [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.branch_search import FARTHEST, NEAREST, starts, wandered
from screwkit.finite.exponentials import Stance, stance_of
from screwkit.finite.finite_branches import (
    FiniteBranch,
    Point,
    branches_of,
    directions,
    marks_of,
    pattern_of,
    platform_system,
)
from screwkit.finite.held_spins import without_idle
from screwkit.finite.idle_freedoms import IdleMotion
from screwkit.finite.local_dimension import (
    EXACT_CUT,
    Kernel,
    around,
    kernels,
    regular_neighbours,
    singular_dimension,
    steady,
    tangents_of,
    unclear_rank,
)
from screwkit.finite.loop_split import Split, split_at
from screwkit.finite.own_frame import in_own_frame
from screwkit.finite.posture_model import PostureModel, scaled, with_locked
from screwkit.finite.spanning_forest import Forest, forest_of

__all__ = ["FiniteBranch", "FiniteMotion", "finite_motion"]

FEW, MANY = 8, 24
"""Starts from a regular posture, and from one that is not."""

PATIENCE = 4
"""How often a start may turn out to stand on a singular posture of its branch."""

WITNESSES = 4
"""At how many singular postures of one rank the dimension is counted."""

CLEAR = (1e-3, 3e-2)
"""Sizes of a platform twist along tangents known from neighbours: none below, one
above, unclear between, as closing to within 1e-12 may leave a double root 1e-6 off."""

DOUBTFUL = 0.2
"""Part of the closed postures that may stay singular without making it all doubtful."""


Generic: TypeAlias = tuple[tuple[int, ...], tuple[int, ...], tuple[object, ...]]
"""The platform's twist system, the one along the branch, and its pattern."""


@dataclass(frozen=True)
class FiniteMotion:
    """The finite motions around a posture, as far as samples tell.

    Attributes:
        status: ``sampled`` or ``undecided``.
        mobility: The dimensions of the branches, ascending; (0,) where nothing moves,
            empty if undecided.
        branches: Largest first; empty where nothing moves.
        reason: What the samples show, or why they show nothing.
        model: What was sampled, in its own lengths; the branches' places are postures
            of it.
    """

    status: str
    mobility: tuple[int, ...]
    branches: tuple[FiniteBranch, ...]
    reason: str
    model: PostureModel | None = field(default=None, compare=False, repr=False)


def finite_motion(
    model: PostureModel,
    *,
    locked: Sequence[str] = (),
    idle: Sequence[IdleMotion] = (),
    seed: int = 0,
) -> FiniteMotion:
    """The finite mobilities around a closed posture, by sampling.

    Args:
        model: At the posture.
        locked: Freedoms held where they are, as `PostureModel.labels` writes them.
        idle: Idle motions that are held, too; branches then have no places.
        seed: Chooses the samples; the same seed gives the same answer.

    Raises:
        UnknownNameError: If ``locked`` names no freedom.
    """
    own = in_own_frame(scaled(with_locked(model, locked)))
    found = _sampled(without_idle(own.model, idle), seed)
    branches = tuple(
        replace(branch, places=own.as_given(branch.places))
        if branch.places is not None and not idle
        else replace(branch, places=None)
        for branch in found.branches
    )
    return replace(found, branches=branches, model=own.given)


def _sampled(model: PostureModel, seed: int) -> FiniteMotion:
    """The same of a model in its own frame and lengths."""
    forest, random = forest_of(model), np.random.default_rng(seed)
    marks = marks_of(model)
    origin = stance_of(model, forest)
    split, values = split_at(forest, origin, cut=float(np.sqrt(np.prod(EXACT_CUT))))
    unclear = unclear_rank(values[0])
    if unclear:
        return FiniteMotion("undecided", (), (), unclear)
    kernel = Kernel(split, steady(split.right[0, :, split.rank :]))
    if not kernel.dimension:
        return FiniteMotion("sampled", (0,), (), "the loop equations leave no motion")
    for scale in (1.0, 0.1):
        distances = scale * np.linspace(NEAREST, FARTHEST, FEW)
        near = around(forest, origin, kernel, distances, random)
        if near.closed.all():
            return _regular(forest, kernel, near.stance, random, marks)
    return _singular(forest, origin, kernel, random, marks)


def _regular(
    forest: Forest,
    kernel: Kernel,
    near: Stance,
    random: np.random.Generator,
    marks: Mapping[str, Array],
) -> FiniteMotion:
    same = np.zeros(len(near), dtype=np.intp)
    points = [
        Point(number, own, kernel.dimension, system, system)
        for number, own in enumerate(kernels(forest, near, kernel.split.take(same)))
        for system in [platform_system(forest, near, number, own.basis)]
    ]
    # Closed around at full dimension means constant rank; only twists may still drop.
    most = max(point.twists for point in points)
    points = [p for p in points if p.twists == most and p.kernel.rank == kernel.rank]
    branches = branches_of(forest, near, points, random, marks)
    words = f"all {len(near)} starts stay closed at the rank of the posture"
    return FiniteMotion("sampled", (kernel.dimension,), branches, words)


def _singular(
    forest: Forest,
    origin: Stance,
    kernel: Kernel,
    random: np.random.Generator,
    marks: Mapping[str, Array],
) -> FiniteMotion:
    found = starts(forest, origin, kernel, MANY, random)
    if not len(found.stance):
        return _nothing_found(found.count, found.collapsed, found.failed)
    split = kernel.split.take(np.zeros(len(found.stance), dtype=np.intp))
    stance, dimensions, known = _settled(forest, found.stance, split, random)
    own = kernels(forest, stance, split)
    dimensions = [
        dimension if kernel.is_clear else None
        for dimension, kernel in zip(dimensions, own, strict=True)
    ]
    unsettled = dimensions.count(None)
    if unsettled > DOUBTFUL * len(dimensions):
        why = (
            f"at {unsettled} of {len(dimensions)} closed postures the rank is unclear, "
            f"or two scales do not agree on the dimension"
        )
        return FiniteMotion("undecided", (), (), why)
    leaving = directions(found.tangents)
    points = [
        Point(
            number,
            own,
            dimension,
            *(
                known.get(number)
                or _singular_one(forest, stance, number, own, dimension, random)
            ),
            leaving[number] if dimension == 1 else 0,
        )
        for number, (own, dimension) in enumerate(zip(own, dimensions, strict=True))
        if dimension is not None
    ]
    points = _alike([p for p in points if p.dimension])
    if not points:
        return _nothing_found(found.count, found.count - found.failed, found.failed)
    branches = branches_of(forest, stance, points, random, marks)
    mobility = tuple(sorted({branch.mobility for branch in branches}))
    words = f"{len(points)} of {found.count} starts lead to closed postures"
    if found.collapsed:
        words += f", {found.collapsed} return to the posture"
    if unsettled:
        words += f", {unsettled} to singular postures"
    return FiniteMotion("sampled", mobility, branches, words)


def _alike(points: Sequence[Point]) -> list[Point]:
    """Points of unknown tangents take those of the branch that they are like else."""
    known: dict[tuple[object, ...], set[tuple[int, ...]]] = {}
    for point in points:
        if point.along:
            known.setdefault(point.looks[:3], set()).add(point.along)
    found = []
    for point in points:
        ways = known.get(point.looks[:3], set())
        lonely = not point.along and len(ways) == 1
        found.append(replace(point, along=next(iter(ways))) if lonely else point)
    return found


def _singular_one(
    forest: Forest,
    stance: Stance,
    number: int,
    kernel: Kernel,
    dimension: int,
    random: np.random.Generator,
) -> Generic:
    """What is so at a posture around which closed ones do not fill the kernel."""
    system = platform_system(forest, stance, number, kernel.basis)
    along = _along(forest, stance, number, kernel, dimension, random)
    here = stance.take(np.array([number]))
    return system, along, pattern_of(forest, here, [kernel])


def _along(
    forest: Forest,
    stance: Stance,
    number: int,
    kernel: Kernel,
    dimension: int,
    random: np.random.Generator,
) -> tuple[int, ...]:
    """The platform's twists along the branch itself; empty where they are not known."""
    here = stance.take(np.array([number]))
    tangents = tangents_of(forest, here, kernel, dimension, random)
    if tangents is None:
        return ()
    small, large = (
        platform_system(forest, stance, number, tangents, size) for size in CLEAR
    )
    return small if small == large else ()


def _settled(
    forest: Forest, stance: Stance, split: Split, random: np.random.Generator
) -> tuple[Stance, list[int | None], dict[int, Generic]]:
    """The postures with the dimension around each, and the platform's system there.

    Where that dimension is below that of the kernel, the posture may just be a singular
    one of its branch: it is moved on before the lower dimension is believed.  Regular
    ones give way to their most general neighbour, as twists may drop there alone.
    """
    known: dict[int, Generic] = {}
    dimensions: list[int | None] = [None] * len(stance)
    left = np.arange(len(stance))
    own: tuple[Kernel, ...] = ()
    for attempt in range(PATIENCE):
        if attempt:
            onward = wandered(forest, stance.take(left), split.take(left), random)
            stance = stance.put(left, onward)
        own = kernels(forest, stance.take(left), split.take(left))
        near = [
            regular_neighbours(forest, stance.take(left[[i]]), kernel, random)
            for i, kernel in enumerate(own)
        ]
        for number, kernel, beside in zip(left, own, near, strict=True):
            if beside is not None:
                dimensions[number] = kernel.dimension
                known[int(number)], best = _generic(forest, beside, kernel)
                onward = beside.take(np.array([best]))
                stance = stance.put(np.array([number]), onward)
        left = left[[beside is None for beside in near]]
        own = tuple(k for k, beside in zip(own, near, strict=True) if beside is None)
        if not len(left):
            break
    for size in {kernel.dimension for kernel in own}:
        alike = [i for i, kernel in enumerate(own) if kernel.dimension == size]
        counts = [
            singular_dimension(forest, stance.take(left[[i]]), own[i], random)
            for i in alike[:WITNESSES]
        ]
        if len(set(counts)) > 1:
            counts += [
                singular_dimension(forest, stance.take(left[[i]]), own[i], random)
                for i in alike[WITNESSES:]
            ]
        if len({count for count in counts if count is not None}) > 1:
            counts = [None]  # of one rank, yet counted differently: not to be trusted
        # Where the first ones agree the others are taken to be of the same sort.
        for place, i in enumerate(alike):
            dimensions[left[i]] = counts[min(place, len(counts) - 1)]
    return stance, dimensions, known


def _generic(forest: Forest, near: Stance, kernel: Kernel) -> tuple[Generic, int]:
    """What is so at the most general of some postures of one branch, and which."""
    split = kernel.split.take(np.zeros(len(near), dtype=np.intp))
    own = kernels(forest, near, split)
    found = [
        platform_system(forest, near, number, k.basis) for number, k in enumerate(own)
    ]
    system = tuple(map(max, zip(*found, strict=True)))
    return (system, system, pattern_of(forest, near, own)), found.index(max(found))


def _nothing_found(count: int, collapsed: int, failed: int) -> FiniteMotion:
    if failed:
        why = f"{failed} of {count} starts did not close and {collapsed} returned"
        return FiniteMotion("undecided", (), (), why)
    why = f"all {count} starts return to the posture"
    return FiniteMotion("sampled", (0,), (), why)
