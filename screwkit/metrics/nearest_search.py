"""The nearest point of a set, looked for in rounds until it is met again and again.

A round walks from the posture in many directions, starts where the conditions nearly
hold on each way, and descends from the nearest points that are come to.  It ends when
the nearest of all was met several times and a whole round found nothing nearer: no
proof, but neither a matter of one lucky start.

References: [RinnooyKanTimmer1987] (multistart from a reduced sample).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.metrics.double_roots import lowest
from screwkit.metrics.nearest_point import Problem, restored
from screwkit.metrics.smooth import Conditions, several
from screwkit.metrics.ways_on_motion import Space, followed, ways_from

WAYS: Final = 16
"""Directions of a round."""

ROUNDS: Final = 6
"""At most so many."""

ROUNDS_OF_NONE: Final = 3
"""At most so many where the conditions are met nowhere."""

ENOUGH: Final = 3
"""How often the nearest point has to be met."""

DESCENTS: Final = 6
"""From how many points of a round the distance descends, the nearest ones, ..."""

OTHERS: Final = 2
"""... and from how many of the rest."""

LOOKED: Final = 20
"""At how many it is looked, once points were met that do not count."""

CLOSER: Final = 4
"""Starts between the posture and the nearest point that was found so far."""

TRIED: Final = 10
"""Points of a round that are looked at one by one, nearest first."""

SAME: Final = 1e-6
"""Difference of coordinates, or of distances, of what counts as met again."""


@dataclass(frozen=True, eq=False)
class Found:
    """A point and how far it is.

    Attributes:
        connected: Whether a way on the motion was followed to it.
    """

    point: Array
    distance: float
    connected: bool


@dataclass(frozen=True, eq=False)
class Outcome:
    """What a search came to.

    Attributes:
        nearest: None where no point was found.
        starts: From how many points it began.
        met: How many of them led to that distance.
    """

    nearest: Found | None
    starts: int
    met: int = 0


class Sample:
    """Points on ways from the posture, round by round, the same for all conditions."""

    def __init__(self, space: Space) -> None:
        self.space = space
        self._rounds: list[Array] = []

    def points(self, number: int) -> Array:
        """Of a round: shape (ways, steps, n); nan behind the end of a way."""
        while len(self._rounds) <= number:
            with np.errstate(all="ignore"):
                ways = ways_from(self.space, WAYS, 1 + len(self._rounds))
            self._rounds.append(ways)
        return self._rounds[number]

    def all(self, number: int = 0) -> Array:
        """The points of a round that exist, the posture first, shape (count, n)."""
        points = self.points(number).reshape(-1, len(self.space.start))
        exist = np.isfinite(points).all(axis=1)
        return np.concatenate([self.space.start[None], points[exist]])


@dataclass
class _Candidate:
    """A point of least distance.

    Attributes:
        begin: A point on the motion that led to it, and to which ways are known;
            None where none is.
        counts: Whether it is what is asked for; None before that is known.
    """

    point: Array
    distance: float
    begin: Array | None
    met: int
    counts: bool | None = None
    connected: bool = False


@dataclass
class _Rounds:
    """A search while it goes on."""

    space: Space
    counts: Callable[[Array], bool]
    found: list[_Candidate] = field(default_factory=list)
    starts: int = 0

    def met(self, point: Array, begin: Array | None, times: int) -> None:
        """Note a point, and how many starts led to it."""
        if self.known(point, times):
            return
        distance = self.space.distance(point)
        self.found.append(
            _Candidate(point, distance, begin, times, connected=not self.space.tied)
        )

    def known(self, point: Array, times: int) -> bool:
        """Whether a point was met before; then it is met so many times more."""
        for one in self.found:
            if _same(one.point, point):
                one.met += times
                return True
        return False

    def promising(self, points: Sequence[Array]) -> list[int]:
        """From which of some points, nearest first, the distance is to descend.

        Where points were met that do not count, others like them are passed over.
        """
        if all(one.counts is not False for one in self.found):
            return list(range(min(DESCENTS, len(points))))
        looked = range(min(LOOKED, len(points)))
        return [i for i in looked if self.counts(points[i])][:DESCENTS]

    def best(self) -> _Candidate | None:
        """The nearest point that counts; if possible one that a way leads to."""
        apart: _Candidate | None = None
        tried = 0
        for one in sorted(self.found, key=lambda one: one.distance):
            if one.counts is None:
                if tried == TRIED:
                    break
                tried += 1
                one.counts = self.counts(one.point)
                if one.counts and not one.connected:
                    one.connected = self._reached(one)
            if one.counts and one.connected:
                return one
            if one.counts and apart is None:
                apart = one
        return apart

    def _reached(self, one: _Candidate) -> bool:
        if one.begin is not None and followed(self.space, one.point, one.begin):
            return True
        return followed(self.space, one.point)

    def how_often(self, best: _Candidate) -> int:
        """How many descents ended at that distance."""
        near = SAME * (1.0 + best.distance)
        return sum(
            one.met for one in self.found if abs(one.distance - best.distance) < near
        )


def nearest(
    sample: Sample,
    conditions: Conditions,
    counts: Callable[[Array], bool],
    others: Sequence[Array] = (),
) -> Outcome:
    """The nearest point where conditions hold.

    Args:
        sample: Points on the motion.
        conditions: What vanishes besides.
        counts: Whether a point where they do is what is asked for.
        others: More points to start from.
    """
    space = sample.space
    parts = [space.kept, conditions] if space.tied else [conditions]
    problem = Problem(space.away, several(parts))
    rounds = _Rounds(space, counts)
    best: _Candidate | None = None
    for number in range(ROUNDS):
        known = [*_nearly(sample, number, conditions)]
        known += others if number == 0 else []
        starts = known + _closer(space, best, number)
        rounds.starts += len(starts)
        with np.errstate(all="ignore"):
            _look(rounds, problem, starts, len(known), number)
            now = rounds.best()
        nearer = now is not best and not (
            now and best and now.distance > best.distance - SAME
        )
        best = now
        if number and best and not nearer and rounds.how_often(best) >= ENOUGH:
            break
        if number + 1 == ROUNDS_OF_NONE and not rounds.found:
            break
    if best is None:
        return Outcome(None, rounds.starts)
    found = Found(best.point, best.distance, best.connected)
    return Outcome(found, rounds.starts, rounds.how_often(best))


def _nearly(sample: Sample, number: int, conditions: Conditions) -> Iterator[Array]:
    """On each way of a round the points where the conditions nearly hold.

    Those where the miss is less than before and behind, the ends of ways included.
    """
    ways = sample.points(number)
    count, steps, n = ways.shape
    flat = ways.reshape(-1, n)
    exist = np.isfinite(flat).all(axis=1)
    sizes = np.full(len(flat), np.inf)
    if exist.any():
        points = flat[exist]
        with np.errstate(all="ignore"):
            misses = conditions.around(points).values(points)
        size = np.linalg.norm(misses, axis=1)
        sizes[exist] = np.where(np.isfinite(size), size, np.inf)
    sizes = np.pad(
        sizes.reshape(count, steps), ((0, 0), (1, 1)), constant_values=np.inf
    )
    here, before, behind = sizes[:, 1:-1], sizes[:, :-2], sizes[:, 2:]
    least = np.isfinite(here) & (here <= before) & (here <= behind)
    yield from ways[least]


def _look(
    rounds: _Rounds,
    problem: Problem,
    starts: Sequence[Array],
    known: int,
    number: int,
) -> None:
    """Bring starts to the conditions, and descend from the nearest that arrive.

    Args:
        rounds: Told what was found.
        problem: What is least where.
        starts: Points.
        known: To how many of them, the first, ways are known.
        number: Of the round.
    """
    if not starts:
        return
    begun = np.array(starts)
    points = restored(problem.equations, begun)
    groups = _groups(points, problem.distances(points))
    left = [own for own in groups if not rounds.known(points[own[0]], len(own))]
    random = np.random.default_rng(number)
    chosen = rounds.promising([points[own[0]] for own in left])
    rest = [i for i in range(len(left)) if i not in chosen]
    chosen += [rest[i] for i in random.permutation(len(rest))[:OTHERS]]
    ends = lowest(problem, points[[left[i][0] for i in chosen]])
    for i, end in zip(chosen, ends, strict=True):
        if np.isfinite(end).all():
            first = min(left[i])
            begin = begun[first] if first < known else None
            rounds.met(end, begin, len(left[i]))


def _groups(points: Array, far: Array) -> list[list[int]]:
    """Starts by the point they came to, the nearest first; without those that failed.

    Args:
        points: Shape (batch, n).
        far: How far each is, shape (batch,); nan where there is none.
    """
    groups: list[list[int]] = []
    for i in map(int, np.argsort(far)):
        if not np.isfinite(far[i]):
            continue
        for own in groups:
            if _same(points[own[0]], points[i]):
                own.append(i)
                break
        else:
            groups.append([i])
    return groups


def _same(one: Array, other: Array) -> bool:
    return bool(np.abs(one - other).max(initial=0.0) < SAME)


def _closer(space: Space, best: _Candidate | None, number: int) -> list[Array]:
    """Starts between the posture and the nearest point that was found so far."""
    if best is None:
        return []
    random = np.random.default_rng(100 + number)
    ways = random.normal(size=(CLOSER, len(best.point)))
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    parts = np.linspace(0.2, 0.9, CLOSER)[:, None]
    points = space.start + parts * (best.point - space.start)
    points += 0.5 * best.distance * ways
    if space.tied:
        points = restored(space.kept, points)
    return [*points[np.isfinite(points).all(axis=1)]]
