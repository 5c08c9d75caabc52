"""The joint graph with its loop equations in symbols: for any mechanism, limbs or none.

The twists of all freedoms stand in one frame.  Every loop gives six rows of the loop
constraint matrix C; where the platform is held, one more loop leads to it and back.  At
an exact point the joint rates that close all loops are counted, and how many of them
the platform feels.

References: [LongCaroKhalil2012] (4)-(9).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from screwkit.algebra.branches import Branch
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.telling_coordinates import telling_coordinates
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import DIRECTION, SCREW_DIMENSION
from screwkit.errors import UndecidedError
from screwkit.kinematics.assembly import assumptions_of
from screwkit.kinematics.exact_postures import ExactPosture
from screwkit.kinematics.frames import FramedTwists, framed_twists
from screwkit.kinematics.loop_basis import held_loops, way_to_platform
from screwkit.kinematics.network import Motion, Network, motion
from screwkit.mechanism.graph import Step
from screwkit.mechanism.model import Mechanism

Row: TypeAlias = dict[int, Polynomial]
"""Entries of a row by column, zeros absent."""


@dataclass(frozen=True)
class GraphState:
    """What moves at a posture, some freedoms locked.

    Attributes:
        loop: Rank of the loop constraint matrix in the freedoms that are not locked.
        mobility: Dimension of the joint rates that close all loops.
        platform_freedom: Dimension of the twists that they give the platform.
    """

    loop: int
    mobility: int
    platform_freedom: int

    @property
    def held(self) -> int:
        """Rank of the same matrix with the platform held to the base, [C; P]."""
        return self.loop + self.platform_freedom


class WholeGraph:
    """A mechanism as a graph, its twists in symbols.

    Attributes:
        mechanism: Whose axes depend on free symbols alone.
        network: The same with its exact postures.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.network = Network(mechanism)

    @cached_property
    def framed(self) -> FramedTwists:
        """The twists of all freedoms in the frame of the base.

        Raises:
            UndecidedError: If a freedom is not placed there.
        """
        names = [joint.name for joint in self.mechanism.joints]
        found = framed_twists(self.mechanism, names, self.mechanism.base)
        missing = [x for x in self.network.labels if x not in found.joints]
        if missing:
            raise UndecidedError(
                f"nothing places joint {missing[0]!r} relative to the base"
            )
        limbs = tuple(
            tuple(x for name in limb.joints for x in self.network.labels_of[name])
            for limb in self.network.limbs
        )
        return replace(found, limbs=limbs)

    @cached_property
    def root(self) -> Branch:
        """The whole space of the free symbols."""
        ring = self.framed.ring
        dimensions = {p.name for p in self.mechanism.parameters if not p.free}
        indices = tuple(
            index
            for index, name in zip(ring.symbol_indices(), ring.symbols, strict=True)
            if name in dimensions
        )
        squares: dict[str, tuple[Polynomial, tuple[Polynomial, ...]]] = {}
        if self.mechanism.geometry != "mdh":
            for joint in self.framed.joints:
                square = self.framed.axis_square(joint)
                if not square.is_constant():
                    squares[str(square)] = square, self.framed.axis_direction(joint)
        return Branch(
            ring,
            assumptions_of(self.mechanism),
            dimensions=indices,
            nonvanishing=tuple(square for square, _ in squares.values()),
            directions=tuple(direction for _, direction in squares.values()),
        )

    @property
    def points(self) -> tuple[tuple[Point, int], ...]:
        """Random exact postures as points of the ring, with their primes."""
        return tuple(self.root.points)

    @cached_property
    def library(self) -> FactorLibrary:
        """The factors met in the ring so far."""
        return FactorLibrary(self.framed.ring)

    @cached_property
    def _loops(self) -> tuple[tuple[Step, ...], ...]:
        return self.network.loops

    @cached_property
    def _loops_held(self) -> tuple[tuple[Step, ...], ...]:
        """The same where the platform is rigidly connected with the base."""
        return held_loops(self.mechanism)

    @cached_property
    def _telling(self) -> tuple[int, ...]:
        columns = [self.framed.column(label) for label in self.framed.joints]
        return telling_coordinates(columns)

    def equations(
        self, locked: Collection[str] = (), *, held: bool = False
    ) -> tuple[tuple[str, ...], list[Row]]:
        """The columns of C and its rows.

        Args:
            locked: Freedoms without a column.
            held: With the platform held to the base, [C; P] instead of C.
        """
        labels, rows = self.numbered_equations(locked, held=held)
        return labels, [*rows.values()]

    def numbered_equations(
        self, locked: Collection[str] = (), *, held: bool = False
    ) -> tuple[tuple[str, ...], dict[int, Row]]:
        """The same with each row's number: six coordinates of one loop after another.

        Rows of zeros, and those that follow from others of their loop, are left out.
        """
        labels = tuple(x for x in self.network.labels if x not in locked)
        place = {label: i for i, label in enumerate(labels)}
        rows: dict[int, Row] = {}
        for number, loop in enumerate(self._loops_held if held else self._loops):
            for coordinate in self._telling:
                row = self._row(loop, coordinate, place)
                if row:
                    rows[SCREW_DIMENSION * number + coordinate] = row
        return labels, rows

    def led_equations(
        self, locked: Collection[str] = ()
    ) -> tuple[tuple[str, ...], dict[int, Row], int]:
        """The columns of [P; C] and its rows, those of the way to the platform first.

        Args:
            locked: Freedoms without a column.

        Returns:
            The columns; the rows by number, six coordinates of the way and of one loop
            after another; how many there are with those that are left out, which are
            zeros or follow from others of their loop.
        """
        labels = tuple(x for x in self.network.labels if x not in locked)
        place = {label: i for i, label in enumerate(labels)}
        rows: dict[int, Row] = {}
        ways = (way_to_platform(self.mechanism), *self._loops)
        for number, way in enumerate(ways):
            for coordinate in self._telling if number else range(SCREW_DIMENSION):
                row = self._row(way, coordinate, place)
                if row:
                    rows[SCREW_DIMENSION * number + coordinate] = row
        return labels, rows, SCREW_DIMENSION * len(ways)

    def unturned_equations(self) -> list[Row]:
        """The rows of C, and those that keep the platform from turning."""
        labels, rows = self.equations()
        place = {label: i for i, label in enumerate(labels)}
        way = way_to_platform(self.mechanism)
        turns = [
            self._row(way, coordinate, place)
            for coordinate in range(SCREW_DIMENSION)[DIRECTION]
        ]
        return [*rows, *filter(None, turns)]

    def _row(
        self, way: Sequence[Step], coordinate: int, place: Mapping[str, int]
    ) -> Row:
        """One coordinate of the twists along a way, by columns."""
        row: Row = {}
        for joint, sign in way:
            for label in self.network.labels_of.get(joint, ()):
                entry = self.framed.column(label)[coordinate]
                if label in place and entry != 0:
                    row[place[label]] = sign * entry
        return row

    def posture_at(self, point: Point, prime: int) -> ExactPosture:
        """The twists at an exact point of the ring."""
        twists = {
            label: tuple(residue(x, point, prime) for x in column)
            for label, column in zip(
                self.framed.joints, self.framed.columns, strict=True
            )
        }
        return ExactPosture(twists, prime, {}, ConstantField((), 0))

    def motion_at(
        self, point: Point, prime: int, locked: Collection[str] = ()
    ) -> Motion:
        """The joint rates that close all loops at an exact point of the ring."""
        return motion(self.network, self.posture_at(point, prime), locked)

    def generic_state(self, locked: Collection[str] = ()) -> GraphState:
        """What moves in general: the larger rank of two random postures."""
        found = [
            state_of(motion(self.network, posture, locked))
            for posture in self.network.postures
        ]
        return max(found, key=ranks_of)

    @cached_property
    def generic_motions(self) -> tuple[Motion, ...]:
        """The joint rates that close all loops, at random exact postures."""
        return self.network.motions

    @cached_property
    def limbs(self) -> tuple[WholeGraph, ...]:
        """The limbs, each as a mechanism of its own."""
        ends = self.mechanism.base, self.mechanism.platform
        return tuple(
            WholeGraph(self.network.part(limb.joints, ends).mechanism)
            for limb in self.network.limbs
        )

    @property
    def libraries(self) -> Mapping[TrigonometricRing, FactorLibrary]:
        """The factors met so far, those of the limbs too, by ring."""
        own = [self, *self.limbs]
        return {graph.framed.ring: graph.library for graph in own}


