"""The program: what is bundled and installed, exit codes and last words.

The exact work runs in a child process, so that no computation is beyond the reach of
Ctrl-C.
"""

from __future__ import annotations

import os
import sys
from typing import Annotated

import typer

from screwkit import (  # noqa: F401 -- two modules register their commands
    __version__,
    errors,
    page_commands,
    verify_command,
)
from screwkit.commands import app
from screwkit.options import AsJson, Which
from screwkit.requests import DEBUG


def _told_version(asked: bool) -> None:
    if asked:
        typer.echo(f"screwkit {__version__}")
        raise typer.Exit


@app.callback()
def program(
    *,
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_told_version, is_eager=True, help="Its version."
        ),
    ] = False,
) -> None:
    """What holds for the program as a whole."""


@app.command()
def cases(*, as_json: AsJson = False) -> None:
    """The bundled cases."""
    from screwkit.catalogue import list_cases  # noqa: PLC0415

    raise typer.Exit(list_cases(as_json=as_json))


@app.command()
def schema(
    which: Annotated[Which, typer.Argument(help="Whose schema.")] = Which.BOTH,
    *,
    as_json: AsJson = True,
) -> None:
    """JSON Schemas of mechanism files and of results."""
    from screwkit.catalogue import print_schema  # noqa: PLC0415

    raise typer.Exit(print_schema(which.value))


@app.command()
def doctor(*, as_json: AsJson = False) -> None:
    """What is installed, and what is missing for what."""
    from screwkit.doctor import examine  # noqa: PLC0415

    raise typer.Exit(examine(as_json=as_json))


def run(words: list[str]) -> int:
    """Run the command line; the exit code."""
    return _run([word for word in words if word != DEBUG], debug=DEBUG in words)


def _run(words: list[str], *, debug: bool) -> int:
    if sys.stderr is None:  # closed before the start: what is told goes nowhere
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
    if sys.stdout is None:
        sys.stderr.write("screwkit: cannot write to standard output: it is closed\n")
        return errors.EXIT_USAGE
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    click = sys.modules[typer.BadParameter.__module__]
    try:
        code = app(words, prog_name="screwkit", standalone_mode=False)
        return int(code or 0)
    except click.ClickException as error:  # type: ignore[attr-defined, unused-ignore]
        if type(error).__name__ == "NoArgsIsHelpError":
            error.show()
            return errors.EXIT_USAGE
        message = error.format_message().replace("Value error, ", "")
        return _failed(words, message, "usage", errors.EXIT_USAGE)
    except (KeyboardInterrupt, typer.Abort):
        return _failed(words, "interrupted", "interrupted", errors.EXIT_INTERRUPTED)
    except errors.MissingToolError as error:
        return _failed(words, str(error), "tool", errors.EXIT_TOOL)
    except errors.OutputError as error:
        return _failed(words, str(error), "output", errors.EXIT_USAGE)
    except (OSError, errors.ScrewkitError) as error:
        if debug:
            raise
        return _failed(words, str(error), "usage", errors.EXIT_USAGE)
    except Exception as error:
        if debug:
            raise
        message = f"internal error: {type(error).__name__}: {error} (--debug)"
        return _failed(words, message, "defect", errors.EXIT_NEGATIVE)


def _failed(words: list[str], message: str, kind: str, code: int) -> int:
    from screwkit.terminal import emit_json, note  # noqa: PLC0415

    note(f"screwkit: {' '.join(message.split())}")
    if "--json" in words and kind != "output":
        emit_json("", {"error": {"kind": kind, "message": message}})
    return code
