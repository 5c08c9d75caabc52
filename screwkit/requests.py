"""From the parameters of a command to what the child process is asked.

Texts stay texts here: names and values are looked up where the file is read.
"""

from __future__ import annotations

import csv
import sys
from math import isfinite
from typing import Any

import typer

DEBUG = "--debug"
_MOST = 2.0**32
"""Gigabytes beyond which a limit is none: no system counts further."""


def request_of(question: str, given: dict[str, Any], **options: Any) -> Any:
    """The request of a command from its parameters.

    Args:
        question: What is asked.
        given: ``locals()`` at the top of the command.
        options: Keyword arguments of the analysis; None is left out.
    """
    from screwkit.terminal import Request  # noqa: PLC0415
    from screwkit.worker import Job, usual_memory  # noqa: PLC0415

    memory, actuated = given["memory"], given["actuated"]
    for name in ("memory", "timeout"):
        if given[name] is not None and not isfinite(given[name]):
            raise typer.BadParameter(f"--{name} {given[name]} is no number of its unit")
    job = Job(
        question=question,
        case=given["case"],
        variant=given["variant"],
        set_values=settings("--set", given["set_values"]),
        at=settings("--at", given["at"]),
        actuated=None if actuated is None else freedoms_in("--actuated", actuated),
        options={name: value for name, value in options.items() if value is not None},
        memory=usual_memory() if memory is None else int(min(memory, _MOST) * 2**30),
    )
    return Request(
        job,
        given["as_json"],
        given["timeout"],
        given["quiet"],
        debug=DEBUG in sys.argv,
    )


def extras(
    add: bool, rank: int | None, within: list[str] | None, length: str | None = None
) -> dict[str, Any]:
    """What else is asked of schemes; details of a ranking are refused without one."""
    for option, given in (("--within", within), ("--length", length)):
        if rank is None and given:
            raise typer.BadParameter(
                f"{option} says how schemes are ranked; give --rank POSTURES with it"
            )
    return {
        "add": add or None,
        "rank": rank,
        "within": list(within) if within else None,
        "length": length,
    }


def refuse_beside_distance(
    distance: bool,
    length: str | None,
    within: list[str] | None,
    others: dict[str, Any],
) -> None:
    """Distances are an answer of their own, and only they have a measure.

    Args:
        distance: Whether they are asked for.
        length: How they are measured.
        within: Where they end.
        others: What goes with loci only, by option.

    Raises:
        typer.BadParameter: If options do not go together.
    """
    if not distance and length is not None:
        raise typer.BadParameter(
            "--length says how distances are measured; give --distance with it"
        )
    if not distance and within:
        raise typer.BadParameter(
            "--within says where distances end; give --distance with it"
        )
    beside = [option for option, given in others.items() if given]
    if distance and beside:
        raise typer.BadParameter(
            f"--distance is an answer of its own; ask without {', '.join(beside)}"
        )


def freedoms_or_none(option: str, text: str | None) -> list[str] | None:
    """`freedoms_in` of an option that may be left out."""
    return None if text is None else list(freedoms_in(option, text))


def settings(option: str, texts: list[str] | None) -> dict[str, str]:
    """Names and texts of values, in the order given."""
    found = {}
    for text in texts or ():
        name, sign, value = text.partition("=")
        if not sign or not name.strip() or not value.strip():
            raise typer.BadParameter(f"{option} {text!r} is not NAME=VALUE")
        if name.strip() in found:
            raise typer.BadParameter(f"{option} gives {name.strip()!r} two values")
        found[name.strip()] = value.strip()
    return found


def names_in(text: str) -> tuple[str, ...]:
    """Names or numbers parted by commas."""
    return tuple(name.strip() for name in text.split(",") if name.strip())


def freedoms_in(option: str, text: str) -> tuple[str, ...]:
    """Freedoms parted by commas, each once; one with a comma stands in quotes.

    Raises:
        typer.BadParameter: If a name is empty or stands twice.
    """
    try:
        (row,) = csv.reader([text], skipinitialspace=True, strict=True)
    except csv.Error:
        raise typer.BadParameter(
            f"{option} {text!r}: freedoms are parted by commas, and one with a comma "
            f'in its name stands in quotes, "a,b"'
        ) from None
    names = tuple(name.strip() for name in row or [""])
    for position, name in enumerate(names):
        if not name:
            raise typer.BadParameter(
                f"{option} {text!r} has an empty name; write freedoms parted by "
                f"commas, {option} 1,2,3"
            )
        if name in names[:position]:
            raise typer.BadParameter(f"{option} {text!r} names {name!r} twice")
    return names
