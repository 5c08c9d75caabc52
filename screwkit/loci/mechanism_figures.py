"""Figures of a whole mechanism: its joints' axes, and the lines of limbs' wrenches."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import partial
from typing import Literal

from screwkit.algebra.branches import Branch
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.block_motions import block_motions
from screwkit.loci.figures import Figures
from screwkit.loci.limb_wrenches import wrench_screws
from screwkit.loci.member_wrenches import member_wrenches
from screwkit.loci.named_screws import NamedScrew, joint_screws
from screwkit.loci.pieces import Piece
from screwkit.loci.placed_features import features_of
from screwkit.loci.placed_points import placed_at, placed_points, sample_points
from screwkit.mechanism.model import Mechanism
from screwkit.screw.vector import Vector, cross


def axes_of(
    framed: FramedTwists,
    root: Branch,
    library: FactorLibrary,
    locked: Collection[str] = (),
) -> tuple[Figures]:
    """The axes and slides of joints that are not locked."""

    def screws() -> list[NamedScrew]:
        return [s for s in joint_screws(framed) if s.name not in locked]

    return (Figures(framed, root, library, screws),)


def graph_figures(
    mechanism: Mechanism,
    framed: FramedTwists,
    root: Branch,
    library: FactorLibrary,
    locked: Collection[str] = (),
) -> tuple[Figures, Figures]:
    """Of any joint graph: its axes, and the wrenches of members with two joints."""
    members = partial(member_wrenches, mechanism, framed, locked)
    own = Figures(framed, root, library, members)
    return (*axes_of(framed, root, library), own)


def figures_of(assembly: Assembly, locked: Collection[str] = ()) -> tuple[Figures, ...]:
    """What may become dependent with these joints locked.

    Two limbs make one loop, of which the axes say more than the wrenches.
    """
    framed = assembly.common_twists
    given = framed, assembly.root(framed.ring), assembly.library(framed.ring)
    (axes,) = axes_of(*given, locked)
    wrenches = Figures(
        *given,
        lambda: wrench_screws(assembly, locked),
        lambda: held_points(assembly, locked),
        directions="last",
        forces="last",
    )
    found = (axes, wrenches) if len(assembly.limbs) < 3 else (wrenches, axes)
    if not assembly.has_blocks:
        return found
    members = partial(member_wrenches, assembly.mechanism, framed, locked)
    # Where limbs lose freedoms unlocked, locked ones are no better.
    behind = [
        Figures(*given, partial(block_motions, assembly, held), directions="first")
        for held in dict.fromkeys((tuple(locked), ()))
    ]
    return (*found, *behind, Figures(*given, members))


def figures_on(
    assembly: Assembly, locked: Collection[str] = ()
) -> Callable[[Piece, bool], Figures]:
    """What limbs transmit on a piece, where some have lost motions and resist more.

    Told to be firm it takes lines that are lost nowhere, where there are such.
    """
    framed = assembly.common_twists
    given = framed, assembly.root(framed.ring), assembly.library(framed.ring)

    def figures(piece: Piece, firm: bool) -> Figures:
        on = [point for branch in piece.branches for point in branch.points]
        screws = partial(wrench_screws, assembly, locked, on, firm=firm)
        along: Literal["first"] | None = "first" if firm else None
        return Figures(*given, screws, directions="first", forces=along)

    return figures


def held_points(
    assembly: Assembly, locked: Collection[str]
) -> list[tuple[str, Vector[Polynomial]]]:
    """Points of the platform that one limb alone keeps where they are.

    All axes of that limb that are not locked pass through the point, so that its
    wrenches are all forces through it, whatever lines there are to name them.

    Args:
        assembly: The mechanism.
        locked: Actuated joints.
    """
    framed = assembly.common_twists
    samples = sample_points(assembly.root(framed.ring))
    if not samples:
        return []
    at, prime = samples[0]

    def stays(label: str, place: Sequence[int]) -> bool:
        turn, velocity = (
            [residue(v, at, prime) for v in framed.column(label)[part]]
            for part in (DIRECTION, MOMENT)
        )
        x, y, z = place
        across = cross((turn[0], turn[1], turn[2]), (x, y, z))
        return not any((v + w) % prime for v, w in zip(velocity, across, strict=True))

    free = [
        [label for label in limb.joints if label not in locked]
        for limb in assembly.limbs
        if limb.elements is None
    ]
    found = []
    for point in features_of(framed).points:
        place = [residue(v, at, prime) for v in point.position]
        if any(own and all(stays(j, place) for j in own) for own in free):
            found.append((place, point))
    if not found:
        return []
    named, _ = placed_points(assembly, samples)
    written = {
        tuple(x * pow(w, -1, prime) % prime for x in (a, b, c)): point.name
        for point, (a, b, c, w) in zip(named, placed_at(named, at, prime), strict=True)
        if point.written and w
    }
    return [
        (written.get(tuple(place), point.name), point.position)
        for place, point in found
    ]
