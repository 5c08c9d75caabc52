"""Sections that answer `screws`: the systems of the limbs and of the platform."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from screwkit.algebra.names import counted, limb_called
from screwkit.reports.blocks import (
    Block,
    Column,
    Condition,
    Heading,
    Listing,
    Paragraph,
    Table,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.phrases import listed, tuple_of
from screwkit.results.screws import (
    ActuationWrench,
    IdentifiedScrew,
    RelativeMotion,
    Screws,
)

LINEAR = "moment-direction"
_ONE_LINE = 76
_READABLE = 240


ADDS_NOTHING = "the limb keeps its freedoms"
"""Why locking a freedom changes nothing: the others of its limb do the same."""


def screws_blocks(answer: Screws) -> tuple[Block, ...]:
    """The whole answer."""
    where = "" if answer.generic else "; at the values of the file"
    blocks: list[Block] = [Paragraph(words(convention(answer) + where), 1)]
    for limb in answer.limbs:
        blocks += [
            Heading(
                words(
                    f"{limb_called(limb.name)}: {listed(limb.joints) or 'no freedom'}"
                ),
                1,
                words(dimensions(limb.twist_dimension, limb.wrench_dimension)),
            ),
            *screw_listings(limb.twists, limb.wrenches, answer.order),
        ]
    platform = answer.platform
    blocks += [
        Heading(
            words("platform"),
            1,
            words(dimensions(platform.twist_dimension, platform.wrench_dimension)),
        ),
        *screw_listings(platform.twists, platform.wrenches, answer.order),
    ]
    if answer.actuation_wrenches:
        blocks += [
            Heading(words("what each locked joint adds"), 1),
            actuation_listing(answer.actuation_wrenches, answer.order),
        ]
    return tuple(blocks)


def relative_blocks(answer: RelativeMotion) -> tuple[Block, ...]:
    """The twists of one body relative to another."""
    blocks: list[Block] = [
        Heading(
            words(f"{answer.body} relative to {answer.relative_to}"),
            1,
            words(dimensions(answer.twist_dimension, answer.wrench_dimension)),
        )
    ]
    if answer.motion_class is not None:
        blocks.append(Paragraph(prose(answer.motion_class.description), 1))
    where = "" if answer.generic else "; at the values of the file"
    blocks.append(Paragraph(words(convention(answer) + where), 1))
    blocks += screw_listings(answer.twists, answer.wrenches, answer.order)
    return tuple(blocks)


def dimensions(twists: int, wrenches: int) -> str:
    """The two dimensions of a system and its reciprocal."""
    constraints = counted(wrenches, "constraint wrench", "constraint wrenches")
    return f"{counted(twists, 'freedom')}, {constraints}"


def halves_of(order: str) -> tuple[str, str]:
    """How a twist and a wrench are written in this order."""
    return ("(v; ω)", "(m; f)") if order == LINEAR else ("(ω; v)", "(f; m)")


def convention(answer: Screws | RelativeMotion) -> str:
    """Order, frame and point, said before any coordinate."""
    twist, wrench = halves_of(answer.order)
    where = "its origin" if answer.point == "origin" else answer.point
    return (
        f"twists {twist} and wrenches {wrench} in the axes of {answer.frame}, "
        f"moments about {where}; each up to a factor"
    )


def split_of(coordinates: tuple[str, ...], order: str, *, wrench: bool) -> int:
    """After how many coordinates the second half begins."""
    if len(coordinates) != 3:
        return len(coordinates) // 2
    return 2 if wrench != (order == LINEAR) else 1


def screw_listings(
    twists: tuple[IdentifiedScrew, ...],
    wrenches: tuple[IdentifiedScrew, ...],
    order: str,
) -> list[Block]:
    """Twists, then wrenches, each in words above its coordinates."""
    blocks: list[Block] = []
    for name, screws, wrench in (
        ("freedoms", twists, False),
        ("constraint wrenches", wrenches, True),
    ):
        if not screws:
            continue
        width = max(len(screw.kind) for screw in screws)
        items = tuple(
            Condition(
                "",
                (Words(f"{screw.kind:<{width}}  "), *line(screw)),
                details=halves(screw, order, wrench=wrench),
            )
            for screw in screws
        )
        blocks += [Heading(words(name), 2), Listing(items)]
    return blocks


def halves(screw: IdentifiedScrew, order: str, *, wrench: bool) -> tuple[Text, ...]:
    """The coordinates on one line, or one for each half where they are long."""
    if not screw.coordinates:
        return ()
    split = split_of(screw.coordinates, order, wrench=wrench)
    whole = tuple_of(screw.coordinates, split)
    if sum(map(len, screw.coordinates)) <= _ONE_LINE:
        return (whole,)
    at = next(i for i, span in enumerate(whole) if span == Words("; "))
    return (*whole[:at], Words(";")), (Words("\u00a0"), *whole[at + 1 :])


def coordinates(screw: IdentifiedScrew, order: str, *, wrench: bool) -> Text:
    """The coordinates of a screw in brackets."""
    if not screw.coordinates:
        return words("–")
    return tuple_of(
        screw.coordinates, split_of(screw.coordinates, order, wrench=wrench)
    )


def line(screw: IdentifiedScrew) -> Text:
    """The screw in geometry's words: its axis, a point of it, its pitch."""
    if screw.description:
        return prose(screw.description.removeprefix(f"{screw.kind} "))
    if sum(map(len, (*screw.axis, *screw.point, screw.pitch))) > _READABLE:
        return words("with its axis and pitch in the JSON")
    parts: list[Text] = []
    if screw.axis:
        parts.append((Words("along "), *tuple_of(screw.axis)))
    if screw.point:
        parts.append((Words("through "), *tuple_of(screw.point)))
    if screw.pitch and screw.pitch != "0":
        parts.append((Words("pitch "), *math(screw.pitch)))
    return joined(parts, " ")


