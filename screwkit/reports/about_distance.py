"""The section that answers `singularities --distance`: nearest first, kind by kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.algebra.names import counted, limb_called
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Paragraph,
    Table,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.conditions import Numbered, place
from screwkit.reports.decimals import decimal
from screwkit.reports.phrases import capital, platform_called
from screwkit.results.distance import (
    Distance,
    DistanceMeasure,
    NearestPosture,
    SingularityDistance,
)

DIGITS = 4
MANY = 8
"""Names or values up to which a list is written out."""

READABLE = 40
"""Characters of an equation up to which it is shown in a cell."""

_HEADS = {
    "limb": "LIMB   where a limb loses a freedom",
    "constraint": "CONSTRAINT   where the constraints of the loops become dependent",
    "actuation": "ACTUATION   where the platform moves with the actuators locked",
}


@dataclass(frozen=True)
class Elsewhere:
    """Where what is too long for a cell can be read.

    Attributes:
        equations: Of a component.
        values: Of a posture.
        numbers: Whose the numbers of components are.
    """

    equations: str
    values: str
    numbers: str


TERMINAL = Elsewhere("--json", "--json", "that `screwkit singularities` gives")
ARTICLE = Elsewhere("see above", "in the JSON document", "of the components above")


def distance_blocks(answer: Distance) -> tuple[Block, ...]:
    """The nearest of each kind in a line, every singularity, what a distance means."""
    blocks: list[Block] = [Paragraph(words(_summary(answer)), 1)]
    for kind, head in _HEADS.items():
        entries = [one for one in answer.singularities if one.kind == kind]
        if entries:
            blocks.append(Heading(words(head), 1))
            blocks.append(Table(_COLUMNS, tuple(_rows(answer, entries, TERMINAL))))
    if answer.posture:
        blocks.append(Paragraph(words(f"from {_values(answer)}"), 1))
    if answer.within:
        blocks.append(Paragraph(words(_limits(answer)), 1))
    measures = dict.fromkeys((answer.measure, answer.by_freedoms))
    blocks += [
        Paragraph(words(_measured(measure, answer)), 1)
        for measure in measures
        if measure is not None
    ]
    blocks += [Paragraph(prose(text), 1) for text in _notes(answer, TERMINAL)]
    return tuple(blocks)


def distance_section(answer: Distance) -> tuple[Block, ...]:
    """The same as a section of an article: one table, and how it is measured."""
    rows = []
    for kind in _HEADS:
        entries = [one for one in answer.singularities if one.kind == kind]
        rows += [(words(kind), *row) for row in _rows(answer, entries, ARTICLE)]
    blocks: list[Block] = [
        Heading(words("Distances to singularities"), 1),
        Paragraph(words(f"{capital(_summary(answer))}.")),
    ]
    if rows:
        caption = words("How far the nearest singularities are along the motion")
        columns = (Column(words("kind")), *_COLUMNS)
        blocks.append(Table(columns, tuple(rows), caption, long=True))
    said = [f"Distances begin at {_values(answer)}"] if answer.posture else []
    said += [_limits(answer)] if answer.within else []
    measures = dict.fromkeys((answer.measure, answer.by_freedoms))
    said += [_measured(one, answer) for one in measures if one is not None]
    blocks += [Paragraph(words(f"{capital(text)}.")) for text in said]
    blocks += [
        Paragraph(prose(f"{capital(text)}.")) for text in _notes(answer, ARTICLE)
    ]
    return tuple(blocks)


_COLUMNS = (
    Column(words("distance, rad")),
    Column(words("singularity"), "wrap", 3.0),
    Column(words("nearest posture"), "wrap", 3.0),
    Column(words("there"), "wrap", 2.0),
)


def _summary(answer: Distance) -> str:
    parts = []
    for kind in _HEADS:
        entries = [one for one in answer.singularities if one.kind == kind]
        if not entries:
            continue
        sizes = [one.nearest.distance for one in entries if one.nearest is not None]
        least = min(sizes, default=None)
        if least is None:
            parts.append(f"{kind} none found")
        elif least == 0:
            parts.append(f"{kind} 0, the posture itself is singular")
        else:
            parts.append(f"{kind} {_in_units(least, answer)}")
    if answer.unfinished:
        return f"nearest singularity so far: {'; '.join(parts) if parts else 'none'}"
    return f"nearest singularity: {'; '.join(parts) if parts else 'there is none'}"


def _in_units(size: float, answer: Distance) -> str:
    """A distance in radians, and as the length that a shift alone would have."""
    text = f"{decimal(size, DIGITS)} rad"
    measure = answer.measure or answer.by_freedoms
    if measure is None or measure.length is None:
        return text
    unit = f" {measure.unit}" if measure.unit else ""
    return f"{text} or {decimal(size * measure.length, DIGITS)}{unit}"


def _rows(
    answer: Distance, entries: Sequence[SingularityDistance], elsewhere: Elsewhere
) -> list[tuple[Text, ...]]:
    def size(one: SingularityDistance) -> float:
        return float("inf") if one.nearest is None else one.nearest.distance

    return [
        (
            _size(one),
            _singularity(one, elsewhere),
            _posture(answer, one, elsewhere),
            words(_there(answer, one)),
        )
        for one in sorted(entries, key=size)
    ]


def _size(one: SingularityDistance) -> Text:
    if one.nearest is None:
        return words("–")
    number = decimal(one.nearest.distance, DIGITS)
    if not one.nearest.exact:
        return words("0" if not one.nearest.distance else f"≈ {number}")
    if one.nearest.exact == number or len(one.nearest.exact) > 2 * MANY:
        return words(f"= {number}")
    return (*math(one.nearest.exact), Words(f" = {number}"))


def _singularity(one: SingularityDistance, elsewhere: Elsewhere) -> Text:
    limb = f"{limb_called(one.limb)}: " if one.limb else ""
    component = one.component
    if component is None:
        return words(f"{limb}wherever the rank is less")
    where, used = place(Numbered(one.number or 0, component), {})
    if not used and max(map(len, component.equations)) > READABLE:
        count = counted(len(component.equations), "equation")
        where = words(f"{count} ({elsewhere.equations})")
    sentence: Text = ()
    if component.geometry and not used:
        sentence = prose(f"; {component.geometry}")
    return (*words(f"{one.number}  {limb}"), *where, *sentence)


def _posture(answer: Distance, one: SingularityDistance, elsewhere: Elsewhere) -> Text:
    found = one.nearest
    if found is None:
        return prose(one.reason)
    parts = [words("here")]
    if found.distance:
        parts = _changes(answer, one, found, elsewhere)
    if not found.connected:
        parts.append(words("no way there along the motion was followed"))
    if one.reason:
        parts.append(prose(one.reason))
    return joined(parts, "; ")


def _changes(
    answer: Distance,
    one: SingularityDistance,
    found: NearestPosture,
    elsewhere: Elsewhere,
) -> list[Text]:
    """The values that differ from the posture where the distance begins."""
    names = answer.freedoms if one.by_freedoms else answer.variables
    before = (0.0,) * len(names) if one.by_freedoms else answer.posture
    changed = [
        (name, value)
        for name, value, old in zip(names, found.values, before, strict=True)
        if abs(value - old) > 5e-7
    ]
    if len(changed) > MANY:
        count = f"{len(changed)} of {len(names)} change"
        return [words(f"{count} ({elsewhere.values})")]
    sign = "by" if one.by_freedoms else "="
    text = ", ".join(
        f"{name} {sign} {decimal(_tidy(value), DIGITS)}" for name, value in changed
    )
    return [words(text)]


def _tidy(value: float) -> float:
    return 0.0 if abs(value) < 1e-9 else value


def _there(answer: Distance, one: SingularityDistance) -> str:
    if one.nearest is None:
        return ""
    platform = platform_called(answer.platform_name).removeprefix("the ")
    parts = []
    if one.kind != "actuation":
        parts.append(f"rank {one.nearest.rank} of {one.generic_rank}")
    freedom = counted(one.nearest.platform_freedom, "freedom")
    parts.append(f"{platform} {freedom}")
    return ", ".join(parts)


def _values(answer: Distance) -> str:
    """The posture where distances begin; zeros together."""
    pairs = zip(answer.variables, answer.posture, strict=True)
    shown = [(n, v) for n, v in pairs if abs(v) > 1e-12]
    text = ", ".join(f"{n} = {decimal(v, DIGITS)}" for n, v in shown)
    if len(shown) == len(answer.variables):
        return text
    rest = "all others 0" if shown else f"{_list(answer.variables)} = 0"
    return f"{text}, {rest}" if text else rest


def _limits(answer: Distance) -> str:
    """Between which values singularities count."""
    text = ", ".join(
        f"{one.name} from {decimal(one.low, DIGITS)} to {decimal(one.high, DIGITS)}"
        for one in answer.within
    )
    counted_from = "" if answer.variables else ", counted from the posture"
    return f"within the limits {text}{counted_from}"


def _list(names: Sequence[str]) -> str:
    if len(names) <= MANY:
        return ", ".join(names)
    return f"{names[0]}, {names[1]}, …, {names[-1]}"


def _measured(measure: DistanceMeasure, answer: Distance) -> str:
    """What is squared and summed, and in which units."""
    parts = []
    platform = platform_called(answer.platform_name)
    if measure.platform:
        shift = " and the shift of its origin over L" if measure.length else ""
        parts.append(f"the angle of {platform}'s rotation in radians{shift}")
    if measure.angles:
        parts.append(f"the changes of {_list(measure.angles)} in radians")
    if measure.lengths:
        parts.append(f"the changes of {_list(measure.lengths)} over L")
    text = f"distance: the root of the sum of squares of {', and of '.join(parts)}"
    if measure.length is not None:
        unit = f" {measure.unit}" if measure.unit else ""
        whose = "as given" if measure.given else "the characteristic length"
        text += (
            f"; L = {decimal(measure.length, DIGITS)}{unit}, {whose}, "
            f"counts as one radian"
        )
    return text


def _notes(answer: Distance, elsewhere: Elsewhere) -> list[str]:
    found = [one for one in answer.singularities if one.nearest is not None]
    notes = []
    if any(one.number for one in answer.singularities):
        notes.append(f"numbers are those {elsewhere.numbers}")
    if any(one.starts == 0 for one in found):
        notes.append("= is exact: the condition is linear in free angles")
    searched = sorted({o.starts for o in answer.singularities if o.starts > 1})
    if searched:
        count = (
            f"{searched[0]}"
            if len(searched) == 1
            else (f"{searched[0]} to {searched[-1]}")
        )
        notes.append(
            f"≈ is the nearest that was found from {count} postures; that nothing is "
            f"nearer is not proved, and where none was found there may be one"
        )
    met = [one.met for one in found if one.starts > 1]
    if met:
        notes.append(f"each of these was met at least {counted(min(met), 'time')}")
    if any(one.by_freedoms for one in answer.singularities):
        notes.append(
            "where the rank itself was looked at, the motion is that of all joints, "
            "and it is said by how much each has moved"
        )
    notes += answer.remarks
    if answer.unfinished:
        notes.append(f"not looked at yet: {', '.join(answer.unfinished)}")
    return notes
