"""`blocks(result)`: one registered function per type of answer.

These are the answers as a terminal or a notebook shows them; `article` makes the
longer form that one submits from the same parts.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import singledispatch
from typing import Any

from screwkit.reports.about_distance import distance_blocks
from screwkit.reports.about_manipulability import manipulability_blocks
from screwkit.reports.about_mobility import mobility_blocks, topology_line
from screwkit.reports.about_reach import reach_blocks
from screwkit.reports.about_schemes import schemes_blocks
from screwkit.reports.about_screws import relative_blocks, screws_blocks
from screwkit.reports.about_singularities import (
    actuation_part,
    constraint_part,
    limb_part,
    singularities_blocks,
)
from screwkit.reports.about_sweep import sweep_blocks
from screwkit.reports.about_verification import verification_blocks
from screwkit.reports.about_view import view_blocks
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
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
from screwkit.reports.notation import is_mathematics
from screwkit.results.analysis import Analysis, ClaimCheck, Description
from screwkit.results.distance import Distance
from screwkit.results.manipulability import Manipulability
from screwkit.results.mobility import Mobility
from screwkit.results.reach import Reach
from screwkit.results.schemes import Schemes
from screwkit.results.screws import RelativeMotion, Screws
from screwkit.results.singularities import (
    ActuationSingularities,
    ConstraintSingularities,
    LimbSingularities,
    Singularities,
)
from screwkit.results.sweep import Sweep
from screwkit.results.undecided import Undecided
from screwkit.results.verification import Verification
from screwkit.results.view import View

_FORMULA = re.compile(r"[*(]|\w [-+] \w")


@dataclass(frozen=True)
class CaseEntry:
    """A bundled case, as `cases` lists it."""

    name: str
    title: str
    source: str
    joints: int
    loops: int


@dataclass(frozen=True)
class CaseList:
    """The bundled cases."""

    cases: tuple[CaseEntry, ...]


@singledispatch
def blocks(result: Any) -> tuple[Block, ...]:
    """The answer as blocks, without its head line.

    Raises:
        TypeError: If the type has no section.
    """
    raise TypeError(f"no section for {type(result).__name__}")


def answer_blocks(result: Any, *, every: bool = False) -> tuple[Block, ...]:
    """The answer with a head line that names the case.

    Args:
        result: Any answer.
        every: Whether long lists of schemes or conditions are shown in full.
    """
    case, title = getattr(result, "case", ""), getattr(result, "title", "")
    if not case:
        return blocks(result)
    head: list[Block] = [Heading(words(title or case), 0, words(case if title else ""))]
    topology = getattr(result, "topology", None)
    if topology is not None:
        head.append(Paragraph(words(topology_line(topology))))
    if every and isinstance(result, Schemes):
        return (*head, *schemes_blocks(result, shown=None))
    if every and isinstance(result, Singularities):
        return (*head, *singularities_blocks(result, shown=None))
    return (*head, *blocks(result))


@blocks.register
def _(result: Mobility) -> tuple[Block, ...]:
    return mobility_blocks(result)


@blocks.register
def _(result: Screws) -> tuple[Block, ...]:
    return screws_blocks(result)


@blocks.register
def _(result: RelativeMotion) -> tuple[Block, ...]:
    return relative_blocks(result)


@blocks.register
def _(result: Singularities) -> tuple[Block, ...]:
    return singularities_blocks(result)


@blocks.register
def _(result: Distance) -> tuple[Block, ...]:
    return distance_blocks(result)


@blocks.register
def _(result: Verification) -> tuple[Block, ...]:
    return verification_blocks(result)


@blocks.register
def _(result: Schemes) -> tuple[Block, ...]:
    return schemes_blocks(result)


@blocks.register
def _(result: Manipulability) -> tuple[Block, ...]:
    return manipulability_blocks(result)


@blocks.register
def _(result: Reach) -> tuple[Block, ...]:
    return reach_blocks(result)


@blocks.register
def _(result: Sweep) -> tuple[Block, ...]:
    return sweep_blocks(result)


@blocks.register
def _(result: View) -> tuple[Block, ...]:
    return view_blocks(result)


@blocks.register
def _(result: Undecided) -> tuple[Block, ...]:
    return (Paragraph((Strong("undecided"), Words(f": {result.reason}")), 1),)


@blocks.register
def _(result: Description) -> tuple[Block, ...]:
    return (Heading(words(result.title or result.case), 0, words(result.case)),)


@blocks.register
def _(result: LimbSingularities) -> tuple[Block, ...]:
    return limb_part(result)


@blocks.register
def _(result: ConstraintSingularities) -> tuple[Block, ...]:
    return constraint_part(result)


@blocks.register
def _(result: ActuationSingularities) -> tuple[Block, ...]:
    return actuation_part(result)


@blocks.register
def _(result: Analysis) -> tuple[Block, ...]:
    parts: list[Block] = []
    if isinstance(result.mobility, Mobility):
        parts.append(Paragraph(words(topology_line(result.mobility.topology))))
    for name, part in (
        ("MOBILITY", result.mobility),
        ("SCREWS", result.screws),
        ("SINGULARITIES", result.singularities),
        ("ACTUATION SCHEMES", result.schemes),
        ("MANIPULABILITY", result.manipulability),
        ("DISTANCES TO SINGULARITIES", result.distance),
    ):
        if part is None:
            continue
        parts.append(Heading(words(name), 1))
        parts += blocks(part)
    if result.claims:
        parts += [
            Heading(words("CLAIMS"), 1, words(claims_line(result.claims))),
            claims_table(result.claims),
        ]
    return tuple(parts)


@blocks.register
def _(result: CaseList) -> tuple[Block, ...]:
    columns = (
        Column(words("case")),
        Column(words("joints"), "right"),
        Column(words("loops"), "right"),
        Column(words("title"), "wrap", 3),
        Column(words("source"), "wrap", 2),
    )
    rows = tuple(
        (
            words(one.name),
            words(str(one.joints)),
            words(str(one.loops)),
            words(one.title),
            words(one.source),
        )
        for one in result.cases
    )
    return (Table(columns, rows, indent=0),)


def claims_line(claims: Sequence[ClaimCheck]) -> str:
    """How many claims were confirmed."""
    agreeing = sum(claim.agrees is True for claim in claims)
    return f"{agreeing} of {len(claims)} confirmed"


def claims_table(claims: Sequence[ClaimCheck]) -> Table:
    """What the sources say beside what holds."""
    columns = (
        Column(words("claim"), "wrap", 2),
        Column(words("stated"), "wrap"),
        Column(words("found"), "wrap"),
        Column(words(""), "wrap", 2),
    )
    rows = tuple(
        (
            words(claim_name(claim)),
            plain_value(claim.claimed),
            found(claim),
            prose(f"{claim_remark(claim)} ({claim.status}: {claim.source})"),
        )
        for claim in claims
    )
    return Table(columns, rows)


def plain_value(value: Any) -> Text:
    """A claimed value on one line."""
    if value is None:
        return ()
    if isinstance(value, bool):
        return words("yes" if value else "no")
    if isinstance(value, list | tuple):
        return joined([plain_value(item) for item in value]) or words("none")
    if isinstance(value, int):
        return words(str(value).replace("-", "−"))
    text = str(value)
    formula = _FORMULA.search(text) and is_mathematics(text)
    return math(text) if formula else prose(text)


def found(claim: ClaimCheck) -> Text:
    """What holds, as far as it can be shown in a cell."""
    shown = plain_value(claim.computed)
    return shown or words("as stated" if claim.agrees else "–")


def claim_name(claim: ClaimCheck) -> str:
    """The question of a claim as words: ``mobility, counts, gogu (bases)``."""
    path, _, aspect = claim.question.partition("#")
    name = path.replace(".", ", ").replace("_", " ")
    return f"{name} ({aspect.replace('_', ' ')})" if aspect else name


def claim_remark(claim: ClaimCheck) -> str:
    """Whether the claim holds, and what does instead."""
    state = {True: "agrees", False: "differs", None: "not compared"}[claim.agrees]
    if claim.agrees is False and not claim.holds:
        state = "differs, as noted"
    return f"{state}; {claim.note}" if claim.note else state
