"""The wrenches of limbs with what a person calls them.

Lines through two of a limb's points first; of limbs with loops inside also those that
are constructed from its points.

References: [Merlet1989]; [LongCaroKhalil2012] Table 3.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from screwkit.algebra.modular import rank
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.constructed_wrenches import constructed_wrenches
from screwkit.loci.named_screws import (
    AXIS,
    JOIN,
    LINE,
    NORMAL,
    NamedScrew,
    joint_screws,
)
from screwkit.loci.placed_points import (
    PlacedPoint,
    placed_points,
    sample_points,
    wrench_through,
)
from screwkit.loci.reciprocal_lines import reciprocal_lines, twists_at


def wrench_screws(
    assembly: Assembly,
    locked: Collection[str] = (),
    on: Sequence[tuple[Sequence[int], int]] = (),
) -> tuple[NamedScrew, ...]:
    """Independent wrenches of each limb; couples of limbs with loops inside beside.

    A limb's wrenches need not all be found.

    Args:
        assembly: The mechanism.
        locked: Actuated joints, which resist every motion.
        on: Exact postures at which they are wrenches; by default all postures.
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
        lines, _ = reciprocal_lines(passive, own, points, on or samples)
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


def _join(
    ring: TrigonometricRing, a: PlacedPoint, b: PlacedPoint, limb: int
) -> NamedScrew:
    wrench = wrench_through(a.coordinates, b.coordinates)
    column = tuple(ring.normal(value) for value in wrench)
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
