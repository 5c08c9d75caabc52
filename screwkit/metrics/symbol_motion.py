"""Whether the symbols of a file move the mechanism as its joints let it move.

To each rate of the symbols along the equations of the bodies there must be joint rates
that close the loops and carry every axis and every centre as the symbols do.

References: [MurrayLiSastry1994] §2.4 (twists carried by a body).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import loop_jacobian, stance_of
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.finite.spanning_forest import Forest, forest_of
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import JointType
from screwkit.metrics.motion_chart import MotionChart, unit_rows
from screwkit.metrics.nearest_point import split_of
from screwkit.metrics.rigid_bodies import centre
from screwkit.metrics.smooth import NUDGE, slopes
from screwkit.metrics.spans import split

CARRIED = 1e-6
"""Largest difference of two rates that are the same; differences give nine digits."""


@dataclass(frozen=True)
class SymbolMotion:
    """What rates of symbols and rates of joints have in common.

    Attributes:
        symbols: Dimension of the motions that the symbols describe.
        joints: Dimension of those that the joints allow, without the ones in which
            every axis stays where it is.
        by_joints: Whether the joints allow what the symbols describe.
    """

    symbols: int
    joints: int
    by_joints: bool


def symbol_motion(chart: MotionChart, point: Array) -> SymbolMotion:
    """Compare the rates at a point.

    Args:
        chart: Of a ``posture`` file.
        point: Of the chart, shape (n,).

    Raises:
        UndecidedError: If an axis has no direction there.
    """
    values = chart.values(point[None])
    model = posture_model(chart.mechanism, {n: float(v[0]) for n, v in values.items()})
    forest = forest_of(model)
    rates = split_of(slopes(chart.kept, point[None])[0])[1]
    wanted, carried = _rates_of_symbols(chart, point, rates), _by_joints(chart, model)
    loops = loop_jacobian(forest, stance_of(model, forest))[0]
    loops = loops / np.tile([1, 1, 1, *[chart.length] * 3], len(loops) // 6)[:, None]
    loops = _in_length(model, loops, chart.length)
    closing = np.concatenate([carried, loops])
    asked = np.concatenate([wanted, np.zeros((len(loops), rates.shape[1]))])
    found = np.linalg.lstsq(closing, asked, rcond=1e-9)[0]
    return SymbolMotion(
        symbols=split(np.where(np.abs(wanted) < CARRIED, 0.0, wanted)).rank,
        joints=split(carried @ split(loops).null_space).rank,
        by_joints=bool(np.abs(closing @ found - asked).max(initial=0.0) < CARRIED),
    )


def _in_length(model: PostureModel, matrix: Array, length: float) -> Array:
    """Columns of slides by rates over the length."""
    slides = np.linalg.norm(model.screws[:, :3], axis=1) < 0.5
    return np.asarray(matrix * np.where(slides, length, 1.0))


def _marks(chart: MotionChart, points: Array) -> Array:
    """Axes, directions and centres of all joints, shape (batch, 6·freedoms or so)."""
    mechanism = chart.mechanism
    rows = unit_rows(mechanism, chart.values(points), chart.length)
    found = []
    for joint in mechanism.joints:
        labels = freedom_labels(joint, mechanism.space)
        if joint.type is JointType.SPHERICAL or len(labels) > 2:
            found.append(centre(rows, labels))
        else:
            found += [rows[label] for label in labels]
    return np.concatenate(found, axis=-1)


def _rates_of_symbols(chart: MotionChart, point: Array, rates: Array) -> Array:
    ahead, behind = point + NUDGE * rates.T, point - NUDGE * rates.T
    return ((_marks(chart, ahead) - _marks(chart, behind)) / (2 * NUDGE)).T


def _by_joints(chart: MotionChart, model: PostureModel) -> Array:
    """The rates of the marks by joint rates, shape (marks, freedoms)."""
    length = chart.length
    measure = np.array([1.0, 1, 1, length, length, length])
    turns = np.linalg.norm(model.screws[:, :3], axis=1, keepdims=True) > 0.5
    screws = np.where(turns, model.screws / measure, model.screws)
    forest = forest_of(model)
    found = []
    start = 0
    for joint in model.joints:
        stop = start + len(joint.screws)
        if len(joint.screws) > 2:
            found.append(_of_centre(forest, screws, start, stop))
        else:
            found += [_of_axis(forest, screws, f) for f in range(start, stop)]
        start = stop
    return np.concatenate(found)


def _before(forest: Forest, screws: Array, freedom: int) -> Array:
    """The twist of what carries a freedom, per joint rate, shape (freedoms, 6)."""
    return np.asarray(screws * forest.ways[forest.before[freedom]][:, None])


def _of_axis(forest: Forest, screws: Array, freedom: int) -> Array:
    twists = _before(forest, screws, freedom)
    along, moment = screws[freedom, :3], screws[freedom, 3:]
    turned = np.cross(twists[:, :3], along)
    shifted = np.cross(twists[:, :3], moment) + np.cross(twists[:, 3:], along)
    return np.concatenate([turned, shifted], axis=1).T


def _of_centre(forest: Forest, screws: Array, start: int, stop: int) -> Array:
    # A ball joint that is passed backwards is entered at its last freedom.
    entered = start if forest.signs[start] > 0 else stop - 1
    twists = _before(forest, screws, entered)
    rows = {str(f): screws[None, f] for f in range(start, stop)}
    point = centre(rows, list(rows))[0]
    return np.asarray((twists[:, 3:] + np.cross(twists[:, :3], point)).T)
