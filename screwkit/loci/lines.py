"""Lines and directions that a mechanism's own geometry singles out.

Along them lie the forces and couples, the rotations and translations, that a person
would draw: through points in which axes meet, along axes, in the planes of meeting
axes.  Each candidate is written once over any ring; which of them are reciprocal to
given screws is a matter of microseconds at an exact point (`reciprocals`).

References: [Merlet1989]; [LongCaroKhalil2012] §5, [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from typing import Any, TypeAlias

from screwkit.loci.constructions import (
    PlaceOf,
    Plane,
    ScrewOf,
    along,
    at_point,
    chord,
    difference,
    free,
    intersection,
    line,
    meeting_across,
    normal_to,
    on_axis,
    rejected,
    transversal,
    unit,
)
from screwkit.loci.features import Features, listed

_Way: TypeAlias = tuple[str, PlaceOf, str]
"""A direction in words, the direction, the axis it is taken from."""


@dataclass(frozen=True)
class Candidate:
    """A line, or a free direction.

    Attributes:
        name: The line: ``axis 3``, ``the line through …``; empty for a direction.
        how: What lies on it: ``along axis 3``, ``through …, parallel to axis 2``.
        screw: (direction, moment) of a screw of pitch 0 on the line; for a direction
            the zero vector and the direction.
        point: A point of the line; None where none is short, and for directions.
        rank: Smaller is simpler.
        parts: How many axes, points and right angles its words name.
    """

    name: str
    how: str
    screw: ScrewOf
    point: PlaceOf | None = None
    rank: int = 0
    parts: int = 1

    @property
    def free(self) -> bool:
        """Whether it is a direction without a place."""
        return not self.name


@dataclass(frozen=True)
class Catalogue:
    """Which lines and directions to try, and how to speak of them.

    Attributes:
        features: Over any ring; only their structure is looked at.
        base: Name of the base link.
        parallel: Pairs of axes that are parallel for every posture.
        forces: What the further lines of the geometry are called.
        whole: Of a platform: only forces are combined with each other, not the many
            joints, and lines through the origin come before all others.
    """

    features: Features[Any]
    base: str
    parallel: tuple[tuple[str, str], ...] = ()
    forces: tuple[str, ...] = ()
    whole: bool = False

    def candidates(self) -> list[Candidate]:
        """All of them, simplest first."""
        sources = [self._directions(), self._at_origin(), self._lines()]
        if not self.whole:
            sources = [sources[0], sources[2], sources[1]]
        return [
            replace(c, rank=number * 100 + c.rank)
            for number, source in enumerate(sources)
            for c in source
        ]

    # -- what there is -----------------------------------------------------------

    @property
    def _axes(self) -> list[str]:
        return [axis.joint for axis in self.features.axes]

    @property
    def _located(self) -> list[str]:
        return [axis.joint for axis in self.features.axes if axis.point is not None]

    @property
    def _combined(self) -> Sequence[str]:
        """Lines that others are built from, two at a time."""
        return self.forces if self.whole else self._axes

    @property
    def _crossed(self) -> Sequence[str]:
        """Those of them that have a place."""
        return self.forces if self.whole else self._located

    def _planes(self) -> list[Plane]:
        if self.whole:
            return []
        planes = [Plane((i, j), n) for i, j, n in self.features.planes]
        return planes + [Plane(pair, None) for pair in self.parallel]

    def _called(self, *axes: str) -> str:
        """``axes 1 and 2``, ``the force of limb left and axis 3``."""
        forces = [name for name in axes if name in self.forces]
        joints = [
            name.removeprefix("axis ") if name in forces else name
            for name in axes
            if name not in forces or name.startswith("axis ")
        ]
        named = [name for name in forces if not name.startswith("axis ")]
        if joints:
            noun = "axis" if len(joints) == 1 else "axes"
            named.append(f"{noun} {listed(joints)}")
        return " and ".join(named)

    # -- directions --------------------------------------------------------------

    def _directions(self) -> Iterator[Candidate]:
        for number, letter in enumerate("xyz"):
            how = f"along the {letter} axis of {self.base}"
            yield Candidate("", how, free(unit(number)), None, 0)
        for name in self._axes:
            how = f"along {self._called(name)}"
            yield Candidate("", how, free(along(name)), None, 1)
        for i, j in combinations(self._combined, 2):
            how = f"normal to {self._called(i, j)}"
            yield Candidate("", how, free(normal_to(i, j)), None, 2, 2)

    # -- lines -------------------------------------------------------------------

    def _at_origin(self) -> Iterator[Candidate]:
        for number, letter in enumerate("xyz"):
            name = f"the {letter} axis of {self.base}"
            screw = line(lambda g: g.origin, unit(number))
            yield Candidate(name, f"along {name}", screw, lambda g: g.origin)

    def _lines(self) -> Iterator[Candidate]:
        for rank, (parts, source) in enumerate(
            (
                (2, self._joining()),
                (2, self._through_points(self._along_axes())),
                (1, self._on_axes()),
                (2, self._through_points(self._along_units())),
                (3, self._through_points(self._across_axes())),
                (3, self._common_normals()),
                (4, self._in_planes()),
                (3, self._meeting()),
                (3, self._meeting_across()),
                (4, self._across_planes()),
                (2, self._through_axes((*self._along_axes(), *self._along_units()))),
                (3, self._through_axes(self._across_axes())),
            )
        ):
            for c in source:
                yield replace(c, rank=rank, parts=parts)

    def _on_axes(self) -> Iterator[Candidate]:
        for name in self._located:
            called = self._called(name)
            screw = line(on_axis(name), along(name))
            yield Candidate(called, f"along {called}", screw, on_axis(name))

    def _joining(self) -> Iterator[Candidate]:
        points = self.features.points
        for p, q in combinations(range(len(points)), 2):
            called = f"the line through {points[p].name} and {points[q].name}"
            screw = line(at_point(p), difference(at_point(p), at_point(q)))
            yield Candidate(called, f"along {called}", screw, at_point(p))

    def _through_points(self, ways: Iterable[_Way]) -> Iterator[Candidate]:
        directions = tuple(ways)
        for p, point in enumerate(self.features.points):
            for words, direction, axis in directions:
                if axis not in point.joints:
                    yield Candidate(
                        f"the line through {point.name} {words}",
                        f"through {point.name}, {words}",
                        line(at_point(p), direction),
                        at_point(p),
                    )

    def _along_axes(self) -> Iterator[_Way]:
        for name in self._axes:
            yield f"parallel to {self._called(name)}", along(name), name

    def _along_units(self) -> Iterator[_Way]:
        for number, letter in enumerate("xyz"):
            words = f"parallel to the {letter} axis of {self.base}"
            yield words, unit(number), ""

    def _across_axes(self) -> Iterator[_Way]:
        for i, j in combinations(self._combined, 2):
            yield f"normal to {self._called(i, j)}", normal_to(i, j), ""

    def _common_normals(self) -> Iterator[Candidate]:
        for i, j in self.parallel:
            if not self.whole:
                called = f"meeting {self._called(i, j)} at right angles"
                across = rejected(along(i), difference(on_axis(i), on_axis(j)))
                yield Candidate(
                    f"the line {called}", called, line(on_axis(i), across), on_axis(i)
                )

    def _in_planes(self) -> Iterator[Candidate]:
        for a, b in combinations(self._planes(), 2):
            if not set(a.axes) & set(b.axes):
                called = (
                    f"the intersection line of the planes of axes {', '.join(a.axes)} "
                    f"and of axes {', '.join(b.axes)}"
                )
                yield Candidate(called, f"along {called}", intersection(a, b))

    def _meeting(self) -> Iterator[Candidate]:
        for p, point in enumerate(self.features.points):
            others = [name for name in self._crossed if name not in point.joints]
            for i, j in combinations(others, 2):
                words = f"meeting {self._called(i, j)}"
                yield Candidate(
                    f"the line through {point.name} {words}",
                    f"through {point.name}, {words}",
                    line(at_point(p), transversal(at_point(p), i, j)),
                    at_point(p),
                )

    def _meeting_across(self) -> Iterator[Candidate]:
        for p, point in enumerate(self.features.points):
            others = [name for name in self._crossed if name not in point.joints]
            for i, j in product(others, self._combined):
                if i != j:
                    words = f"meeting {self._called(i)}, normal to {self._called(j)}"
                    yield Candidate(
                        f"the line through {point.name} {words}",
                        f"through {point.name}, {words}",
                        line(at_point(p), meeting_across(at_point(p), i, j)),
                        at_point(p),
                    )

    def _across_planes(self) -> Iterator[Candidate]:
        for plane in self._planes():
            others = [name for name in self._crossed if name not in plane.axes]
            for k, m in combinations(others, 2):
                words = (
                    f"in the plane of axes {', '.join(plane.axes)}, "
                    f"meeting {self._called(k, m)}"
                )
                yield Candidate(f"the line {words}", words, chord(plane, k, m))

    def _through_axes(self, ways: Iterable[_Way]) -> Iterator[Candidate]:
        named = {name for point in self.features.points for name in point.joints}
        directions = tuple(ways)
        for i in self._located:
            if i in named and self.whole:
                continue
            for words, direction, _ in directions:
                yield Candidate(
                    f"the line meeting {self._called(i)} {words}",
                    f"meeting {self._called(i)}, {words}",
                    line(on_axis(i), direction),
                    on_axis(i),
                )
