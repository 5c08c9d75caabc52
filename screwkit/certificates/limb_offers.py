"""Ranks of limbs and minors of their wrenches that bound the rank of all loops.

Wrenches are far shorter than minors of the loop equations: lines and couples as a rule.
A limb that is nowhere singular on a branch needs no minor where its own list is proved:
its components are looked at instead.

References: [LongCaroKhalil2012] (4)-(9), (26); docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent
from screwkit.algebra.points import Point, residue
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.limb_systems import (
    LimbHere,
    LimbSystem,
    RankClaim,
    Shown,
    Wrench,
)
from screwkit.certificates.looped_limbs import FILLED
from screwkit.certificates.offers import Offer
from screwkit.certificates.records import Node, OfLimb
from screwkit.certificates.steps import added
from screwkit.conventions import SCREW_DIMENSION
from screwkit.errors import TooLargeError

OFFERED = 8
"""Choices of minors and wrenches of one kind at one node."""

ACROSS = 4
"""Minors of the same wrenches that are offered, short ones first."""


@dataclass
class _Limbs:
    """All limbs at a point of a branch.

    Attributes:
        wrenches: By limb.
        wanted: The rank of the loops that is to be shown.
    """

    here: list[LimbHere]
    wrenches: list[list[Wrench]]
    at: tuple[Point, int]
    wanted: int
    source: random.Random

    def drawn(self, count: int, limbs: Sequence[int]) -> Iterator[list[_Drawn]]:
        """Independent wrenches of some limbs, short ones first."""
        every = [_Drawn(i, w, self._at(w)) for i in limbs for w in self.wrenches[i]]
        seen = set[tuple[int, ...]]()
        for number in range(OFFERED):
            noise = 2.0 if number else 0.0
            weights = [
                own.wrench.terms * (1 + self.source.uniform(0, noise)) for own in every
            ]
            order = sorted(range(len(every)), key=weights.__getitem__)
            values = [every[k].values for k in order]
            chosen = [order[k] for k in independent(values, self.at[1])][:count]
            if len(chosen) < count:
                return
            key = tuple(sorted(chosen))
            if key not in seen or number % 2:
                seen.add(key)
                yield [every[k] for k in key]

    def _at(self, wrench: Wrench) -> list[int]:
        return [residue(x, *self.at) for x in wrench.covector[:SCREW_DIMENSION]]

    def sums(self) -> Iterator[Offer]:
        """Wrenches of all limbs whose minor shows how many of them are independent."""
        count = SCREW_DIMENSION
        if self.wanted >= 0:
            count += self.wanted - sum(own.rank for own in self.here)
        ring = self.here[0].branch.ring
        for own in self.drawn(count, range(len(self.here))):
            try:
                minors = minors_of(ring, [w.wrench.line for w in own], FILLED)
                claims = self._claims(range(len(self.here))) if self.wanted >= 0 else {}
            except TooLargeError:
                continue
            shown = [k for k, value in minors.items() if residue(value, *self.at)]
            for chosen in sorted(shown, key=lambda k: len(minors[k]))[:ACROSS]:
                # Of a wrench forces come first, of a covector what goes with rotations.
                rows = [row for row in range(SCREW_DIMENSION) if chosen >> row & 1]
                across = tuple((row + 3) % SCREW_DIMENSION for row in rows)
                yield self._offer(claims, own, Node(-1, rows=across), minors[chosen])

    def works(self, held: int) -> Iterator[Offer]:
        """Wrenches of all limbs but one that do work in the joints of that one."""
        others = [i for i in range(len(self.here)) if i != held]
        count = self.wanted - sum(self.here[i].rank for i in others)
        limb = self.here[held]
        ring, prime = limb.branch.ring, self.at[1]
        if count <= 0:
            yield from self._blocks(others)
            return
        if count > limb.rank:
            return
        for own in self.drawn(count, others):
            twists = list(range(len(limb.columns)))
            twists.sort(key=lambda k: sum(map(len, limb.columns[k][0])))
            if self.source.random() < 0.5:
                self.source.shuffle(twists)
            at = [
                [_work(w.values, limb.values[k][:SCREW_DIMENSION], prime) for w in own]
                for k in twists
            ]
            chosen = sorted(twists[k] for k in independent(at, prime))
            if len(chosen) < count:
                continue
            columns = [limb.columns[k] for k in chosen]
            entries = [
                [_product(limb.branch, w.wrench, column) for w in own]
                for column, _ in columns
            ]
            try:
                minors = minors_of(ring, entries, FILLED)
                claims = self._claims(others)
            except TooLargeError:
                continue
            value = minors.get((1 << count) - 1, ring.zero)
            labels = tuple(limb.system.labels[k] for k in chosen)
            over = added(*(powers for _, powers in columns))
            yield self._offer(claims, own, Node(-1, columns=labels, over=over), value)

    def _blocks(self, limbs: Sequence[int]) -> Iterator[Offer]:
        """Limbs whose ranks together are the one that is to be shown."""
        for _ in range(OFFERED):
            try:
                claims = self._claims(limbs)
            except TooLargeError:
                continue
            yield self._offer(claims, (), Node(-1), None)
            if all(self.here[i].is_known for i in limbs):
                break

    def _claims(self, limbs: Sequence[int]) -> dict[int, RankClaim]:
        return {i: self.here[i].claim(self.source) for i in limbs}

    def _offer(
        self,
        claims: Mapping[int, RankClaim],
        wrenches: Sequence[_Drawn],
        node: Node,
        value: Polynomial | None,
    ) -> Offer:
        said, fallen = [], []
        parts = [] if value is None else [(value, 1)]
        parts += [(own.wrench.weight, 1) for own in wrenches]
        over = dict(node.over or {})
        for number, limb in enumerate(self.here):
            given = [own.wrench for own in wrenches if own.limb == number]
            claim = claims.get(number)
            if claim is None and not given:
                continue
            own = OfLimb(limb.system.name) if claim is None else claim.said
            if claim is not None and claim.minor is not None:
                parts += claim.minor
                over = added(over, claim.over)
            by_part = claim is not None and claim.minor is None
            fallen.append((limb.system.below(limb.rank) or ()) if by_part else ())
            said.append(_with_wrenches(own, limb, given))
        return Offer(
            tuple(parts), replace(node, limbs=tuple(said), over=over), tuple(fallen)
        )


@dataclass(frozen=True)
class _Drawn:
    """A wrench of a limb, and its values at the point."""

    limb: int
    wrench: Wrench
    values: list[int]


def limb_offers(
    systems: Sequence[LimbSystem],
    branch: Branch,
    at: tuple[Point, int],
    library: FactorLibrary,
    wanted: int,
    source: random.Random,
    shown: Shown,
) -> Iterator[Offer]:
    """What limbs say at a node; minors that are too long are left out.

    Args:
        systems: All limbs.
        branch: Of the node.
        at: A point of it that does not belong to the locus.
        library: Of the branch's ring.
        wanted: The rank of the loops that is to be shown; −1 where the platform is to
            keep still.
        source: Draws minors and wrenches.
        shown: Tells what follows from the conditions of the node.
    """
    here = [LimbHere.of(system, branch, at) for system in systems]
    places = range(len(here))
    total = sum(own.rank for own in here)
    if wanted >= 0:
        order = sorted(places, key=lambda i: (here[i].is_known, here[i].rank))
        bare = [i for i in order if total - here[i].rank >= wanted]
        if bare:
            limbs = _Limbs(here, [], at, wanted, source)
            yield from chain.from_iterable(map(limbs.works, bare))
            return
    try:
        wrenches = [own.wrenches(library, shown) for own in here]
    except TooLargeError:
        return
    limbs = _Limbs(here, wrenches, at, wanted, source)
    if wanted >= 0:
        yield from chain.from_iterable(map(limbs.works, places))
    if wanted < 0 or len(here) > 2:
        yield from limbs.sums()


def _work(covector: Sequence[int], column: Sequence[int], prime: int) -> int:
    return sum(a * b for a, b in zip(covector, column, strict=True)) % prime


def _product(
    branch: Branch, wrench: Wrench, column: Sequence[Polynomial]
) -> Polynomial:
    ring, whole = branch.ring, slice(SCREW_DIMENSION)
    pairs = zip(wrench.line, column[whole], strict=True)
    return ring.normal(sum((a * b for a, b in pairs), ring.zero))


def _with_wrenches(own: OfLimb, limb: LimbHere, given: Sequence[Wrench]) -> OfLimb:
    """What is said of a limb with the texts of its wrenches."""
    ring, count = limb.branch.ring, len(limb.columns)
    work = (
        replace(multiple, equation=multiple.equation + number * count)
        for number, wrench in enumerate(given)
        for multiple in wrench.work
    )
    texts = tuple(
        tuple(text(ring, x) for x in _forces_first(w.covector)) for w in given
    )
    return replace(own, wrenches=texts, work=tuple(work))


def _forces_first(covector: Sequence[Polynomial]) -> Iterator[Polynomial]:
    """(f; m), six by six: f goes with velocities, m with rotations."""
    half = SCREW_DIMENSION // 2
    for start in range(0, len(covector), SCREW_DIMENSION):
        middle, end = start + half, start + SCREW_DIMENSION
        yield from (*covector[middle:end], *covector[start:middle])
