"""Displacements: where a frame is, seen from another.

``target_from_source`` maps coordinates in the source frame to coordinates in the
target frame; products read like chains of names.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic

from screwkit.algebra.ring import Ring, S
from screwkit.screw import vector
from screwkit.screw.vector import Rotation, Vector


@dataclass(frozen=True)
class Displacement(Generic[S]):
    """A rotation followed by a translation: x ↦ rotation·x + translation."""

    rotation: Rotation[S]
    translation: Vector[S]

    @classmethod
    def identity(cls, ring: Ring[S]) -> Displacement[S]:
        """Nothing moves."""
        o, i = ring.zero, ring.one
        return cls(((i, o, o), (o, i, o), (o, o, i)), (o, o, o))

    def then(self, inner: Displacement[S], ring: Ring[S]) -> Displacement[S]:
        """Self ∘ inner: a_from_b.then(b_from_c) is a_from_c."""
        moved = vector.rotate(self.rotation, inner.translation)
        return Displacement(
            vector.compose(ring, self.rotation, inner.rotation),
            vector.normal(ring, vector.add(moved, self.translation)),
        )

    def inverse(self, ring: Ring[S]) -> Displacement[S]:
        """The displacement back."""
        rotation = vector.transpose(self.rotation)
        x, y, z = vector.rotate(rotation, self.translation)
        return Displacement(rotation, vector.normal(ring, (-x, -y, -z)))


def screw_about(
    axis: int, pair: tuple[S, S], shift: S, ring: Ring[S]
) -> Displacement[S]:
    """Rotation by (cos, sin) about coordinate axis 0 or 2, and a shift along it."""
    c, s = pair
    o, i = ring.zero, ring.one
    if axis == 2:
        return Displacement(((c, -s, o), (s, c, o), (o, o, i)), (o, o, shift))
    return Displacement(((i, o, o), (o, c, -s), (o, s, c)), (shift, o, o))
