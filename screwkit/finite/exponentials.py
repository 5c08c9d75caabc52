"""Finite motion of many postures at once by products of exponentials.

Bodies are placed along a spanning forest; a joint outside it closes a loop, and what
the loop misses is the displacement that would close it.  A `Stance` holds the screws
where they stand now, so every step starts again from coordinates 0: the columns of
the Jacobian are the screws themselves and no ball joint ever locks.

References: [MurrayLiSastry1994] §2.2-§3.2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.finite.posture_model import PosedJoint, PostureModel
from screwkit.finite.spanning_forest import Forest, Indices, forest_of


@dataclass(frozen=True, eq=False)
class Stance:
    """Postures of a mechanism, one for each entry of a batch.

    Attributes:
        screws: Where the freedoms stand, shape (batch, freedoms, 6).
        gaps: The displacement around each loop, shape (batch, loops, 4, 4); the unit
            where the loop is closed.
        bodies: How far the tracked nodes have been displaced, the platform by default,
            shape (batch, tracked, 4, 4).
    """

    screws: Array
    gaps: Array
    bodies: Array

    @property
    def platform(self) -> Array:
        """The displacement of the first tracked body, shape (batch, 4, 4)."""
        return np.asarray(self.bodies[:, 0])

    def __len__(self) -> int:
        return len(self.screws)

    def take(self, chosen: Indices | NDArray[np.bool_]) -> Stance:
        """Some of the postures, or some of them several times."""
        return Stance(self.screws[chosen], self.gaps[chosen], self.bodies[chosen])

    def put(self, chosen: Indices | NDArray[np.bool_], other: Stance) -> Stance:
        """The postures with some of them replaced."""
        arrays = []
        for mine, theirs in (
            (self.screws, other.screws),
            (self.gaps, other.gaps),
            (self.bodies, other.bodies),
        ):
            joined = mine.copy()
            joined[chosen] = theirs
            arrays.append(joined)
        return Stance(*arrays)


def stance_of(model: PostureModel, forest: Forest, batch: int = 1) -> Stance:
    """The model's own posture, ``batch`` times."""
    loops = len(forest.closing_joints)
    return Stance(
        np.broadcast_to(model.screws, (batch, *model.screws.shape)).copy(),
        np.broadcast_to(np.eye(4), (batch, loops, 4, 4)).copy(),
        np.broadcast_to(np.eye(4), (batch, len(forest.tracked), 4, 4)).copy(),
    )


def exponential(screws: Array, coordinates: Array) -> Array:
    """exp(q ξ) of unit screws by Rodrigues' formula, shape batch + (4, 4).

    Args:
        screws: (ω; v) with |ω| = 1 or ω = 0, shape batch + (6,).
        coordinates: q, shape batch.

    References: [MurrayLiSastry1994] (2.14), (2.32), (2.36).
    """
    along, moment = screws[..., :3], screws[..., 3:]
    q = np.asarray(coordinates)[..., None]
    skew = _cross_matrix(along)
    turn = np.sin(q)[..., None] * skew
    turn = turn + (1.0 - np.cos(q))[..., None] * (skew @ skew)
    foot = cross(along, moment)
    pitch = np.sum(along * moment, axis=-1, keepdims=True)
    slides = np.sum(along * along, axis=-1, keepdims=True) < 0.5
    shift = q * np.where(slides, moment, pitch * along)
    result = np.zeros((*turn.shape[:-2], 4, 4))
    result[..., :3, :3] = turn + np.eye(3)
    result[..., :3, 3] = shift - (turn @ foot[..., None])[..., 0]
    result[..., 3, 3] = 1.0
    return result


def carried(displacements: Array, screws: Array) -> Array:
    """Screws displaced: Ad(g) ξ, shape batch + (6,)."""
    rotation, shift = displacements[..., :3, :3], displacements[..., :3, 3]
    along = (rotation @ screws[..., :3, None])[..., 0]
    moment = (rotation @ screws[..., 3:, None])[..., 0] + cross(shift, along)
    return np.concatenate([along, moment], axis=-1)


def inverse(displacements: Array) -> Array:
    """g⁻¹, shape batch + (4, 4)."""
    result = np.zeros_like(displacements)
    turned = np.swapaxes(displacements[..., :3, :3], -1, -2)
    result[..., :3, :3] = turned
    result[..., :3, 3] = -(turned @ displacements[..., :3, 3, None])[..., 0]
    result[..., 3, 3] = 1.0
    return result


def placed_nodes(forest: Forest, screws: Array, coordinates: Array) -> Array:
    """The displacement of every node, shape (batch, nodes, 4, 4)."""
    batch = len(coordinates)
    steps = exponential(screws, coordinates * forest.signs)
    placed = np.broadcast_to(np.eye(4), (batch, len(forest.ways), 4, 4)).copy()
    for level in forest.levels:
        placed[:, level.behind] = placed[:, level.before] @ steps[:, level.freedoms]
    return placed


