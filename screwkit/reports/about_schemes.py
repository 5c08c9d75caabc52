"""Sections that answer `schemes`: how many, why not the others, the simplest first."""

from __future__ import annotations

from collections.abc import Iterable

from screwkit.algebra.names import counted
from screwkit.reports.about_singularities import ONE_POSTURE
from screwkit.reports.added_actuators import added_blocks
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Loci,
    Paragraph,
    Span,
    Strong,
    Table,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.conditioning import conditioning_texts, ranking_remarks
from screwkit.reports.notation import term_count
from screwkit.reports.phrases import listed
from screwkit.results.schemes import Ranking, Scheme, Schemes
from screwkit.results.undecided import Undecided

SHOWN = 12


def schemes_blocks(answer: Schemes, *, shown: int | None = SHOWN) -> tuple[Block, ...]:
    """The whole answer; ``shown`` caps the admissible schemes, None shows all."""
    blocks: list[Block] = [Paragraph(summary(answer), 1)]
    if answer.refusals:
        blocks += [Heading(words("never admissible"), 1), refusals_table(answer)]
    admissible = in_order(answer)
    if admissible:
        listed_ones = admissible if shown is None else admissible[:shown]
        blocks += [
            Heading(words(f"admissible, {order_words(answer)}"), 1),
            loci_table(listed_ones, answer.ranking),
        ]
        hidden = len(admissible) - len(listed_ones)
        if hidden:
            more = f"… {hidden} more (--all, --json, -o schemes.tex)"
            blocks.append(Paragraph(words(more), 1))
    notes = remarks(answer)
    blocks += [Paragraph(text, 1) for text in notes]
    return (*blocks, *added_blocks(answer.redundancy))


def summary(answer: Schemes) -> Text:
    """The counts in one sentence."""
    spans: list[Span] = [
        Words(
            f"{answer.total} way{'' if answer.total == 1 else 's'} to actuate "
            f"{counted(answer.size, 'freedom')}: "
        ),
        Strong(f"{answer.admissible} admissible"),
    ]
    if answer.balanced is not None and answer.balanced.total != answer.total:
        spans.append(
            Words(
                f"; of the {answer.balanced.total} with the same number in every limb, "
                f"{answer.balanced.admissible}"
            )
        )
    return tuple(spans)


def remarks(answer: Schemes) -> tuple[Text, ...]:
    """Symmetry, lengths left out, and what is open."""
    notes: list[Text] = []
    if answer.one_posture:
        notes.append(words(ONE_POSTURE))
    if answer.mirror is not None:
        classes, own = answer.mirror.admissible
        images = "its own mirror image" if own == 1 else "their own mirror image"
        notes.append(
            words(
                f"up to the mirror symmetry: {answer.mirror.total[0]} classes, "
                f"{classes} admissible" + (f" ({own} {images})" if own else "")
            )
        )
    if answer.left_out:
        lengths = joined([math(text) for text in answer.left_out])
        notes.append((Words("left out of the loci, never zero: "), *lengths))
    if any(s.deeper and not s.undecided for s in answer.schemes if s.admissible):
        notes.append(
            words(
                "on hypersurfaces; where several conditions hold at once some schemes "
                "may fail too: singularities --actuated … searches there"
            )
        )
    notes += ranking_remarks(answer.ranking)
    if not answer.complete:
        reason = answer.reason or "not every locus was expanded"
        notes.append(words(f"undecided: the loci in full. {reason}"))
    return tuple(notes)


def refusals_table(answer: Schemes) -> Table:
    """The reasons shared by inadmissible schemes."""
    rows = tuple(
        (
            words(str(refusal.schemes)),
            words(listed(refusal.example) if refusal.schemes == 1 else ""),
            prose(refusal.reason),
        )
        for refusal in answer.refusals
    )
    columns = (Column((), "right"), Column(()), Column((), "wrap"))
    if not any(row[1] for row in rows):
        return Table(
            (columns[0], columns[2]),
            tuple((number, reason) for number, _, reason in rows),
        )
    return Table(columns, rows)


def complexity(scheme: Scheme) -> tuple[bool, int, int]:
    """What is easy to read comes first: terms and length; what is undecided last."""
    terms = sum(term_count(factor) for factor in scheme.locus)
    return scheme.undecided, terms, sum(map(len, scheme.locus))


def in_order(answer: Schemes) -> tuple[Scheme, ...]:
    """The admissible schemes, best conditioned first where they are ranked."""
    if not isinstance(answer.ranking, Ranking):
        return by_simplicity(answer)
    named = {scheme.actuated: scheme for scheme in answer.schemes}
    return tuple(named[one.actuated] for one in answer.ranking.schemes)


def order_words(answer: Schemes) -> str:
    """What `in_order` puts first."""
    ranked = isinstance(answer.ranking, Ranking)
    return "best conditioned first" if ranked else "simplest locus first"


def by_simplicity(answer: Schemes) -> tuple[Scheme, ...]:
    """The admissible schemes, simplest locus first."""
    admissible = [scheme for scheme in answer.schemes if scheme.admissible]
    return tuple(sorted(admissible, key=complexity))


def locus(scheme: Scheme) -> Text:
    """A scheme's locus as a product of powers, or what is known of it."""
    if not scheme.locus:
        if scheme.undecided:
            return words("undecided")
        if scheme.deeper:
            return words("on no hypersurface")
        return words("never singular")
    powers = scheme.multiplicities or (1,) * len(scheme.locus)
    factors = tuple(
        (text, power, term_count(text))
        for text, power in zip(scheme.locus, powers, strict=True)
    )
    return (Loci(factors),)


def loci_table(
    schemes: Iterable[Scheme], ranking: Ranking | Undecided | None = None
) -> Table:
    """Schemes beside their loci, with their conditioning where they are ranked."""
    if not isinstance(ranking, Ranking):
        rows = tuple((words(listed(one.actuated)), locus(one)) for one in schemes)
        return Table((Column(()), Column((), "wrap")), rows)
    columns = (
        Column(words("actuated")),
        Column(words("median"), "right"),
        Column(words("worst"), "right"),
        Column(words("locus"), "wrap"),
    )
    numbers = conditioning_texts(ranking)
    return Table(
        columns,
        tuple(
            (words(listed(one.actuated)), *numbers[one.actuated], locus(one))
            for one in schemes
        ),
    )