class InPlace(WholeGraph):
    """A part of a mechanism as a mechanism of its own, in the ring of the whole."""

    def __init__(self, mechanism: Mechanism, framed: FramedTwists) -> None:
        super().__init__(mechanism)
        self._framed = framed

    @cached_property
    def framed(self) -> FramedTwists:
        """The twists of the whole mechanism."""
        return self._framed


def state_of(found: Motion) -> GraphState:
    """The counts of a motion."""
    return GraphState(found.rank, found.mobility, len(found.platform_twists))


def ranks_of(state: GraphState) -> tuple[int, int]:
    """What is largest at postures in general: the rank, then what the platform feels.

    Both are ranks of matrices; where the first is the same the second, which has the
    platform's rows besides, falls with its freedom at special postures.
    """
    return state.loop, state.platform_freedom


class LockedRanks:
    """What is left to move when freedoms are locked, for many choices of them.

    The joint rates that close all loops are few; of a choice only their part in the
    locked freedoms matters.
    """

    def __init__(self, found: Motion) -> None:
        self._motion = found
        network, prime = found.network, found.posture.prime
        platform = network.mechanism.platform
        connected = network.connected(platform, network.mechanism.base)
        self._platform = [t[platform] if connected else [] for t in found.all_twists]
        self._prime = prime

    def state(self, locked: Sequence[str]) -> GraphState:
        """What moves with these freedoms locked."""
        rates = [[r.get(x, 0) for x in locked] for r in self._motion.rates]
        held = rank(rates, self._prime) if locked and rates else 0
        both = [
            [*own, *twist] for own, twist in zip(rates, self._platform, strict=True)
        ]
        felt = rank(both, self._prime) - held if both and both[0] else 0
        mobility = self._motion.mobility - held
        columns = len(self._motion.network.labels) - len(locked)
        return GraphState(columns - mobility, mobility, felt)
