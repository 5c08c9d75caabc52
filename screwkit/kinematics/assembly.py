"""A mechanism with its limbs resolved and its twists at hand.

An `Assembly` owns what several questions share -- the twists of each limb in the frame
that keeps them short, those of all limbs in one frame, random exact postures -- and
computes each of them once, when first asked for.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TypeVar

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.expression import Number
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.modular import ModularRing, ResampleError, prime_for, rank
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.errors import UndecidedError
from screwkit.kinematics.frames import (
    FramedTwists,
    framed_twists,
    shortest_twists,
    survey,
)
from screwkit.kinematics.placement import MOVING, joint_twists, table_joints
from screwkit.kinematics.values import with_values
from screwkit.mechanism.graph import independent_loops
from screwkit.mechanism.graph import limbs as limbs_of
from screwkit.mechanism.model import Mechanism, freedom_label

T = TypeVar("T")


@dataclass(frozen=True)
class SerialLimb:
    """A chain from base to platform.

    Attributes:
        joints: Names of its moving joints, from base to platform.
        signs: +1 where a joint points towards the platform, −1 where back.
        chain: All its joints, fixed ones included.
        links: The links it passes, base first, as far as the table places them.
    """

    name: str
    joints: tuple[str, ...]
    signs: tuple[int, ...]
    chain: tuple[str, ...]
    links: tuple[str, ...]


class Assembly:
    """A mechanism, its serial limbs, and their twists on demand.

    Attributes:
        mechanism: As read.
        limbs: In the order of the file.
        assumptions: The signs that the file declares.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        """Resolve the limbs.

        Raises:
            UndecidedError: If a limb is no serial chain, is not placed by the table, or
                the mechanism has loops outside its limbs.
        """
        self.mechanism = mechanism
        table_joints(mechanism)
        self.limbs = _serial_limbs(mechanism)
        self.assumptions = Assumptions(
            positive=frozenset(p.name for p in mechanism.parameters if p.positive),
            nonzero=frozenset(
                p.name for p in mechanism.parameters if p.nonzero or p.positive
            ),
        )
        self._libraries: dict[TrigonometricRing, FactorLibrary] = {}
        self.loops = independent_loops(mechanism)
        closed = max(0, len(self.limbs) - 1)
        if self.loops != closed:
            raise UndecidedError(
                f"the graph has {self.loops} independent loops, "
                f"of which the limbs close {closed}; loops outside or inside limbs are "
                f"not analysed yet"
            )

    @cached_property
    def at_values(self) -> Assembly | None:
        """The same mechanism with the file's values put in for its symbols."""
        values = {
            p.name: p.value for p in self.mechanism.parameters if p.value is not None
        }
        if not values:
            return None
        return Assembly(with_values(self.mechanism, values))

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """The moving joints of all limbs, limb by limb."""
        return tuple(name for limb in self.limbs for name in limb.joints)

    @cached_property
    def free_joints(self) -> tuple[str, ...]:
        """Moving joints outside every limb: each adds one mobility of its own."""
        inside = set(self.joints)
        return tuple(
            joint.name
            for joint in self.mechanism.joints
            if joint.type in MOVING and joint.name not in inside
        )

    @cached_property
    def limb_twists(self) -> Mapping[str, FramedTwists]:
        """Each limb's twists in the shortest frame, by limb name."""
        return {
            limb.name: shortest_twists(self.mechanism, limb.chain, limb.links)
            for limb in self.limbs
        }

    @cached_property
    def common_twists(self) -> FramedTwists:
        """The twists of all limbs in the one frame that keeps them shortest."""
        base = self.mechanism.base
        origins = [base] + [
            link for limb in self.limbs for link in limb.links[1:3] if link != base
        ]
        shortest = shortest_twists(self.mechanism, self._chains, origins)
        return replace(shortest, limbs=tuple(limb.joints for limb in self.limbs))

    @cached_property
    def base_twists(self) -> FramedTwists:
        """The twists of all limbs in the base frame."""
        return framed_twists(self.mechanism, self._chains, self.mechanism.base)

    @cached_property
    def _chains(self) -> tuple[str, ...]:
        return tuple(name for limb in self.limbs for name in limb.chain)

    def random_twists(
        self, seed: int, bits: int = 61
    ) -> tuple[dict[str, list[int]], int]:
        """The twists of all limbs at a random exact posture, and the prime.

        Independent of the polynomials: the kinematics is run over residues.
        """
        seen = survey(self.mechanism, self._chains, self.mechanism.base)
        radicands = [r.value for r in seen.roots if isinstance(r, Number)]
        if seen.turn:
            radicands += [Fraction(2), Fraction(3)]
        for attempt in range(200):
            prime = prime_for(seen.turn, radicands, seed + 1000 * attempt, bits)
            ring = ModularRing(seed + attempt, prime)
            try:
                twists = joint_twists(
                    self.mechanism, ring, self.mechanism.base, self._chains
                )
            except ResampleError:
                continue
            return {
                name: [int(x) for x in twist.coordinates]
                for name, twist in twists.items()
            }, prime
        raise UndecidedError("no random exact posture was found in 200 attempts")

    @cached_property
    def random_postures(self) -> tuple[tuple[dict[str, list[int]], int], ...]:
        """Two random exact postures modulo two primes."""
        return self.random_twists(1), self.random_twists(2)

    def generic_rank(self, joints: Sequence[str]) -> int:
        """Rank of the twists of some joints, generic over all symbols."""
        return max(
            rank([twists[name] for name in joints], prime)
            for twists, prime in self.random_postures
        )

    @cached_property
    def loop_rank(self) -> int:
        """Generic rank of the loop constraint matrix."""
        return self.loop_rank_of(self.joints)

    def loop_rank_of(self, joints: Sequence[str]) -> int:
        """Generic rank of these columns of the loop constraint matrix."""
        chosen = set(joints)
        return max(
            rank(
                loop_rows(
                    [[t[j] for j in limb.joints if j in chosen] for limb in self.limbs]
                ),
                prime,
            )
            for t, prime in self.random_postures
        )

    def root(self, ring: TrigonometricRing) -> Branch:
        """The whole configuration space of a ring of this mechanism."""
        dimensions = {p.name for p in self.mechanism.parameters if not p.free}
        indices = tuple(
            index
            for index, name in zip(ring.symbol_indices(), ring.symbols, strict=True)
            if name in dimensions
        )
        return Branch(ring, self.assumptions, dimensions=indices)

    def library(self, ring: TrigonometricRing) -> FactorLibrary:
        """The factors met in a ring so far, kept for as long as the assembly."""
        if ring not in self._libraries:
            self._libraries[ring] = FactorLibrary(ring)
        return self._libraries[ring]

    def label(self, joint: str) -> str:
        """How the freedom of a joint is written in schemes."""
        return freedom_label(self.mechanism.joint(joint), 0)


