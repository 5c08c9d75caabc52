"""What the platform at the end of limbs can do on a branch: ranks at its exact points.

The platform's twists are the meet of the limbs' twist systems, whatever overlaps; with
joints locked, the meet of those of the passive twists.

References: [Zlatanov2002]; [LongCaroKhalil2012] §5.2.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, Protocol

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.search import Search
from screwkit.algebra.telling_coordinates import telling_coordinates
from screwkit.conventions import MOMENT, SCREW_DIMENSION
from screwkit.kinematics.assembly import Assembly, loop_rows
from screwkit.kinematics.joints_aside import freedoms_aside
from screwkit.kinematics.subspaces import PlatformSystem
from screwkit.loci.dependence import dependent_zeros
from screwkit.loci.rank_drop import Column, rank_drop
from screwkit.mechanism.model import Mechanism
from screwkit.results.strata import PlatformState


class Change(NamedTuple):
    """Where on a branch one of the ranks that make a state falls.

    Attributes:
        found: There are postures with another state.
        ruled_out: It is proved that there are none.
        cost: Case distinctions.
    """

    found: bool
    ruled_out: bool
    cost: int


class States(Protocol):
    """States of one mechanism with one scheme, and where they change.

    Attributes:
        mechanism: Of which they are.
        size: Coordinates of a twist.
        root: The whole space of its free symbols.
        library: The factors met in its ring.
    """

    mechanism: Mechanism
    size: int
    root: Branch
    library: FactorLibrary

    def on(self, branch: Branch) -> PlatformState | None:
        """Generic on a branch; None where it has no exact point."""

    def changes(self, branch: Branch, search: Search) -> Iterator[Change]:
        """By each rank that makes the state.

        Args:
            branch: Irreducible.
            search: Its budget is that of each rank.
        """


class PlatformStates:
    """States of limbs that are serial chains.

    Args:
        assembly: The mechanism.
        actuated: The joints that are locked; None where none is.
    """

    def __init__(self, assembly: Assembly, actuated: Collection[str] | None) -> None:
        ring = assembly.common_twists.ring
        self.mechanism = assembly.mechanism
        self.size = assembly.dimension
        self.root = replace(assembly.root(ring), thorough=True)
        self.library = assembly.library(ring)
        self._assembly = assembly
        self._moving = len(assembly.joints) + freedoms_aside(assembly)
        self._actuated = actuated

    def on(self, branch: Branch) -> PlatformState | None:
        """Generic on a branch; None where it has no exact point.

        Of two random points the one with the higher ranks is generic.
        """
        states = [self.at(*point) for point in branch.points]
        if not states:
            return None
        return max(states, key=lambda s: (s.limb_ranks, -s.mobility))

    def at(self, point: Point, prime: int) -> PlatformState:
        """At one exact point of the ring of all limbs."""
        assembly = self._assembly
        framed = assembly.common_twists
        limbs = [
            {
                joint: [residue(x, point, prime) for x in framed.column(joint)]
                for joint in limb.joints
            }
            for limb in assembly.limbs
        ]
        twists = [list(limb.values()) for limb in limbs]
        rows = loop_rows(twists)
        platform = PlatformSystem.held_by(twists, prime)
        locked = None
        if self._actuated is not None:
            passive = [
                [twist for joint, twist in limb.items() if joint not in self._actuated]
                for limb in limbs
            ]
            locked = PlatformSystem.held_by(passive, prime).freedom
        return PlatformState(
            limb_ranks=tuple(rank(limb, prime) for limb in twists),
            wrench_dimension=assembly.dimension - platform.freedom,
            platform_freedom=platform.freedom,
            motion_type=platform.motion_type,
            mobility=self._moving - (rank(rows, prime) if rows else 0),
            locked_freedom=locked,
        )

    def changes(self, branch: Branch, search: Search) -> Iterator[Change]:
        """Where limbs lose a rank, or their wrenches become dependent.

        Translations are what one more limb that slides in every direction allows.
        """
        choices = [self._limbs(())]
        if self._actuated:
            choices.append(self._limbs(self._actuated))
        for limbs in choices:
            for limb in filter(None, limbs):
                drop = rank_drop(branch, limb, search).decomposition
                found = any(b.points for b in drop.branches)
                yield Change(found, drop.complete and not drop.branches, 0)
            yield _dependence(branch, limbs, search)
        state = self.on(branch)
        if state is None or may_slide_more(state):
            yield _dependence(branch, self._with_slides(), search)

    def _limbs(self, locked: Collection[str]) -> list[list[Column]]:
        return [
            [*self._assembly.told([j for j in limb.joints if j not in locked])]
            for limb in self._assembly.limbs
        ]

    def _with_slides(self) -> list[list[Column]]:
        """The limbs, and one that allows every translation that a limb could give."""
        framed = self._assembly.common_twists
        ring = framed.ring
        moments = range(SCREW_DIMENSION)[MOMENT]
        met = [i for i in moments if any(column[i] != 0 for column in framed.columns)]
        slides: list[Column] = [
            [ring.context.constant(int(i == place)) for i in range(SCREW_DIMENSION)]
            for place in met
        ]
        limbs = [*([*map(framed.column, x.joints)] for x in self._assembly.limbs)]
        whole: list[Sequence[Column]] = [*limbs, slides]
        places = telling_coordinates(column for limb in whole for column in limb)
        return [[[c[place] for place in places] for c in limb] for limb in whole]


def may_slide_more(state: PlatformState) -> bool:
    """Whether twists of this dimension can hold more translations than they do."""
    return state.motion_type != f"{state.platform_freedom}T0R"


def _dependence(
    branch: Branch, limbs: Sequence[Sequence[Column]], search: Search
) -> Change:
    """Where the twists of limbs that keep their ranks meet in more."""
    own = replace(search, found=[], unfinished=[], special=[])
    zeros = dependent_zeros(branch, limbs, own, within=True)
    cost = 1 + search.budget - own.budget
    return Change(bool(zeros.branches), not zeros.open, cost)
