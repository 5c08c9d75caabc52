"""A mechanism as tables of text, for the head of a report."""

from __future__ import annotations

from dataclasses import fields

from screwkit.algebra.expression import ZERO, Expression, Symbol
from screwkit.algebra.expression_building import add
from screwkit.algebra.text import expression_text
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.model import Joint, JointType, MdhRow, Mechanism
from screwkit.results.analysis import Description, JointRow

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
        columns=_COLUMNS if mdh else (),
        rows=tuple(
            JointRow(
                joint.name,
                str(joint.type),
                placed_by.get(joint.parent, joint.parent),
                _cells(joint) if mdh else (),
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
