"""The loop equations of a joint graph at a posture, from the mechanism alone.

C are the equations of its loops, [C; P] those of the mechanism whose platform is
rigidly connected with the base, so that rank [C; P] − rank C is the dimension of the
platform's twists.  A limb is taken as a mechanism of its own.  *Constraint* asks for
the rank of C, *actuation* for that of the columns of C that are not locked, *limb* for
that of [C; P].

References: [LongCaroKhalil2012] (4)-(9).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import Any

from screwkit.algebra.all_roots import rank_at_roots
from screwkit.algebra.exact_point import PointRing, determinant_modulo
from screwkit.certificates.postures import Postures
from screwkit.conventions import SCREW_DIMENSION
from screwkit.kinematics.loop_basis import held_loops, short_loops, way_to_platform
from screwkit.mechanism.graph import Step, limbs
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.parts import part_of


class GraphMatrix:
    """The matrix of a part whose form is ``loops``.

    Args:
        postures: Of the mechanism and the part.
        locked: Freedoms that are held; by default those of the part.
    """

    def __init__(
        self, postures: Postures, locked: Collection[str] | None = None
    ) -> None:
        self._postures = postures
        self._part = postures.part
        self.prime = postures.prime
        self._locked = frozenset(self._part.locked if locked is None else locked)
        self._mechanism = postures.spoken_of.mechanism
        self._labels = {
            joint.name: freedom_labels(joint, self._mechanism.space)
            for joint in self._mechanism.joints
        }

    def twists(self, point: PointRing) -> Mapping[str, tuple[Any, ...]]:
        """The twists at a posture, by freedom, times their scales."""
        return self._postures.twists(point)

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """The freedoms that are columns of the matrix."""
        every = (x for labels in self._labels.values() for x in labels)
        return tuple(x for x in every if x not in self._locked)

    @cached_property
    def _closed(self) -> tuple[tuple[Step, ...], ...]:
        return short_loops(self._mechanism)

    @cached_property
    def _held(self) -> tuple[tuple[Step, ...], ...]:
        return held_loops(self._mechanism)

    @property
    def is_held(self) -> bool:
        """Whether the matrix is [C; P]."""
        return self._part.question == "limb"

    def _of(
        self, point: PointRing, loops: Sequence[Sequence[Step]]
    ) -> dict[str, list[Any]]:
        """The columns at a posture, six coordinates of one loop after another."""
        twists = self.twists(point)
        found = {
            label: [point.zero] * (SCREW_DIMENSION * len(loops))
            for label in self.columns
        }
        for number, loop in enumerate(loops):
            here = slice(SCREW_DIMENSION * number, SCREW_DIMENSION * (number + 1))
            for joint, sign in loop:
                for label in self._labels.get(joint, ()):
                    if label in found:
                        found[label][here] = [sign * x for x in twists[label]]
        return found

    def matrix(self, point: PointRing) -> dict[str, list[Any]]:
        """The columns of the part's matrix at a posture, by freedom."""
        return self._of(point, self._held if self.is_held else self._closed)

    @cached_property
    def freedoms_of(self) -> dict[str, tuple[str, ...]]:
        """By limb, its freedoms, locked or not."""
        return {
            limb.name: tuple(x for name in limb.joints for x in self._labels[name])
            for limb in limbs(self._mechanism)
        }

    @cached_property
    def _ways(self) -> dict[str, tuple[tuple[Step, ...], ...]]:
        """By limb, a way to the platform and the loops inside."""
        ends, found = (self._mechanism.base, self._mechanism.platform), {}
        for limb in limbs(self._mechanism):
            own = part_of(self._mechanism, limb.joints, ends)
            found[limb.name] = way_to_platform(own), *short_loops(own)
        return found

    @property
    def is_of_limbs(self) -> bool:
        """Whether every joint belongs to a limb."""
        own = {x for labels in self.freedoms_of.values() for x in labels}
        return own == {x for labels in self._labels.values() for x in labels}

    def height(self, limb: str) -> int:
        """Rows of [P; C] of a limb."""
        return SCREW_DIMENSION * len(self._ways[limb])

    def of_limb(self, limb: str, point: PointRing) -> dict[str, list[Any]]:
        """[P; C] of a limb at a posture, by freedom: six rows of P, then those of C."""
        columns = self._of(point, self._ways[limb])
        return {x: columns[x] for x in self.freedoms_of[limb] if x in columns}

    def rank_of(self, rows: Sequence[Sequence[Any]]) -> int:
        """Of a matrix of residues, or of values at roots."""
        return rank_at_roots(rows, self.prime)

    def rank(self, point: PointRing) -> int:
        """Of the matrix at a posture."""
        return self._rank(point, self._held if self.is_held else self._closed)

    def loop_rank(self, point: PointRing) -> int:
        """Of C at a posture."""
        return self._rank(point, self._closed)

    def bounding_ranks(self, point: PointRing) -> tuple[int, ...]:
        """Rank that exceeds that of the matrix, or falls short, by the freedom.

        Of [C; P] where the matrix is C, and of C where it is [C; P].
        """
        return (self._rank(point, self._closed if self.is_held else self._held),)

    def freedom(self, point: PointRing) -> int:
        """Dimension of the platform's twists at a posture, locked freedoms held."""
        return self._rank(point, self._held) - self._rank(point, self._closed)

    def _rank(self, point: PointRing, loops: Sequence[Sequence[Step]]) -> int:
        if not loops:
            return 0
        return self.rank_of([*self._of(point, loops).values()])

    def minor(
        self, point: PointRing, rows: Sequence[int], columns: Sequence[str]
    ) -> Any:
        """A minor of the matrix at a posture."""
        matrix = self.matrix(point)
        chosen = [[matrix[name][row] for row in rows] for name in columns]
        return determinant_modulo(chosen, self.prime)
