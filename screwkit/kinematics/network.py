"""The joint graph with its freedoms and loops: what any mechanism is, limbs or none.

A `Network` knows the loops and the ways between bodies; a `Motion` is its space of
joint rates at one exact posture, J_c q̇ = 0, from which the twists of any body relative
to any other follow.

References: [LongCaroKhalil2012] (4)-(9), [Hunt1978].
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from screwkit.algebra.elimination_modulo import eliminated
from screwkit.algebra.modular import annihilator
from screwkit.kinematics.exact_postures import (
    ExactPosture,
    ResidueTwist,
    at_zero,
    exact_postures,
)
from screwkit.kinematics.loop_basis import short_loops
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.subspaces import dimension
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.graph import (
    Limb,
    Part,
    Step,
    components,
    limbs,
    other_parts,
    spanning_tree,
)
from screwkit.mechanism.joints import CATALOGUE, freedom_labels
from screwkit.mechanism.model import Mechanism
from screwkit.mechanism.parts import part_of

DENSE = 400
"""Columns up to which loop equations are solved as a dense matrix."""


class Network:
    """A mechanism as a graph of bodies and freedoms.

    Attributes:
        mechanism: As read.
        labels: All freedoms, joint by joint, those of contacts included.
        tied: Why joint variables are tied together; empty where they are not.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        space = mechanism.space
        self.labels_of: Mapping[str, tuple[str, ...]] = {
            joint.name: freedom_labels(joint, space) for joint in mechanism.joints
        }
        self.labels = tuple(
            label for labels in self.labels_of.values() for label in labels
        )
        self.tied = why_tied(mechanism)

    @property
    def rows(self) -> range:
        """The coordinates of a twist that count: all six, or (ωz; vx, vy)."""
        return range(2, 5) if self.mechanism.space == "planar" else range(6)

    @property
    def has_symbols(self) -> bool:
        """Whether anything is left free: symbols, or joint variables that nothing ties.

        The axes of ``posture`` files do not depend on joint variables.
        """
        mechanism = self.mechanism
        if mechanism.parameters:
            return True
        free = mechanism.geometry != "posture" and not self.tied
        return free and bool(mechanism.joint_variables)

    @cached_property
    def joint_of(self) -> Mapping[str, str]:
        """The joint of each freedom."""
        return {
            label: joint for joint, labels in self.labels_of.items() for label in labels
        }

    @cached_property
    def contact_labels(self) -> frozenset[str]:
        """Freedoms of contacts, which no joint variable measures."""
        return frozenset(
            label
            for joint in self.mechanism.joints
            if CATALOGUE[joint.type].contact
            for label in self.labels_of[joint.name]
        )

    @cached_property
    def loops(self) -> tuple[tuple[Step, ...], ...]:
        """A basis of short loops, in the order of a sweep from the base."""
        return short_loops(self.mechanism)

    @cached_property
    def limbs(self) -> tuple[Limb, ...]:
        """What connects base and platform."""
        return limbs(self.mechanism)

    @cached_property
    def other_parts(self) -> tuple[Part, ...]:
        """What is no limb."""
        return other_parts(self.mechanism)

    @cached_property
    def components(self) -> tuple[tuple[str, ...], ...]:
        """The connected bodies, the base's first."""
        return components(self.mechanism)

    @cached_property
    def steps(self) -> Mapping[str, tuple[str, Step]]:
        """For every link but the roots the link before it and the joint between.

        In an order in which the link before comes first.
        """
        tree = set(spanning_tree(self.mechanism))
        neighbours: dict[str, list[tuple[str, Step]]] = {}
        for joint in self.mechanism.joints:
            if joint.name in tree:
                ends = joint.parent, joint.child
                neighbours.setdefault(ends[0], []).append((ends[1], (joint.name, 1)))
                neighbours.setdefault(ends[1], []).append((ends[0], (joint.name, -1)))
        found: dict[str, tuple[str, Step]] = {}
        for group in self.components:
            base = self.mechanism.base
            root = base if base in group else group[0]
            waiting = deque([root])
            while waiting:
                here = waiting.popleft()
                for there, step in neighbours.get(here, ()):
                    if there != root and there not in found:
                        found[there] = here, step
                        waiting.append(there)
        return found

    def connected(self, one: str, other: str) -> bool:
        """Whether joints connect two links."""
        return any(one in group and other in group for group in self.components)

    @cached_property
    def postures(self) -> tuple[ExactPosture, ExactPosture]:
        """Two exact postures, random where the mechanism has symbols.

        Where loops tie joint variables together the file's own posture is taken.
        """
        mechanism = at_zero(self.mechanism) if self.tied else self.mechanism
        one, other = exact_postures(mechanism)
        return one, other

    @cached_property
    def motions(self) -> tuple[Motion, Motion]:
        """The joint rates that close all loops, at both postures."""
        one, other = self.postures
        return motion(self, one), motion(self, other)

    @cached_property
    def motion(self) -> Motion:
        """The motion at the posture of larger rank, which is the generic one."""
        return max(self.motions, key=lambda m: m.rank)

    @cached_property
    def at_values(self) -> Network | None:
        """The same with the file's values put in; None where it has none."""
        values = declared_values(self.mechanism)
        return Network(with_values(self.mechanism, values)) if values else None

    def part(self, joints: Collection[str], ends: Sequence[str]) -> Network:
        """Some of the joints alone, seen from the first of ``ends`` to the last."""
        return Network(part_of(self.mechanism, joints, ends))


