"""Figures of a whole mechanism: its joints' axes, and the lines of limbs' wrenches."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial

from screwkit.algebra.branches import Branch
from screwkit.algebra.factors import FactorLibrary
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.figures import Figures
from screwkit.loci.limb_wrenches import wrench_screws
from screwkit.loci.named_screws import NamedScrew, joint_screws
from screwkit.loci.pieces import Piece


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


def figures_of(
    assembly: Assembly, locked: Collection[str] = ()
) -> tuple[Figures, Figures]:
    """What may become dependent with these joints locked.

    Two limbs make one loop, of which the axes say more than the wrenches.
    """
    framed = assembly.common_twists
    given = framed, assembly.root(framed.ring), assembly.library(framed.ring)
    (axes,) = axes_of(*given, locked)
    wrenches = Figures(*given, lambda: wrench_screws(assembly, locked))
    return (axes, wrenches) if len(assembly.limbs) < 3 else (wrenches, axes)


def figures_on(
    assembly: Assembly, locked: Collection[str] = ()
) -> Callable[[Piece], Figures]:
    """What limbs transmit on a piece, where some have lost motions and resist more."""
    framed = assembly.common_twists
    given = framed, assembly.root(framed.ring), assembly.library(framed.ring)

    def figures(piece: Piece) -> Figures:
        on = [point for branch in piece.branches for point in branch.points]
        screws = partial(wrench_screws, assembly, locked, on)
        return Figures(*given, screws, directions=True)

    return figures
