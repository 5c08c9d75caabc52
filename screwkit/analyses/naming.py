"""Redundant constraints and remaining freedoms by name, not by number alone.

States of self-stress say which constraint wrenches depend on each other; a basis of the
joint rates says what is free.  Both are found at two exact postures, so that whatever
does not depend on symbols is written with its exact coordinates; supports and kinds
hold in any case.

References: [Davies1981], [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from screwkit.analyses.naming_words import (
    added_words,
    idle_words,
    joints_words,
    limbs_words,
    loop_words,
    platform_words,
    wrench_words,
)
from screwkit.analyses.screw_texts import Pair, ScrewTexts, TextReader
from screwkit.kinematics.network import Motion, Network
from screwkit.reasons.added_freedoms import Candidate, removing_freedoms
from screwkit.reasons.carriers import Carrier, carriers, limb_wrenches
from screwkit.reasons.joint_points import Point, joint_points
from screwkit.reasons.named_freedoms import NamedFreedom, named_freedoms
from screwkit.reasons.readable_screws import Row, kind_of, passes
from screwkit.reasons.self_stress import (
    SelfStress,
    redundant_count,
    self_stresses,
)
from screwkit.reasons.short_loops import by_name
from screwkit.results.mobility import (
    AddedFreedom,
    CarriedWrench,
    Redundancy,
    RemainingFreedom,
)

MOST_REDUNDANCIES = 60
MOST_REMAINING = 60
MOST_FREEDOMS = 400
"""Sizes up to which redundancies and freedoms are named one by one."""

WRENCH_KINDS = {"free": "couple", "line": "force", "screw": "screw"}
TWIST_KINDS = {"free": "translation", "line": "rotation", "screw": "screw"}


@dataclass(frozen=True)
class Named:
    """What `mobility` says beyond numbers.

    Attributes:
        unnamed: Why something is not listed; empty if all is.
    """

    redundancies: tuple[Redundancy, ...] = ()
    remaining_freedoms: tuple[RemainingFreedom, ...] = ()
    unnamed: str = ""


@dataclass(frozen=True)
class _Found:
    """What one posture shows."""

    motion: Motion
    points: Mapping[str, Point]
    stresses: tuple[SelfStress, ...]
    added: tuple[tuple[Candidate, ...], ...]
    freedoms: tuple[NamedFreedom, ...]

    @property
    def prime(self) -> int:
        """The modulus of all residues."""
        return self.motion.posture.prime

    @property
    def shape(self) -> tuple[object, ...]:
        """All that does not depend on the prime, to compare two postures by."""
        return (
            [(list(s.wrenches), s.loop) for s in self.stresses],
            [[(c.joint, c.kind) for c in listed] for listed in self.added],
            [(f.idle, list(f.rates), f.bodies) for f in self.freedoms],
            sorted(self.points),
        )


def named(network: Network, motion: Motion) -> Named:
    """Name every redundant constraint and every freedom left.

    Args:
        network: The mechanism.
        motion: One of ``network.motions``, nothing locked.
    """
    reasons = []
    redundant, freedoms = redundant_count(motion), len(network.labels)
    if freedoms > MOST_FREEDOMS:
        reason = f"{freedoms} joint freedoms are more than the {MOST_FREEDOMS} up to "
        return Named(unnamed=f"{reason}which they are named one by one")
    if redundant > MOST_REDUNDANCIES:
        reasons.append(_too_many(redundant, "redundant constraints", MOST_REDUNDANCIES))
    if motion.mobility > MOST_REMAINING:
        reasons.append(_too_many(motion.mobility, "freedoms", MOST_REMAINING))
    found = _at(motion)
    partner = next(
        (m for m in network.motions if m.posture.prime != motion.posture.prime), None
    )
    other = (
        _at(partner) if partner is not None and partner.rank == motion.rank else None
    )
    if other is not None and other.shape != found.shape:
        other = None
    named_here = len(found.stresses)
    if named_here < redundant <= MOST_REDUNDANCIES:
        reasons.append(
            f"{redundant - named_here} of {redundant} redundant constraints run "
            f"through many loops at once and are not named"
        )
    words = _Words(found, other)
    return Named(
        tuple(map(words.redundancy, range(len(found.stresses)))),
        tuple(map(words.freedom, range(len(found.freedoms)))),
        "; ".join(reasons),
    )


def _too_many(count: int, what: str, most: int) -> str:
    return f"{count} {what} are more than the {most} that are named one by one"


def _at(motion: Motion) -> _Found:
    points = joint_points(motion.network, motion.posture)
    stresses: tuple[SelfStress, ...] = ()
    freedoms: tuple[NamedFreedom, ...] = ()
    if redundant_count(motion) <= MOST_REDUNDANCIES:
        stresses = self_stresses(motion, points)
    if motion.mobility <= MOST_REMAINING:
        freedoms = named_freedoms(motion)
    added = removing_freedoms(motion, stresses, points)
    return _Found(motion, points, stresses, added, freedoms)


class _Words:
    """Results with texts; without coordinates where one posture is all there is."""

    def __init__(self, one: _Found, other: _Found | None) -> None:
        self._one, self._other = one, other or one
        self._network = one.motion.network
        self._reader: TextReader | None = None
        if other is not None:
            self._reader = TextReader.between(one.motion.posture, other.motion.posture)
        ends = self._network.mechanism.base, self._network.mechanism.platform
        held = self._network.connected(*ends)
        self._rests = ", the platform rests" if held else ""
        self._movable = sum(map(bool, self._network.labels_of.values()))

    def redundancy(self, number: int) -> Redundancy:
        """A state of self-stress in words."""
        one, other = self._one, self._other
        mine, theirs = (
            carriers(self._network, found.stresses[number], found.prime)
            for found in (one, other)
        )
        pairs = [(a.wrench, b.wrench) for a, b in zip(mine, theirs, strict=True)]
        texts = [
            self._screw(pair, carrier.joints)
            for pair, carrier in zip(pairs, mine, strict=True)
        ]
        carried = tuple(
            CarriedWrench(
                carrier.joints,
                carrier.limb,
                WRENCH_KINDS[text.kind],
                coordinates,
                wrench_words(text),
            )
            for carrier, text, coordinates in zip(
                mine, texts, self._coordinates(pairs), strict=True
            )
        )
        removed_by = tuple(
            self._added(a, b)
            for a, b in zip(one.added[number], other.added[number], strict=True)
        )
        return Redundancy(carried, removed_by, self._sentence(number, mine, texts))

    def _sentence(
        self, number: int, mine: Sequence[Carrier], texts: Sequence[ScrewTexts]
    ) -> str:
        """Which wrenches depend on which: around a loop, between limbs, at joints."""
        one, other = self._one, self._other
        stress, loops = one.stresses[number], self._network.loops
        exerted = limb_wrenches(self._network, stress, one.prime)
        across = limb_wrenches(self._network, other.stresses[number], other.prime)
        limbs = {carrier.limb for carrier in mine}
        limb = limbs.pop() if len(limbs) == 1 and len(self._network.limbs) > 1 else ""
        joints = [joint for joint, _ in stress.loop]
        if joints and (len(exerted) < 2 or len(loops) == 1):
            return loop_words(texts[0], joints, limb)
        if len(exerted) > 1:
            return limbs_words(
                {
                    name: self._screw((wrench, across[name]), joints)
                    for name, wrench in exerted.items()
                }
            )
        kinds = [text.kind for text in texts]
        return joints_words(kinds, [j for c in mine for j in c.joints], limb)

    def _coordinates(self, pairs: Sequence[Pair]) -> list[tuple[str, ...]]:
        """The wrenches of one state, with one common factor."""
        planar = self._network.mechanism.space == "planar"
        chosen = (0, 1, 5) if planar else tuple(range(6))
        first, second = (
            [pair[side][i] for pair in pairs for i in chosen] for side in (0, 1)
        )
        texts = self._reader.scaled((first, second)) if self._reader else ()
        size = len(chosen) if texts else 0
        return [texts[size * i : size * (i + 1)] for i in range(len(pairs))]

    def _added(self, one: Candidate, other: Candidate) -> AddedFreedom:
        axis: tuple[str, ...] = ()
        point: tuple[str, ...] = ()
        if self._reader is not None:
            axis = self._reader.scaled((one.direction, other.direction))
            if one.point is not None and other.point is not None:
                point = self._reader.vector((one.point, other.point))
        words = added_words(one.joint, one.kind, axis)
        return AddedFreedom(one.joint, one.kind, axis, point, words)

    def _is_leg(self, joints: Sequence[str], bodies: Sequence[str]) -> bool:
        """Whether the joints lead from these bodies to more than one other body."""
        ends = {
            link
            for joint in self._network.mechanism.joints
            if joint.name in joints
            for link in (joint.parent, joint.child)
        }
        return len(ends.difference(bodies)) > 1

    def freedom(self, number: int) -> RemainingFreedom:
        """A remaining freedom in words."""
        one, other = self._one.freedoms[number], self._other.freedoms[number]
        joint_of = self._network.joint_of
        joints = tuple(dict.fromkeys(joint_of[label] for label in one.rates))
        text = self._screw((one.twist, other.twist), joints) if one.twist else None
        if one.idle or text is None:
            through = self._met(one.twist, joints) if one.twist else []
            leg = self._is_leg(joints, one.bodies)
            words = idle_words(text, joints, one.bodies, through, self._rests, leg=leg)
        else:
            words = platform_words(text, joints, self._movable)
        return RemainingFreedom(
            one.idle,
            tuple(one.rates),
            one.bodies,
            TWIST_KINDS[text.kind] if text else "",
            text.direction if text else (),
            text.point if text else (),
            text.pitch if text else "",
            words,
        )

    def _met(self, screw: Row, joints: Sequence[str] = ()) -> list[str]:
        """Joints with different points on the axis of a screw; of all by default."""
        found: dict[Point, str] = {}
        for joint in joints or sorted(self._one.points, key=by_name):
            point = self._one.points.get(joint)
            if point and passes(screw, point, self._one.prime):
                found.setdefault(point, joint)
        return list(found.values())

    def _screw(self, pair: Pair, joints: Sequence[str]) -> ScrewTexts:
        """The texts, and where they do not suffice joints that the axis meets."""
        text = self._read(pair, joints)
        if text.kind == "free" or (text.direction and text.point):
            return text
        return replace(text, through=tuple(self._met(tuple(pair[0]))[:2]))

    def _read(self, pair: Pair, joints: Sequence[str]) -> ScrewTexts:
        if self._reader is None:
            kind = kind_of(pair[0], self._one.prime)
            return ScrewTexts(kind, pitch="0" if kind == "line" else "")
        near = [
            (self._one.points[joint], self._other.points[joint])
            for joint in joints
            if joint in self._one.points
        ]
        return self._reader.screw(pair, near)
