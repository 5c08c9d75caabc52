"""States of self-stress: the redundant constraints of a joint graph, one by one.

A self-stress gives every joint a wrench that is reciprocal to all its freedoms, with
every body in equilibrium; there are as many independent ones as constraints that follow
from others.  The basis found here is one of small supports: single loops first, short
before long, then pairs of limbs, then more of them, and at last whatever is left with
as few joints as possible.  Supports are exact, and so is which wrench is a couple.

References: [Horton1987], [Davies1981] (wrenches around loops).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain, combinations, islice, permutations
from typing import TypeAlias

from screwkit.algebra.elimination_modulo import eliminated
from screwkit.algebra.modular import annihilator
from screwkit.kinematics.exact_postures import ExactPosture
from screwkit.kinematics.network import Motion, Network
from screwkit.kinematics.subspaces import reciprocal
from screwkit.mechanism.graph import Step
from screwkit.reasons.readable_screws import Row, kind_of, readable_basis
from screwkit.reasons.residue_spaces import (
    Span,
    complement,
    least_outside,
    vanishing,
)
from screwkit.reasons.short_loops import by_name, from_first, short_loops

Entry: TypeAlias = tuple[str, int]
"""A joint and a coordinate of its wrench."""
Stress: TypeAlias = dict[Entry, int]

_LIMBS = 6
"""Limbs up to which every set of them is tried."""
_SEARCH = 2000
"""Missing states times joints up to which supports of several loops are looked for."""


@dataclass(frozen=True)
class SelfStress:
    """One redundant constraint.

    Attributes:
        wrenches: (f; m) modulo the prime that each joint transmits from parent to
            child; joints that transmit nothing are absent.
        loop: The joints in their order, where one loop carries the same wrench all
            around; else empty.
    """

    wrenches: Mapping[str, Row]
    loop: tuple[Step, ...] = ()


def redundant_count(motion: Motion) -> int:
    """How many equations follow from others: rows of all loops less the rank."""
    network = motion.network
    return len(network.rows) * len(network.loops) - motion.rank


def self_stresses(
    motion: Motion, points: Mapping[str, Sequence[int]]
) -> tuple[SelfStress, ...]:
    """A basis of all states of self-stress, small supports first.

    Where very many states run through several loops at once, those are left out.

    Args:
        motion: With nothing locked.
        points: A point of each joint, modulo the posture's prime, where it has one:
            lines of force are put through it where there is a choice.
    """
    count = redundant_count(motion)
    found = _Found(motion.posture.prime)
    if not count:
        return ()
    _add_loops(motion, points, count, found)
    if 0 < (count - len(found.span)) * len(motion.network.mechanism.joints) <= _SEARCH:
        _add_larger(motion, points, count, found)
    return tuple(found.stresses)


class _Found:
    """What has been found so far, with the space it spans."""

    def __init__(self, prime: int) -> None:
        self.prime = prime
        self.span: Span[Entry] = Span(prime)
        self.vectors: list[Stress] = []
        self.stresses: list[SelfStress] = []

    def add(self, vector: Stress, loop: tuple[Step, ...] = ()) -> None:
        """Keep a stress unless it follows from those before.

        Args:
            vector: The wrenches.
            loop: Around which it is carried, if it is one.
        """
        if not self.span.add(vector):
            return
        self.vectors.append(vector)
        joints = dict.fromkeys(joint for joint, _ in vector)
        wrenches = {
            joint: tuple(vector.get((joint, i), 0) for i in range(6))
            for joint in sorted(joints, key=by_name)
        }
        self.stresses.append(SelfStress(wrenches, loop))


def _add_loops(
    motion: Motion, points: Mapping[str, Sequence[int]], count: int, found: _Found
) -> None:
    """What single loops carry: the same wrench at every joint."""
    network, posture = motion.network, motion.posture
    joints = network.mechanism.joints
    short = islice(short_loops(joints), 4 * len(joints) + 100)
    for loop in chain(short, _pairs_of_limbs(network)):
        twists = [
            posture.twists[label]
            for joint, _ in loop
            for label in network.labels_of[joint]
        ]
        wrenches = reciprocal(twists, posture.prime)
        if network.mechanism.space == "planar":
            wrenches = [[w[0], w[1], 0, 0, 0, w[5]] for w in wrenches]
        if not any(map(any, wrenches)):
            continue
        point = _first_point((joint for joint, _ in loop), points)
        for wrench in readable_basis(wrenches, posture.prime, point):
            stress = {
                (joint, i): sign * x % posture.prime
                for joint, sign in loop
                for i, x in enumerate(wrench)
                if x
            }
            found.add(stress, loop)
        if len(found.span) == count:
            return


def _pairs_of_limbs(network: Network) -> Iterator[tuple[Step, ...]]:
    """Out over one serial limb and back over another, short ones first."""
    paths = sorted(
        (limb.path for limb in network.limbs if limb.path),
        key=lambda path: (len(path), by_name(path[0][0])),
    )
    for out, back in combinations(paths, 2):
        yield from_first((*out, *((name, -sign) for name, sign in reversed(back))))


def _add_larger(
    motion: Motion, points: Mapping[str, Sequence[int]], count: int, found: _Found
) -> None:
    """What only several loops together carry, limb by limb where there are limbs."""
    prime = motion.posture.prime
    everything = _all_stresses(motion.network, motion.posture)
    joints = sorted({joint for v in everything for joint, _ in v}, key=by_name)
    for allowed in _sets_of_limbs(motion.network, joints):
        left = [joint for joint in joints if joint not in allowed]
        spared = [_entries([joint]) for joint in reversed(joints) if joint in allowed]
        space = vanishing(everything, _entries(left), prime)
        while any(found.span.rest(vector) for vector in space):
            least = least_outside(space, spared, found.span)
            support = {joint for v in least for joint, _ in v}
            known = [v for v in found.vectors if {j for j, _ in v} <= support]
            inner = {joint for v in known for joint, _ in v}
            point = _first_point(inner or support, points)
            for vector in _simplest(
                _moments_about(least, point, prime),
                _moments_about(known, point, prime),
                prime,
            ):
                back = [-x for x in point]
                found.add(_moments_about([vector], back, prime)[0])
        if len(found.span) == count:
            return


def _simplest(
    space: Sequence[Stress], known: Sequence[Stress], prime: int
) -> list[Stress]:
    """What a space adds to what is known in it, with few screws and few entries.

    What adds is free up to what is known; the entries to be cleared are tried in
    several orders.
    """
    tried = [
        complement(space, known, prime, partial(_order, axes, half))
        for axes in permutations(range(3))
        for half in (0, 1)
    ]
    return min(tried, key=lambda vectors: _difficulty(vectors, prime))[::-1]


def _order(axes: Sequence[int], first: int, entry: Entry) -> tuple[object, ...]:
    """Forces (0) or moments (1) first, joint by joint, axes in this order."""
    joint, coordinate = entry
    return coordinate // 3 != first, by_name(joint), axes.index(coordinate % 3)


def _difficulty(vectors: Sequence[Stress], prime: int) -> tuple[int, int, int]:
    """Screws, wrenches that are no couples, and entries."""
    kinds = [
        kind_of([vector.get((joint, i), 0) for i in range(6)], prime)
        for vector in vectors
        for joint in {joint for joint, _ in vector}
    ]
    lines = len(kinds) - kinds.count("free")
    return kinds.count("screw"), lines, sum(map(len, vectors))


def _sets_of_limbs(network: Network, joints: Sequence[str]) -> Iterator[set[str]]:
    """Joints of pairs of limbs, of three and so on; at last all joints there are."""
    limbs = sorted(
        (limb.joints for limb in network.limbs),
        key=lambda names: min(map(by_name, names)),
    )
    for limb in limbs:
        yield set(limb)
    if len(limbs) <= _LIMBS:
        for size in range(2, len(limbs)):
            for chosen in combinations(limbs, size):
                yield {joint for limb in chosen for joint in limb}
    yield set(joints)


def _all_stresses(network: Network, posture: ExactPosture) -> list[Stress]:
    """The left null space of J_c as wrenches of the joints."""
    prime, size = posture.prime, len(network.rows)
    # A row (ω; v) of J_c times a wrench (f; m): the coordinate of f that meets v.
    partner = [(row + 3) % 6 for row in network.rows]
    width = size * len(network.loops)
    rows: dict[str, dict[int, int]] = {}
    passing: dict[str, list[tuple[int, int]]] = {}
    for number, loop in enumerate(network.loops):
        for joint, sign in loop:
            passing.setdefault(joint, []).append((number, sign))
            for label in network.labels_of[joint]:
                row = rows.setdefault(label, {})
                for place, coordinate in enumerate(network.rows):
                    value = sign * posture.twists[label][coordinate] % prime
                    if value:
                        row[size * number + place] = value
    if width <= 400:
        dense = [[row.get(i, 0) for i in range(width)] for row in rows.values()]
        vectors = [
            {i: x for i, x in enumerate(vector) if x}
            for vector in annihilator(dense, width, prime)
        ]
    else:
        vectors = eliminated(rows.values(), width, prime).null_vectors()
    stresses = []
    for vector in vectors:
        stress: Stress = {}
        for joint, loops in passing.items():
            for place, coordinate in enumerate(partner):
                total = sum(s * vector.get(size * n + place, 0) for n, s in loops)
                if total % prime:
                    stress[joint, coordinate] = total % prime
        stresses.append(stress)
    return stresses


def _entries(joints: Sequence[str]) -> list[Entry]:
    return [(joint, i) for joint in joints for i in range(6)]


def _first_point(
    joints: Iterator[str] | set[str], points: Mapping[str, Sequence[int]]
) -> Sequence[int]:
    """A point of the first of these joints that has one; else the origin."""
    for joint in sorted(joints, key=by_name):
        if joint in points:
            return points[joint]
    return (0, 0, 0)


def _moments_about(
    stresses: Sequence[Stress], point: Sequence[int], prime: int
) -> list[Stress]:
    """The same wrenches with moments about another point."""
    x, y, z = point
    moved = []
    for stress in stresses:
        result: Stress = {}
        for joint in {joint for joint, _ in stress}:
            fx, fy, fz, mx, my, mz = (stress.get((joint, i), 0) for i in range(6))
            wrench = (
                *(fx, fy, fz),
                *(mx - y * fz + z * fy, my - z * fx + x * fz, mz - x * fy + y * fx),
            )
            for i, value in enumerate(wrench):
                if value % prime:
                    result[joint, i] = value % prime
        moved.append(result)
    return moved
