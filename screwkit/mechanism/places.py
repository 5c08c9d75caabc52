"""Named points and vectors of a file, and the pose that moves the platform's own.

Everything is brought to base coordinates here: a point declared with ``link:`` the
platform becomes translation + rotation · coordinates.
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt
from typing import Final, Literal, TypeAlias

from screwkit.algebra.expression import ONE, ZERO, Expression, Number
from screwkit.algebra.expression_building import (
    add,
    call,
    multiply,
    negate,
    power,
    quotient,
    subtract,
)
from screwkit.algebra.names import RESERVED, shown, why_no_symbol
from screwkit.algebra.tokens import names_in
from screwkit.algebra.vector_expression import (
    ZERO_VECTOR,
    VectorExpression,
    add_vectors,
    dot,
)
from screwkit.mechanism.model import Pose
from screwkit.mechanism.nodes import Path, find
from screwkit.mechanism.ordering import in_order_of_need
from screwkit.mechanism.plane_checks import check_pose_plane, refuse_height
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.requirements import nonzero
from screwkit.mechanism.schema import RotationEntry, VectorEntry
from screwkit.mechanism.structure import Draft

Matrix: TypeAlias = tuple[VectorExpression, VectorExpression, VectorExpression]

_TWO: Final = Number(Fraction(2))
_UNITS: Final[dict[str, VectorExpression]] = {
    "x": (ONE, ZERO, ZERO),
    "y": (ZERO, ONE, ZERO),
    "z": (ZERO, ZERO, ONE),
}
IDENTITY: Final[Matrix] = (_UNITS["x"], _UNITS["y"], _UNITS["z"])


def read_pose(draft: Draft, reading: Reading) -> Pose | None:
    """The platform's pose; None where the file gives none."""
    entry = draft.entry.pose
    if entry is None:
        return None
    if draft.entry.geometry != "posture" and "geometry" not in draft.broken:
        reading.fault_at_key(
            ("pose",),
            f"pose: only `geometry: posture` files have a pose of the platform, "
            f"this one is {draft.entry.geometry!r}",
        )
    _check_pose_is_used(draft, reading)
    path: Path = ("pose", "translation")
    translation: VectorExpression | None = ZERO_VECTOR
    if entry.translation is not None:
        translation = reading.vector(path, entry.translation)
    rotation: Matrix | None = IDENTITY
    if entry.rotation is not None:
        rotation = _rotation(entry.rotation, ("pose", "rotation"), reading)
        reading.vouch(part for row in rotation or () for part in row)
    if translation is None or rotation is None:
        return None
    pose = Pose(translation, rotation)
    return pose if check_pose_plane(pose, reading) else None


def _check_pose_is_used(draft: Draft, reading: Reading) -> None:
    """A pose acts on what stands in the platform's frame; there must be something."""
    entry = draft.entry
    places = [*entry.points.values(), *entry.vectors.values()]
    unsure = draft.broken & {"platform", "points", "vectors"} or draft.lost_names
    if unsure or any(place.link not in {None, entry.base} for place in places):
        return
    reading.fault_at_key(
        ("pose",),
        f"pose: no point or vector is given in the platform's frame, so that the pose "
        f"moves nothing; declare them with `link: {entry.platform}`",
    )


def _rotation(entry: RotationEntry, path: Path, reading: Reading) -> Matrix | None:
    forms = [
        entry.axis is not None or entry.angle is not None,
        entry.euler is not None or entry.angles is not None,
        entry.quaternion is not None,
    ]
    if sum(forms) != 1:
        reading.fault(
            path,
            "exactly one form is expected: {axis, angle}, {euler, angles} or "
            "{quaternion}",
        )
        return None
    if entry.quaternion is not None:
        return _from_quaternion(entry.quaternion, (*path, "quaternion"), reading)
    if forms[0]:
        return _from_axis(entry, path, reading)
    return _from_euler(entry, path, reading)


