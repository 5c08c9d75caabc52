"""Smooth families of closed postures, from the groups in which loops close.

If the displacement of every loop of a basis stays in a group of dimension dᵢ and the
loop equations have the rank Σ dᵢ, they are a submersion and the closed postures are a
manifold.  Two devices make more loops close in small groups: joints that turn by equal
or opposite angles are tied to one parameter, and a body whose twists form an algebra is
also led there by a virtual joint of that group.  Either leaves a subfamily; if its
dimension is the instantaneous mobility, it is all there is.  A short loop that closes
identically along its own motion counts with its rank.

References: [Herve1999], [RicoRavani2003] (kinematic chains and subalgebras).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from screwkit.finite.chain_graph import (
    ChainGraph,
    Cycle,
    Edge,
    independent_cycles,
    with_parameters,
)
from screwkit.finite.higher_order import continuation, fails_at_once, fails_early
from screwkit.finite.lie_closure import (
    ResidueScrew,
    Span,
    is_subalgebra,
    loop_algebra,
)
from screwkit.finite.tied_families import MOST_CYCLES, subfamilies

MOST_VIRTUAL = 8
LONGEST = 6
"""Freedoms up to which a single loop is followed along its own motion."""

LARGEST_BLOCK = 80
"""Freedoms up to which subfamilies and all short loops are tried."""


@dataclass(frozen=True)
class Closing:
    """A subfamily with the groups in which a basis of its loops closes.

    Attributes:
        graph: The subfamily; its parameters may be fewer than the mechanism's freedoms.
        basis: Loops.
        dimensions: dᵢ of each loop of the basis.
        virtual: Pairs of bodies joined by a virtual joint.
        tied: Whether joints are tied to each other.
        held: Whether joints that do not move are held.
        followed: Orders through which loops of the basis were followed whose dᵢ is
            their rank, because they close identically along their own motions.
    """

    graph: ChainGraph
    basis: tuple[Cycle, ...]
    dimensions: tuple[int, ...]
    virtual: tuple[tuple[str, str], ...] = ()
    tied: bool = False
    held: bool = False
    followed: tuple[int, ...] = ()

    @property
    def deficit(self) -> int:
        """Σ dᵢ − rank; the family is proved smooth where it is 0."""
        return sum(self.dimensions) - self.graph.rank

    @property
    def identical(self) -> bool:
        """Whether all loops close identically: any parameters give a posture."""
        return not any(self.dimensions) and not self.virtual


class _Search:
    """The search in one family; the groups of loops are computed once.

    Attributes:
        graph: The family without virtual joints.
        ends: Bodies between which a virtual joint is tried in any case.
        follow: Whether short loops are followed along their own motion.
    """

    def __init__(
        self, graph: ChainGraph, ends: Sequence[str], follow: bool = False
    ) -> None:
        self.graph, self.ends, self.follow = graph, ends, follow
        self._twists = graph.body_twists()
        self._dimensions: dict[tuple[str, ...], int] = {}
        self._systems: dict[tuple[str, str], Sequence[ResidueScrew] | None] = {}
        self._alone: dict[tuple[str, ...], tuple[ChainGraph, int]] = {}
        self._followed: dict[tuple[str, ...], int] = {}

    def best(self) -> Closing:
        """Virtual joints are added as long as one makes loops close in less."""
        found = self._best()
        while not found.deficit and not self._confirmed(found):
            found = self._best()
        return self._told(found)

    def plain(self) -> Closing:
        """Without virtual joints: all postures."""
        found = self._closing(())
        while not self._confirmed(found):
            found = self._closing(())
        return self._told(found)

    def _best(self) -> Closing:
        best = self._closing(())
        pair = tuple(body for body in self.ends if body in self._twists)
        if best.deficit and len(pair) == 2 and self._system(pair[0], pair[1]):
            other = self._closing(((pair[0], pair[1]),))
            if other.deficit <= best.deficit:
                best = other
        while best.deficit and len(best.virtual) < MOST_VIRTUAL:
            found = self._split(best)
            if found is None:
                break
            best = self._closing((*best.virtual, found))
        return best

    def _closing(self, virtual: tuple[tuple[str, str], ...]) -> Closing:
        """The loops with the smallest groups, some virtual joints added."""
        graph = self.graph
        for one, other in virtual:
            graph = _joined(graph, one, other, self._system(one, other) or ())
        cycles = graph.simple_cycles(MOST_CYCLES)
        ordered = sorted(cycles, key=lambda c: (self._dimension(graph, c), len(c)))
        basis = independent_cycles(graph, ordered, len(graph.fundamental_cycles))
        dimensions = tuple(self._dimension(graph, c) for c in basis)
        return Closing(graph, tuple(basis), dimensions, virtual)

    def _confirmed(self, closing: Closing) -> bool:
        """Whether the loops counted with their rank close for good.

        They were followed through the first orders alone, and are far enough only where
        it matters; those that fail count with their group from then on.
        """
        for cycle in closing.basis:
            key = _names(closing.graph, cycle)
            if key in self._alone and key not in self._followed:
                alone, dimension = self._alone[key]
                found = continuation(alone)
                if found.fails_at is not None or not found.identical:
                    del self._alone[key]
                    self._dimensions[key] = dimension
                    return False
                self._followed[key] = found.checked
        return True

    def _told(self, closing: Closing) -> Closing:
        """With the orders through which loops of the basis were followed."""
        keys = (_names(closing.graph, cycle) for cycle in closing.basis)
        orders = (self._followed.get(key) for key in keys if key in self._alone)
        followed = tuple(order for order in orders if order is not None)
        return replace(closing, followed=followed)

    def _split(self, closing: Closing) -> tuple[str, str] | None:
        """The two bodies of a loop whose virtual joint saves most equations.

        It turns a loop of the basis into two, with fewer equations than the loop and
        the joint's freedoms together.
        """
        graph, most, chosen = closing.graph, 0, None
        for cycle, dimension in zip(closing.basis, closing.dimensions, strict=True):
            bodies = [
                (graph.edges[n].tail if sign > 0 else graph.edges[n].head)
                for n, sign in cycle
            ]
            for i, j in combinations(range(len(cycle)), 2):
                pair = bodies[i], bodies[j]
                system = self._system(*pair)
                if system is None or pair in closing.virtual:
                    continue
                two = _joined(graph, *pair, system)
                new = range(len(graph.edges), len(two.edges))
                there = tuple((n, 1) for n in new)
                back = tuple((n, -1) for n in reversed(new))
                saved = dimension + len(system)
                saved -= self._dimension(two, (*cycle[i:j], *back))
                if saved > most:
                    saved -= self._dimension(two, (*cycle[j:], *cycle[:i], *there))
                if saved > most:
                    most, chosen = saved, pair
        return chosen

    def _dimension(self, graph: ChainGraph, cycle: Cycle) -> int:
        key = _names(graph, cycle)
        if key not in self._dimensions:
            dimension = len(loop_algebra(graph.word(cycle), graph.prime))
            self._dimensions[key] = dimension
            if self.follow:
                self._follow(graph, cycle)
        return self._dimensions[key]

    def _follow(self, graph: ChainGraph, cycle: Cycle) -> None:
        """Count a loop with its rank if it is one like Bennett's, which closes so."""
        key, word = _names(graph, cycle), graph.word(cycle)
        alone = with_parameters((graph.edges[n] for n, _ in cycle), graph.prime)
        if not alone.mobility or not alone.width == len(word) <= LONGEST:
            return
        if alone.rank < self._dimensions[key] and not fails_early(alone):
            self._alone[key] = alone, self._dimensions[key]
            self._dimensions[key] = alone.rank

    def _system(self, one: str, other: str) -> Sequence[ResidueScrew] | None:
        """Relative twists of two bodies, where they are an algebra below se(3)."""
        key = one, other
        if key not in self._systems:
            self._systems[key] = None
            if one in self._twists and other in self._twists:
                system = self._relative_twists(one, other)
                if len(system) < 6 and is_subalgebra(system, self.graph.prime):
                    self._systems[key] = system
        return self._systems[key]

    def _relative_twists(self, one: str, other: str) -> list[ResidueScrew]:
        prime, system = self.graph.prime, list[ResidueScrew]()
        span = Span(prime)
        for a, b in zip(self._twists[one], self._twists[other], strict=True):
            relative = tuple((y - x) % prime for x, y in zip(a, b, strict=True))
            if span.add(relative):
                system.append(relative)
        return system


