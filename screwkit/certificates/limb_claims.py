"""Claims about limbs alone that bound the rank of all loops, or hold the platform.

With r_i the rank of the twists of limb i and W_i their reciprocal wrenches, of
dimension 6 − r_i, the loop constraint matrix has rank Σ r_i − 6 + dim Σ W_i.  By block
elimination that is the sum of the r_i of all limbs but one, and the rank of the work
that wrenches of those do in the joints of that one.  The platform is still where the
W_i together have dimension 6.

Of a limb with loops inside the matrix [P; C] stands for the twists: P leads to the
platform, C are the equations of its loops.  A wrench of the platform is reciprocal to
all that the limb allows where, with some reactions of the loops, it does no work in any
joint; r_i is the rank of [P; C].

References: [LongCaroKhalil2012] (4)-(9), (26).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from screwkit.algebra.exact_point import PointRing, determinant_modulo
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.multiples import follows
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Node, OfLimb, Part
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.texts import RefusedError, read
from screwkit.conventions import SCREW_DIMENSION

_ROWS = frozenset(range(SCREW_DIMENSION))


class LimbClaims:
    """Examines what nodes of one part say of limbs.

    Args:
        postures: Of the mechanism and the part.
        matrix: Of the part.
        parts: Of the certificate; those of limbs that are proved are used.
    """

    def __init__(
        self,
        postures: Postures,
        matrix: ScrewMatrix | GraphMatrix,
        parts: Sequence[Part],
    ) -> None:
        self._postures, self._matrix, self._part = postures, matrix, postures.part
        self._known: dict[tuple[str, int], list[tuple[str, ...]]] = {}
        """By limb and rank: where it is lower, as the limb's own part proves."""
        for part in parts:
            if part.question != "limb":
                continue
            for floor in part.floors:
                self._known[part.limb, floor.rank] = [*floor.loci]
            if part.proof is not None and not part.form:
                own = [locus.equations for locus in part.components]
                self._known[part.limb, part.rank] = own
        held = {*self._part.locked}
        self._whole = matrix.freedoms_of
        self._labels = {
            name: [label for label in own if label not in held]
            for name, own in self._whole.items()
        }

    def check(self, node: Node, way: Way) -> None:
        """Where no case of a node holds, no posture of the locus is.

        Args:
            node: That speaks of limbs.
            way: To the node.

        Raises:
            RefusedError: If that does not follow, or a wrench is not reciprocal.
        """
        if self._part.question == "limb" or not self._matrix.is_of_limbs:
            raise RefusedError("limbs say nothing about it")
        names = [own.limb for own in node.limbs]
        if len({*names}) < len(names) or not {*names} <= {*self._labels}:
            raise RefusedError("its limbs are none of the mechanism, or stand twice")
        for own in node.limbs:
            self._shows_rank(own)
            height = self._matrix.height(own.limb)
            if any(len(wrench) != height for wrench in own.wrenches):
                raise RefusedError("a wrench has six coordinates, reactions aside")
        if node.columns:
            self._of_work(node)
        else:
            self._of_sum(node)
        for point in self._postures.several(way):
            for own in node.limbs:
                self._reciprocal(own, way, point)

    def _reciprocal(self, own: OfLimb, way: Way, point: PointRing) -> None:
        """Check that wrenches do no work in their limb, where all conditions hold."""
        twists, labels = self._matrix.of_limb(own.limb, point), self._labels[own.limb]
        multiples = {multiple.equation: multiple for multiple in own.work}
        for number, wrench in enumerate(self._values(own, point)):
            for place, label in enumerate(labels, number * len(labels)):
                work = _work(wrench, twists[label])
                if not follows(work, multiples.get(place), way, point):
                    raise RefusedError(f"a wrench does work in limb {own.limb}")

    def _of_work(self, node: Node) -> None:
        """Check a minor of the work of wrenches in the joints of another limb."""
        count = sum(len(own.wrenches) for own in node.limbs)
        held = self._other(node)
        if held is None or not {*node.columns} <= {*self._labels[held]}:
            raise RefusedError("its freedoms are not those of one limb that is left")
        if len(node.columns) != count or node.rows:
            raise RefusedError(f"its minor is none of the work of {count} wrenches")
        self._bounded(sum(own.rank for own in node.limbs) + count)

    def _of_sum(self, node: Node) -> None:
        """Check a minor of wrenches, or that limbs need none."""
        count = sum(len(own.wrenches) for own in node.limbs)
        if len(node.rows) != count or not {*node.rows} <= _ROWS:
            raise RefusedError(f"its minor is none of {count} wrenches")
        ranks = sum(own.rank for own in node.limbs)
        if self._part.question == "actuation":
            self._bounded(self._part.rank if count == SCREW_DIMENSION else -1)
        elif count or self._other(node) is None:
            self._bounded(ranks - SCREW_DIMENSION + count)
        else:
            self._bounded(ranks)

    def _other(self, node: Node) -> str | None:
        """A limb of which a node says nothing."""
        named = {own.limb for own in node.limbs}
        return next((name for name in self._labels if name not in named), None)

    def _bounded(self, shown: int) -> None:
        if shown < self._part.rank:
            raise RefusedError("its limbs do not bound the rank of the loops")

    def _shows_rank(self, own: OfLimb) -> None:
        if own.columns or own.rows:
            if not len(own.rows) == len(own.columns) == own.rank:
                raise RefusedError(f"its minor of limb {own.limb} has another size")
            rows = range(self._matrix.height(own.limb))
            if not {*own.columns} <= {*self._labels[own.limb]} or (
                not {*own.rows} <= {*rows}
            ):
                raise RefusedError(f"its minor is none of limb {own.limb}")
        elif own.rank:
            self._rests_on_part(own)
            return
        if own.fallen or own.rank < 0:
            raise RefusedError(f"what it says of limb {own.limb} has no reason")

    def _rests_on_part(self, own: OfLimb) -> None:
        loci = self._known.get((own.limb, own.rank))
        if loci is None or {*self._whole[own.limb]} & {*self._part.locked}:
            raise RefusedError(f"no part proves rank {own.rank} of limb {own.limb}")
        if len(own.fallen) != len(loci):
            raise RefusedError(f"limb {own.limb} loses rank elsewhere too")

    def fallen(self, node: Node) -> Iterator[tuple[tuple[str, ...], Node]]:
        """Where limbs have a lower rank than is said, with what follows there."""
        for own in node.limbs:
            if own.fallen:
                loci = self._known[own.limb, own.rank]
                yield from zip(loci, own.fallen, strict=True)

    def product(self, node: Node, point: PointRing) -> Any:
        """The minors of a node's limbs and wrenches at a posture, multiplied."""
        found, prime = point.one, self._postures.prime
        for own in node.limbs:
            if own.columns:
                columns = self._matrix.of_limb(own.limb, point)
                chosen = [[columns[x][row] for row in own.rows] for x in own.columns]
                found = found * determinant_modulo(chosen, prime)
        wrenches = [w for own in node.limbs for w in self._values(own, point)]
        held = self._other(node)
        if node.columns and held is not None:
            twists = self._matrix.of_limb(held, point)
            bare = [wrench[:SCREW_DIMENSION] for wrench in wrenches]
            chosen = [
                [_work(w, twists[x][:SCREW_DIMENSION]) for w in bare]
                for x in node.columns
            ]
        else:
            chosen = [[wrench[row] for row in node.rows] for wrench in wrenches]
        return found * determinant_modulo(chosen, prime)

    def _values(self, own: OfLimb, point: PointRing) -> list[list[Any]]:
        return [[point.value(read(x)) for x in wrench] for wrench in own.wrenches]


def _work(wrench: Sequence[Any], twist: Sequence[Any]) -> Any:
    """f·v + m·ω of a wrench (f; m) and a twist (ω; v), summed over six by six."""
    half = SCREW_DIMENSION // 2
    pairs: list[tuple[Any, Any]] = []
    for start in range(0, len(wrench), SCREW_DIMENSION):
        middle, end = start + half, start + SCREW_DIMENSION
        across = (*twist[middle:end], *twist[start:middle])
        pairs += zip(wrench[start:end], across, strict=True)
    return sum((a * b for a, b in pairs[1:]), pairs[0][0] * pairs[0][1])
