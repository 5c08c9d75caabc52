"""The commands: arguments to a request, nothing more.

Everything heavy is imported inside the commands, and the exact work runs in a child
process, so that ``screwkit --help`` answers at once and no computation is beyond the
reach of Ctrl-C.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

from screwkit import errors
from screwkit.options import (
    Actuated,
    AsJson,
    At,
    Best,
    Body,
    CaseName,
    Every,
    Format,
    Memory,
    Order,
    Quiet,
    RelativeTo,
    Setting,
    Timeout,
    Variant,
    Which,
)
from screwkit.requests import DEBUG, names_in, request_of

_EXAMPLE = """Mobility, singularities and actuation of mechanisms, derived exactly.

\b
  $ screwkit mobility nao_t14
  $ screwkit singularities arm.yaml --actuated 1,2,3,7
  $ screwkit schemes nao_t14 --balanced
  $ screwkit report nao_t14 --format pdf -o report.pdf

CASE is a mechanism file (YAML or JSON) or the name of a bundled case: see
`screwkit cases`. Exit codes: 0 done; 1 the answer is negative or undecided; 2 usage;
3 the file is wrong; 4 out of time; 5 a needed tool is missing; 130 interrupted.
`--debug` anywhere shows tracebacks.
"""

app = typer.Typer(
    rich_markup_mode=None,
    add_completion=False,
    pretty_exceptions_enable=False,
    no_args_is_help=True,
    help=_EXAMPLE,
)


def _answer(request: Any) -> NoReturn:
    from screwkit.terminal import ask  # noqa: PLC0415

    raise typer.Exit(ask(request))


@app.command()
def check(
    case: CaseName,
    *,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Is the file right: all errors, or a one-line summary.

    Example: screwkit check arm.yaml
    """
    from screwkit.catalogue import check_case  # noqa: PLC0415

    # The same options as everywhere; reading a file needs no deadline.
    job = request_of("check", {**locals(), "memory": None}).job
    changes = {
        "set_values": job.set_values,
        "actuated": job.actuated,
        "variant": job.variant,
        "at": job.at,
    }
    raise typer.Exit(check_case(job.case, changes, as_json=as_json, quiet=quiet))