def _from_axis(entry: RotationEntry, path: Path, reading: Reading) -> Matrix | None:
    if entry.axis is None or entry.angle is None:
        reading.fault(path, "a rotation by axis has the keys axis and angle")
        return None
    angle = reading.angle((*path, "angle"), entry.angle)
    if isinstance(entry.axis, str) and entry.axis in _UNITS:
        axis: VectorExpression | None = _UNITS[entry.axis]
    else:
        axis = reading.vector((*path, "axis"), entry.axis)
    if angle is None or axis is None:
        return None
    required = nonzero(axis, "the axis is zero", "write a direction such as [0, 0, 1]")
    if not reading.require((*path, "axis"), required):
        return None
    return _about(axis, angle)


def _from_euler(entry: RotationEntry, path: Path, reading: Reading) -> Matrix | None:
    if entry.euler is None or entry.angles is None:
        reading.fault(path, "a rotation by Euler angles has the keys euler and angles")
        return None
    order = entry.euler
    if len(order) != 3 or not set(order) <= set(_UNITS):
        reading.fault(
            (*path, "euler"), f"{shown(order)} is no order of axes such as 'zyx'"
        )
        return None
    if len(entry.angles) != 3:
        reading.fault(
            (*path, "angles"), f"three angles are expected, not {len(entry.angles)}"
        )
        return None
    rotation = IDENTITY
    for i, (letter, text) in enumerate(zip(order, entry.angles, strict=True)):
        angle = reading.angle((*path, "angles", i), text)
        if angle is None:
            return None
        rotation = _times(rotation, _about(_UNITS[letter], angle))
    return rotation


def _from_quaternion(
    texts: tuple[str, ...], path: Path, reading: Reading
) -> Matrix | None:
    if len(texts) != 4:
        reading.fault(path, f"a quaternion has four entries, not {len(texts)}")
        return None
    read = [reading.length((*path, i), text) for i, text in enumerate(texts)]
    parts = [part for part in read if part is not None]
    if len(parts) != 4:
        return None
    w, x, y, z = parts
    square = add(*(power(part, 2) for part in parts))
    advice = "the unit quaternion is [1, 0, 0, 0]"
    if not reading.require(path, nonzero(parts, "the quaternion is zero", advice)):
        return None

    def twice(a: Expression, b: Expression) -> Expression:
        return multiply(_TWO, a, b)

    def diagonal(plus: Expression, one: Expression, two: Expression) -> Expression:
        squares = add(power(w, 2), power(plus, 2))
        return subtract(subtract(squares, power(one, 2)), power(two, 2))

    rows: list[list[Expression]] = [
        [
            diagonal(x, y, z),
            subtract(twice(x, y), twice(w, z)),
            add(twice(x, z), twice(w, y)),
        ],
        [
            add(twice(x, y), twice(w, z)),
            diagonal(y, x, z),
            subtract(twice(y, z), twice(w, x)),
        ],
        [
            subtract(twice(x, z), twice(w, y)),
            add(twice(y, z), twice(w, x)),
            diagonal(z, x, y),
        ],
    ]
    first, second, third = (
        (quotient(a, square), quotient(b, square), quotient(c, square))
        for a, b, c in rows
    )
    return first, second, third


def _about(axis: VectorExpression, angle: Expression) -> Matrix:
    """The rotation about a direction of any length (Rodrigues)."""
    length = _root(dot(axis, axis))
    x, y, z = (quotient(part, length) for part in axis)
    cosine, sine = call("cos", angle), call("sin", angle)
    rest = subtract(ONE, cosine)

    def entry(a: Expression, b: Expression, same: bool, skew: Expression) -> Expression:
        outer = multiply(rest, a, b)
        if same:
            # For a unit axis of the frame, c + (1 - c) is written as 1.
            return ONE if outer == rest else add(cosine, outer)
        return add(outer, multiply(sine, skew))

    return (
        (entry(x, x, True, ZERO), entry(x, y, False, negate(z)), entry(x, z, False, y)),
        (entry(y, x, False, z), entry(y, y, True, ZERO), entry(y, z, False, negate(x))),
        (entry(z, x, False, negate(y)), entry(z, y, False, x), entry(z, z, True, ZERO)),
    )


def _root(square: Expression) -> Expression:
    if isinstance(square, Number):
        above, below = square.value.numerator, square.value.denominator
        if isqrt(above) ** 2 == above and isqrt(below) ** 2 == below:
            return Number(Fraction(isqrt(above), isqrt(below)))
    return call("sqrt", square)


