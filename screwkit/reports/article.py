"""An analysis as an article: summary, tables in the manner of the literature, sources.

Sections follow the order in which a kinematician argues: the mechanism, its mobility,
its screw systems, its singularities, its actuation schemes; then what was published
beside what holds.
"""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.reports.about_distance import distance_section
from screwkit.reports.about_freedoms import (
    branch_blocks,
    class_sentence,
    connectivity_blocks,
    freedom_blocks,
    redundancy_blocks,
    unnamed_paragraph,
)
from screwkit.reports.about_mobility import (
    freedoms,
    full_cycle,
    locked,
    motion_place,
    topology_line,
)
from screwkit.reports.about_schemes import remarks, summary
from screwkit.reports.about_screws import convention, halves_of
from screwkit.reports.added_actuators import added_section
from screwkit.reports.article_manipulability import manipulability_section
from screwkit.reports.article_mechanism import mechanism_section
from screwkit.reports.article_schemes import (
    counts_table,
    factors_table,
    reasons_table,
    schemes_table,
)
from screwkit.reports.article_screws import screws_section
from screwkit.reports.article_singularities import (
    singularities_sections,
    singularities_summary,
)
from screwkit.reports.blocks import (
    Bibliography,
    Block,
    Column,
    Formula,
    Heading,
    Loose,
    Paragraph,
    Reference,
    Strong,
    Table,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.given_names import given_names, with_given_names
from screwkit.reports.phrases import platform_called, signed
from screwkit.reports.records import version
from screwkit.reports.references import cited, entries, keys_in
from screwkit.reports.sections import (
    claim_name,
    claim_remark,
    claims_line,
    found,
    plain_value,
)
from screwkit.results.analysis import Analysis, ClaimCheck
from screwkit.results.distance import Distance
from screwkit.results.manipulability import Manipulability
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Schemes
from screwkit.results.screws import Screws
from screwkit.results.singularities import Singularities
from screwkit.results.undecided import Undecided


@dataclass(frozen=True)
class Article:
    """A report before it is rendered."""

    title: str
    byline: str
    summary: tuple[Block, ...]
    blocks: tuple[Block, ...]

    @property
    def tables(self) -> tuple[Table, ...]:
        """The tables, in order."""
        return tuple(block for block in self.blocks if isinstance(block, Table))


def article(analysis: Analysis) -> Article:
    """Compose the report of an analysis."""
    body: list[Block] = [
        *mechanism_section(analysis.description),
        *_mobility_section(analysis.mobility),
        *_screws(analysis.screws),
        *_singularities(analysis.singularities),
        *_schemes_section(analysis.schemes),
        *_manipulability(analysis.manipulability),
        *_distances(analysis.distance),
        *_claims_section(analysis.claims),
        *_conventions_section(analysis),
    ]
    keys: set[str] = {"Hunt1978"}
    for block in body:
        if isinstance(block, Paragraph):
            keys |= keys_in(block.text)
        elif isinstance(block, Table):
            keys |= keys_in(block.caption)
            for row in block.rows:
                keys = keys.union(*(keys_in(cell) for cell in row))
    body.append(Bibliography(entries(keys)))
    names = given_names(analysis.description)
    return Article(
        title=analysis.title or analysis.case,
        byline=f"Case {analysis.case}, derived by screwkit {version()}",
        summary=with_given_names(_summary(analysis), names),
        blocks=with_given_names(body, names),
    )


def _undecided(title: str, refusal: Undecided) -> tuple[Block, ...]:
    return (
        Heading(words(title), 1),
        Paragraph((Strong("Undecided"), Words(f": {refusal.reason}"))),
    )


def _summary(analysis: Analysis) -> tuple[Block, ...]:
    """The answers, one paragraph each."""
    parts: list[Text] = []
    if isinstance(analysis.mobility, Mobility):
        of_platform, of_mechanism = freedoms(analysis.mobility)
        parts.append(
            (
                *_capitalised(of_platform),
                Words("; "),
                *of_mechanism,
                Words(f". {_sentence(full_cycle(analysis.mobility))}"),
            )
        )
    if isinstance(analysis.singularities, Singularities):
        parts.append(words(singularities_summary(analysis.singularities)))
    if isinstance(analysis.schemes, Schemes):
        parts.append((*_capitalised(summary(analysis.schemes)), Words(".")))
    open_ones = [
        name
        for name, answer in (
            ("mobility", analysis.mobility),
            ("screw systems", analysis.screws),
            ("singularities", analysis.singularities),
            ("actuation schemes", analysis.schemes),
            ("manipulability", analysis.manipulability),
            ("distances to singularities", analysis.distance),
        )
        if isinstance(answer, Undecided)
    ]
    if open_ones:
        parts.append(words(f"Undecided: {', '.join(open_ones)}."))
    return (Paragraph(joined(parts, " ")),)


def _capitalised(text: Text) -> Text:
    first, *rest = text
    if isinstance(first, Words) and first.text:
        first = Words(first.text[0].upper() + first.text[1:])
    return (first, *rest)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")


def _mobility_section(answer: Mobility | Undecided) -> tuple[Block, ...]:
    if isinstance(answer, Undecided):
        return _undecided("Mobility", answer)
    of_platform, of_mechanism = freedoms(answer)
    blocks: list[Block] = [
        Heading(words("Mobility"), 1),
        Paragraph(
            (
                *words(f"The graph has {topology_line(answer.topology)}. "),
                *_capitalised(of_platform),
                Words("; "),
                *of_mechanism,
                Words(". Each count reads as follows."),
            )
        ),
    ]
    for index, working in enumerate(answer.workings):
        blocks.append(Paragraph(_working_head(working.name, cited(working.equation))))
        blocks.append(
            Formula(
                Loose(f"n = {working.formula} = {signed(working.value)}"),
                f"equation:count{index}",
            )
        )
    blocks.append(_counts_table(answer))
    blocks.append(
        Paragraph(
            words(
                f"The loop constraint matrix has rank {answer.loop_rank}. "
                f"{_sentence(full_cycle(answer))}"
            )
        )
    )
    if any(case.reason for case in answer.platform.cases):
        blocks.append(_motion_table(answer))
    if said := class_sentence(answer):
        name, _, members = said.partition(": ")
        whole = f"class of the platform's motion: {name}"
        whole += f" – {members}" if members else ""
        blocks.append(Paragraph(prose(_sentence(whole))))
    blocks += [
        *redundancy_blocks(answer, captioned=True),
        *freedom_blocks(answer, captioned=True),
        *unnamed_paragraph(answer),
        *branch_blocks(answer.full_cycle, captioned=True),
        *connectivity_blocks(answer.connectivity, captioned=True),
    ]
    if answer.actuation is not None:
        blocks.append(
            Paragraph(
                words(_sentence(locked(answer.actuation, answer.platform_name, ", ")))
            )
        )
    if answer.at_values is not None and answer.at_values.differences:
        said = " ".join(_sentence(text) for text in answer.at_values.differences)
        what = (
            "posture of the file is" if answer.on_motion else "values of the file are"
        )
        blocks.append(Paragraph(prose(f"The {what} special. {said}")))
    return tuple(blocks)


def _working_head(name: str, citation: Text) -> Text:
    name = name[:1].upper() + name[1:]
    return (Words(name), *((Words(" "), *citation) if citation else ()), Words(":"))


def _counts_table(answer: Mobility) -> Table:
    rows = tuple(
        (
            words(working.name[:1].upper() + working.name[1:]),
            (
                Words("("),
                Reference(f"equation:count{index}", str(index + 1)),
                Words(")"),
            ),
            words(signed(working.value)),
            prose(working.remark or _agreement(working.value, answer)),
        )
        for index, working in enumerate(answer.workings)
    )
    columns = (
        Column(words("Count")),
        Column(words("Equation"), "centre"),
        Column(words("Value"), "right"),
        Column(words("Remark"), "wrap"),
    )
    caption = words("The counts of mobility side by side")
    return Table(columns, rows, caption, "table:counts")


def _agreement(value: int | None, answer: Mobility) -> str:
    if value is None:
        return "does not apply"
    true = answer.instantaneous_mobility
    if value in (true, answer.platform.twist_dimension):
        return ""
    return f"differs from the instantaneous mobility {signed(true)}"


def _motion_table(answer: Mobility) -> Table:
    rows = tuple(
        (motion_place(case), words(case.motion_type), prose(case.reason))
        for case in answer.platform.cases
    )
    caption = f"Motion of {platform_called(answer.platform_name)}"
    columns = (
        Column(words("Where"), "wrap", 1.2),
        Column(words("Motion")),
        Column(words("Constraint wrenches"), "wrap"),
    )
    return Table(columns, rows, words(caption), "table:motion")


def _screws(answer: Screws | Undecided) -> tuple[Block, ...]:
    if isinstance(answer, Undecided):
        return _undecided("Screw systems", answer)
    return screws_section(answer)


def _singularities(answer: Singularities | Undecided) -> tuple[Block, ...]:
    if isinstance(answer, Undecided):
        return _undecided("Singularities", answer)
    return singularities_sections(answer)


def _schemes_section(answer: Schemes | Undecided) -> tuple[Block, ...]:
    if isinstance(answer, Undecided):
        return _undecided("Actuation schemes", answer)
    blocks: list[Block] = [
        Heading(words("Actuation schemes"), 1),
        Paragraph((*_capitalised(summary(answer)), Words("."))),
        counts_table(answer),
    ]
    if answer.refusals:
        blocks.append(reasons_table(answer))
    if answer.admissible:
        blocks.append(schemes_table(answer))
    if answer.factors:
        blocks.append(factors_table(answer))
    blocks += [Paragraph((*_capitalised(text), Words("."))) for text in remarks(answer)]
    return (*blocks, *added_section(answer.redundancy))


def _manipulability(answer: Manipulability | Undecided) -> tuple[Block, ...]:
    if isinstance(answer, Undecided):
        return _undecided("Manipulability", answer)
    return manipulability_section(answer)


def _distances(answer: Distance | Undecided | None) -> tuple[Block, ...]:
    if answer is None:
        return ()
    if isinstance(answer, Undecided):
        return _undecided("Distances to singularities", answer)
    return distance_section(answer)


def _claims_section(claims: tuple[ClaimCheck, ...]) -> tuple[Block, ...]:
    if not claims:
        return ()
    rows = tuple(
        (
            words(claim_name(claim)),
            plain_value(claim.claimed),
            found(claim),
            prose("; ".join(filter(None, (claim.source, claim_remark(claim))))),
        )
        for claim in claims
    )
    columns = (
        Column(words("Claim"), "wrap", 1.2),
        Column(words("Stated"), "wrap", 1.2),
        Column(words("Holds"), "wrap", 0.6),
        Column(words("Source and remark"), "wrap", 2),
    )
    caption = words(f"Published beside what holds: {claims_line(claims)}")
    return (
        Heading(words("Published beside what holds"), 1),
        Table(columns, rows, caption, "table:claims", long=True),
    )


def _conventions_section(analysis: Analysis) -> tuple[Block, ...]:
    parts: list[Text] = []
    order = ""
    if isinstance(analysis.screws, Screws):
        order = analysis.screws.order
        parts.append(words(f"Screws: {_lowered(convention(analysis.screws))}."))
    twist, wrench = halves_of(order)
    parts.append(
        (
            Words(
                f"The reciprocal product of a wrench {wrench} and a twist {twist} is "
            ),
            Loose("f·v + m·ω"),
            Words(
                ". Angles are radians. Ranks are exact and hold for generic values of "
                "the free symbols."
            ),
        )
    )
    answer = analysis.singularities
    if isinstance(answer, Singularities) and answer.assumptions:
        taken = joined([math(text) for text in answer.assumptions])
        parts.append((Words("Assumed throughout: "), *taken, Words(".")))
    return (
        Heading(words("Assumptions and conventions"), 1),
        Paragraph(joined(parts, " ")),
    )


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]
