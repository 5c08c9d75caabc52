"""Closed postures of a mechanism whose loops tie joint variables, and what they demand.

The proof starts with the demands as conditions that are not solved.  Each must be a
multiple of an equation that the loops of the mechanism give, so that it holds at every
closed posture.  What is claimed of postures is looked at where all loops close.  Where
nothing is tied every posture is closed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

from screwkit.algebra.all_roots import vanishes
from screwkit.algebra.exact_point import PointRing
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.postures import POINTS, Postures, Way
from screwkit.certificates.texts import NoPostureError, RefusedError, read
from screwkit.kinematics.tied_twists import closing_demands, tied_demands
from screwkit.mechanism.model import Mechanism

_ATTEMPTS = 40


class ClosedPostures:
    """The closed postures of one part.

    Args:
        mechanism: As read.
        postures: Of the mechanism and the part.
    """

    def __init__(self, mechanism: Mechanism, postures: Postures) -> None:
        self._mechanism, self._postures = mechanism, postures
        self._part = postures.part

    @property
    def conditions(self) -> tuple[str, ...]:
        """Equations that vanish at every closed posture."""
        return tuple(demand.equation for demand in self._part.demands)

    def demanded(self) -> None:
        """Check that closed loops demand what the part says.

        Raises:
            RefusedError: If they do not.
        """
        demands = self._part.demands
        if demands and not self._postures.tied:
            raise RefusedError("no loop of it ties joint variables")
        for point in self._postures.several(Way()):
            if not self._postures.tied:
                return
            known = dict(enumerate(tied_demands(self._mechanism, point)))
            for demand in demands:
                if demand.number not in known:
                    raise RefusedError(f"its loops give no equation {demand.number}")
                right = point.value(read(demand.times)) * known[demand.number]
                if point.value(read(demand.equation)) != right:
                    raise RefusedError(f"its loops do not give {demand.equation} = 0")

    def is_closed(self, point: PointRing) -> bool:
        """Whether all loops close at a posture."""
        return not (self._postures.tied and closing_demands(self._mechanism, point))

    def closes(self, point: PointRing) -> bool:
        """As `is_closed`, at all roots at once.

        Raises:
            SplitError: If loops close at some of them alone.
        """
        return all(map(vanishes, closing_demands(self._mechanism, point)))

    def in_general(self) -> list[PointRing]:
        """Closed postures that the part gives.

        Raises:
            RefusedError: If none is found.
        """
        if not self._postures.tied:
            return self._postures.several(Way())
        return [*self.on(Way(), self._part.closed)]

    def on(self, way: Way, roots: Sequence[Unsolved]) -> Iterator[PointRing]:
        """Closed ones among postures that steps and some conditions admit.

        Raises:
            RefusedError: If none is found.
        """
        return islice(self._closed(self._postures.on(way, roots)), POINTS)

    def _closed(self, points: Iterable[PointRing]) -> Iterator[PointRing]:
        missed = 0
        for point in points:
            if self.is_closed(point):
                missed = 0
                yield point
                continue
            missed += 1
            if missed > _ATTEMPTS:
                raise NoPostureError("no loop closes at its postures")
