"""Sections that answer `mobility`: the freedoms first, then what each count sees."""

from __future__ import annotations

from dataclasses import replace

from screwkit.algebra.names import counted
from screwkit.reports.about_freedoms import (
    branch_blocks,
    class_sentence,
    freedom_blocks,
    loose_sentence,
    redundancy_blocks,
    unnamed_paragraph,
)
from screwkit.reports.blocks import (
    Block,
    Column,
    Condition,
    Heading,
    Listing,
    Loose,
    Paragraph,
    Strong,
    Table,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.phrases import listed, platform_called, signed
from screwkit.results.mobility import (
    Actuation,
    AtPosture,
    Mobility,
    MotionCase,
    Platform,
    Topology,
)


def mobility_blocks(answer: Mobility) -> tuple[Block, ...]:
    """The whole answer."""
    said = [*freedoms(answer)]
    said += [prose(t) for t in (class_sentence(answer), loose_sentence(answer)) if t]
    blocks: list[Block] = [
        *(Paragraph(text, 1) for text in said),
        counts_table(answer),
    ]
    blocks += [
        *redundancy_blocks(answer),
        *freedom_blocks(answer),
        *unnamed_paragraph(answer),
        *branch_blocks(answer.full_cycle),
    ]
    if len(answer.platform.cases) > 1:
        blocks += [
            Heading(words(f"motion of {platform_called(answer.platform_name)}"), 2),
            motion_listing(answer.platform),
        ]
    closing = [full_cycle(answer), *driven(answer)]
    if answer.actuation is not None:
        closing.append(locked(answer.actuation, answer.platform_name))
    if answer.at_posture is not None:
        closing.append(moved(answer.at_posture, answer.platform_name))
    blocks += [Paragraph(words(text), 1) for text in closing]
    return (*blocks, *at_values(answer))


def at_values(answer: Mobility) -> tuple[Block, ...]:
    """What differs at the values, or at the posture, of the file."""
    special = answer.at_values
    if special is None:
        return ()
    where = f"at the {'posture' if answer.on_motion else 'values'} of the file"
    blocks: list[Block] = [
        Paragraph(words(f"{where}: {text}"), 1) for text in special.differences
    ]
    if special.redundancies or special.remaining_freedoms:
        there = replace(
            answer,
            redundancies=special.redundancies,
            remaining_freedoms=special.remaining_freedoms,
        )
        blocks.append(Heading(words(where), 1))
        blocks += [*redundancy_blocks(there), *freedom_blocks(there)]
    return tuple(blocks)


def where_it_holds(answer: Mobility) -> str:
    """For which postures and values the first numbers are."""
    if answer.on_motion:
        several = len(answer.full_cycle.branches) > 1
        return "on branch 1 of the motion" if several else "on the motion"
    return "in general" if answer.generic else "at the posture of the file"


def topology_line(topology: Topology) -> str:
    """The graph in one line."""
    joints = counted(topology.joints, "joint")
    if topology.joints:
        joints += f" with {counted(topology.freedoms, 'freedom')}"
    parts = [
        counted(topology.links, "body", "bodies"),
        joints,
        counted(topology.independent_loops, "loop"),
    ]
    if topology.components > 1:
        parts.append(f"{topology.components} components")
    return ", ".join(parts)


def freedoms(answer: Mobility) -> tuple[Text, ...]:
    """The answer in two sentences."""
    platform = answer.platform
    name = platform_called(answer.platform_name)
    where = where_it_holds(answer)
    of_platform: Text = (Words(f"{name} has no freedom, {where}"),)
    if answer.topology.links == 1:
        of_platform = words("base and platform are one body, which has no freedom")
    if platform.twist_dimension:
        of_platform = (
            Words(f"{name} has "),
            Strong(counted(platform.twist_dimension, "freedom")),
            Words(": "),
            Strong(platform.motion_type),
            Words(f", {where}"),
        )
    of_mechanism: Text = (
        Words("the mechanism has "),
        Strong(counted(answer.instantaneous_mobility, "freedom")),
        Words(
            f"{finite(answer)}; "
            f"{f'{idle(answer)}, ' if answer.instantaneous_mobility else ''}"
            f"{redundant(answer.redundant_constraints)}"
        ),
    )
    return of_platform, of_mechanism


def finite(answer: Mobility) -> str:
    """Whether the freedoms are finite motions, in a word or two; empty if undecided."""
    cycle, movable = answer.full_cycle, answer.instantaneous_mobility
    if not movable or not cycle.mobility:
        return ""
    if cycle.mobility == (movable,):
        return ", finite"
    if not any(cycle.mobility):
        return ", none of them finite: it is shaky"
    numbers = " or ".join(map(str, cycle.mobility))
    return f" at once, of finite motion {numbers}"


def idle(answer: Mobility) -> str:
    """How many freedoms leave the platform where it is."""
    number = answer.partition.redundancy
    if not number:
        return "none is idle"
    verb = "leaves" if number == 1 else "leave"
    return f"{number} {verb} {platform_called(answer.platform_name)} at rest"


def driven(answer: Mobility) -> tuple[str, ...]:
    """Which motions the actuators make alone, with passive joints, or not at all."""
    if answer.actuation is None or not answer.partition.blocks:
        return ()
    platform = platform_called(answer.platform_name)
    parts = [
        f"{block.dimension} where {block.meaning.replace('the platform', platform)}"
        for block in answer.partition.blocks
    ]
    motions = "motion" if answer.partition.mobility == 1 else "motions"
    actuated = listed(answer.actuation.actuated)
    return (f"{motions} driven by {actuated}: {'; '.join(parts)}",)


def redundant(number: int) -> str:
    """How many constraints follow from others."""
    if not number:
        return "no constraint is redundant"
    verb = "is" if number == 1 else "are"
    return f"{counted(number, 'constraint')} {verb} redundant"


def counts_table(answer: Mobility) -> Table:
    """Every count with its working and what is to be said of it."""
    remarks = any(working.remark for working in answer.workings)
    columns = [Column(()), Column(()), Column((), "right")]
    if remarks:
        columns.append(Column((), "wrap"))
    rows: list[tuple[Text, ...]] = []
    for working in answer.workings:
        row: list[Text] = [
            words(working.name),
            (Loose(working.formula),),
            words(f"= {signed(working.value)}"),
        ]
        if remarks:
            row.append(prose(working.remark))
        rows.append(tuple(row))
    return Table(tuple(columns), tuple(rows))


def motion_place(case: MotionCase) -> Text:
    """Where a motion type holds."""
    if not case.conditions and not case.solutions:
        return words("in general")
    if case.solutions:
        return joined([math(text) for text in case.solutions])
    return joined([math(f"{text} = 0") for text in case.conditions])


def motion_listing(platform: Platform) -> Listing:
    """The motion types with their conditions."""
    return Listing(
        tuple(
            Condition("", motion_place(c), words(c.motion_type), prose(c.reason))
            for c in platform.cases
        )
    )


def full_cycle(whole: Mobility) -> str:
    """Whether the freedoms are finite motions."""
    answer = whole.full_cycle
    reason = answer.reason.removesuffix(", so the motion is finite")
    because = f": {reason}" if reason else ""
    if answer.status == "undecided":
        return f"undecided whether the motion is finite{because}"
    how = " (sampled)" if answer.status == "sampled" else ""
    mobilities = answer.mobility
    number = sum(branch.modes for branch in answer.branches)
    if number > 1 and len(mobilities) == 1 and mobilities != (0,):
        what = _finite(whole, mobilities[0])
        return f"{what}, on {number} branches{_along(whole)}{because}{how}"
    if mobilities == (0,) and not whole.instantaneous_mobility:
        return f"nothing moves{because}{how}"
    if mobilities == (0,):
        return f"no finite motion: the structure is shaky{because}{how}"
    if len(mobilities) > 1:
        branches = ", ".join(map(str, mobilities))
        return f"branches of mobility {branches} meet at this posture{because}{how}"
    what = f"{_finite(whole, mobilities[0])}{_along(whole)}{because}{how}"
    return f"{what}{_on_a_line(whole)}"


def _on_a_line(whole: Mobility) -> str:
    """Which joints of the platform run straight on the one branch there is."""
    branches = whole.full_cycle.branches
    if len(branches) != 1 or not branches[0].straight:
        return ""
    *others, last = branches[0].straight
    joints = f"{', '.join(others)} and {last}" if others else last
    keeps = "keep" if others else "keeps"
    name = platform_called(whole.platform_name)
    return f"; on a walk along it {joints} of {name} {keeps} to a straight line"


def _finite(whole: Mobility, dimension: int) -> str:
    if dimension == whole.instantaneous_mobility:
        return "the motion is finite"
    at_once = counted(whole.instantaneous_mobility, "freedom")
    return f"finite motion has dimension {dimension}, of {at_once} at once"


def _along(whole: Mobility) -> str:
    """How the platform moves on the one kind of branch there is, where that is news."""
    branches = whole.full_cycle.branches
    if len(branches) != 1 or not branches[0].finite_type:
        return ""
    (branch,) = branches
    name = platform_called(whole.platform_name)
    if branch.finite_type == whole.platform.motion_type:
        return ""
    if branch.finite_type == "0T0R":
        return f", and {name} rests"
    motion = f" ({branch.motion})" if branch.motion else ""
    return f", {branch.finite_type} for {name}{motion}"


def locked(actuation: Actuation, platform: str = "", separator: str = " ") -> str:
    """What stays movable with the actuated joints locked."""
    name = platform_called(platform)
    head = f"with {separator.join(actuation.actuated)} locked"
    if not actuation.actuated:
        head = "with no joint actuated"
    if actuation.remaining_platform_freedom:
        left = counted(actuation.remaining_platform_freedom, "freedom")
        return f"{head}, {name} keeps {left}"
    if actuation.remaining_mobility:
        left = counted(actuation.remaining_mobility, "freedom")
        verb = "stays" if actuation.remaining_mobility == 1 else "stay"
        return f"{head}, {name} is fixed and {left} {verb} idle"
    return f"{head}, nothing moves"


def moved(answer: AtPosture, platform: str = "") -> str:
    """The posture asked for, and what holds there."""
    at = ", ".join(
        f"{name} = {value:.6g}"
        for name, value in zip(answer.variables, answer.values, strict=True)
    )
    if not answer.closed:
        return f"the posture asked for was not reached: {answer.reason}; left at {at}"
    left = counted(answer.instantaneous_mobility, "freedom")
    said = (
        f"moved to {at}: {left}, loop rank {answer.loop_rank}, "
        f"{platform_called(platform)} {answer.motion_type}"
    )
    if answer.remaining_platform_freedom:
        kept = counted(answer.remaining_platform_freedom, "freedom")
        said += f", which keeps {kept} with the actuated joints locked"
    unclear = f"; unclear: {answer.reason}" if answer.reason else ""
    return f"{said} (in floating point){unclear}"
