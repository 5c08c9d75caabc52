"""How screws, loops and the platform change with the coordinates of all joints.

What a freedom carries moves with its twist: a screw by the Lie bracket, the centre of a
ball joint by the twist's velocity there, what a loop misses by the twists of its ends.

References: [MurrayLiSastry1994] §3.4 (Jacobians), [LynchPark2017] ch. 8 (brackets).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import (
    Stance,
    carried,
    cross,
    exponential,
    moved,
    placed_nodes,
    rotation_vectors,
    stance_of,
)
from screwkit.finite.posture_model import PostureModel
from screwkit.finite.spanning_forest import Forest, Indices

SMALL = 1e-4
"""Angles below which the first term of a series is the rest of it."""


@dataclass(frozen=True, eq=False)
class Placed:
    """A mechanism at joint coordinates, its freedoms as they are passed there.

    Attributes:
        carriers: The node that carries each screw of the stance, shape (freedoms,).
        stance: The posture.
        nodes: Displacements of all nodes, shape (batch, nodes, 4, 4).
        columns: The twist of what follows each freedom per rate, shape
            (batch, freedoms, 6); unlike the screws of a stance not set upright.
    """

    forest: Forest
    carriers: Indices
    stance: Stance
    nodes: Array
    columns: Array

    def twists(self, node: int) -> Array:
        """Of a node per unit rate, shape (batch, 6, freedoms)."""
        return np.swapaxes(self.columns * self.forest.ways[node][:, None], 1, 2)

    def misses_by_rates(self) -> Array:
        """Of the rotation vector and the shift of each loop's gap.

        Returns:
            Shape (batch, 6·loops, freedoms).
        """
        (far, near), ways, gaps = (
            self.forest.closing,
            self.forest.ways,
            self.stance.gaps,
        )
        there = self.columns[:, None] * ways[far][:, :, None]
        here = self.columns[:, None] * ways[near][:, :, None]
        batch, loops, freedoms, _ = there.shape
        twists = there - carried(gaps[:, :, None], here)
        turning, moving = twists[..., :3], twists[..., 3:]
        shift = np.broadcast_to(gaps[:, :, None, :3, 3], moving.shape)
        turned = by_turning(rotation_vectors(gaps[..., :3, :3]))
        rates = np.concatenate(
            [
                turned @ np.swapaxes(turning, 2, 3),
                np.swapaxes(moving + cross(turning, shift), 2, 3),
            ],
            axis=2,
        )
        return rates.reshape(batch, 6 * loops, freedoms)

    def pose_by_rates(self, point: Array) -> Array:
        """Of the platform's rotation vector and of where it carries a point.

        Args:
            point: Shape (3,).

        Returns:
            Shape (batch, 6, freedoms).
        """
        node = int(self.forest.tracked[0])
        turn, shift = self.nodes[:, node, :3, :3], self.nodes[:, node, :3, 3]
        twists = np.swapaxes(self.twists(node), 1, 2)
        turning, moving = twists[..., :3], twists[..., 3:]
        now = np.broadcast_to((turn @ point + shift)[:, None], moving.shape)
        return np.concatenate(
            [
                by_turning(rotation_vectors(turn)) @ np.swapaxes(turning, 1, 2),
                np.swapaxes(moving + cross(turning, now), 1, 2),
            ],
            axis=1,
        )

    def forms_by_rates(self, forms: Array) -> Array:
        """Of Σ φ_j(s_j) for fixed linear forms of the screws of the stance.

        Args:
            forms: φ_j, shape (batch, count, freedoms, 6).

        Returns:
            Shape (batch, count, freedoms).
        """
        screws = self.stance.screws
        along, moment = (
            np.broadcast_to(x[:, None], forms[..., :3].shape)
            for x in (screws[..., :3], screws[..., 3:])
        )
        first, second = forms[..., :3], forms[..., 3:]
        # φ([c, s]) for a twist c that carries s, as a form of c.
        carrying = np.concatenate(
            [cross(along, first) + cross(moment, second), cross(along, second)], axis=-1
        )
        before = self.carriers.copy()
        if len(self.forest.balls):
            triple = self.forest.balls[:, None] + np.arange(3)
            axes, arms = screws[:, triple, :3], screws[:, triple, 3:]
            centre = 0.5 * cross(axes, arms).sum(axis=2)
            pulled = cross(along[:, :, triple], second[:, :, triple])
            middle = np.broadcast_to(centre[:, None, :, None], pulled.shape)
            # Upright axes stay, so that only the centre's velocity counts.
            carrying[:, :, triple] = np.concatenate(
                [cross(middle, pulled), pulled], axis=-1
            )
            before[triple] = before[self.forest.balls][:, None]
        behind = self.forest.ways[before].T @ carrying
        return np.asarray((behind * self.columns[:, None]).sum(axis=-1))


def placed_at(
    model: PostureModel, forest: Forest, points: Array, carriers: Indices
) -> Placed:
    """The mechanism at joint coordinates.

    Args:
        model: From which they count.
        forest: Of the model.
        points: Shape (batch, freedoms).
        carriers: The node that carries each screw, shape (freedoms,).
    """
    start = stance_of(model, forest, len(points))
    nodes = placed_nodes(forest, start.screws, points)
    columns = carried(nodes[:, forest.before], start.screws)
    stance = moved(forest, start, points, nodes)
    (apart,) = np.nonzero(carriers != forest.before)
    stance.screws[:, apart] = carried(nodes[:, carriers[apart]], start.screws[:, apart])
    return Placed(forest, carriers, stance, nodes, columns)


def by_turning(vectors: Array) -> Array:
    """The rates of a rotation vector by angular velocities, shape batch + (3, 3).

    The inverse of the left Jacobian of SO(3), by its series in the cross product, whose
    even terms sum to one over the squared angle less a cotangent; the angle at most π.
    """
    angle = np.linalg.norm(vectors, axis=-1)[..., None, None]
    skew = np.zeros((*vectors.shape, 3))
    for i in range(3):
        skew[..., (i + 1) % 3, i] = vectors[..., (i + 2) % 3]
        skew[..., i, (i + 1) % 3] = -vectors[..., (i + 2) % 3]
    safe = np.where(angle > SMALL, angle, 1.0)
    bent = (1.0 - 0.5 * safe / np.tan(0.5 * safe)) / safe**2
    bent = np.where(angle > SMALL, bent, 1.0 / 12.0)
    return np.asarray(np.eye(3) - 0.5 * skew + bent * (skew @ skew))


def ball_by_rates(screws: Array, angles: Array) -> Array:
    """Of the rotation vector of a ball joint by its three angles.

    Args:
        screws: Of its freedoms, shape (3, 6).
        angles: Shape (batch, 3).

    Returns:
        Shape (batch, 3, 3).
    """
    turn = np.broadcast_to(np.eye(3), (len(angles), 3, 3))
    axes = []
    for screw, angle in zip(screws, angles.T, strict=True):
        axes.append(turn @ screw[:3])
        steps = np.broadcast_to(screw, (len(angle), 6))
        turn = turn @ exponential(steps, angle)[:, :3, :3]
    return np.asarray(by_turning(rotation_vectors(turn)) @ np.stack(axes, axis=-1))
