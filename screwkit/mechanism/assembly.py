"""From the models of a file to the mechanism, with every fault of meaning.

Names are resolved, texts become expressions, and what contradicts itself is reported;
reading goes on after a fault so that one run finds them all.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

from screwkit.algebra.expression import ONE, ZERO, Expression
from screwkit.algebra.names import counted
from screwkit.algebra.vector_expression import VectorExpression
from screwkit.mechanism.actuation import read_actuation, read_weights
from screwkit.mechanism.claim_entries import read_claims
from screwkit.mechanism.geometry_checks import (
    check_antecedents,
    check_joint,
    check_kind,
)
from screwkit.mechanism.limb_names import check_limb_names
from screwkit.mechanism.model import (
    Demand,
    Joint,
    JointType,
    MdhRow,
    Mechanism,
)
from screwkit.mechanism.name_checks import check_links, check_names
from screwkit.mechanism.nodes import (
    Faults,
    Path,
    Scalar,
    find,
)
from screwkit.mechanism.places import read_places, read_pose
from screwkit.mechanism.plane_checks import check_table_plane, refuse_height
from screwkit.mechanism.reading import Outside, Reading
from screwkit.mechanism.schema import MdhEntry, MechanismEntry
from screwkit.mechanism.sides import with_sides
from screwkit.mechanism.structure import Draft, subject
from screwkit.mechanism.symbols import (
    default_variables,
    read_parameters,
    read_variables,
)
from screwkit.mechanism.variants import check_values, read_variants
from screwkit.mechanism.weight_checks import check_weights

_WHY_CONSTANT: Final = {
    "posture": (
        "axes and points hold at the one posture that the file describes: describe it "
        "by symbols under `variables`"
    ),
    "reference": (
        "axes and points hold at joint variables 0, and the joints move them from there"
    ),
    "mdh": (
        "what stands in a file is constant: a row adds the variable of its own joint "
        "to theta (revolute) or r (prismatic) by itself"
    ),
}
"""Why geometry cannot depend on joint variables, by the kind of file."""


def assembled(
    draft: Draft, faults: Faults, outside: Outside | None = None
) -> Mechanism:
    """The mechanism; of use only where ``faults`` stays empty.

    Args:
        draft: What is right in the structure of the file.
        faults: Gets what is wrong.
        outside: What is known beside the file.
    """
    entry = draft.entry
    reading = Reading(
        draft.root,
        faults,
        lost=draft.lost_names | _variables_of_lost(draft),
        planar=entry.space == "planar",
        outside=outside or Outside(),
    )
    check_names(draft, reading)
    check_links(draft, reading)
    written = read_parameters(draft, reading)
    parameters = written.parameters
    names = frozenset(parameter.name for parameter in parameters)
    variables = read_variables(draft, reading, names)
    reading.names = names
    reading.joint_variables = frozenset(name for own in variables for name in own)
    reading.why_constant = _WHY_CONSTANT[entry.geometry]
    pose = read_pose(draft, reading)
    points, vectors = read_places(draft, reading, pose)
    joints = tuple(
        _joint(draft, number, own, reading) for number, own in enumerate(variables)
    )
    if entry.geometry == "posture" and entry.space == "spatial" and not faults.found:
        joints = with_sides(joints, pose, vectors.values(), parameters)
    for joint, position in zip(joints, draft.positions, strict=True):
        path: Path = ("joints", position)
        if check_kind(joint.type, path, draft, reading):
            check_joint(joint, path, draft, reading)
    check_antecedents(joints, draft.positions, draft, reading)
    check_table_plane(joints, draft.positions, draft, reading)
    joints, order = read_actuation(joints, draft, reading)
    mechanism = Mechanism(
        name=entry.name,
        title=entry.title,
        base=entry.base,
        platform=entry.platform,
        links=entry.links,
        joints=joints,
        geometry=entry.geometry,
        space=entry.space,
        source=entry.source,
        units=entry.units,
        parameters=parameters,
        limb_names=dict(entry.limbs),
        claims=read_claims(entry.expected, ("expected",), reading),
        reference_point=_reference_point(entry, reading),
        points=points,
        vectors=vectors,
        pose=pose,
        weights=read_weights(draft, order, reading),
        scheme_order=order,
        known_for=_line(entry.known_for, ("known_for",), reading),
        variants=read_variants(draft, written, reading),
        written=written.written,
    )
    check_values(written, mechanism.variants, reading)
    check_weights(mechanism, draft, reading)
    check_limb_names(mechanism, draft, reading)
    demands = (Demand(subject(draft.root, p), r) for p, r in reading.required)
    return replace(mechanism, demands=tuple(demands))


def _variables_of_lost(draft: Draft) -> frozenset[str]:
    """What joints at fault would have declared; so that their use is no fault."""
    found = set(draft.lost("variable"))
    for name in draft.lost("name"):
        found |= {*default_variables(name, 0, 1), *default_variables(name, 0, 3)}
    return frozenset(found)


def _joint(
    draft: Draft, number: int, variables: tuple[str, ...], reading: Reading
) -> Joint:
    entry: Any = draft.entry.joints[number]
    path: Path = ("joints", draft.positions[number])
    joint_type = JointType(entry.type)

    def vector(key: str) -> VectorExpression | None:
        written = getattr(entry, key, None)
        return None if written is None else reading.vector((*path, key), written)

    axes: tuple[VectorExpression, ...] = ()
    if getattr(entry, "axes", None) is not None:
        read = [reading.vector((*path, "axes", i), a) for i, a in enumerate(entry.axes)]
        axes = tuple(axis for axis in read if axis is not None)
    elif axis := vector("axis"):
        axes = (axis,)
    normal = vector("normal")
    if draft.entry.space == "planar":
        along_z: VectorExpression = (ZERO, ZERO, ONE)
        if joint_type is JointType.REVOLUTE and getattr(entry, "axis", None) is None:
            axes = (along_z,)
        if joint_type is JointType.PLANAR and getattr(entry, "normal", None) is None:
            normal = along_z
    pitch = getattr(entry, "pitch", None)
    return Joint(
        name=entry.name,
        type=joint_type,
        parent=entry.parent,
        child=entry.child,
        variables=variables,
        offsets=_offsets(entry, path, len(variables), reading),
        mdh=_row(getattr(entry, "mdh", None), (*path, "mdh"), reading),
        axes=axes,
        point=vector("point"),
        normal=normal,
        line=vector("line"),
        pitch=None if pitch is None else reading.length((*path, "pitch"), pitch),
    )


def _offsets(
    entry: Any, path: Path, count: int, reading: Reading
) -> tuple[Expression, ...]:
    written: tuple[str, ...] = entry.offset or ()
    inner: Path = (*path, "offset")
    if written and len(written) != count:
        reading.fault(
            inner,
            f"{counted(len(written), 'offset')} for {counted(count, 'freedom')}",
        )
        return (ZERO,) * count
    is_list = not isinstance(find(reading.root, inner), Scalar)
    slides = entry.type == JointType.PRISMATIC
    read_as = reading.length if slides else reading.angle
    if count > 1:  # No table places such a joint, and other files have no offsets.
        read_as = reading.scalar
    read = [
        read_as((*inner, i) if is_list else inner, text)
        for i, text in enumerate(written)
    ]
    return tuple(e if e is not None else ZERO for e in read) or (ZERO,) * count


def _row(entry: MdhEntry | None, path: Path, reading: Reading) -> MdhRow | None:
    if entry is None:
        return None
    read = {
        key: read_as((*path, key), getattr(entry, key))
        for read_as, keys in (
            (reading.angle, ("gamma", "alpha", "theta")),
            (reading.length, ("b", "d", "r")),
        )
        for key in keys
    }
    return MdhRow(**{key: e if e is not None else ZERO for key, e in read.items()})


def _line(text: str, path: Path, reading: Reading) -> str:
    if "\n" in text.strip():
        reading.fault(path, "one line of text is expected")
    return text.strip()


def _reference_point(
    entry: MechanismEntry, reading: Reading
) -> VectorExpression | None:
    if entry.reference_point is None:
        return None
    path: Path = ("reference_point",)
    point = reading.vector(path, entry.reference_point)
    if point is not None:
        refuse_height(path, point, reading)
    return point
