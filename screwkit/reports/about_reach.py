"""The section that answers `reach`: configurations and their indices, a row each."""

from __future__ import annotations

from screwkit.algebra.names import counted
from screwkit.reports.blocks import (
    Block,
    Column,
    Paragraph,
    Table,
    Text,
    words,
)
from screwkit.reports.decimals import coordinates, decimal
from screwkit.reports.phrases import listed, platform_called
from screwkit.results.manipulability import Manipulability
from screwkit.results.reach import Reach

COLUMNS = 8
"""Joint variables up to which each has a column; beyond, they share one."""

_INDICES = ("slowest", "fastest", "weakest", "strongest")


def reach_blocks(answer: Reach) -> tuple[Block, ...]:
    """The whole answer."""
    blocks: list[Block] = [
        Paragraph(words(_wanted(answer)), 1),
        Table(_columns(answer), tuple(_rows(answer))),
    ]
    blocks += [Paragraph(words(text), 1) for text in _notes(answer)]
    return tuple(blocks)


def _wanted(answer: Reach) -> str:
    parts = []
    if answer.point:
        platform = platform_called(answer.platform_name)
        parts.append(
            f"the reference point of {platform} at {coordinates(answer.point)}"
        )
    planar = all(not any(body.turn[:2]) for body in answer.turned)
    for body in answer.turned:
        turn = (
            decimal(body.turn[2])
            if planar and answer.configurations[0].space == "planar"
            else coordinates(body.turn)
        )
        parts.append(f"{body.body} turned by {turn}")
    return "; ".join(parts) if parts else "any closed posture"


def _columns(answer: Reach) -> tuple[Column, ...]:
    names = answer.joint_variables
    joints = (
        [Column(words(name), "right") for name in names]
        if len(names) <= COLUMNS
        else [Column(words(listed(names)), "wrap", 3.0)]
    )
    return (
        Column((), "right"),
        *joints,
        *(Column(words(name), "right") for name in _INDICES),
        *([Column(words("not held"), "right")] if _unheld(answer) else []),
    )


def _unheld(answer: Reach) -> bool:
    return any(found.kinematic.infinite for found in answer.configurations)


def _rows(answer: Reach) -> list[tuple[Text, ...]]:
    rows = []
    for number, found in enumerate(answer.configurations, 1):
        at = dict(zip(found.posture.variables, found.posture.values, strict=True))
        values = [at.get(name, 0.0) for name in answer.joint_variables]
        cells = (
            [words(decimal(value, 4)) for value in values]
            if len(values) <= COLUMNS
            else [words(coordinates(values))]
        )
        cells += _extremes(found)
        if _unheld(answer):
            cells.append(words(str(found.kinematic.infinite)))
        rows.append((words(str(number)), *cells))
    return rows


def _extremes(found: Manipulability) -> list[Text]:
    """The semi-axes in which the platform is slowest, fastest, weakest, strongest."""
    said = []
    for index in (found.kinematic, found.force):
        ends = [value**0.5 for value in index.finite]
        said += [decimal(x, 4) for x in (min(ends), max(ends))] if ends else ["–"] * 2
    return [words(text) for text in said]


def _notes(answer: Reach) -> list[str]:
    count = len(answer.configurations)
    notes = []
    if answer.spare:
        notes.append(
            f"actuated joints can still move in {counted(answer.spare, 'direction')}, "
            f"so this is one configuration of infinitely many, near the posture of the "
            f"file"
        )
    else:
        notes.append(
            f"{counted(count, 'configuration')}, looked for from {answer.starts} "
            f"postures; there may be more"
        )
    notes.append(
        "joint values and turns count from the posture of the file, in radians"
    )
    notes.append(
        "slowest, fastest, weakest, strongest: semi-axes of velocity and force; --json "
        "has all of each configuration, --draw its picture"
    )
    return notes
