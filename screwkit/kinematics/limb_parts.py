"""A limb as its parts in series: twists of joints, and blocks of chains side by side.

A serial limb is its columns; a limb with loops inside has `SideBySide` among them.  At
an exact point the joint motions of such a limb are counted: what the platform gets of
them, and what stays idle with both ends held.

References: [Hunt1978], §13 (systems in series and in parallel).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from screwkit.algebra.modular import annihilator, echelon, rank
from screwkit.algebra.points import Point, residue
from screwkit.kinematics.series_parallel import Chain

Column: TypeAlias = Sequence[Any]
"""A twist: polynomials, or their residues at a point."""


@dataclass(frozen=True)
class SideBySide:
    """Chains between the same two bodies; each allows what its parts together do."""

    chains: tuple[Parts, ...]


Part: TypeAlias = Column | SideBySide
Parts: TypeAlias = Sequence[Part]


def parts_of(chain: Chain, columns: Mapping[str, Sequence[Column]]) -> list[Part]:
    """The parts of a chain.

    Args:
        chain: Joints and blocks from one end to the other.
        columns: The twists of every joint's freedoms that are not locked, by joint.
    """
    found: list[Part] = []
    for element in chain:
        if isinstance(element, str):
            found.extend(columns.get(element, ()))
        else:
            branches = tuple(tuple(parts_of(b, columns)) for b in element.branches)
            found.append(SideBySide(branches))
    return found


def has_loops(parts: Parts) -> bool:
    """Whether chains lie side by side among the parts."""
    return any(isinstance(part, SideBySide) for part in parts)


def columns_of(parts: Parts) -> Iterator[Column]:
    """The twists of all freedoms, those inside blocks too."""
    for part in parts:
        if isinstance(part, SideBySide):
            for chain in part.chains:
                yield from columns_of(chain)
        else:
            yield part


def mapped(parts: Parts, change: Callable[[Column], Column]) -> list[Part]:
    """The same parts with every column changed."""
    return [
        SideBySide(tuple(tuple(mapped(chain, change)) for chain in part.chains))
        if isinstance(part, SideBySide)
        else change(part)
        for part in parts
    ]


@dataclass(frozen=True)
class PartsMotion:
    """What some parts in series can do at one exact point.

    Attributes:
        twists: Basis of the twists of one end relative to the other, residues.
        freedoms: Number of columns.
        idle: Dimension of the joint motions with both ends held.
        height: Coordinates of a twist.
    """

    twists: tuple[Sequence[int], ...]
    freedoms: int
    idle: int
    height: int

    @property
    def dimension(self) -> int:
        """Of the twists."""
        return len(self.twists)

    @property
    def inner_rank(self) -> int:
        """Rank of the closure equations of the loops inside."""
        return self.freedoms - self.idle - self.dimension


def motion_at(parts: Parts, height: int, point: Point, prime: int) -> PartsMotion:
    """The joint motions of parts in series at an exact point.

    Args:
        parts: In series.
        height: Coordinates of a twist.
        point: Of the ring of the columns.
        prime: Of the point.
    """

    def at_point(column: Column) -> list[int]:
        return [residue(entry, point, prime) for entry in column]

    return motion_of(mapped(parts, at_point), height, prime)


def motion_of(parts: Parts, height: int, prime: int) -> PartsMotion:
    """The joint motions of parts in series whose columns are residues."""
    rows: list[Sequence[int]] = []
    freedoms = idle = 0
    for part in parts:
        if isinstance(part, SideBySide):
            own = _between(part, height, prime)
            rows.extend(own.twists)
            freedoms += own.freedoms
            idle += own.idle
        else:
            rows.append(part)
            freedoms += 1
    basis = tuple(echelon(rows, prime))
    return PartsMotion(basis, freedoms, idle + len(rows) - len(basis), height)


def _between(block: SideBySide, height: int, prime: int) -> PartsMotion:
    chains = [motion_of(chain, height, prime) for chain in block.chains]
    forms = [f for c in chains for f in annihilator(c.twists, height, prime)]
    return PartsMotion(
        tuple(annihilator(forms, height, prime)),
        sum(chain.freedoms for chain in chains),
        sum(chain.idle for chain in chains),
        height,
    )


def shared_dimension(limbs: Sequence[PartsMotion], prime: int) -> int:
    """Dimension of the twists that all limbs allow the body at their end."""
    if not limbs:
        return 0
    height = limbs[0].height
    forms = [f for limb in limbs for f in annihilator(limb.twists, height, prime)]
    return height - rank(forms, prime)
