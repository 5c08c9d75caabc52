"""Unit twists of all freedoms about the reference point, at many postures at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.grasping.matrices import reference_point
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.placement import joint_twists
from screwkit.kinematics.product_of_exponentials import placed_by_variables
from screwkit.mechanism.model import Mechanism
from screwkit.screw import vector
from screwkit.screw.vector import Vector


@dataclass(frozen=True, eq=False)
class UnitTwists:
    """Twists of unit axes, about the reference point.

    Attributes:
        labels: The freedoms.
        directions: Unit vectors, zero for slides; shape (postures, freedoms, 3).
        moments: In file units for axes that turn, unit vectors for slides; same shape.
    """

    labels: tuple[str, ...]
    directions: Array
    moments: Array

    @property
    def turning(self) -> Array:
        """Which twists turn, shape (postures, freedoms)."""
        return np.asarray(self.directions.any(axis=-1))

    def at(self, chosen: Array) -> UnitTwists:
        """At some of the postures."""
        return UnitTwists(self.labels, self.directions[chosen], self.moments[chosen])

    def of(self, labels: Sequence[str], length: float) -> Array:
        """Coordinates without units: (ω; v/L), and (0; v) of slides, by rates over L.

        Args:
            labels: The freedoms, in the order wanted.
            length: L, in file units.

        Returns:
            Shape (postures, freedoms, 6).
        """
        order = [self.labels.index(label) for label in labels]
        measure = np.where(self.turning, length, 1.0)[..., None]
        whole = np.concatenate([self.directions, self.moments / measure], axis=-1)
        return np.asarray(whole[:, order])


def unit_twists(mechanism: Mechanism, ring: BatchRing, postures: int) -> UnitTwists:
    """The twists at all postures of a ring; nan where a number does not exist.

    Args:
        mechanism: Every symbol has a value in the ring.
        ring: Arrays of shape (postures,), or numbers.
        postures: How many.
    """
    twists, centre = twists_and_centre(mechanism, ring)
    about = np.stack([np.broadcast_to(x, postures) for x in centre], axis=-1)
    directions, moments = (
        np.stack(
            [
                np.stack([np.broadcast_to(x, postures) for x in half], axis=-1)
                for half in halves
            ],
            axis=1,
        )
        for halves in (
            [twist.direction for twist in twists.values()],
            [twist.moment for twist in twists.values()],
        )
    )
    moments = moments - np.cross(about[:, None], directions)
    turns = directions.any(axis=-1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        size = np.linalg.norm(
            np.where(turns, directions, moments), axis=-1, keepdims=True
        )
        return UnitTwists(tuple(twists), directions / size, moments / size)


def twists_and_centre(
    mechanism: Mechanism, ring: BatchRing
) -> tuple[Mapping[str, JointTwist[Array]], Vector[Array]]:
    """Twists about the base origin as the file writes them, and the reference point."""
    centre = reference_point(mechanism, ring)
    if mechanism.geometry != "reference":
        return joint_twists(mechanism, ring, mechanism.base), centre
    placed, twists = placed_by_variables(mechanism, ring)
    there = placed[mechanism.platform]
    return twists, vector.add(vector.rotate(there.rotation, centre), there.translation)
