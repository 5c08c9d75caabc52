"""The command that checks certificates."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import typer

from screwkit.commands import answer, app
from screwkit.options import AsJson, Memory, Quiet, Timeout
from screwkit.requests import request_of


@app.command()
def verify(
    certificate: Annotated[
        str, typer.Argument(metavar="CERTIFICATE", help="A certificate's file.")
    ],
    case: Annotated[
        str | None,
        typer.Argument(metavar="[CASE]", help="The mechanism it must be about."),
    ] = None,
    *,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Check a certificate again, from the mechanism alone.

    Example: screwkit verify nao.json nao_t14
    """
    given = dict.fromkeys(("variant", "set_values", "at", "actuated")) | {
        "case": "",
        "memory": memory,
        "timeout": timeout,
        "as_json": as_json,
        "quiet": quiet,
    }
    request = request_of("verify", given, certificate=certificate, case=case)
    job = replace(request.job, target="screwkit.verification:verify")
    answer(replace(request, job=job))