def moved(
    forest: Forest,
    stance: Stance,
    coordinates: Array,
    placed: Array | None = None,
) -> Stance:
    """Every posture after a motion, based anew where it arrives.

    Args:
        forest: Of the mechanism.
        stance: Where the motion starts.
        coordinates: How far every freedom moves, shape (batch, freedoms); ball joints
            turn about x, then y, then z.
        placed: What `placed_nodes` gives for them, where that is known.
    """
    if placed is None:
        placed = placed_nodes(forest, stance.screws, coordinates)
    far, near = forest.closing
    before = placed[:, forest.before]
    screws = carried(before, stance.screws)
    if len(forest.balls):
        screws = _upright(forest.balls, before, stance.screws, screws)
    gaps = placed[:, far] @ stance.gaps @ inverse(placed[:, near])
    bodies = placed[:, forest.tracked] @ stance.bodies
    return Stance(screws, gaps, bodies)


def _upright(balls: Indices, before: Array, old: Array, new: Array) -> Array:
    """Axes of ball joints along x, y, z again, through the point where they are now."""
    triple = balls[:, None] + np.arange(3)
    along, moments = old[:, triple, :3], old[:, triple, 3:]
    centre = 0.5 * cross(along, moments).sum(axis=2)
    frames = before[:, balls]
    centre = (frames[..., :3, :3] @ centre[..., None])[..., 0] + frames[..., :3, 3]
    axes = np.broadcast_to(np.eye(3), along.shape)
    upright = np.concatenate([axes, cross(centre[:, :, None], axes)], axis=-1)
    new[:, triple] = upright
    return new


def misses(stance: Stance) -> Array:
    """By what the loops miss: (rotation vector; shift), shape (batch, 6·loops).

    To first order the twist that the joints of the loop have to undo.
    """
    turned = rotation_vectors(stance.gaps[..., :3, :3])
    both = np.concatenate([turned, stance.gaps[..., :3, 3]], axis=-1)
    return both.reshape(len(stance), -1)


def loop_jacobian(forest: Forest, stance: Stance) -> Array:
    """J_c at every posture, shape (batch, 6·loops, freedoms)."""
    signs = forest.loop_signs
    columns = stance.screws[:, None] * signs[..., None]
    batch, loops, freedoms, _ = columns.shape
    return np.swapaxes(columns, -1, -2).reshape(batch, 6 * loops, freedoms)


def body_jacobian(forest: Forest, stance: Stance, node: int) -> Array:
    """The twist of a body per unit rate, shape (batch, 6, freedoms)."""
    return np.swapaxes(stance.screws * forest.ways[node][:, None], -1, -2)


def rebased(model: PostureModel, coordinates: Array) -> PostureModel:
    """The model after a motion, as a model at the posture where it arrives.

    Args:
        model: Where the motion starts.
        coordinates: q of every freedom, shape (freedoms,), such that loops close.
    """
    forest = forest_of(model)
    q = np.asarray(coordinates, dtype=float).reshape(1, -1)
    return at_stance(model, moved(forest, stance_of(model, forest), q))


def at_stance(model: PostureModel, stance: Stance, entry: int = 0) -> PostureModel:
    """The model at one posture of a stance."""
    joints: list[PosedJoint] = []
    start = 0
    for joint in model.joints:
        stop = start + len(joint.screws)
        joints.append(replace(joint, screws=stance.screws[entry, start:stop]))
        start = stop
    return replace(model, joints=tuple(joints))


def cross(first: Array, second: Array) -> Array:
    """The vector product, broadcast; numpy's own is several times slower."""
    a, b, c = first[..., 0], first[..., 1], first[..., 2]
    x, y, z = second[..., 0], second[..., 1], second[..., 2]
    found = np.empty((*np.broadcast_shapes(a.shape, x.shape), 3))
    found[..., 0] = b * z - c * y
    found[..., 1] = c * x - a * z
    found[..., 2] = a * y - b * x
    return found


def _cross_matrix(vectors: Array) -> Array:
    matrix = np.zeros((*vectors.shape, 3))
    for i in range(3):
        matrix[..., (i + 1) % 3, i] = vectors[..., (i + 2) % 3]
        matrix[..., i, (i + 1) % 3] = -vectors[..., (i + 2) % 3]
    return matrix


def rotation_vectors(rotation: Array) -> Array:
    """Axis times angle, batch + (3,); 0 at exactly half a turn, which has no axis."""
    axis = 0.5 * np.stack(
        [
            rotation[..., 2, 1] - rotation[..., 1, 2],
            rotation[..., 0, 2] - rotation[..., 2, 0],
            rotation[..., 1, 0] - rotation[..., 0, 1],
        ],
        axis=-1,
    )
    sine = np.linalg.norm(axis, axis=-1)
    cosine = 0.5 * (np.trace(rotation, axis1=-2, axis2=-1) - 1.0)
    angle = np.arctan2(sine, cosine)
    return (
        axis * np.where(sine > 1e-150, angle / np.maximum(sine, 1e-150), 1.0)[..., None]
    )
