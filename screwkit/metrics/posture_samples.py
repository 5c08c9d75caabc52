"""A set of closed postures, always the same, and the length that goes with it.

What a file declares under ``variables``, and the joint variables of tables and open
chains, describe the posture.  Each is drawn evenly from a range: an angle from the
circle, anything else from a surrounding of its value, half the characteristic length to
either side, or 1/2 where it is a component of a rotation and has no unit.  No loop
ties these symbols, so that every draw is a closed posture.

The characteristic length is the root mean square distance of the turning axes from the
reference point, with all but the angles as in the file.  It grows with the mechanism,
so that what is divided by it does not.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.names import left_or_meant
from screwkit.algebra.ranges import end_of_range
from screwkit.errors import ExpressionError, UndecidedError, UnknownNameError
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.unit_twists import UnitTwists, twists_and_centre, unit_twists
from screwkit.results.schemes import SampledRange

SEED = 1
"""Of the random numbers; a constant, so that the same question has the same answer."""

Interval = tuple[float, float]


@dataclass(frozen=True, eq=False)
class PostureSample:
    """Postures and the unit twists there.

    Attributes:
        twists: At the postures that exist.
        undefined: How many were left out because a number does not exist there.
        ranges: What was drawn from; empty where there is one posture only.
        length: That counts as one radian, in file units.
    """

    twists: UnitTwists
    undefined: int
    ranges: tuple[SampledRange, ...]
    length: float


def interval_of(
    text: str, known: Sequence[str], given: Collection[str] = ()
) -> tuple[str, Interval]:
    """A symbol and its range as they are written, ``NAME=FROM:TO``.

    Args:
        text: The range.
        known: Symbols of the mechanism.
        given: Those that had a value put in their place.

    Raises:
        UnknownNameError: If the name is no symbol of the mechanism.
        ExpressionError: If the rest is no range.
    """
    name, interval = limits_of(text)
    if name not in known:
        hint = left_or_meant(name, known, given)
        raise UnknownNameError(f"--within {text}: no symbol {name!r} to draw{hint}")
    return name, interval


def limits_of(text: str) -> tuple[str, Interval]:
    """Any name and its range.

    Raises:
        ExpressionError: If it is none.
    """
    name, sign, rest = text.rpartition("=")
    parts = rest.split(":")
    if not sign or len(parts) != 2:
        raise ExpressionError(f"{text!r} is no range; write NAME=FROM:TO")
    start, stop = (end_of_range(part, text) for part in parts)
    if not start <= stop:
        raise ExpressionError(f"{text!r} ends before it starts")
    return name.strip(), (start, stop)


def posture_symbols(mechanism: Mechanism) -> tuple[str, ...]:
    """The symbols that describe the posture, not the mechanism."""
    free = tuple(p.name for p in mechanism.parameters if p.free)
    if mechanism.geometry == "posture":
        return free
    joints = tuple(
        name
        for joint in mechanism.joints
        for number, name in enumerate(joint.variables)
        if not joint.held or joint.held[number] is None
    )
    return free + joints


def posture_sample(
    mechanism: Mechanism,
    count: int,
    within: Mapping[str, Interval],
    length: float | None = None,
    seed: int = SEED,
) -> PostureSample:
    """Random closed postures of a mechanism whose loops tie no symbols.

    Args:
        mechanism: Its dimensions have values.
        count: How many postures are drawn; one where nothing can differ.
        within: Ranges in place of the usual ones, by symbol.
        length: That counts as one radian; the characteristic length where None.
        seed: Of the random numbers.

    Raises:
        UndecidedError: If a symbol has no value, or no posture exists.
    """
    names = tuple(dict.fromkeys((*posture_symbols(mechanism), *within)))
    centres = _centres(mechanism, names, within)
    count = count if names else 1
    unit = np.random.default_rng(seed).random((count, len(names)))
    drawn = dict(zip(names, unit.T, strict=True))
    angles = _angles(mechanism, centres)
    intervals = {**dict.fromkeys(angles, (-np.pi, np.pi)), **within}

    def at(known: Mapping[str, Interval]) -> UnitTwists:
        values: dict[str, Array | float] = {**centres}
        for name, (start, stop) in known.items():
            values[name] = start + (stop - start) * drawn[name]
        ring = ring_at(mechanism, values)
        with np.errstate(all="ignore"):
            return unit_twists(mechanism, ring, count)

    turned = {name: intervals[name] for name in angles}
    measure = _root_mean_square(at(turned)) if length is None else length
    rotated = _rotation_symbols(mechanism)
    for name in names:
        if name not in intervals:
            reach = 0.5 if name in rotated else measure / 2
            intervals[name] = centres[name] - reach, centres[name] + reach
    twists = at(intervals)
    exist = _existing(twists)
    if not exist.any():
        raise UndecidedError(
            f"none of the {count} postures that were drawn exists: give ranges with "
            f"--within"
        )
    ranges = tuple(
        SampledRange(name, *intervals[name], name in angles, name in within)
        for name in names
    )
    left_out = count - int(exist.sum())
    return PostureSample(twists.at(exist), left_out, ranges, measure)


def _existing(twists: UnitTwists) -> Array:
    finite = np.isfinite(twists.directions) & np.isfinite(twists.moments)
    return np.asarray(finite.all(axis=(1, 2)))


def _root_mean_square(twists: UnitTwists) -> float:
    """Of the axes' distances from the reference point; 1 where all pass through it."""
    kept = twists.at(_existing(twists))
    arms = np.cross(kept.directions, kept.moments)[kept.turning]
    if not len(arms):
        return 1.0
    square = float((arms**2).sum(axis=-1).mean())
    return float(np.sqrt(square)) or 1.0


def _centres(
    mechanism: Mechanism, names: Sequence[str], within: Mapping[str, Interval]
) -> dict[str, float]:
    """Values of the file, the middle of a range where it gives none, else 0."""
    written = {p.name for p in mechanism.parameters if p.value is not None}
    for parameter in mechanism.parameters:
        if parameter.name not in written and parameter.name not in names:
            raise UndecidedError(
                f"no value for {parameter.name}: --set {parameter.name}=…"
            )
    middle = {name: (low + high) / 2 for name, (low, high) in within.items()}
    known = {name: middle.get(name, 0.0) for name in names if name not in written}
    values = ring_at(mechanism, known).values
    return {name: float(values[name]) for name in names}


class _Asked(BatchRing):
    """Remembers which symbols are used as numbers, not as angles alone."""

    def __init__(self, values: Mapping[str, Array | float]) -> None:
        super().__init__(values)
        self.numbers: set[str] = set()

    def symbol(self, name: str) -> Array:
        """The value, which counts as asked for."""
        self.numbers.add(name)
        return super().symbol(name)

    def cosine_sine(self, angle: str) -> tuple[Array, Array]:
        """Cos and sin, which ask for no number."""
        value = self.values[angle]
        return np.cos(value), np.sin(value)


def _angles(mechanism: Mechanism, centres: Mapping[str, float]) -> frozenset[str]:
    """The symbols that occur in sines and cosines alone."""
    ring = _Asked(ring_at(mechanism, centres).values)
    with np.errstate(all="ignore"):
        twists_and_centre(mechanism, ring)
    return frozenset(centres) - ring.numbers


def _rotation_symbols(mechanism: Mechanism) -> frozenset[str]:
    """Symbols in the platform's rotation: angles, or components of a quaternion."""
    if mechanism.pose is None:
        return frozenset()
    parts = (symbols_of(x) for row in mechanism.pose.rotation for x in row)
    return frozenset().union(*parts)