def freedom_names(wrenches: tuple[ActuationWrench, ...]) -> list[str]:
    """The freedoms as they are typed: ``name:k`` where the joint has several."""
    several = {w.joint for w in wrenches if w.freedom}
    return [
        f"{w.joint}:{w.freedom}" if w.joint in several else w.joint for w in wrenches
    ]


def _entries(
    wrenches: tuple[ActuationWrench, ...],
) -> Iterator[tuple[str, ActuationWrench | None]]:
    """Each freedom with what it adds; idle ones in a row in one line, with None."""
    named = zip(freedom_names(wrenches), wrenches, strict=True)
    for adds, group in groupby(named, key=lambda pair: pair[1].screw is not None):
        run = list(group)
        if adds:
            yield from run
        elif len(run) <= 2:
            yield from ((name, None) for name, _ in run)
        else:
            yield f"{run[0][0]} … {run[-1][0]}", None


def actuation_listing(wrenches: tuple[ActuationWrench, ...], order: str) -> Listing:
    """One entry a freedom; a freedom that adds nothing says so."""
    items: list[Condition] = []
    for name, entry in _entries(wrenches):
        if entry is None:
            items.append(Condition(name, words(f"nothing: {ADDS_NOTHING}")))
            continue
        assert entry.screw is not None
        where = (Words(f"{entry.screw.kind}  "), *line(entry.screw))
        details = halves(entry.screw, order, wrench=True)
        items.append(Condition(name, where, details=details))
    return Listing(tuple(items), 1)


def actuation_table(wrenches: tuple[ActuationWrench, ...], order: str) -> Table:
    """One row a freedom; a freedom that adds nothing says so."""
    rows: list[tuple[Text, ...]] = []
    for name, entry in _entries(wrenches):
        if entry is None:
            nothing = words(f"adds nothing: {ADDS_NOTHING}")
            rows.append((words(name), words("–"), nothing, ()))
            continue
        assert entry.screw is not None
        rows.append(
            (
                words(name),
                words(entry.screw.kind),
                coordinates(entry.screw, order, wrench=True),
                line(entry.screw),
            )
        )
    columns = (Column(()), Column(()), Column((), "wrap", 3), Column((), "wrap", 2))
    return Table(columns, tuple(rows))