def loop_rows(limbs: Sequence[Sequence[Sequence[T]]]) -> list[list[T]]:
    """Transposed loop constraint matrix of limbs given by their twists.

    Each limb after the first closes a loop with the first: [T1 −T2 0; T1 0 −T3].
    """
    if len(limbs) < 2:
        return []
    loops = len(limbs) - 1
    rows = [[*column] * loops for column in limbs[0]]
    for number, limb in enumerate(limbs[1:]):
        for column in limb:
            zero = [column[0] - column[0]]  # type: ignore[operator]
            before, after = zero * (6 * number), zero * (6 * (loops - number - 1))
            rows.append([*before, *column, *after])
    return rows


def _serial_limbs(mechanism: Mechanism) -> tuple[SerialLimb, ...]:
    found = []
    for limb in limbs_of(mechanism):
        if limb.path is None:
            raise UndecidedError(
                f"limb {limb.name!r} is no serial chain; hybrid limbs are not analysed "
                f"yet"
            )
        links, at = [mechanism.base], mechanism.base
        moving, signs = [], []
        grasped = False
        for name, sign in limb.path:
            joint = mechanism.joint(name)
            at = joint.child if sign > 0 else joint.parent
            if joint.mdh is None:
                grasped = True
                continue
            if grasped:
                raise UndecidedError(
                    f"limb {limb.name!r}: joint {name!r} follows a joint without a row "
                    f"of the table, so nothing places it"
                )
            links.append(at)
            if joint.type in MOVING:
                moving.append(name)
                signs.append(sign)
        chain = tuple(
            name for name, _ in limb.path if mechanism.joint(name).mdh is not None
        )
        found.append(
            SerialLimb(limb.name, tuple(moving), tuple(signs), chain, tuple(links))
        )
    return tuple(found)
