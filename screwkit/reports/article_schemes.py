"""Actuation schemes as an article shows them: counts, reasons, loci, factors."""

from __future__ import annotations

from screwkit.algebra.names import counted
from screwkit.reports.about_schemes import in_order, locus, order_words
from screwkit.reports.blocks import Column, Math, Table, Text, prose, words
from screwkit.reports.conditioning import conditioning_texts
from screwkit.reports.phrases import listed
from screwkit.results.schemes import Ranking, Schemes

SHOWN = 24
SHOWN_FACTORS = 30


def counts_table(answer: Schemes) -> Table:
    """How many schemes, how many admissible; up to symmetry where there is one."""
    mirror = answer.mirror
    columns = [
        Column(words("Schemes")),
        Column(words("Total"), "right"),
        Column(words("Admissible"), "right"),
    ]
    if mirror is not None:
        columns += [
            Column(words("Classes"), "right"),
            Column(words("Admissible"), "right"),
        ]
    rows: list[tuple[Text, ...]] = []
    for name, total, admissible, classes, good in (
        (
            "all",
            answer.total,
            answer.admissible,
            mirror.total if mirror else None,
            mirror.admissible if mirror else None,
        ),
        (
            "the same number in every limb",
            answer.balanced.total if answer.balanced else None,
            answer.balanced.admissible if answer.balanced else None,
            mirror.balanced if mirror else None,
            mirror.balanced_admissible if mirror else None,
        ),
    ):
        if total is None:
            continue
        row = [words(name), words(str(total)), words(str(admissible))]
        if classes is not None and good is not None:
            row += [
                words(f"{classes[0]} ({classes[1]})"),
                words(f"{good[0]} ({good[1]})"),
            ]
        rows.append(tuple(row))
    caption = f"Actuation schemes of {counted(answer.size, 'freedom')}"
    if mirror is not None:
        caption += "; classes up to the mirror symmetry, their own image in brackets"
    return Table(tuple(columns), tuple(rows), words(caption), "table:schemes")


def reasons_table(answer: Schemes) -> Table:
    """Why schemes are never admissible."""
    rows = tuple(
        (
            words(str(refusal.schemes)),
            words(listed(refusal.example)),
            prose(refusal.reason),
        )
        for refusal in answer.refusals
    )
    columns = (
        Column(words("Schemes"), "right"),
        Column(words("Example")),
        Column(words("Reason"), "wrap"),
    )
    return Table(
        columns, rows, words("Never admissible"), "table:reasons", long=len(rows) > 12
    )


def schemes_table(answer: Schemes, *, shown: int | None = SHOWN) -> Table:
    """The admissible schemes with their loci, simplest first."""
    admissible = in_order(answer)
    taken = admissible if shown is None else admissible[:shown]
    rows: tuple[tuple[Text, ...], ...]
    columns: tuple[Column, ...]
    rows = tuple((words(listed(one.actuated)), locus(one)) for one in taken)
    columns = (Column(words("Actuated")), Column(words("Singular locus"), "wrap"))
    if isinstance(answer.ranking, Ranking):
        numbers = conditioning_texts(answer.ranking)
        rows = tuple(
            (row[0], *numbers[one.actuated], row[1])
            for row, one in zip(rows, taken, strict=True)
        )
        added = (Column(words("Median"), "right"), Column(words("Worst"), "right"))
        columns = (columns[0], *added, columns[1])
    caption = f"Admissible schemes, {order_words(answer)}; singular where it vanishes"
    if len(taken) < len(admissible):
        caption += (
            f". The first {len(taken)} of {len(admissible)}; the others are in the JSON"
        )
    return Table(columns, rows, words(caption), "table:loci", long=True)


def factors_table(answer: Schemes) -> Table:
    """The factors of the loci with what they mean."""
    ordered = sorted(answer.factors, key=lambda f: (-f.schemes, f.terms))
    taken = ordered[:SHOWN_FACTORS]
    rows: tuple[tuple[Text, ...], ...] = tuple(
        (
            (Math(factor.equation, factor.terms),),
            words(str(factor.schemes)),
            prose(factor.meaning or "–"),
        )
        for factor in taken
    )
    columns: tuple[Column, ...] = (
        Column(words("Factor"), "wrap", 1.2),
        Column(words("Schemes"), "right"),
        Column(words("Meaning"), "wrap"),
    )
    if not any(factor.meaning for factor in taken):
        columns, rows = columns[:-1], tuple(row[:-1] for row in rows)
    caption = "Factors of the loci"
    if len(taken) < len(ordered):
        caption += (
            f": the {len(taken)} most frequent of {len(ordered)}; the others are in "
            "the JSON"
        )
    return Table(columns, rows, words(caption), "table:factors", long=True)
