"""What happens where singularities meet, where loops tie joint variables together.

Conditions hold at closed postures.  Those of several are taken together with the
closing equations: exact closed postures are found on all of them, or it is proved that
there is none.  Ranks are taken at these postures.

References: [LongCaroKhalil2012] §5.2.1; [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.slopes import slope
from screwkit.algebra.trigonometric import Polynomial
from screwkit.analyses.closed_example import closed_example
from screwkit.analyses.strata_parts import (
    differs,
    expected_state,
    left_side,
    members_of,
)
from screwkit.errors import ExpressionError
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.loci.closed_pieces import closed_on
from screwkit.loci.graph_states import GraphStates
from screwkit.progress import Progress, silent
from screwkit.results.singularities import Component, Singularities
from screwkit.results.solution import Solution
from screwkit.results.strata import Member, PlatformState, Strata, Stratum

TRIED = 60
"""Intersections that are tried."""


@dataclass(frozen=True)
class _Place:
    """A condition, with the components that it is.

    Attributes:
        equations: With their texts and solutions.
        points: Exact closed postures on it.
    """

    equations: tuple[tuple[Polynomial, str, Solution | None], ...]
    points: tuple[tuple[Point, int], ...]
    labels: list[Member]

    @property
    def polynomials(self) -> list[Polynomial]:
        return [polynomial for polynomial, _, _ in self.equations]

    def holds_at(self, point: Point, prime: int) -> bool:
        return not any(residue(p, point, prime) for p in self.polynomials)


@dataclass(frozen=True)
class _Set:
    """Closed postures on the same places, with the same state.

    Attributes:
        places: Numbers of all places that they lie on.
        asked: Of those whose equations led to them.
    """

    places: frozenset[int]
    asked: frozenset[int]
    state: PlatformState
    codimension: int


def tied_strata(
    graph: TiedGraph,
    answer: Singularities,
    together: int,
    progress: Progress = silent,
) -> Strata:
    """Where up to ``together`` components of an answer meet, and what holds there.

    Args:
        graph: The mechanism of the answer.
        answer: Its singularities.
        together: How many components are intersected, at least 1.
        progress: Told about the stage.
    """
    found = _TiedStratification(graph, answer)
    progress("strata", f"{len(found.places)} conditions")
    return found.up_to(together)


class _TiedStratification:
    def __init__(self, graph: TiedGraph, answer: Singularities) -> None:
        scheme = None if answer.actuation is None else answer.actuation.actuated
        self._graph = graph
        self._kept = graph.unknowns_of(scheme or ())
        self._states = GraphStates(graph, scheme)
        self._missing = self._open = self._tried = self._untried = 0
        self.places: list[_Place] = []
        for member, component in members_of(answer):
            self._take(member, component)

    def _take(self, member: Member, component: Component) -> None:
        """A component as a place, or as another name of one that is there."""
        place = self._placed(component)
        if place is None:
            self._missing += 1
            return
        for known in self.places:
            if _is_inside(known, place) and _is_inside(place, known):
                known.labels.append(member)
                return
        place.labels.append(member)
        self.places.append(place)

    def _placed(self, component: Component) -> _Place | None:
        ring = self._graph.framed.ring
        solved = component.solved or (None,) * len(component.equations)
        try:
            equations = tuple(
                (left_side(ring, text), text, solution)
                for text, solution in zip(component.equations, solved, strict=True)
            )
        except (ExpressionError, KeyError):
            return None
        points = closed_on(self._graph, [p for p, _, _ in equations], self._kept).points
        return _Place(equations, points, []) if points else None

    # -- sets ------------------------------------------------------------------------

    def up_to(self, together: int) -> Strata:
        level = [
            one
            for number, place in enumerate(self.places)
            for one in self._sets(place.points, frozenset({number}))
        ]
        found = list(level)
        tried: set[frozenset[int]] = set()
        for _ in range(together - 1):
            lower: list[_Set] = []
            for one in level:
                for number in range(len(self.places)):
                    key = one.asked | {number}
                    if number in one.places or key in tried:
                        continue
                    tried.add(key)
                    fresh = [x for x in self._meet(key) if not _is_among(x, found)]
                    found += fresh
                    lower += fresh
            level = lower
        strata = [self._stratum(one, found) for one in found]
        strata.sort(key=lambda s: (bool(s.around), s.codimension))
        reasons = [*self._reasons()]
        return Strata(
            together=together,
            deepest=self._dimension(self._graph.closed.points, ()),
            generic=self._generic,
            strata=tuple(strata),
            complete=not reasons,
            reason="; ".join(reasons),
        )

    def _meet(self, numbers: frozenset[int]) -> list[_Set]:
        """Closed postures on several places at once."""
        if self._tried >= TRIED:
            self._untried += 1
            return []
        self._tried += 1
        equations = self._equations(numbers)
        there = closed_on(self._graph, equations, self._kept, thorough=True)
        if not there.points and not there.never:
            self._open += 1
        return self._sets(there.points, numbers)

    def _equations(self, numbers: frozenset[int]) -> list[Polynomial]:
        return [p for n in sorted(numbers) for p in self.places[n].polynomials]

    def _sets(
        self, points: Sequence[tuple[Point, int]], asked: frozenset[int]
    ) -> list[_Set]:
        """Exact closed postures on some places by all their places and states."""
        kinds: dict[tuple[frozenset[int], PlatformState], list[tuple[Point, int]]] = {}
        for point in points:
            places = frozenset(
                n for n, place in enumerate(self.places) if place.holds_at(*point)
            )
            kinds.setdefault((places, self._states.at(*point)), []).append(point)
        return [
            _Set(places, asked, state, self._codimension(own, places))
            for (places, state), own in kinds.items()
        ]

    @cached_property
    def _generic(self) -> PlatformState:
        states = [self._states.at(*point) for point in self._graph.closed.points]
        return max(states, key=lambda s: (s.limb_ranks, -s.mobility))

    # -- dimensions ------------------------------------------------------------------

    def _codimension(
        self, points: Sequence[tuple[Point, int]], places: frozenset[int]
    ) -> int:
        """Among closed postures, by tangents: it may be more."""
        whole = self._dimension(self._graph.closed.points, ())
        return max(1, whole - self._dimension(points, self._equations(places)))

    def _dimension(
        self, points: Sequence[tuple[Point, int]], equations: Sequence[Polynomial]
    ) -> int:
        """Of the tangents at the most regular of some exact closed postures."""
        ring, wanted = self._graph.framed.ring, (*self._graph.closing, *equations)
        slopes = [[slope(ring, e, u) for u in self._joints] for e in wanted]
        ranks = (
            rank([[residue(x, *point) for x in row] for row in slopes], point[1])
            for point in points
        )
        return len(self._joints) - max(ranks)

    @cached_property
    def _joints(self) -> tuple[Unknown, ...]:
        """The joint variables by which loops close."""
        ring, fixed = self._graph.framed.ring, self._graph.unknowns_of(())
        met = (u for e in self._graph.closing for u in unknowns(ring, e))
        return tuple(dict.fromkeys(u for u in met if u not in fixed))

    # -- words -----------------------------------------------------------------------

    def _stratum(self, one: _Set, found: Sequence[_Set]) -> Stratum:
        itself = self._itself(one)
        around = [n for n in sorted(one.places) if self.places[n] is not itself]
        wide = [
            n
            for n in around
            if not any(
                m != n and _is_inside(self.places[n], self.places[m]) for m in around
            )
        ]
        equations = [self.places[n] for n in wide] if itself is None else [itself]
        written = {e[1]: e for place in equations for e in place.equations}.values()
        alike = [x for x in found if x.places == one.places]
        expected = None
        if wide:
            alone = [self._general(n, found) for n in wide]
            expected = expected_state(self._states.size, self._generic, alone)
        polynomials = [polynomial for polynomial, _, _ in written]
        posture = closed_example(self._graph, polynomials)
        return Stratum(
            members=tuple(m for n in sorted(one.places) for m in self.places[n].labels),
            itself=tuple(itself.labels) if itself is not None else (),
            around=tuple(self.places[n].labels[0] for n in wide),
            equations=tuple(text for _, text, _ in written),
            extra=(),
            solved=tuple(solution for _, _, solution in written),
            codimension=one.codimension,
            state=one.state,
            expected=expected,
            differs=expected is not None and differs(one.state, expected),
            holds="undecided" if len(alike) == 1 else "generally",
            real="met" if posture else "undecided",
            # Where states differ it is not known whose it is.
            posture=(posture or ()) if len(alike) == 1 else (),
        )

    def _itself(self, one: _Set) -> _Place | None:
        """The place that is this very set: all others of the set are around it."""
        for n in sorted(one.places):
            place = self.places[n]
            if all(m == n or _is_inside(place, self.places[m]) for m in one.places):
                return place
        return None

    def _general(self, number: int, found: Sequence[_Set]) -> PlatformState:
        """What holds on a place in general: where it lies on the fewest others."""
        own = [one for one in found if number in one.places and number in one.asked]
        return min(own, key=lambda one: len(one.places)).state

    def _reasons(self) -> Iterator[str]:
        if self._missing:
            noun = "condition has" if self._missing == 1 else "conditions have"
            yield f"{self._missing} {noun} no exact closed posture"
        if self._open:
            noun = "intersection" if self._open == 1 else "intersections"
            yield f"whether closed postures meet {self._open} {noun} was not decided"
        if self._untried:
            yield f"{self._untried} intersections beyond {TRIED} not tried"


def _is_inside(inner: _Place, outer: _Place) -> bool:
    return all(outer.holds_at(*point) for point in inner.points)


def _is_among(one: _Set, found: Sequence[_Set]) -> bool:
    """Whether postures on the same places with the same state are known."""
    return any(x.places == one.places and x.state == one.state for x in found)
