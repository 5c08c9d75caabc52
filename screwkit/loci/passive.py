"""The twists that stay when some joints are locked: ranks, determinants, freedoms.

One table of minors per limb serves every choice of locked joints: the determinant of
the passive columns of the loop constraint matrix is the join of the duals of the limbs'
passive twists.  Whether the platform can move is read from ranks at exact points.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from math import comb
from typing import TypeAlias

from screwkit.algebra.batched_ranks import BITS, batched_ranks
from screwkit.algebra.minors import MinorTable, combined, joined, minor_table
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.hybrid_ranks import HybridRanks
from screwkit.loci.limb_extensors import (
    Minor,
    PrimitiveExtensor,
    content_of,
    primitive_extensor,
)
from screwkit.loci.wrench_sums import COSTLIEST, Units, cost, filling_units, sum_minors

MINORS = 4
"""Minors beyond the first that a locus is looked at with."""

CHEAP = 20_000
"""Products of terms in a minor; no cheaper one is looked for."""

CHOICES = 300
"""Choices of columns of which each gives a determinant."""


class RankTable:
    """Ranks of any passive joints at one exact point; columns are evaluated once."""

    def __init__(
        self, limbs: Sequence[Mapping[str, Sequence[int]]], prime: int
    ) -> None:
        self._limbs = limbs
        self._prime = prime
        self._limb_ranks: dict[tuple[int, frozenset[str]], int] = {}
        loops = len(limbs) - 1
        self._rows: dict[str, list[int]] = {}
        for number, limb in enumerate(limbs):
            for joint, twist in limb.items():
                values = [int(x) for x in twist]
                if number == 0:
                    self._rows[joint] = values * max(loops, 1)
                else:
                    before, after = 6 * (number - 1), 6 * (loops - number)
                    self._rows[joint] = [0] * before + values + [0] * after

    def row(self, joint: str) -> list[int]:
        """A column of the loop constraint matrix."""
        return self._rows[joint]

    def loop_rank(self, joints: Collection[str]) -> int:
        """Rank of these columns of the loop constraint matrix."""
        if len(self._limbs) < 2:
            return 0
        rows = [self._rows[joint] for joint in joints]
        return self._rank(rows)

    def state(self, joints: Collection[str]) -> LoopState:
        """What can move when only these joints can."""
        return LoopState(self.limb_ranks(joints), self.loop_rank(joints), len(joints))

    def limb_ranks(self, joints: Collection[str]) -> tuple[int, ...]:
        """Rank of these joints' twists in each limb; computed once per choice."""
        ranks = []
        for number, limb in enumerate(self._limbs):
            chosen = frozenset(joint for joint in limb if joint in joints)
            key = number, chosen
            if key not in self._limb_ranks:
                rows = [[int(x) for x in limb[joint]] for joint in chosen]
                self._limb_ranks[key] = self._rank(rows)
            ranks.append(self._limb_ranks[key])
        return tuple(ranks)

    def _rank(self, rows: Sequence[Sequence[int]]) -> int:
        return rank(rows, self._prime)


Ranks: TypeAlias = RankTable | HybridRanks
"""Ranks of any passive joints at one exact point."""


def _more_generic(one: LoopState, two: LoopState) -> LoopState:
    """The larger ranks of two random points are the true ones."""
    if one.inner != two.inner:
        return max(one, two, key=lambda state: state.inner)
    limbs = tuple(map(max, one.limbs, two.limbs))
    return LoopState(limbs, max(one.loop, two.loop), one.freedoms, one.inner)


