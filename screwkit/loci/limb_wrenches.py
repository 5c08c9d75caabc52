"""The wrenches of limbs with what a person calls them.

Lines through two of a limb's points first; of limbs with loops inside also those that
are constructed from its points.

References: [Merlet1989]; [LongCaroKhalil2012] Table 3.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import partial

from screwkit.algebra.cases import possible_factors
from screwkit.algebra.modular import rank
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.conventions import DIRECTION
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.brackets import Line
from screwkit.loci.constructed_wrenches import constructed_wrenches
from screwkit.loci.named_screws import (
    AXIS,
    JOIN,
    LINE,
    NORMAL,
    NamedScrew,
    joint_screws,
)
from screwkit.loci.placed_features import features_of
from screwkit.loci.placed_points import (
    PlacedPoint,
    common_normals,
    normal_directions,
    placed_points,
    sample_points,
    wrench_through,
)
from screwkit.loci.reciprocal_lines import reciprocal_lines, twists_at

_NORMALS = 10  # directions normal to two of a limb
_SQUARE = 40  # terms of a squared distance


def wrench_screws(
    assembly: Assembly,
    locked: Collection[str] = (),
    on: Sequence[tuple[Sequence[int], int]] = (),
    *,
    firm: bool = False,
) -> tuple[NamedScrew, ...]:
    """Independent wrenches of each limb; couples of limbs with loops inside beside.

    A limb's wrenches need not all be found.

    Args:
        assembly: The mechanism.
        locked: Actuated joints, which resist every motion.
        on: Exact postures at which they are wrenches; by default all postures.
        firm: Rather take lines through points that coincide at no posture.
    """
    framed = assembly.common_twists
    samples = sample_points(assembly.root(framed.ring))
    if not samples:
        return ()
    points, owners = placed_points(assembly, samples)
    axes = [s for s in joint_screws(framed) if s.is_line and not s.ball]
    found: list[NamedScrew] = []
    for number, limb in enumerate(assembly.limbs):
        if not limb.nested:
            continue
        passive = twists_at(assembly, limb, locked, on or samples)
        own = [i for i, owner in enumerate(owners) if number in owner]
        is_firm = partial(_is_firm, assembly, points) if firm else None
        lines, wanted = reciprocal_lines(passive, own, points, on or samples, is_firm)
        if len(lines) < wanted and limb.elements is None:
            more = [
                *normal_directions(points, own, framed.ring)[:_NORMALS],
                *common_normals(features_of(framed), number, framed.ring)[:_NORMALS],
            ]
            own += range(len(points), len(points) + len(more))
            points += more
            lines, _ = reciprocal_lines(passive, own, points, on or samples, is_firm)
        joins = [_join(framed.ring, points[a], points[b], number) for a, b in lines]
        found += joins
        if limb.elements is not None:
            found += constructed_wrenches(
                framed.ring,
                number,
                joins,
                [points[i] for i in own],
                [axis for axis in axes if axis.limb == number],
                passive,
                on or samples,
            )
    return tuple(_named_as_axis(screw, axes, samples) for screw in found)


def _named_as_axis(
    screw: NamedScrew,
    axes: Sequence[NamedScrew],
    samples: Sequence[tuple[Sequence[int], int]],
) -> NamedScrew:
    """The line by the name of the axis that lies on it, if one does."""
    if screw.is_line:
        for axis in sorted(axes, key=lambda a: a.limb != screw.limb):
            if all(rank([screw.at(*at), axis.at(*at)], at[1]) == 1 for at in samples):
                return replace(screw, noun=AXIS, name=axis.name)
    return screw


def _is_firm(assembly: Assembly, points: Sequence[PlacedPoint], line: Line) -> bool:
    """Whether a line's points are apart at every posture, or one is a direction."""
    a, b = (points[i] for i in line)
    if a.ideal or b.ideal:
        return not (a.ideal and b.ideal)
    ring = assembly.common_twists.ring
    along = wrench_through(a.coordinates, b.coordinates)[DIRECTION]
    square = ring.normal(sum((x * x for x in along), ring.zero))
    if not 0 < len(square) <= _SQUARE:
        return False
    root, library = assembly.root(ring), assembly.library(ring)
    return not possible_factors(root, square, library)


def _join(
    ring: TrigonometricRing, a: PlacedPoint, b: PlacedPoint, limb: int
) -> NamedScrew:
    wrench = wrench_through(a.coordinates, b.coordinates)
    column = tuple(ring.normal(value) for value in wrench)
    if a.constructed or b.constructed:
        place, way = (b, a) if a.constructed else (a, b)
        name = f"through {place.name} {way.name}"
        return NamedScrew(column, JOIN, name, limb)
    if a.ideal and b.ideal:
        name = " and ".join(_axis(p) for p in (a, b))
        return NamedScrew(column, NORMAL, name, limb, free=True)
    if a.ideal or b.ideal:
        place, way = (b, a) if a.ideal else (a, b)
        name = f"through {place.name} parallel to axis {_axis(way)}"
        return NamedScrew(column, JOIN, name, limb)
    if a.written and b.written:
        name = " ".join(sorted((a.name, b.name)))
        return NamedScrew(column, LINE, name, limb)
    return NamedScrew(column, JOIN, f"through {a.name} and {b.name}", limb)


def _axis(direction: PlacedPoint) -> str:
    return direction.name.removeprefix("the direction of axis ")
