"""A mechanism as tables of text, for the head of a report."""

from __future__ import annotations

from dataclasses import fields

from screwkit.algebra.expression import ZERO, Expression, Symbol
from screwkit.algebra.expression_building import add
from screwkit.algebra.names import RESERVED
from screwkit.algebra.text import expression_text
from screwkit.algebra.tokens import names_in
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.model import (
    Joint,
    JointType,
    MdhRow,
    Mechanism,
    VectorExpression,
)
from screwkit.results.analysis import Description, JointRow

LONGEST = 60
"""Characters of a vector that is written out."""

_COLUMNS = tuple(cell.name for cell in fields(MdhRow))


def description(mechanism: Mechanism) -> Description:
    """What the file gives: joints with their geometry, symbols with their values."""
    placed_by = {
        joint.child: joint.name for joint in mechanism.joints if joint.mdh is not None
    }
    mdh = mechanism.geometry == "mdh"
    return Description(
        case=mechanism.name,
        title=mechanism.title,
        source=mechanism.source,
        units=mechanism.units,
        base=mechanism.base,
        platform=mechanism.platform,
        links=len(mechanism.links),
        columns=_COLUMNS if mdh else _places(mechanism),
        rows=tuple(
            JointRow(
                joint.name,
                str(joint.type),
                placed_by.get(joint.parent, joint.parent),
                _cells(joint)
                if mdh
                else tuple(_place(joint, what) for what in _places(mechanism)),
                ", ".join(joint.variables),
            )
            for joint in mechanism.joints
        ),
        values=tuple(
            (
                p.name,
                "" if p.value is None else expression_text(p.value),
                "positive" if p.positive else "nonzero" if p.nonzero else "",
            )
            for p in mechanism.parameters
        ),
        limbs=tuple((limb.name, limb.joints) for limb in limbs(mechanism)),
    )


def _cells(joint: Joint) -> tuple[str, ...]:
    """The row with the joint's variable and offset added where they act."""
    if joint.mdh is None:
        return ("",) * len(_COLUMNS)
    values: dict[str, Expression] = {
        name: getattr(joint.mdh, name) for name in _COLUMNS
    }
    moved = "r" if joint.type is JointType.PRISMATIC else "theta"
    for variable, offset in zip(joint.variables, joint.offsets, strict=True):
        parts = [values[moved], Symbol(variable), offset]
        values[moved] = add(*(part for part in parts if part != ZERO))
    return tuple(expression_text(values[name]) for name in _COLUMNS)


def _places(mechanism: Mechanism) -> tuple[str, ...]:
    """What places the joints of a file without a table."""
    columns = ["axis", "point"]
    if any(joint.pitch is not None for joint in mechanism.joints):
        columns.append("pitch")
    if any(joint.line is not None for joint in mechanism.joints):
        columns.append("line")
    return tuple(columns)


def _place(joint: Joint, what: str) -> str:
    match what:
        case "axis":
            directions = joint.axes or ((joint.normal,) if joint.normal else ())
            return ", ".join(_vector(axis) for axis in directions)
        case "point":
            return "" if joint.point is None else _vector(joint.point)
        case "line":
            return "" if joint.line is None else _vector(joint.line)
        case _:
            return "" if joint.pitch is None else expression_text(joint.pitch)


def _vector(vector: VectorExpression) -> str:
    """Three coordinates, or of long ones the symbols that they depend on."""
    texts = [expression_text(part) for part in vector]
    text = f"[{', '.join(texts)}]"
    if len(text) <= LONGEST:
        return text
    met = {name for part in texts for name, _ in names_in(part)} - RESERVED
    return f"[a function of {', '.join(sorted(met))}]"
