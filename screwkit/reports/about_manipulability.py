"""Sections that answer `manipulability`: who moves with whom, then how well."""

from __future__ import annotations

from collections.abc import Sequence
from re import sub

from screwkit.algebra.names import counted, limb_called
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Math,
    Paragraph,
    Table,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.decimals import coordinates, decimal
from screwkit.reports.phrases import listed, platform_called
from screwkit.results.manipulability import (
    Cooperative,
    Ellipsoid,
    IndexValues,
    Manipulability,
    Statics,
)
from screwkit.results.partition import Partition
from screwkit.results.undecided import Undecided

RATES = 12
"""Actuated freedoms up to which a direction of rates is written out."""


def manipulability_blocks(answer: Manipulability) -> tuple[Block, ...]:
    """The whole answer."""
    blocks: list[Block] = [Paragraph(text, 1) for text in held(answer)]
    blocks += [
        Heading(words("WHO MOVES WITH WHOM"), 1),
        *partition_blocks(answer.partition, answer.platform_name),
        Heading(words("STATICS"), 1),
        *statics_blocks(answer.statics, answer),
        Heading(words("KINEMATIC INDEX"), 1, words("u against actuated rates")),
        *index_blocks(answer.kinematic, answer, "rates"),
        *in_symbols(answer),
        *reach(answer),
        Heading(words("FORCE INDEX"), 1, words("w against actuated torques")),
        *index_blocks(answer.force, answer, "torques"),
        *worst_cases(answer),
    ]
    if internal := internal_blocks(answer):
        head = Heading(words("INTERNAL FORCES"), 1, words("forces against torques"))
        blocks += [head, *internal]
    blocks += cooperative_blocks(answer.cooperative, answer)
    blocks += [Paragraph(words(text), 1) for text in notes(answer)]
    return tuple(blocks)


def held(answer: Manipulability) -> tuple[Text, ...]:
    """What holds the object, and what drives it."""
    kinds: dict[str, list[str]] = {}
    for contact in answer.contacts:
        kinds.setdefault(contact.kind, []).append(contact.joint)
    places = "; ".join(
        f"{_article(kind, len(names))} {_named(names)}" for kind, names in kinds.items()
    )
    driven = _driven(answer)
    if not (answer.actuated or answer.passive):
        driven = "there are no joints but these: nothing can be actuated"
    elif answer.all_actuated:
        driven = "the file declares no scheme: all joints are taken as actuated"
    return (
        prose(f"{platform_called(answer.platform_name)} is held by {places}"),
        prose(driven),
    )


def _article(kind: str, count: int) -> str:
    if kind.startswith("rigid"):
        return f"rigid attachment{'s' if count > 1 else ''}"
    return f"{count} {kind}s" if count > 1 else f"a {kind}"


def _named(names: Sequence[str]) -> str:
    return ", ".join(names) if len(names) <= RATES else f"({len(names)} of them)"


def _driven(answer: Manipulability) -> str:
    passive = ", ".join(answer.passive)
    if len(answer.passive) > RATES:
        passive = f"{len(answer.passive)} freedoms"
    tail = f"; passive: {passive}" if passive else "; no joint is passive"
    return f"actuated: {', '.join(answer.actuated)}{tail}"


def partition_blocks(partition: Partition, platform_name: str) -> tuple[Block, ...]:
    """The four numbers, then the blocks that are not empty."""
    numbers = (
        f"mobility {partition.mobility}, connectivity {partition.connectivity}, "
        f"redundancy {partition.redundancy}, indeterminacy {partition.indeterminacy}"
    )
    rows: list[tuple[Text, ...]] = []
    for block in partition.blocks:
        meaning = block.meaning
        for number, motion in enumerate(block.motions or (None,)):
            sentence = "" if motion is None else motion.words
            rows.append(
                (
                    words(block.name if number == 0 else ""),
                    words(str(block.dimension) if number == 0 else ""),
                    prose(_called(meaning if number == 0 else "", platform_name)),
                    prose(_called(sentence, platform_name)),
                )
            )
    columns = (
        Column(words("block")),
        Column(words("dim"), "right"),
        Column(words("meaning"), "wrap", 2.0),
        Column(words("basis"), "wrap", 3.0),
    )
    return (Paragraph(words(numbers), 1), Table(columns, tuple(rows)))


def _called(sentence: str, platform_name: str) -> str:
    return sentence.replace("the platform", platform_called(platform_name))