def _names(graph: ChainGraph, cycle: Cycle) -> tuple[str, ...]:
    """Tells a cycle in all graphs of a search; virtual joints are named by bodies."""
    return tuple(sorted(graph.edges[number].name for number, _ in cycle))


def smooth_family(graph: ChainGraph, ends: Sequence[str]) -> Closing | None:
    """A family of closed postures proved smooth, of the full instantaneous mobility.

    Args:
        graph: A block.
        ends: Base and platform, which are tried as ends of a virtual joint.
    """
    if graph.width > LARGEST_BLOCK:
        closing = all_postures(graph)
        return None if closing.deficit else closing
    plain = _Search(graph, ()).plain()
    if not plain.deficit:
        return plain
    if fails_at_once(graph):
        return None
    for family, tied, held in subfamilies(graph):
        closing = _Search(family, ends).best()
        if not closing.deficit and closing.graph.mobility == graph.mobility:
            return replace(closing, tied=tied, held=held)
    closing = _Search(graph, ends, follow=True).best()
    return None if closing.deficit else closing


def smooth_subfamilies(
    graph: ChainGraph, rates: Sequence[Mapping[int, int]]
) -> Iterator[Closing]:
    """Families of closed postures proved smooth whose rates are those given.

    Args:
        graph: A block.
        rates: Some of those that close its loops, independent.
    """
    if graph.width > LARGEST_BLOCK:
        return
    for family, tied, held in subfamilies(graph, rates):
        closing = _Search(family, ()).best()
        if not closing.deficit and closing.graph.mobility == len(rates):
            yield replace(closing, tied=tied, held=held)


def all_postures(graph: ChainGraph) -> Closing:
    """The groups in which the loops of a block close, nothing tied or led.

    The deficit is the number of equations that second and higher orders can add.
    """
    if graph.width <= LARGEST_BLOCK:
        return _Search(graph, (), follow=True).plain()
    basis = graph.fundamental_cycles
    algebras = [loop_algebra(graph.word(cycle), graph.prime) for cycle in basis]
    return Closing(graph, basis, tuple(map(len, algebras)))


def _joined(
    graph: ChainGraph, one: str, other: str, system: Sequence[ResidueScrew]
) -> ChainGraph:
    """With a virtual joint: exponentials of a basis in series, locally the group."""
    edges, here = list(graph.edges), one
    for number, screw in enumerate(system, start=1):
        there = other if number == len(system) else f"{one}~{other}/{number}"
        name = f"{one}~{other}:{number}"
        edges.append(Edge(name, here, there, screw, graph.width + number - 1))
        here = there
    if not system:
        edges.append(Edge(f"{one}~{other}", one, other))
    return ChainGraph(tuple(edges), graph.width + len(system), graph.prime)
