"""The commands about the whole mechanism: all answers, a report, a 3-D picture."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from screwkit.commands import answer, app
from screwkit.options import (
    Actuated,
    Add,
    AsJson,
    At,
    CaseName,
    Distant,
    Form,
    Format,
    Memory,
    Open,
    Quiet,
    Rank,
    ReportPlace,
    Setting,
    Strata,
    Timeout,
    Variant,
    Within,
)
from screwkit.requests import extras, request_of


@app.command()
def analyze(
    case: CaseName,
    *,
    add: Add = False,
    rank: Rank = None,
    within: Within = None,
    strata: Strata = None,
    distance: Distant = False,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """All of it, and the claims of the case beside what holds.

    Example: screwkit analyze nao_t14 --json
    """
    options = {**extras(add, rank, within), "distances": distance or None}
    answer(request_of("analyze", locals(), strata=strata, **options))


@app.command()
def view(
    case: CaseName,
    *,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            help="Where the page goes, .html; NAME_view.html beside the file of the "
            "case if not given, in the current folder for a bundled case.",
        ),
    ] = None,
    opened: Open = False,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """An interactive 3-D picture with the screws of the platform: one HTML page.

    It needs no network.

    Example: screwkit view 3rps -o 3rps.html --at z=2
    """
    place = None if output is None else str(output)
    request = request_of("view", locals(), output=place)
    if opened:
        from screwkit.delivery import open_page  # noqa: PLC0415

        request = replace(request, beside=open_page)
    answer(request)


@app.command()
def report(
    case: CaseName,
    *,
    form: Form = Format.LATEX,
    output: ReportPlace = None,
    add: Add = False,
    rank: Rank = None,
    within: Within = None,
    strata: Strata = None,
    distance: Distant = False,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """An article with everything: LaTeX with fragments and JSON, PDF or HTML.

    Example: screwkit report nao_t14 --format pdf -o report.pdf
    """
    options = {**extras(add, rank, within), "distances": distance or None}
    request = request_of("analyze", locals(), strata=strata, **options)
    from screwkit.delivery import deliver_report  # noqa: PLC0415

    answer(replace(request, deliver=deliver_report(form.value, output)))
