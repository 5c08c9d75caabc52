"""A joint graph whose loops tie joint variables together: closed postures as points.

The twists stand in the ring of all joint variables, as if they were free; which values
belong together is said by the closing equations.  Ranks are taken at exact closed
postures, modulo a prime.

References: [LongCaroKhalil2012] (4)-(9), [Schwartz1980].
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import cached_property

from screwkit.algebra.angle_elimination import Elimination, eliminated
from screwkit.algebra.branches import Branch, random_branch_prime
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.points import Point, rank_at, residue
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.search import Search
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.algebra.zeros_modulo import exact_zeros, have_no_zero
from screwkit.errors import UndecidedError
from screwkit.kinematics.frames import FramedTwists, balls_among
from screwkit.kinematics.link_invariants import link_invariants
from screwkit.kinematics.network import Motion
from screwkit.kinematics.parallel_axes import parallel_basis
from screwkit.kinematics.tied_twists import (
    closing_demands,
    tied_demands,
    tied_twists,
)
from screwkit.kinematics.whole_graph import (
    GraphState,
    InPlace,
    WholeGraph,
    ranks_of,
    state_of,
)

_BUDGET = 60  # case distinctions on the closing equations
_POINTS = 4  # exact closed postures from elimination


class TiedGraph(WholeGraph):
    """A mechanism whose joint variables are tied by its loops."""

    @cached_property
    def framed(self) -> FramedTwists:
        """The twists of all freedoms in the frame of the base, variables as if free.

        Raises:
            UndecidedError: If a freedom is not placed there.
        """
        mechanism, base = self.mechanism, self.mechanism.base
        seen = SurveyRing()
        tied_twists(mechanism, seen, base)
        tied_demands(mechanism, seen)
        names = [joint.name for joint in mechanism.joints]
        basis = parallel_basis(mechanism, names, base, TrigonometricRing(seen))
        ring = TrigonometricRing(seen, basis)
        twists = tied_twists(mechanism, ring, base)
        missing = [x for x in self.network.labels if x not in twists]
        if missing:
            raise UndecidedError(
                f"nothing places joint {missing[0]!r} relative to the base"
            )
        labels = self.network.labels
        return FramedTwists(
            ring,
            base,
            labels,
            tuple(tuple(ring.without_divisors(twists[x].coordinates)) for x in labels),
            tuple(twists[x].point for x in labels),
            tuple(
                tuple(x for name in limb.joints for x in self.network.labels_of[name])
                for limb in self.network.limbs
            ),
            balls_among(mechanism, names),
        )

    @cached_property
    def closing(self) -> tuple[Polynomial, ...]:
        """The closing equations, each once."""
        ring = self.framed.ring
        found: dict[str, Polynomial] = {}
        for equation in closing_demands(self.mechanism, ring):
            value = ring.without_divisors([equation])[0]
            if value != 0 and str(-value) not in found:
                found.setdefault(str(value), value)
        return tuple(found.values())

    @cached_property
    def invariants(self) -> tuple[Polynomial, ...]:
        """Short consequences of the closing equations, in the same unknowns."""
        ring = self.framed.ring
        known = {u for equation in self.closing for u in unknowns(ring, equation)}
        found = (
            ring.without_divisors([value])[0]
            for value in link_invariants(self.mechanism, ring)
        )
        return tuple(e for e in found if known.issuperset(unknowns(ring, e)))

    def closed_where(self, equations: Sequence[Polynomial]) -> ClosedPart:
        """Closed postures at which further equations hold."""
        root = replace(self.root, thorough=True)
        search = Search(self.library, budget=_BUDGET)
        wanted = [*equations, *self.closing]
        zeros = common_zeros(root, wanted, search)
        # On what was left open not every equation need hold.
        points = [
            point
            for branch in (*zeros.branches, *zeros.open)
            for point in branch.points
            if not any(residue(equation, *point) for equation in wanted)
        ]
        branches = tuple(zeros.branches) if zeros.complete else None
        return ClosedPart(tuple(points), branches)

    def implied(
        self, equations: Sequence[Polynomial], kept: Collection[Unknown]
    ) -> Elimination | None:
        """What further equations imply for some unknowns at closed postures.

        Args:
            equations: That hold beside the closing equations.
            kept: The unknowns.

        Returns:
            None where the others could not be taken out.
        """
        wanted = (*equations, *self.closing)
        found = eliminated(self.framed.ring, wanted, kept)
        if found is None and self.invariants:
            found = eliminated(self.framed.ring, (*self.invariants, *wanted), kept)
        return found

    @cached_property
    def closed(self) -> ClosedPart:
        """All closed postures.

        Where they were not all taken apart, points come from random slices or from
        elimination too, which know no special ones.
        """
        found = self.closed_where(())
        if found.is_complete:
            return found
        points = self.met_where(())
        if not points:
            implied = self.implied((), self.unknowns_of(self.mechanism.actuated))
            points = () if implied is None else points_of(implied, _POINTS)
        return ClosedPart((*points, *found.points), None)

    def met_where(
        self, equations: Sequence[Polynomial]
    ) -> tuple[tuple[Point, int], ...]:
        """Exact closed postures at which further equations hold, on random slices."""
        wanted = (*equations, *self.closing, *self.invariants)
        return exact_zeros(self.framed.ring, wanted, self.unknowns_of(()), _POINTS)

    def is_never_closed_where(self, equations: Sequence[Polynomial]) -> bool:
        """Whether it is seen that no closed posture, complex ones included, meets them.

        Asked only where they are more than there are unknowns.
        """
        ring, given = self.framed.ring, self.unknowns_of(())
        wanted = (*equations, *self.closing)
        met = {u for e in wanted for u in unknowns(ring, e)}.difference(given)
        more = (*wanted, *self.invariants)
        return len(wanted) > len(met) and have_no_zero(ring, more, given)

    @property
    def points(self) -> tuple[tuple[Point, int], ...]:
        """The exact closed postures that were found."""
        return self.closed.points

    def generic_state(self, locked: Collection[str] = ()) -> GraphState:
        """What moves in general at closed postures.

        Raises:
            UndecidedError: If no exact closed posture was found.
        """
        self.need_closed_postures()
        return self.state_at(self.closed.points, locked)

    def state_at(
        self, points: Sequence[tuple[Point, int]], locked: Collection[str] = ()
    ) -> GraphState:
        """The counts of largest rank at some exact postures."""
        found = [state_of(self.motion_at(*point, locked)) for point in points]
        return max(found, key=ranks_of)

    def unknowns_of(self, driven: Sequence[str]) -> tuple[Unknown, ...]:
        """The variables of driven freedoms and the dimensions, as unknowns."""
        ring, mechanism = self.framed.ring, self.mechanism
        joints = {self.network.joint_of[label] for label in driven}
        names = {v for j in mechanism.joints if j.name in joints for v in j.variables}
        names |= {parameter.name for parameter in mechanism.parameters}
        angles = [
            ("angle", number)
            for number, form in enumerate(ring.basis)
            if form[0][0] in names or form[0][0] in ring.constant_angles
        ]
        places = zip(ring.symbol_indices(), ring.symbols, strict=True)
        return (*angles, *(("x", index) for index, name in places if name in names))

    @cached_property
    def generic_motions(self) -> tuple[Motion, ...]:
        """At the exact closed postures that were found.

        Raises:
            UndecidedError: If none was.
        """
        self.need_closed_postures()
        return tuple(self.motion_at(*point) for point in self.closed.points)

    def need_closed_postures(self) -> None:
        """Refuse where no exact closed posture was found.

        Raises:
            UndecidedError: Then.
        """
        if not self.closed.points:
            raise UndecidedError(
                f"{self.network.tied}, and no exact closed posture was found"
            )

    @cached_property
    def limbs_in_place(self) -> tuple[InPlace, ...]:
        """The limbs, each as a mechanism of its own, at postures of the whole."""
        ends = self.mechanism.base, self.mechanism.platform
        return tuple(
            InPlace(self.network.part(limb.joints, ends).mechanism, self.framed)
            for limb in self.network.limbs
        )

    def limb_freedom(self, number: int, points: Sequence[tuple[Point, int]]) -> int:
        """Dimension of the twists that a limb alone allows, at exact postures."""
        limb = self.limbs_in_place[number]
        found = [state_of(limb.motion_at(*point)) for point in points]
        return max(found, key=ranks_of).platform_freedom

    def rank_of(
        self, labels: Sequence[str], points: Sequence[tuple[Point, int]]
    ) -> int:
        """The largest rank of the twists of some freedoms at exact postures."""
        columns = [self.framed.column(label) for label in labels]
        return max(rank_at(columns, *point) for point in points)


class ClosedPart:
    """Exact closed postures that were found, and whether there are others.

    Attributes:
        points: With their primes.
        branches: On which all of them lie; None where the closing equations were not
            taken apart.
        is_complete: Whether the closing equations were taken apart.
        is_empty: There is none at all; proved for real postures, special dimensions
            aside.
    """

    def __init__(
        self,
        points: tuple[tuple[Point, int], ...],
        branches: tuple[Branch, ...] | None,
    ) -> None:
        self.points = points
        self.branches = branches
        self.is_complete = branches is not None
        self.is_empty = branches == ()


def points_of(implied: Elimination, most: int) -> tuple[tuple[Point, int], ...]:
    """Exact postures at which equations hold, as far as they are found."""
    source = random.Random(20121)
    found = []
    for _ in range(4 * most):
        prime = random_branch_prime(source)
        point = implied.point(source, prime)
        if point is not None:
            found.append((point, prime))
        if len(found) == most:
            break
    return tuple(found)
