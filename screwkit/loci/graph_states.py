"""What the platform of any joint graph can do on a branch, and where that changes.

A limb's rank is the dimension of the twists that it alone allows the platform, loops
inside it closed.  All numbers of a state are ranks of C or of [C; P], the loop
constraint matrix without and with the platform held: of the whole graph, of each limb,
and with the actuators locked.

References: [Zlatanov2002]; [LongCaroKhalil2012] §5.2.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace
from functools import partial

from screwkit.algebra.branches import Branch
from screwkit.algebra.points import Point
from screwkit.algebra.search import Search
from screwkit.conventions import DIRECTION
from screwkit.kinematics.network import motion
from screwkit.kinematics.subspaces import dimension
from screwkit.kinematics.whole_graph import InPlace, Row, WholeGraph, state_of
from screwkit.loci.matrix_drop import RankAt, matrix_zeros
from screwkit.loci.platform_state import Change, may_slide_more
from screwkit.results.strata import PlatformState


class GraphStates:
    """States of one joint graph whose loops close by construction.

    Args:
        graph: The mechanism.
        actuated: The freedoms that are locked; None where none is.
    """

    def __init__(self, graph: WholeGraph, actuated: Collection[str] | None) -> None:
        self.mechanism = graph.mechanism
        self.size = len(graph.network.rows)
        self.root = replace(graph.root, thorough=True)
        self.library = graph.library
        self._graph = graph
        self._actuated = actuated
        ends = graph.mechanism.base, graph.mechanism.platform
        self._limbs = [
            InPlace(graph.network.part(limb.joints, ends).mechanism, graph.framed)
            for limb in graph.network.limbs
        ]

    def on(self, branch: Branch) -> PlatformState | None:
        """Generic on a branch; None where it has no exact point."""
        states = [self.at(*point) for point in branch.points]
        return max(states, key=lambda s: (s.limb_ranks, -s.mobility), default=None)

    def at(self, point: Point, prime: int) -> PlatformState:
        """At one exact point of the ring."""
        graph = self._graph
        posture = graph.posture_at(point, prime)
        whole = motion(graph.network, posture)
        twists = whole.platform_twists
        turning = dimension([twist[DIRECTION] for twist in twists], prime)
        locked = None
        if self._actuated is not None:
            held = motion(graph.network, posture, self._actuated)
            locked = len(held.platform_twists)
        return PlatformState(
            limb_ranks=tuple(
                len(motion(limb.network, posture).platform_twists)
                for limb in self._limbs
            ),
            wrench_dimension=self.size - len(twists),
            platform_freedom=len(twists),
            motion_type=f"{len(twists) - turning}T{turning}R",
            mobility=whole.mobility,
            locked_freedom=locked,
        )

    def changes(self, branch: Branch, search: Search) -> Iterator[Change]:
        """Where C or [C; P] lose rank: of the limbs, of the whole, actuators locked."""
        state = self.on(branch)
        matrices = [*self._matrices()]
        if state is None or may_slide_more(state):
            matrices.append((self._graph.unturned_equations(), self._unturned_rank))
        for rows, rank_at in matrices:
            own = replace(search, found=[], unfinished=[], special=[])
            zeros = matrix_zeros(branch, rows, rank_at, own)
            found = any(self.on(part) != state for part in zeros.branches)
            # Ranks may fall together and leave the state, and fall apart inside.
            ruled_out = not zeros.open and not zeros.branches
            yield Change(found, ruled_out, 1 + search.budget - own.budget)

    def _matrices(self) -> Iterator[tuple[list[Row], RankAt]]:
        graphs: list[tuple[WholeGraph, Collection[str]]] = [
            (limb, ()) for limb in self._limbs
        ]
        graphs.append((self._graph, ()))
        if self._actuated:
            graphs.append((self._graph, self._actuated))
        for graph, locked in graphs:
            for held in (False, True):
                _, rows = graph.equations(locked, held=held)
                if rows:
                    yield rows, partial(_rank, graph, locked, held)

    def _unturned_rank(self, point: Point, prime: int) -> int:
        """Of C and the rows that keep the platform from turning, at an exact point."""
        found = self._graph.motion_at(point, prime)
        turns = [twist[DIRECTION] for twist in found.platform_twists]
        return state_of(found).loop + dimension(turns, prime)


def _rank(
    graph: WholeGraph, locked: Collection[str], held: bool, point: Point, prime: int
) -> int:
    """Of C or [C; P] at an exact point."""
    state = state_of(graph.motion_at(point, prime, locked))
    return state.held if held else state.loop
