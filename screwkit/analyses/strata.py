"""What happens where singularities meet: several limbs, constraint and actuation.

The components of an answer are intersected, and on each irreducible set that is found
the ranks are taken at exact points.  Whether they are the same at all its postures is
decided by looking for where they fall; whether it has a real posture, by a proof that
Newton's method gives.

References: [LongCaroKhalil2012] §5.2.1; [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import Literal

from screwkit.algebra.angle_basis import inverse_forms
from screwkit.algebra.branches import Branch
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.real_point import RealPoint, real_point
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.analyses.strata_parts import (
    differs,
    expected_state,
    left_side,
    members_of,
)
from screwkit.errors import ExpressionError
from screwkit.loci.canonical import in_known_conditions
from screwkit.loci.meetings import Meeting, Meetings, is_inside, recovered, same_set
from screwkit.loci.on_all_places import on_all_places
from screwkit.loci.pieces import Piece
from screwkit.loci.platform_state import States
from screwkit.loci.wording import equations_of, solved_equations
from screwkit.mechanism.model import Mechanism
from screwkit.progress import Progress, silent
from screwkit.results.singularities import Component, Singularities
from screwkit.results.strata import Member, PlatformState, Strata, Stratum

DEEPEST = 4
"""Codimension up to which intersections are looked for."""

TRIED = 400
"""Intersections of two sets that are tried."""

LONGEST = 300
"""Terms of an equation that is intersected."""

EFFORT = 600
"""Case distinctions to tell where ranks fall, on all strata together."""

ON_ONE = 40
"""Of these, on one stratum."""

Holds = Literal["everywhere", "generally", "undecided"]


def strata(
    states: States,
    answer: Singularities,
    together: int,
    progress: Progress = silent,
) -> Strata:
    """Where up to ``together`` components of an answer meet, and what holds there.

    Args:
        states: Of the mechanism of the answer, with its scheme.
        answer: Its singularities.
        together: How many components are intersected, at least 1.
        progress: Told about each stage.
    """
    return _Stratification(states, answer, progress).up_to(together)


class _Stratification:
    """One run: the mechanism, its scheme, its places."""

    def __init__(
        self, states: States, answer: Singularities, progress: Progress
    ) -> None:
        self._progress = progress
        self._root = states.root
        self._search = Search(states.library)
        self._states = states
        self._effort = EFFORT
        self._missing = 0
        self._places: list[Piece] = []
        self._labels: list[list[Member]] = []
        for member, component in members_of(answer):
            self._take(member, component)

    @cached_property
    def _generic(self) -> PlatformState:
        found = self._states.on(self._root)
        assert found is not None
        return found

    def _take(self, member: Member, component: Component) -> None:
        """A component as a place, or as another name of one that is there."""
        piece = self._recovered(component)
        if piece is None:
            self._missing += component.codimension < DEEPEST
            return
        for place, labels in zip(self._places, self._labels, strict=True):
            if same_set(piece, place):
                labels.append(member)
                return
        self._places.append(piece)
        self._labels.append([member])

    def _recovered(self, component: Component) -> Piece | None:
        ring = self._root.ring
        try:
            equations = [left_side(ring, text) for text in component.equations]
        except (ExpressionError, KeyError):
            return None
        if any(len(equation) > LONGEST for equation in equations):
            return None
        return recovered(self._root, equations, component.codimension, self._search)

    def up_to(self, together: int) -> Strata:
        self._progress("strata", f"{len(self._places)} conditions")
        meetings = Meetings(self._search, self._places, DEEPEST, TRIED, self._states.on)
        found = meetings.up_to(together)
        states = [self._state(meeting.piece) for meeting in found]
        strata = [
            self._stratum(number, meeting, found, states)
            for number, meeting in enumerate(found)
        ]
        strata.sort(key=lambda s: (bool(s.around), s.codimension))
        reasons = _reasons(self._missing, meetings)
        return Strata(
            together=together,
            deepest=DEEPEST,
            generic=self._generic,
            strata=tuple(strata),
            complete=not reasons,
            reason="; ".join(reasons),
        )

    def _state(self, piece: Piece) -> PlatformState:
        """Generic on the first sheets; they have points."""
        states = [s for b in piece.branches[:2] if (s := self._states.on(b))]
        return max(states, key=lambda s: (s.limb_ranks, -s.mobility))

    def _stratum(
        self,
        number: int,
        meeting: Meeting,
        found: Sequence[Meeting],
        states: Sequence[PlatformState],
    ) -> Stratum:
        piece, state = meeting.piece, states[number]
        members = tuple(m for n in sorted(meeting.places) for m in self._labels[n])
        wide = sorted(self._widest(meeting))
        expected = None
        if wide:
            alone = [states[n] for n in wide]
            expected = expected_state(self._states.size, self._generic, alone)
        itself = self._labels[number] if number < len(self._places) else []
        if not itself:
            piece = self._in_words_of(piece, [self._places[n] for n in wide])
            around = [self._places[n] for n in sorted(meeting.places)]
            piece = on_all_places(piece, self._root, around, self._search)
        texts = equations_of(piece)
        shown = {text for n in wide for text in equations_of(self._places[n])}
        extra = () if itself else tuple(text for text in texts if text not in shown)
        apart = [
            other.piece.equations
            for other in found
            if not is_inside(meeting.piece, other.piece)
        ]
        real = self._real(meeting.piece, apart)
        return Stratum(
            members=members,
            itself=tuple(itself),
            around=tuple(self._labels[n][0] for n in wide),
            equations=texts,
            extra=extra,
            solved=solved_equations(piece),
            codimension=piece.codimension,
            state=state,
            expected=expected,
            differs=expected is not None and differs(state, expected),
            holds=self._holds(number, found, states),
            real="undecided" if real is None else "proved",
            posture=() if real is None else _posture(self._root.ring, real),
        )

    def _in_words_of(self, piece: Piece, around: Sequence[Piece]) -> Piece:
        """With equations of the sets around it, where these say exactly the same."""
        known = [e.equations[0] for e in around if len(e.equations) == 1]
        return in_known_conditions(piece, self._root, known, self._search)

    def _widest(self, meeting: Meeting) -> list[int]:
        """The places around a set that lie in no other of them; not the set itself."""
        around = [
            n for n in meeting.places if not same_set(self._places[n], meeting.piece)
        ]
        return [
            n
            for n in around
            if not any(
                m != n and is_inside(self._places[n], self._places[m]) for m in around
            )
        ]

    # -- where the state changes ---------------------------------------------------

    def _holds(
        self, number: int, found: Sequence[Meeting], states: Sequence[PlatformState]
    ) -> Holds:
        """Whether the state is the same at all postures of a set."""
        piece, state = found[number].piece, states[number]
        for n, other in enumerate(found):
            deeper = other.piece.codimension > piece.codimension
            if deeper and states[n] != state and is_inside(other.piece, piece):
                return "generally"
        verdict: Holds = "everywhere"
        for branch in piece.branches:
            if self._states.on(branch) != state:
                return "generally"
            one = self._on_branch(branch)
            if one == "generally":
                return one
            if one == "undecided":
                verdict = one
        return verdict

    def _on_branch(self, branch: Branch) -> Holds:
        # Postures at which a divisor vanishes are limits, which no search looks at.
        complete = all(
            branch.assumptions.is_nonzero(branch.ring, step.divisor)
            for step in branch.steps
        )
        for change in self._states.changes(branch, self._next()):
            if change.found:
                return "generally"
            self._effort -= change.cost
            complete = complete and change.ruled_out
        return "everywhere" if complete else "undecided"

    def _next(self) -> Search:
        budget = max(0, min(ON_ONE, self._effort))
        return replace(self._search, found=[], unfinished=[], special=[], budget=budget)

    # -- real postures -------------------------------------------------------------

    def _real(
        self, piece: Piece, apart: Sequence[Sequence[Polynomial]]
    ) -> RealPoint | None:
        given = dict(_dimensions(self._states.mechanism))
        for number, branch in enumerate(piece.branches[:4]):
            found = real_point(branch, given, number, apart, piece.equations)
            if found is not None:
                return found
        return None


def _reasons(missing: int, meetings: Meetings) -> list[str]:
    reasons = []
    if missing:
        noun = "condition is" if missing == 1 else "conditions are"
        reasons.append(f"{missing} {noun} too long to be intersected, or without point")
    if meetings.open:
        reasons.append(f"{meetings.open} intersections could not be taken apart")
    if meetings.untried:
        reasons.append(f"{meetings.untried} intersections beyond {TRIED} not tried")
    return reasons


def _dimensions(mechanism: Mechanism) -> Iterator[tuple[str, Fraction]]:
    """Dimensions at the file's values, or at odd numbers where it gives none."""
    for number, parameter in enumerate(mechanism.parameters):
        if parameter.free:
            continue
        value = None if parameter.value is None else rational_value(parameter.value)
        yield parameter.name, Fraction(7 + 2 * number, 11) if value is None else value


def _posture(
    ring: TrigonometricRing, found: RealPoint
) -> tuple[tuple[str, float], ...]:
    """Declared angles in (−π, π], then the symbols."""
    angles = {
        name: sum(count * found.turns[i] for i, count in combination)
        for name, combination in inverse_forms(ring.basis).items()
    }
    turned = {n: pi - (pi - value) % (2 * pi) for n, value in angles.items()}
    return tuple({**turned, **found.numbers}.items())