def statics_blocks(statics: Statics, answer: Manipulability) -> tuple[Block, ...]:
    """What contact forces can do, in numbers and in wrenches."""
    platform = platform_called(answer.platform_name)
    said = [
        f"of {counted(statics.admissible, 'contact force')} that passive joints let "
        f"through, {statics.transmitted} "
        f"{'carries' if statics.transmitted == 1 else 'carry'} torques to {platform}, "
        f"{statics.internal} {'is' if statics.internal == 1 else 'are'} internal, "
        f"{statics.structural} structural, {statics.indeterminacy} indeterminate",
        f"{'every wrench' if statics.balances_all else 'not every wrench'} on "
        f"{platform} can be balanced",
    ]
    blocks: list[Block] = [Paragraph(words(text), 1) for text in said]
    if statics.structural_wrenches:
        wrenches = [_wrench(w) for w in statics.structural_wrenches]
        text = (Words("balanced without torque: "), *joined(wrenches, ", "))
        blocks.append(Paragraph(text, 1))
    if statics.internal_torques:
        torques = [_bracket(t) for t in statics.internal_torques]
        text = (Words("internal torques: "), *joined(torques, ", "))
        blocks.append(Paragraph(text, 1))
    return tuple(blocks)


def _wrench(wrench: Sequence[str]) -> Text:
    return _bracket(wrench, 2 if len(wrench) == 3 else 3)


def _bracket(texts: Sequence[str], split: int = 0) -> Text:
    spans: list[Words | Math] = [Words("(")]
    for index, text in enumerate(texts):
        if index:
            spans.append(Words("; " if index == split else ", "))
        spans.append(Math(text))
    return (*spans, Words(")"))


def index_blocks(
    index: IndexValues, answer: Manipulability, effort: str
) -> tuple[Block, ...]:
    """The finite values with their directions, what is infinite and what is zero."""
    planar = answer.space == "planar"
    twist = effort == "rates"
    split = (1 if planar else 3) if twist else (2 if planar else 3)
    head = coordinate_names(planar=planar, twist=twist)
    platform = platform_called(answer.platform_name)
    blocks: list[Block] = []
    if index.finite:
        columns = [
            Column((), "right"),
            Column(words("value"), "right"),
            Column(words("semi-axis"), "right"),
            Column(words(f"{platform} {head}"), "wrap", 2.0),
        ]
        short = len(answer.actuated) <= RATES
        if short:
            names = listed(answer.actuated)
            columns.append(Column(words(f"{effort} of {names}"), "wrap", 2.0))
        rows = []
        for number, value in enumerate(index.finite):
            cells = [
                words(str(number + 1)),
                words(decimal(value)),
                words(decimal(value**0.5, 4)),
                words(coordinates(index.directions[number], split)),
            ]
            if short:
                cells.append(words(coordinates(index.joint_directions[number])))
            rows.append(tuple(cells))
        blocks.append(Table(tuple(columns), tuple(rows)))
    blocks += [Paragraph(text, 1) for text in _exactly(index, answer)]
    if index.infinite and twist:
        rows_ = ", ".join(coordinates(d, split) for d in index.infinite_directions)
        blocks.append(
            Paragraph(
                words(
                    f"infinite in {counted(index.infinite, 'direction')}, where the "
                    f"actuators do not hold {platform}: "
                    f"{rows_}"
                ),
                1,
            )
        )
    if index.zero and twist:
        rows_ = ", ".join(coordinates(d) for d in index.zero_directions)
        text = (
            f"zero for {counted(index.zero, 'direction')} of the rates, which leave "
            f"{platform} at rest"
        )
        tail = f": {rows_}" if len(answer.actuated) <= RATES else ""
        blocks.append(Paragraph(words(text + tail), 1))
    if not index.finite:
        nothing = "no motion is coordinated: there is no finite value"
        if not twist:
            nothing = "no torque becomes a wrench: there is no finite value"
        blocks.insert(0, Paragraph(words(nothing), 1))
    return tuple(blocks)


def coordinate_names(*, planar: bool, twist: bool) -> str:
    """How the coordinates of a twist or wrench are called.

    >>> coordinate_names(planar=True, twist=False)
    '(fx, fy; mz)'
    >>> coordinate_names(planar=False, twist=True)
    '(ω; v)'
    """
    if planar:
        return "(ωz; vx, vy)" if twist else "(fx, fy; mz)"
    return "(ω; v)" if twist else "(f; m)"


def _exactly(index: IndexValues, answer: Manipulability) -> tuple[Text, ...]:
    if not index.polynomial:
        return ()
    value = answer.symbolic.unknown  # no symbol of the file
    polynomial = sub(r"\bx\b", value, index.polynomial)
    spans: list[Text] = [(Words("exactly: "), Math(f"{polynomial} = 0"))]
    if index.exact:
        roots = joined([math(text) for text in index.exact], ", ")
        spans = [(*spans[0], Words(", "), Math(value), Words(" = "), *roots)]
    return tuple(spans)