@dataclass(frozen=True, eq=False)
class Motion:
    """All joint rates that close the loops at one posture.

    Attributes:
        network: The graph.
        posture: The twists.
        locked: Freedoms held still.
        rank: Of the columns of the freedoms that are not locked.
        rates: Basis of the joint rates, residues by label, zeros absent.
    """

    network: Network
    posture: ExactPosture
    locked: frozenset[str]
    rank: int
    rates: tuple[Mapping[str, int], ...]

    @property
    def mobility(self) -> int:
        """Dimension of the joint rates."""
        return len(self.rates)

    def body_twists(self, rates: Mapping[str, int]) -> dict[str, list[int]]:
        """The twist that joint rates give every link, relative to its component's root.

        The root is the base, or the first link of a component without it.
        """
        twists: dict[str, list[int]] = {}
        prime, still = self.posture.prime, [0] * 6
        for link, (before, (joint, sign)) in self.network.steps.items():
            total = twists.get(before, still)
            for label in self.network.labels_of[joint]:
                rate = rates.get(label, 0)
                if rate:
                    twist = self.posture.twists[label]
                    total = [
                        (x + sign * rate * y) % prime
                        for x, y in zip(total, twist, strict=True)
                    ]
            twists[link] = total
        return {link: twists.get(link, still) for link in self.network.mechanism.links}

    @cached_property
    def all_twists(self) -> tuple[dict[str, list[int]], ...]:
        """`body_twists` of every basis vector of `rates`."""
        return tuple(self.body_twists(rates) for rates in self.rates)

    def twists_of(self, link: str, relative_to: str = "") -> list[list[int]]:
        """Basis of the twists of a link: independent ones of those of `rates`.

        A link that nothing connects with the other moves in all six ways (three in a
        planar file).
        """
        other = relative_to or self.network.mechanism.base
        if not self.network.connected(link, other):
            rows = self.network.rows
            return [[int(i == k) for i in range(6)] for k in rows]
        prime = self.posture.prime
        given = [
            [(a - b) % prime for a, b in zip(twists[link], twists[other], strict=True)]
            for twists in self.all_twists
        ]
        return independent_rows(given, prime)

    @cached_property
    def platform_twists(self) -> list[list[int]]:
        """Basis of the twists of the platform relative to the base."""
        return self.twists_of(self.network.mechanism.platform)

    def moving(self, rates: Mapping[str, int]) -> tuple[str, ...]:
        """The links that move relative to the root of their component."""
        return tuple(
            link for link, twist in self.body_twists(rates).items() if any(twist)
        )


def motion(
    network: Network, posture: ExactPosture, locked: Collection[str] = ()
) -> Motion:
    """The joint rates that close all loops at a posture, with some freedoms locked."""
    held = frozenset(locked)
    labels = [label for label in network.labels if label not in held]
    column = {label: number for number, label in enumerate(labels)}
    rows = list(_equations(network, posture, column))
    prime = posture.prime
    if len(labels) <= DENSE and len(rows) <= 2 * DENSE:
        dense = [[row.get(i, 0) for i in range(len(labels))] for row in rows]
        vectors = annihilator(dense, len(labels), prime)
        rates = tuple(
            {labels[i]: x for i, x in enumerate(vector) if x} for vector in vectors
        )
    else:
        found = eliminated(rows, len(labels), prime).null_vectors()
        rates = tuple({labels[i]: x for i, x in v.items()} for v in found)
    return Motion(network, posture, held, len(labels) - len(rates), rates)


def _equations(
    network: Network, posture: ExactPosture, column: Mapping[str, int]
) -> Iterator[dict[int, int]]:
    """The rows of J_c: for every loop the coordinates of the twist that must vanish."""
    prime = posture.prime
    for loop in network.loops:
        rows: list[dict[int, int]] = [{} for _ in network.rows]
        for joint, sign in loop:
            for label in network.labels_of[joint]:
                if label not in column:
                    continue
                twist = posture.twists[label]
                for row, coordinate in zip(rows, network.rows, strict=True):
                    value = sign * twist[coordinate] % prime
                    if value:
                        row[column[label]] = value
        yield from (row for row in rows if row)


def independent_rows(rows: Sequence[Sequence[int]], prime: int) -> list[list[int]]:
    """The first rows that are independent."""
    chosen: list[list[int]] = []
    for row in rows:
        if not any(row):
            continue
        trial = [*chosen, list(row)]
        if dimension(trial, prime) == len(trial):
            chosen = trial
        if len(chosen) == len(row):
            break
    return chosen


def twist_system(
    network: Network, posture: ExactPosture, joints: Collection[str], end: str
) -> list[ResidueTwist]:
    """What some joints alone allow a body relative to the base, loops among them kept.

    Args:
        network: The whole mechanism.
        posture: The twists.
        joints: For instance those of a limb.
        end: The body.
    """
    part = network.part(joints, (network.mechanism.base, end))
    return [tuple(row) for row in motion(part, posture).platform_twists]