@app.command()
def mobility(
    case: CaseName,
    *,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Freedoms, counted every way, with why the counts differ.

    Example: screwkit mobility bennett
    """
    _answer(request_of("mobility", locals()))


@app.command()
def screws(
    case: CaseName,
    *,
    order: Annotated[
        Order, typer.Option(help="linear prints (v; ω) and (m; f).")
    ] = Order.DIRECTION,
    body: Body = None,
    relative_to: RelativeTo = None,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Twist and wrench systems of limbs and platform, actuation wrenches.

    With --body those of any body relative to any other.

    Example: screwkit screws nao_t14 --order linear
    """
    given = locals()
    if body is not None or relative_to is not None:
        options = {"body": body or "", "relative_to": relative_to or ""}
        options["order"] = "linear" if order is Order.LINEAR else "angular"
        _answer(request_of("relative_motion", given, **options))
    request = request_of("screws", given)
    if order is Order.LINEAR:
        from dataclasses import replace  # noqa: PLC0415

        from screwkit.reports.verdict import in_linear_order  # noqa: PLC0415

        request = replace(request, change=in_linear_order)
    _answer(request)


@app.command()
def singularities(
    case: CaseName,
    *,
    every: Every = False,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Limb, constraint and actuation singularities in closed form.

    Example: screwkit singularities nao_t14 --actuated 1,2,3,7
    """
    request = request_of("singularities", locals())
    if every:
        from dataclasses import replace  # noqa: PLC0415

        from screwkit.delivery import show_all  # noqa: PLC0415

        request = replace(request, show=show_all)
    _answer(request)


@app.command()
def schemes(
    case: CaseName,
    *,
    size: Annotated[
        int | None, typer.Option(min=0, help="Actuated freedoms in a scheme.")
    ] = None,
    candidates: Annotated[
        str | None, typer.Option(metavar="1,2,3", help="Freedoms to choose from.")
    ] = None,
    balanced: Annotated[
        bool, typer.Option("--balanced", help="Same number from every limb.")
    ] = False,
    every: Every = False,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="Write .tex, .csv, .json or .txt."),
    ] = None,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Every choice of actuated joints, admissible or not and why, with its locus.

    Example: screwkit schemes nao_t14 --size 5 --candidates 1,2,3,6,7,8 --all
    """
    request = request_of(
        "schemes",
        locals(),
        size=size,
        candidates=None if candidates is None else list(names_in(candidates)),
    )
    from dataclasses import replace  # noqa: PLC0415

    from screwkit import delivery  # noqa: PLC0415

    _answer(
        replace(
            request,
            change=delivery.only_balanced if balanced else None,
            show=delivery.show_all if every else None,
            deliver=None if output is None else delivery.deliver_schemes(output),
        )
    )


@app.command()
def manipulability(
    case: CaseName,
    *,
    length: Annotated[
        str | None,
        typer.Option(
            metavar="L", help="A length that counts as one radian, without weights."
        ),
    ] = None,
    draw: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="A picture too: .pdf, .svg or .png."),
    ] = None,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Who moves with whom, and how fast, strong and accurate the platform is.

    Example: screwkit manipulability five_bar --actuated A,E
    """
    request = request_of("manipulability", locals(), length=length)
    if draw is not None:
        from dataclasses import replace  # noqa: PLC0415

        from screwkit.delivery import deliver_picture  # noqa: PLC0415

        request = replace(request, beside=deliver_picture(draw))
    _answer(request)


@app.command()
def sweep(
    case: CaseName,
    *,
    vary: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=A:B:COUNT", help="A range of a symbol; repeatable."),
    ] = None,
    index: Annotated[
        str,
        typer.Option(
            help="kinematic or force with .min .max .condition .product .misfit; "
            "locus; sigma_min."
        ),
    ] = "kinematic.min",
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="Write .csv, .npz or a .pdf map."),
    ] = None,
    samples: Annotated[
        int | None, typer.Option(min=1, help="So many points of the box, no grid.")
    ] = None,
    best: Annotated[
        Best | None, typer.Option(help="Refine the least or the greatest value.")
    ] = None,
    workers: Annotated[
        int | None, typer.Option(min=1, help="Processes on this machine.")
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Of a Dask cluster.")
    ] = None,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    at: At = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """An index over a grid or samples of symbols and joint variables.

    Example: screwkit sweep stewart_alpha_beta --vary alpha=-pi:pi:61
    --vary beta=-pi:pi:61 --index kinematic.misfit --best least
    """
    _answer(
        request_of(
            "sweep",
            locals(),
            vary=list(vary or ()),
            index=index,
            output=None if output is None else str(output),
            samples=samples,
            best=None if best is None else best.value,
            workers=workers,
            scheduler=scheduler,
        )
    )


@app.command()
def analyze(
    case: CaseName,
    *,
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
    _answer(request_of("analyze", locals()))


@app.command()
def report(
    case: CaseName,
    *,
    form: Annotated[
        Format, typer.Option("--format", help="What to write.")
    ] = Format.LATEX,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="File or folder.")
    ] = None,
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
    request = request_of("analyze", locals())
    from dataclasses import replace  # noqa: PLC0415

    from screwkit.delivery import deliver_report  # noqa: PLC0415

    _answer(replace(request, deliver=deliver_report(form.value, output)))


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


def main(arguments: list[str] | None = None) -> NoReturn:
    """Run the command line and leave with its exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    sys.exit(_run([word for word in words if word != DEBUG], debug=DEBUG in words))


def _run(words: list[str], *, debug: bool) -> int:
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
        return _failed(words, error.format_message(), "usage", errors.EXIT_USAGE)
    except (KeyboardInterrupt, typer.Abort):
        return _failed(words, "interrupted", "interrupted", errors.EXIT_INTERRUPTED)
    except errors.MissingToolError as error:
        return _failed(words, str(error), "tool", errors.EXIT_TOOL)
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
    if "--json" in words:
        emit_json("", {"error": {"kind": kind, "message": message}})
    return code


if __name__ == "__main__":
    main()