class PassiveSystem:
    """All choices of locked joints of one assembly."""

    def __init__(self, assembly: Assembly) -> None:
        self.assembly = assembly
        self.joints = assembly.joints
        self._primitives: dict[tuple[int, frozenset[str]], PrimitiveExtensor] = {}

    @cached_property
    def generic(self) -> tuple[Ranks, Ranks]:
        """Ranks at two random exact postures."""
        first, second = (
            self._table(twists, prime)
            for twists, prime in self.assembly.random_postures
        )
        return first, second

    def _table(self, twists: Mapping[str, Sequence[int]], prime: int) -> Ranks:
        if self.assembly.has_blocks:
            return HybridRanks(self.assembly, twists, prime)
        return self._rank_table(twists, prime)

    def _rank_table(self, twists: Mapping[str, Sequence[int]], prime: int) -> RankTable:
        limbs = self.assembly.limbs
        return RankTable([{j: twists[j] for j in x.joints} for x in limbs], prime)

    def generic_state(self, passive: Collection[str]) -> LoopState:
        """Generic over all symbols: the larger rank of two points is the true one."""
        one, two = (table.state(passive) for table in self.generic)
        return _more_generic(one, two)

    def generic_states(self, choices: Sequence[Collection[str]]) -> list[LoopState]:
        """`generic_state` of many choices of one size, their loop ranks at once."""
        one, two = self.generic
        if isinstance(one, HybridRanks) or isinstance(two, HybridRanks):
            return [self.generic_state(choice) for choice in choices]
        return [
            LoopState(
                tuple(map(max, one.limb_ranks(choice), two.limb_ranks(choice))),
                loop,
                len(choice),
            )
            for choice, loop in zip(
                choices, self.generic_loop_ranks(choices), strict=True
            )
        ]

    @cached_property
    def _small(self) -> tuple[dict[str, int], list[list[int]], int]:
        """Rows of the loop constraint matrix modulo a 31-bit prime, by joint."""
        twists, prime = self.assembly.random_twists(3, BITS)
        table = self._rank_table(twists, prime)
        order = {joint: number for number, joint in enumerate(self.joints)}
        return order, [table.row(joint) for joint in self.joints], prime

    def generic_loop_ranks(self, choices: Sequence[Collection[str]]) -> list[int]:
        """Generic ranks of the loop constraint matrix for many choices of columns.

        All choices are of one size and are taken at once modulo a 31-bit prime, where
        full rank is proof; those that come out deficient are confirmed at another
        random posture modulo a 61-bit prime.
        """
        if not choices or not choices[0] or len(self.assembly.limbs) < 2:
            return [0] * len(choices)
        order, rows, prime = self._small
        numbers = [[order[joint] for joint in choice] for choice in choices]
        found = batched_ranks(rows, numbers, prime).tolist()
        full = min(len(numbers[0]), len(rows[0]))
        for position, value in enumerate(found):
            if value < full:
                joints = choices[position]
                found[position] = max(value, self.generic[0].loop_rank(joints))
        return [int(value) for value in found]

    def table_at(self, point: Point, prime: int) -> Ranks:
        """Ranks at an exact point of the common frame's ring."""
        framed = self.assembly.common_twists
        at_point = {
            joint: [residue(x, point, prime) for x in framed.column(joint)]
            for joint in self.joints
        }
        return self._table(at_point, prime)

    @cached_property
    def _tables(self) -> tuple[MinorTable[Polynomial], ...]:
        ring = self.assembly.common_twists.ring
        return tuple(
            minor_table(ring, self.assembly.told(limb.joints), self.height)
            for limb in self.assembly.limbs
        )

    @property
    def height(self) -> int:
        """Coordinates that tell all twists apart: three in a plane or about a point."""
        return len(self.assembly.telling)

    def _extensor(
        self, limb: int, passive: Collection[str]
    ) -> Mapping[int, Polynomial]:
        joints = self.assembly.limbs[limb].joints
        bits = sum(1 << i for i, joint in enumerate(joints) if joint in passive)
        return self._tables[limb].get(bits, {})

    def fills(self, passive: Collection[str]) -> bool:
        """Whether these columns just fill the loop equations: one determinant."""
        return len(passive) == self.height * (len(self.assembly.limbs) - 1)

    def size(self, passive: Collection[str]) -> int:
        """Products of terms that a determinant of these columns may take.

        Of limbs with loops inside no determinant is expanded; there it is the number of
        freedoms inside that are locked, and one more where it is not the declared
        scheme that is left.
        """
        if self.assembly.has_blocks:
            locked = {joint for joint in self.joints if joint not in passive}
            other = locked != {*self.assembly.mechanism.actuated}
            return self._locked_inside(passive) + other
        extensors = [self._own(i, passive) for i in range(len(self.assembly.limbs))]
        return cost([e.coordinates for e in extensors], ((),) * len(extensors))

    def _locked_inside(self, passive: Collection[str]) -> int:
        return sum(
            joint not in passive
            and self.assembly.joint_of(joint).name not in (limb.elements or limb.chain)
            for limb in self.assembly.limbs
            for joint in limb.joints
        )

    def maximal_minors(self, passive: Collection[str]) -> Iterator[Minor]:
        """Polynomials that all vanish where these columns become dependent.

        One determinant where the columns just fill the loop equations; with two limbs
        all minors; else some of them, the shortest first, each of them not zero.
        Minors that would take too long to expand are left out.
        """
        ring = self.assembly.common_twists.ring
        count = len(self.assembly.limbs)
        if not count:
            yield Minor(ring.one, ())  # of no columns and no equations
            return
        equations = self.height * (count - 1)
        if len(passive) < equations and count == 2:
            both = [self._primitive(i, passive) for i in range(2)]
            content = content_of(both)
            one, other = (e.coordinates for e in both)
            for rest in joined(ring, one, other).values():
                yield Minor(rest, content)
            return
        found = False
        if len(passive) >= equations:
            for chosen in self._square_choices(passive, equations):
                extensors = [self._primitive(i, chosen) for i in range(count)]
                parts = [e.coordinates for e in extensors]
                if all(parts):
                    content = content_of(extensors)
                    for rest in combined(ring, parts, self.height).values():
                        found = True
                        yield Minor(rest, content)
        if not found:
            yield from self._some_minors(passive)

    def _some_minors(self, passive: Collection[str]) -> Iterator[Minor]:
        """Minors that are not zero at a random point, cheap ones first."""
        ring = self.assembly.common_twists.ring
        if len(self.assembly.limbs) < 2 or self._sample is None:
            return
        residues, prime = self._sample
        limbs = range(len(self.assembly.limbs))
        own = [self._own(i, passive) for i in limbs]
        content = content_of(own)
        extensors = [e.coordinates for e in own]
        at_point = [
            [residues[joint] for joint in self._spanning(i, passive)] for i in limbs
        ]
        choices: list[Units] = []
        for units in filling_units(at_point, self.height, prime):
            choices.append(units)
            if len(choices) >= MINORS and cost(extensors, units) < CHEAP:
                break
        choices.sort(key=lambda units: (cost(extensors, units), units))
        for units in choices[:MINORS]:
            if cost(extensors, units) > COSTLIEST:
                return
            for rest in sum_minors(ring, extensors, units, self.height):
                yield Minor(rest, content)

    def _own(self, limb: int, passive: Collection[str]) -> PrimitiveExtensor:
        """The extensor of what a limb's passive twists span."""
        return self._primitive(limb, self._spanning(limb, passive))

    def _primitive(self, limb: int, passive: Collection[str]) -> PrimitiveExtensor:
        """The extensor of a limb's passive twists; computed once per choice."""
        joints = self.assembly.limbs[limb].joints
        key = limb, frozenset(joint for joint in joints if joint in passive)
        if key not in self._primitives:
            ring = self.assembly.common_twists.ring
            self._primitives[key] = primitive_extensor(
                ring, self._extensor(limb, passive), self.assembly.library(ring)
            )
        return self._primitives[key]

    def _spanning(self, limb: int, passive: Collection[str]) -> list[str]:
        """Passive joints of a limb that are independent at the sample."""
        own = [j for j in self.assembly.limbs[limb].joints if j in passive]
        if self._sample is None:
            return own
        residues, prime = self._sample
        return [own[k] for k in independent([residues[j] for j in own], prime)]

    @cached_property
    def _sample(self) -> tuple[dict[str, list[int]], int] | None:
        """The telling coordinates of all twists at a random point of their ring."""
        assembly = self.assembly
        points = assembly.root(assembly.common_twists.ring).points
        if not points:
            return None
        point, prime = points[0]
        columns = zip(assembly.joints, assembly.told(assembly.joints), strict=True)
        return {
            joint: [residue(x, point, prime) for x in column]
            for joint, column in columns
        }, prime

    def _square_choices(
        self, passive: Collection[str], equations: int
    ) -> list[frozenset[str]]:
        """Choices of passive columns that are as many as the equations."""
        if len(passive) == equations:
            return [frozenset(passive)]
        if comb(len(passive), equations) > CHOICES:
            return []
        ordered = [joint for joint in self.joints if joint in passive]
        return [frozenset(c) for c in combinations(ordered, equations)]