def _times(left: Matrix, right: Matrix) -> Matrix:
    columns = tuple(zip(*right, strict=True))
    first, second, third = (
        (dot(row, columns[0]), dot(row, columns[1]), dot(row, columns[2]))
        for row in left
    )
    return first, second, third


def _turned(rotation: Matrix, vector: VectorExpression) -> VectorExpression:
    return (
        dot(rotation[0], vector),
        dot(rotation[1], vector),
        dot(rotation[2], vector),
    )


Group: TypeAlias = Literal["points", "vectors"]


def read_places(
    draft: Draft, reading: Reading, pose: Pose | None
) -> tuple[dict[str, VectorExpression], dict[str, VectorExpression]]:
    """The named points and vectors, each after those it is made of."""
    declared = _declared(draft, reading)
    needs = {name: _needs(entry) for name, (_, entry) in declared.items()}
    order = in_order_of_need(needs)
    for name in order:
        group, entry = declared[name]
        value = _placed((group, name), entry, draft, reading, pose)
        if value is None:
            reading.lost |= {name}
        else:
            reading.vectors[name] = value
    circular = declared.keys() - set(order)
    results: dict[Group, dict[str, VectorExpression]] = {"points": {}, "vectors": {}}
    for name, (group, _) in declared.items():
        if name in circular:
            through = min(needs[name] & circular)
            reading.fault_at_key(
                (group, name),
                f"{group}: {name!r} depends on itself through {through!r}",
            )
        elif name in reading.vectors:
            results[group][name] = reading.vectors[name]
    reading.lost |= circular
    return results["points"], results["vectors"]


def _declared(draft: Draft, reading: Reading) -> dict[str, tuple[Group, VectorEntry]]:
    found: dict[str, tuple[Group, VectorEntry]] = {}
    groups: tuple[tuple[Group, dict[str, VectorEntry]], ...] = (
        ("points", draft.entry.points),
        ("vectors", draft.entry.vectors),
    )
    for group, entries in groups:
        for name, entry in entries.items():
            path = (group, name)
            if reason := why_no_symbol(name):
                reading.fault_at_key(path, f"{group}: {reason}")
            elif name in reading.names | reading.joint_variables or name in found:
                what = found[name][0] if name in found else "symbols"
                reading.fault_at_key(
                    path, f"{group}: {shown(name)} stands among the {what} already"
                )
            else:
                found[name] = (group, entry)
    return found


def _needs(entry: VectorEntry) -> set[str]:
    texts = (entry.at,) if isinstance(entry.at, str) else entry.at
    return {name for text in texts for name, _ in names_in(text)} - RESERVED


def _placed(
    path: tuple[Group, str],
    entry: VectorEntry,
    draft: Draft,
    reading: Reading,
    pose: Pose | None,
) -> VectorExpression | None:
    inner: Path = (*path, "at") if find(reading.root, (*path, "at")) else path
    value = reading.vector(inner, entry.at)
    if entry.link is not None and entry.link not in draft.entry.links:
        if "links" not in draft.broken:
            words = reading.unknown_link(entry.link, draft.entry.links)
            reading.fault((*path, "link"), words)
        return None
    if not _has_frame(entry.link, draft):
        reading.fault(
            (*path, "link"),
            f"the frame of {shown(entry.link or '')} is not known; only the platform "
            f"{shown(draft.entry.platform)} has a pose: give base coordinates",
        )
        return None
    if value is None:
        return None
    if path[0] == "points" and refuse_height(inner, value, reading):
        return None
    if entry.link != draft.entry.platform:
        return value
    if pose is None:
        is_given = draft.entry.pose is not None or "pose" in draft.broken
        return None if is_given else value  # one that cannot be read moves it somewhere
    turned = _turned(pose.rotation, value)
    if path[0] == "vectors":
        return turned
    return add_vectors(pose.translation, turned)


def _has_frame(link: str | None, draft: Draft) -> bool:
    """Whether coordinates in the frame of a body have a meaning.

    At the zero posture of a ``reference`` file all frames are that of the base.
    """
    entry = draft.entry
    known = {None, entry.base, entry.platform}
    unsure = draft.broken & {"geometry", "base", "platform"}
    return link in known or entry.geometry == "reference" or bool(unsure)
