"""Random exact postures on the way to a node, rebuilt from the mechanism alone.

Every posture is a point modulo a random prime.  The angles and symbols that the steps
of a way leave free are drawn, the others follow; a condition that was not solved is met
by a root.  At the posture the twists come from the kinematics over residues.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count, islice
from typing import Any
from weakref import WeakKeyDictionary

from screwkit.algebra.angle_basis import inverse_forms
from screwkit.algebra.angle_measures import common_measures
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.dual_point import DualRing
from screwkit.algebra.exact_point import (
    PointRing,
    Turn,
    random_residue,
    random_turn,
    roots_of,
    turn_of,
)
from screwkit.algebra.expression import Number
from screwkit.algebra.modular import ResampleError, prime_for
from screwkit.algebra.survey import SurveyRing
from screwkit.certificates.equations_told import Angles, Step, Unsolved
from screwkit.certificates.records import Part
from screwkit.certificates.root_postures import Roots
from screwkit.certificates.spoken_of import spoken_of
from screwkit.certificates.texts import (
    NoPostureError,
    RefusedError,
    fraction,
    names_in,
    radicands_of,
    read,
)
from screwkit.kinematics.placement import joint_twists, why_tied
from screwkit.kinematics.tied_twists import tied_demands, tied_twists
from screwkit.mechanism.model import Mechanism

POINTS = 2
"""Postures at which an identity is compared."""

CHOICES = 6
"""Angles solved in numbers on one way, each with two solutions, at most."""

_ATTEMPTS = 60
_REMEMBERED = 16


@dataclass(frozen=True)
class Way:
    """What holds at a node: solved equations, and conditions that were not solved."""

    steps: tuple[Step, ...] = ()
    conditions: tuple[str, ...] = ()


class Postures:
    """Draws postures of one mechanism in the terms of one part of a certificate.

    Args:
        mechanism: As read.
        part: Says which frame, which basis angles and which matrix.
        source: Of randomness; whoever wrote the certificate must not know it.

    Attributes:
        declared: Each declared angle as an integer combination of basis angles.
        symbols: What the geometry depends on besides angles.
        divisors: What the geometry divides by.
        radicands: Whose square roots it takes.
        tied: Whether loops tie joint variables together.
        plain: Whether it has no roots of symbols and no angles in numbers.

    Raises:
        RefusedError: If the part does not fit the mechanism.
    """

    def __init__(self, mechanism: Mechanism, part: Part, source: random.Random) -> None:
        self._mechanism = mechanism
        self.part = part
        self._source = source
        self.spoken_of = spoken_of(mechanism, part)
        self._chain = self.spoken_of.chain
        self.tied = bool(why_tied(mechanism))
        seen = SurveyRing()
        if self.tied:
            tied_twists(mechanism, seen, part.origin)
            tied_demands(mechanism, seen)
        else:
            joint_twists(mechanism, seen, part.origin, self._chain)
        radicands = [r.value for r in seen.roots if isinstance(r, Number)]
        self._field = ConstantField.needed_by(radicands, seen.turn)
        roots = [*radicands, *map(Fraction, self._field.primes), *radicands_of(part)]
        self.prime = prime_for(seen.turn, roots, source.randrange(2**60))
        self._measures = common_measures(seen.constant_angles)
        wanted = {*seen.angles, *map(str, self._measures.values)}
        self.declared = _declared(part.angles, wanted)
        self.symbols = tuple(seen.symbols)
        self.divisors, self.radicands = tuple(seen.divisors), tuple(seen.roots)
        self.plain = not seen.constant_angles and all(
            isinstance(root, Number) for root in seen.roots
        )
        self._may_fail = bool(seen.roots or seen.divisors or part.scales)
        self._roots = Roots(self.prime, source)
        self._first: PointRing | None = None
        self._first = self._drawn()
        self._known: dict[tuple[Step, ...], list[tuple[PointRing, PointRing]]] = {}
        self._twists = WeakKeyDictionary[PointRing, Mapping[str, tuple[Any, ...]]]()

    def several(self, way: Way) -> list[PointRing]:
        """Random postures that the steps of a way admit, with every choice in numbers.

        Raises:
            RefusedError: If none is found in many attempts, or there are many choices.
        """
        return [*islice(self.on(Way(way.steps)), self._enough(way))]

    def several_before(self, way: Way) -> list[PointRing]:
        """Random points whose images under `moved` are such postures.

        Raises:
            RefusedError: If none is found in many attempts, or there are many choices.
        """
        return [*islice(self.drawn_before(Way(way.steps)), self._enough(way))]

    def _enough(self, way: Way) -> int:
        choices = sum(step.kind == "numbers" for step in way.steps)
        if choices > CHOICES:
            raise RefusedError("too many angles are solved in numbers")
        return max(POINTS, int(2**choices))

    def on(self, way: Way, roots: Sequence[Unsolved] = ()) -> Iterator[PointRing]:
        """Random postures that the steps of a way and some conditions admit.

        Raises:
            RefusedError: If none is found in many attempts.
        """
        return (there for _, there in self._drawings(way, roots))

    def drawn_before(
        self, way: Way, roots: Sequence[Unsolved] = ()
    ) -> Iterator[PointRing]:
        """Random points whose images under `moved` are postures of the way.

        Raises:
            RefusedError: If none is found in many attempts.
        """
        return (before for before, _ in self._drawings(way, roots))

    def meeting(
        self, way: Way, roots: Sequence[Unsolved]
    ) -> Iterator[tuple[PointRing, PointRing]]:
        """Points before and after the steps at which all conditions of a way hold.

        A condition without a root of its own may hold at some roots of the others.

        Raises:
            RefusedError: If some condition holds at none of many.
        """
        conditions = [read(text) for text in way.conditions]
        missed = 0
        for before, there in self._drawings(way, roots):
            if all(there.value(condition) == 0 for condition in conditions):
                yield before, there
                continue
            missed += 1
            if missed > _ATTEMPTS:
                raise RefusedError("a condition holds at no root of the others")

    def _drawings(
        self, way: Way, roots: Sequence[Unsolved]
    ) -> Iterator[tuple[PointRing, PointRing]]:
        """Points before and after the steps; the same again for the same steps.

        Whoever wrote the certificate knows none of them, so that one set of points
        serves all questions about a way.  Where a step leaves a choice between two
        solutions the drawings take one after the other.
        """
        if roots or any(step.kind == "numbers" for step in way.steps):
            for number in count():
                yield self._drawing(way, roots, number)
        known = self._known.pop(way.steps, [])
        self._known[way.steps] = known
        if len(self._known) > _REMEMBERED:
            del self._known[next(iter(self._known))]
        for number in count():
            if number == len(known):
                known.append(self._drawing(way, (), 0))
            yield known[number]

    def _drawing(
        self, way: Way, roots: Sequence[Unsolved], sheet: int
    ) -> tuple[PointRing, PointRing]:
        for _ in range(_ATTEMPTS):
            try:
                before = self._drawn()
                before.sheet = sheet
                for angle, turn in self._in_numbers(before, way):
                    before = before.changed(angle, turn)
                before = self._roots.met(before, roots)
                there = self.moved(before, way)
                if self._may_fail:  # where the geometry's roots exist all others do
                    self.twists(there)
            except (ResampleError, ZeroDivisionError):
                continue
            return before, there
        raise NoPostureError("no exact posture was found where one is claimed")

    def unknowns_of(self, texts: Sequence[str], way: Way) -> list[int | str]:
        """Basis angles and symbols on which expressions may depend after the steps."""
        told = [t for step in way.steps for t in _told(step)]
        names = {n for text in (*texts, *told) for n in names_in(text)}
        angles = {k for n in names & {*self.declared} for k in self.declared[n]}
        return [*sorted(angles), *(n for n in self.symbols if n in names)]

    def bearing_on(self, text: str, way: Way) -> Way:
        """Those steps of a way by which the value of an expression may change."""
        if any(step.kind == "numbers" for step in way.steps):
            return way  # a point tells their choices by their order
        met = self._moved_by(names_in(text))
        steps = []
        for step in way.steps:  # the first is the last that is followed
            if (step.symbol if step.kind == "symbol" else step.angle) in met:
                steps.append(step)
                for own in _told(step):
                    met |= self._moved_by(names_in(own))
        return Way(tuple(steps))

    def _moved_by(self, names: frozenset[str]) -> set[int | str]:
        """The basis angles and symbols by which names have their values."""
        angles = (k for name in names & {*self.declared} for k in self.declared[name])
        return {*names, *angles}

    def another(self) -> PointRing:
        """A random point that was not drawn before.

        Raises:
            RefusedError: If none is found in many attempts.
        """
        return self._drawing(Way(), (), 0)[0]

    def turn(self) -> Turn:
        """A random point of the circle."""
        return random_turn(self._source, self.prime)

    def _drawn(self) -> PointRing:
        p, source = self.prime, self._source
        return PointRing(
            p,
            self._field,
            self.declared,
            [random_turn(source, p) for _ in self.part.angles],
            {name: random_residue(source, p) for name in self.symbols},
            self._first,
            self._measures,
        )

    def moved(self, point: PointRing, way: Way) -> PointRing:
        """The posture of a way with the values of a point where it leaves them free."""
        for angle, turn in self._in_numbers(point, way):
            point = point.changed(angle, turn)
        for step in reversed(way.steps):
            if step.kind != "numbers":
                point = self._stepped(point, step)
        return point

    def _in_numbers(self, point: PointRing, way: Way) -> Iterator[tuple[int, Turn]]:
        """Angles that a way solves in numbers; what else it solves may hold them."""
        choices = point.sheet
        for step in reversed(way.steps):
            if step.kind == "numbers":
                turn = self._numbers_turn(point, step.numbers, choices & 1)
                yield step.angle, turn
                choices >>= 1

    def excluded(self, way: Way) -> bool:
        """Whether a divisor of a way, which is 0 nowhere there, is 0 all over it.

        Whatever solutions in numbers are chosen.
        """
        for sheet in range(self._enough(way)):
            point, after = self._drawn(), Way()
            point.sheet = sheet
            for step in reversed(way.steps):
                if self.moved(point, after).value(read(step.over)) == 0:
                    break
                after = Way((step, *after.steps))
            else:
                return False
        return True

    def _stepped(self, point: PointRing, step: Step) -> PointRing:
        over = None if step.over == "1" else point.value(read(step.over))
        if over is not None and over == 0:
            raise ResampleError

        def value(text: str) -> Any:
            above = point.value(read(text))
            return above if over is None else above / over

        if step.kind == "symbol":
            return point.changed(numbers={step.symbol: value(step.value)})
        return point.changed(step.angle, (value(step.cosine), value(step.sine)))

    def _numbers_turn(
        self, point: PointRing, numbers: Sequence[str], second: int
    ) -> Turn:
        """The first or the second solution of a·sin φ + b·cos φ + c = 0."""
        a, b, c = (point.rational(fraction(text)) for text in numbers)
        # In the tangent t of half the angle: 2at + b(1 − t²) + c(1 + t²) = 0.
        found = sorted(roots_of([int(b + c), int(2 * a), int(c - b)], self.prime))
        there = (turn_of(point.rational(Fraction(t))) for t in found)
        turns = [turn for turn in there if turn is not None]
        if c == b:
            turns.append((-point.one, point.zero))
        if not turns:
            raise ResampleError
        return turns[second % len(turns)]

    def changes(
        self, point: PointRing, way: Way, texts: Sequence[str]
    ) -> list[list[Any]]:
        """How symbols or expressions change with everything that a way leaves free.

        Args:
            point: From `drawn_before`.
            way: Its steps are followed.
            texts: Of the expressions.
        """
        directions = [*range(len(point.turns)), *point.numbers]
        ring = DualRing(point, self.declared, directions)
        for angle, turn in self._in_numbers(point, way):
            ring.turn(angle, ring.still(turn))
        for step in reversed(way.steps):
            if step.kind != "numbers":
                self._follow(ring, step)
        changes = [ring.of(read(text)).changes for text in texts]
        return [
            [own.get(k, point.zero) for own in changes] for k in range(len(directions))
        ]

    def _follow(self, ring: DualRing, step: Step) -> None:
        over = ring.of(read(step.over))
        if step.kind == "symbol":
            ring.replace(step.symbol, ring.of(read(step.value)).over(over))
        else:
            cosine = ring.of(read(step.cosine)).over(over)
            ring.turn(step.angle, (cosine, ring.of(read(step.sine)).over(over)))

    def twists(self, point: PointRing) -> Mapping[str, tuple[Any, ...]]:
        """The twists at a posture, by freedom, times their scales."""
        if point not in self._twists:
            self._twists[point] = self._twists_at(point)
        return self._twists[point]

    def _twists_at(self, point: PointRing) -> Mapping[str, tuple[Any, ...]]:
        part = self.part
        placed = tied_twists if self.tied else joint_twists
        found = placed(self._mechanism, point, part.origin, self._chain)
        scales = part.scales or {}
        twists = {}
        for label, twist in found.items():
            values = twist.coordinates
            if label in scales:
                factor = point.value(read(scales[label]))
                if factor == 0:
                    raise ResampleError
                values = tuple(factor * x for x in values)
            twists[label] = tuple(values)
        return twists


def _told(step: Step) -> list[str]:
    """The texts of a step's values."""
    return [t for t in (step.sine, step.cosine, step.value, step.over) if t]


def _declared(angles: Angles, wanted: set[str]) -> dict[str, dict[int, int]]:
    """Each declared angle as a combination of basis angles.

    Raises:
        RefusedError: If the forms are no unimodular basis of the angles.
    """
    if {name for form in angles for name in form} != wanted:
        raise RefusedError("the basis angles are not those of the mechanism")
    try:
        found = inverse_forms([tuple(form.items()) for form in angles])
    except ValueError as error:
        raise RefusedError(str(error)) from None
    return {name: dict(combination) for name, combination in found.items()}
