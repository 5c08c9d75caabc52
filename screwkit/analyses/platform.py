"""The platform's freedoms: its twist system, the wrenches that leave it, its class."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite

from screwkit.algebra.modular import ResampleError
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.kinematics.network import Motion, Network
from screwkit.kinematics.subspaces import dimension, reciprocal
from screwkit.results.mobility import (
    FullCycle,
    MotionClass,
    Platform,
    PrincipalScrew,
)
from screwkit.systems.system_class import classify

OUT_OF_PLANE = ((1, 0, 0, 0, 0, 0), (0, 1, 0, 0, 0, 0), (0, 0, 0, 0, 0, 1))
"""The twists that a planar file does not speak of."""


def platform(at: Motion) -> Platform:
    """Dimensions and type at an exact posture."""
    prime, twists = at.posture.prime, at.platform_twists
    around = list(OUT_OF_PLANE) if len(at.network.rows) == 3 else []
    wrenches = reciprocal([*twists, *around], prime)
    directions = dimension([twist[:3] for twist in twists], prime)
    forces = dimension([wrench[:3] for wrench in wrenches], prime)
    translations = len(twists) - directions
    return Platform(
        twist_dimension=len(twists),
        translations=translations,
        rotations=directions,
        motion_type=f"{translations}T{directions}R",
        wrench_dimension=len(wrenches),
        couples=len(wrenches) - forces,
        finite_motion_types=(),
        motion_class=motion_class(at.network),
    )


def motion_class(
    network: Network, body: str = "", relative_to: str = ""
) -> MotionClass | None:
    """The class of a body's twist system, the platform's by default.

    None where the two exact postures disagree.
    """
    one, other = network.motions
    link = body or network.mechanism.platform
    systems = [(m.twists_of(link, relative_to), m.posture.prime) for m in (one, other)]
    known = Reconstruction(
        one.posture.field,
        (one.posture.prime, other.posture.prime),
        (one.posture.constants, other.posture.constants),
    )
    try:
        found = classify(systems, known)
    except ResampleError:
        return None
    return MotionClass(
        found.name,
        found.words,
        found.subgroup,
        tuple(
            PrincipalScrew(
                screw.direction,
                screw.point or (),
                screw.pitch if isfinite(screw.pitch) else None,
            )
            for screw in found.principal
        ),
    )


def finite_types(about: Platform, cycle: FullCycle, mobility: int | None) -> Platform:
    """With the motion types of the finite branches, each once, in a fixed order.

    Args:
        about: The platform at the posture.
        cycle: The branches.
        mobility: Dimension of the joint rates there.  Where the finite motion is proved
            to have that dimension, its type is that of the twists; None where a posture
            was reached by numbers alone.
    """
    types = sorted({b.finite_type for b in cycle.branches if b.mobility} - {""})
    proved = cycle.status == "proved" and cycle.mobility == (mobility,)
    if cycle.mobility == (0,):
        types = ["0T0R"]
    elif not types and proved:
        types = [about.motion_type]
    return replace(about, finite_motion_types=tuple(types))
