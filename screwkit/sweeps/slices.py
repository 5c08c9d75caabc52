"""Singular loci in a slice of two symbols: their curves, by the signs of polynomials.

All other symbols have been given their values before the loci were derived, so that the
components are those of the slice.  A curve is drawn where a component has one equation
and this changes its sign; everything else is said in words.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression, Symbol
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.names import limb_called
from screwkit.algebra.parse import parse
from screwkit.algebra.text import expression_text
from screwkit.errors import ExpressionError, UndecidedError
from screwkit.kinematics.placement import TURNING, why_tied
from screwkit.kinematics.values import declared_values, given_before
from screwkit.mechanism.model import Joint, JointType, Mechanism
from screwkit.results.singularities import Component, Singularities
from screwkit.results.slice import SingularSlice, SlicedComponent
from screwkit.sweeps.grid import Axis, axis_of, grid_of, refuse_unfit
from screwkit.sweeps.zero_lines import Segment, zero_lines

STEPS: Final = 201
"""Values of a symbol where the range says no number."""


@dataclass(frozen=True)
class Slicing:
    """Which symbols vary, and what the others are.

    Attributes:
        axes: Along and across.
        units: Of the two, for labels.
        fixed: The values of all others.
    """

    axes: tuple[Axis, Axis]
    units: tuple[str, str]
    fixed: dict[str, Expression]


def slicing_of(mechanism: Mechanism, ranges: Sequence[str]) -> Slicing:
    """Two ranges, ``name=from:to`` or ``name=from:to:count``, and the other values.

    Raises:
        UnknownNameError: If a name is no symbol that may vary.
        ExpressionError: If there are not two ranges, or one is none.
        UndecidedError: If another symbol has no value.
    """
    if len(ranges) != 2:
        raise ExpressionError(
            f"a slice has two symbols, --slice NAME=FROM:TO twice, not {len(ranges)}"
        )
    free: list[str] = []
    if mechanism.geometry != "posture" and not why_tied(mechanism):
        free = [name for joint in mechanism.joints for name in _not_held(joint)]
    symbols = [parameter.name for parameter in mechanism.parameters]
    given = given_before(mechanism)
    one, two = (_axis(text, [*symbols, *free], given) for text in ranges)
    refuse_unfit((one, two), mechanism.parameters, zero=True)
    if one.name == two.name:
        raise ExpressionError(f"{one.name!r} is sliced twice")
    grid_of((one, two))
    varied = {one.name, two.name}
    values = declared_values(mechanism)
    missing = [name for name in symbols if name not in values and name not in varied]
    if missing:
        raise UndecidedError(
            f"in a slice all other symbols have values, and {', '.join(missing)} "
            f"{'has' if len(missing) == 1 else 'have'} none: --set {missing[0]}=…"
        )
    fixed = {name: values[name] for name in symbols if name not in varied}
    fixed |= {name: parse("0", ()) for name in free if name not in varied}
    units = _unit(mechanism, one.name), _unit(mechanism, two.name)
    return Slicing((one, two), units, fixed)


def _not_held(joint: Joint) -> list[str]:
    """The variables of a joint to which no value was given."""
    held = joint.held or (None,) * len(joint.variables)
    return [n for n, value in zip(joint.variables, held, strict=True) if value is None]


def _axis(text: str, known: Sequence[str], given: Collection[str]) -> Axis:
    if text.count(":") not in {1, 2}:
        raise ExpressionError(f"{text!r} is no range; write NAME=FROM:TO")
    full = text if text.count(":") > 1 else f"{text}:{STEPS}"
    found = axis_of(full, known, given)
    if not (np.isfinite([found.start, found.stop]).all() and found.start < found.stop):
        raise ExpressionError(f"{text!r}: a range of a slice ascends")
    if found.count < 2:
        raise ExpressionError(f"{text!r}: a slice needs two values or more")
    return found


def _unit(mechanism: Mechanism, name: str) -> str:
    """Of a symbol where the file says what it is: an angle, or a length."""
    for joint in mechanism.joints:
        if name in joint.variables:
            slides = joint.type is JointType.PRISMATIC
            return "rad" if joint.type in TURNING else mechanism.units if slides else ""
    if any(p.name == name and p.angle for p in mechanism.parameters):
        return "rad"
    pose = mechanism.pose
    moves = pose is not None and Symbol(name) in pose.translation
    return mechanism.units if moves else ""


@dataclass(frozen=True)
class Curve:
    """A component and its curve in the slice."""

    component: SlicedComponent
    segments: tuple[Segment, ...]


def curves_of(answer: Singularities, slicing: Slicing) -> tuple[Curve, ...]:
    """The components of the loci of a slice, each once, with their curves."""
    parts: dict[tuple[str, ...], list[str]] = {}
    first: dict[tuple[str, ...], Component] = {}
    for part, component in _components(answer):
        key = component.equations
        parts.setdefault(key, []).append(part)
        first.setdefault(key, component)
    return tuple(
        _curve(component, tuple(parts[key]), slicing)
        for key, component in first.items()
    )


def _components(answer: Singularities) -> list[tuple[str, Component]]:
    found = [
        (limb_called(limb.limb), component)
        for limb in answer.limb
        for component in limb.components
    ]
    found += [("constraint", component) for component in answer.constraint.components]
    if answer.actuation is not None:
        found += [("actuation", c) for c in answer.actuation.components]
        found += [("idle", c) for c in answer.actuation.idle]
    return found


def _curve(component: Component, parts: tuple[str, ...], slicing: Slicing) -> Curve:
    shown = SlicedComponent(
        parts, component.equations, component.geometry or "", segments=0
    )
    if len(component.equations) != 1:
        note = "several equations: isolated points, or none that is real"
        return Curve(replace(shown, note=note), ())
    one, two = slicing.axes
    names = one.name, two.name
    expression = parse(component.equations[0], names, limits=RESULT_LIMITS)
    function = partial(_values, expression, names)
    segments = zero_lines(function, one.values, two.values)
    note = "" if segments else "it does not change its sign on the grid"
    return Curve(replace(shown, segments=len(segments), note=note), segments)


def _values(
    expression: Expression, names: tuple[str, str], x: Array, y: Array
) -> Array:
    ring = BatchRing(dict(zip(names, (x, y), strict=True)))
    return np.asarray(np.broadcast_to(evaluate(expression, ring), x.shape))


def slice_of(
    answer: Singularities, slicing: Slicing, curves: Sequence[Curve]
) -> SingularSlice:
    """What is drawn, in words and numbers."""
    one, two = slicing.axes
    return SingularSlice(
        (one.name, two.name),
        ((one.start, one.stop), (two.start, two.stop)),
        (one.count, two.count),
        slicing.units,
        tuple(f"{n} = {expression_text(v)}" for n, v in slicing.fixed.items()),
        tuple(curve.component for curve in curves),
        _remark(answer),
    )


def _remark(answer: Singularities) -> str:
    actuation = answer.actuation
    if actuation is not None and not actuation.admissible:
        locked = ", ".join(actuation.actuated)
        return f"the platform can move everywhere in the slice with {locked} locked"
    proved = [limb.complete for limb in answer.limb] + [answer.constraint.complete]
    proved += [] if actuation is None else [actuation.complete]
    return "" if all(proved) else "not proved to be all components"