def in_symbols(answer: Manipulability) -> tuple[Block, ...]:
    """The polynomial that holds for all values of the symbols."""
    if not answer.symbolic.kinematic:
        return ()
    formula = Math(f"{answer.symbolic.kinematic} = 0")
    said: Text = (Words("in the symbols of the file: "), formula)
    unknown = answer.symbolic.unknown
    if unknown != "x":
        said = (*said, Words(", with the value "), Math(unknown))
    return (Paragraph(said, 1),)


def reach(answer: Manipulability) -> tuple[Block, ...]:
    """Both readings, and velocities and rotations apart."""
    if not answer.kinematic.finite:
        return ()
    said = []
    if answer.translation.semi_axes and answer.rotation.semi_axes:
        said.append(
            f"apart: the reference point moves with semi-axes "
            f"{_lengths(answer.translation)}, and turns with "
            f"{_lengths(answer.rotation)}"
        )
    said.append(
        "read as rates, a large value is fast; read as errors of the actuators, a "
        "large value is inaccurate"
    )
    return tuple(Paragraph(words(text), 1) for text in said)


def _lengths(ellipsoid: Ellipsoid) -> str:
    return ", ".join(decimal(x, 4) for x in ellipsoid.semi_axes)


def worst_cases(answer: Manipulability) -> tuple[Block, ...]:
    """The active and the passive index beside the force index."""
    said = []
    if answer.active_force.zero:
        said.append(
            f"active force, worst over structural wrenches: the same, and "
            f"{answer.active_force.zero} zero for internal torques"
        )
    if answer.passive_force.infinite:
        said.append(
            f"passive force, best over internal torques: the same, and "
            f"{answer.passive_force.infinite} infinite for structural wrenches"
        )
    if not said:
        said = ["active and passive force index have the same values"]
    return tuple(Paragraph(words(text), 1) for text in said)


def internal_blocks(answer: Manipulability) -> tuple[Block, ...]:
    """Contact forces that balance each other, per unit of torque."""
    index = answer.internal_force
    said: list[Text] = []
    if index.finite:
        values = ", ".join(decimal(value) for value in index.finite)
        said.append(words(f"values {values}"))
        said += _exactly(index, answer)
    if index.zero:
        said.append(
            words(
                f"zero for {counted(index.zero, 'direction')} of the torques, which "
                f"load nothing but loops inside limbs"
            )
        )
    if index.infinite:
        said.append(
            words(
                f"{counted(index.infinite, 'contact force')} more "
                f"{'is' if index.infinite == 1 else 'are'} in balance without torque: "
                f"statically indeterminate"
            )
        )
    return tuple(Paragraph(text, 1) for text in said)


def cooperative_blocks(
    cooperative: Cooperative | Undecided, answer: Manipulability
) -> tuple[Block, ...]:
    """The ellipsoids of several arms, with each arm's own."""
    if isinstance(cooperative, Undecided):
        return ()
    columns = (
        Column(()),
        Column(words("absolute velocity"), "wrap"),
        Column(words("external force"), "wrap"),
        Column(words("relative velocity"), "wrap"),
        Column(words("internal force"), "wrap"),
    )
    system = (
        words("system"),
        words(_lengths(cooperative.absolute_velocity) or "–"),
        words(_lengths(cooperative.external_force) or "–"),
        words(_lengths(cooperative.relative_velocity) or "–"),
        words(_lengths(cooperative.internal_force) or "–"),
    )
    arms = tuple(
        (
            words(f"{limb_called(arm.name)} alone"),
            words(_lengths(arm.absolute_velocity) or "–"),
            words(_lengths(arm.external_force) or "–"),
            (),
            (),
        )
        for arm in cooperative.arms
    )
    blocks: list[Block] = [
        Heading(words("COOPERATION"), 1, words("semi-axes")),
        Table(columns, (system, *arms)),
    ]
    if any(arm.shares for arm in cooperative.arms):
        shares = "; ".join(
            f"{arm.name} {', '.join(f'{share:.0%}' for share in arm.shares)}"
            for arm in cooperative.arms
        )
        blocks.append(
            Paragraph(words(f"shares along the axes of the velocity: {shares}"), 1)
        )
    rule = (
        f"the arms do not combine by the rules of two rigid grasps: {cooperative.rule}"
        if cooperative.rule
        else "velocities combine in parallel, relative velocities in series"
    )
    blocks.append(Paragraph(prose(rule), 1))
    return tuple(blocks)


def notes(answer: Manipulability) -> tuple[str, ...]:
    """Posture, measure and what is special."""
    said = list(answer.differences)
    if answer.units:
        said.append(answer.units)
    if not answer.posture.exact:
        gap = answer.posture.gap or 0.0
        sure = f"; the least clear differ by a factor of {gap:.0e}" if gap < 1e6 else ""
        said.append(
            "the posture is known in floating point, and dimensions are counts of "
            f"singular values{sure}"
        )
    return tuple(said)
