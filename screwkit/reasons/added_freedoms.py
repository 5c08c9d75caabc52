"""Freedoms that would remove redundant constraints if joints were given them.

A freedom added to a joint removes a state of self-stress exactly if the wrench that the
joint carries does work on it: the rank then grows by one and the mobility stays.  Tried
are rotations about lines through the joint and translations, along the base axes, the
joint's own directions and that of the wrench.

References: [Hunt1978] (reciprocity); every answer is checked by exact products.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from screwkit.conventions import DIRECTION, MOMENT
from screwkit.kinematics.network import Motion
from screwkit.mechanism.joints import RIGID
from screwkit.reasons.joint_points import Point
from screwkit.reasons.readable_screws import Row, kind_of, product
from screwkit.reasons.residue_spaces import Span
from screwkit.reasons.self_stress import SelfStress
from screwkit.screw.vector import cross

LISTED = 3
"""Freedoms that are named for each redundant constraint."""
_TURN, _SLIDE = "rotation", "translation"
_AXES: tuple[Row, ...] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@dataclass(frozen=True)
class Candidate:
    """A freedom that a joint might be given.

    Attributes:
        direction: Of the axis or the translation, modulo the prime.
        point: Of the axis; None for translations.
        work: Reciprocal product with the wrench of each state of self-stress at this
            joint, by the number of the state; those that are zero are absent.
    """

    joint: str
    kind: str
    direction: Row
    point: Point | None
    work: Mapping[int, int]

    @property
    def twist(self) -> Row:
        """(ω; v), not reduced modulo the prime."""
        if self.point is None:
            return (0, 0, 0, *self.direction)
        return (*self.direction, *cross(self.point, self.direction))


def removing_freedoms(
    motion: Motion, stresses: Sequence[SelfStress], points: Mapping[str, Point]
) -> tuple[tuple[Candidate, ...], ...]:
    """For each state of self-stress freedoms that remove it, each alone.

    The first of every list together remove all states.

    Args:
        motion: Where the states were found.
        stresses: A basis of the states.
        points: A point of each joint; the base origin is taken where there is none.
    """
    ranked = _ranked(motion, stresses, points)
    chosen = _independent(ranked, len(stresses), motion.posture.prime)
    lists = []
    for number, first in enumerate(chosen):
        listed = [first]
        for candidate in ranked[number]:
            if len(listed) == LISTED:
                break
            if all(candidate.joint != other.joint for other in listed):
                listed.append(candidate)
        lists.append(tuple(listed))
    return tuple(lists)


def _ranked(
    motion: Motion, stresses: Sequence[SelfStress], points: Mapping[str, Point]
) -> list[list[Candidate]]:
    """All candidates for each state, those that remove no other state first."""
    order = {joint.name: i for i, joint in enumerate(motion.network.mechanism.joints)}
    rigid = {j.name for j in motion.network.mechanism.joints if j.type in RIGID}
    carrying: dict[str, list[int]] = {}
    for number, stress in enumerate(stresses):
        for joint in stress.wrenches:
            carrying.setdefault(joint, []).append(number)
    ranked: list[list[tuple[tuple[object, ...], Candidate]]] = [[] for _ in stresses]
    for joint, numbers in carrying.items():
        wrenches = {n: stresses[n].wrenches[joint] for n in numbers}
        for place, candidate in enumerate(_at(motion, joint, wrenches, points)):
            for number in candidate.work:
                pure = kind_of(wrenches[number], motion.posture.prime)
                fits = candidate.kind == (_SLIDE if pure == "line" else _TURN)
                score = (
                    len(candidate.work),
                    not fits,
                    joint in rigid,
                    place,
                    order[joint],
                )
                ranked[number].append((score, candidate))
    return [
        [candidate for _, candidate in sorted(entries, key=lambda entry: entry[0])]
        for entries in ranked
    ]


def _at(
    motion: Motion,
    joint: str,
    wrenches: Mapping[int, Row],
    points: Mapping[str, Point],
) -> list[Candidate]:
    """The candidates at one joint that remove some state, simple directions first."""
    prime = motion.posture.prime
    planar = motion.network.mechanism.space == "planar"
    point = points.get(joint, (0, 0, 0))
    turns: list[Row] = list(_AXES[2:] if planar else _AXES)
    slides: list[Row] = list(_AXES[:2] if planar else _AXES)
    for label in motion.network.labels_of[joint]:
        twist = motion.posture.twists[label]
        own = twist[DIRECTION] if any(twist[DIRECTION]) else twist[MOMENT]
        turns += [] if planar else [own]
        slides += [] if planar and own[2] else [own]
    for wrench in wrenches.values():
        if any(wrench[DIRECTION]):
            slides.append(wrench[DIRECTION])
        elif not planar:
            turns.append(wrench[MOMENT])
    found = []
    for kind, directions in ((_TURN, turns), (_SLIDE, slides)):
        for direction in _different(directions, prime):
            place = point if kind == _TURN else None
            candidate = Candidate(joint, kind, direction, place, {})
            work = {
                number: done
                for number, wrench in wrenches.items()
                if (done := product(wrench, candidate.twist, prime))
            }
            if work:
                found.append(Candidate(joint, kind, direction, place, work))
    return found


def _different(directions: Sequence[Row], prime: int) -> list[Row]:
    """Without those that are multiples of one before."""
    kept: list[Row] = []
    for direction in directions:
        if all(any(c % prime for c in cross(direction, other)) for other in kept):
            kept.append(tuple(direction))
    return kept


def _independent(
    ranked: Sequence[Sequence[Candidate]], count: int, prime: int
) -> list[Candidate]:
    """One candidate for each state, such that all of them remove all states.

    A nonsingular matrix has a permutation without zeros: candidates whose work is
    independent can always be handed out so that each removes its own state.
    """
    entries = [
        (len(candidate.work), number, place, candidate)
        for number, candidates in enumerate(ranked)
        for place, candidate in enumerate(candidates)
    ]
    entries.sort(key=lambda entry: (entry[0] > 1, entry[2], entry[1]))
    span: Span[int] = Span(prime)
    chosen: list[tuple[int, Candidate]] = []
    for _, number, _, candidate in entries:
        if len(chosen) == count:
            break
        if span.add(candidate.work):
            chosen.append((number, candidate))
    owner: dict[int, int] = {}

    def hand_out(index: int, tried: set[int]) -> bool:
        number, candidate = chosen[index]
        for state in sorted(candidate.work, key=lambda state: state != number):
            if state not in tried:
                tried.add(state)
                if state not in owner or hand_out(owner[state], tried):
                    owner[state] = index
                    return True
        return False

    for index in range(len(chosen)):
        hand_out(index, set())
    return [chosen[owner[state]][1] for state in range(count)]
