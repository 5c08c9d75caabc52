"""From the parameters of a command to what the child process is asked.

Texts stay texts here: names and values are looked up where the file is read.
"""

from __future__ import annotations

import sys
from typing import Any

import typer

DEBUG = "--debug"


def request_of(question: str, given: dict[str, Any], **options: Any) -> Any:
    """The request of a command from its parameters.

    Args:
        question: What is asked.
        given: ``locals()`` at the top of the command.
        options: Keyword arguments of the analysis; None is left out.
    """
    from screwkit.terminal import Request  # noqa: PLC0415
    from screwkit.worker import Job  # noqa: PLC0415

    memory, actuated = given["memory"], given["actuated"]
    job = Job(
        question=question,
        case=given["case"],
        variant=given["variant"],
        set_values=settings("--set", given["set_values"]),
        at=settings("--at", given["at"]),
        actuated=None if actuated is None else names_in(actuated),
        options={name: value for name, value in options.items() if value is not None},
        memory=None if memory is None else int(memory * 2**30),
    )
    return Request(
        job,
        given["as_json"],
        given["timeout"],
        given["quiet"],
        debug=DEBUG in sys.argv,
    )


def settings(option: str, texts: list[str] | None) -> dict[str, str]:
    """Names and texts of values, in the order given."""
    found = {}
    for text in texts or ():
        name, sign, value = text.partition("=")
        if not sign or not name.strip() or not value.strip():
            raise typer.BadParameter(f"{option} {text!r} is not NAME=VALUE")
        found[name.strip()] = value.strip()
    return found


def names_in(text: str) -> tuple[str, ...]:
    """Names parted by commas."""
    return tuple(name.strip() for name in text.split(",") if name.strip())
