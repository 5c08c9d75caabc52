"""The commands: arguments to a request, nothing more.

Everything heavy is imported inside the commands, so that ``screwkit --help`` answers
at once.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, NoReturn

import typer

from screwkit.options import (
    Actuated,
    Add,
    AsJson,
    At,
    Balanced,
    Body,
    Candidates,
    CaseName,
    CertificateFile,
    Distant,
    Draw,
    Every,
    Index,
    Length,
    Limits,
    MapFile,
    Memory,
    Order,
    Point,
    Quiet,
    Rank,
    Refined,
    RelativeTo,
    Samples,
    Scheduler,
    SchemesFile,
    ScrewOrder,
    Setting,
    Size,
    Slice,
    SlicePicture,
    Strata,
    Timeout,
    Turn,
    Variant,
    Vary,
    Within,
    Work,
    Workers,
)
from screwkit.requests import (
    extras,
    freedoms_or_none,
    names_in,
    refuse_beside_distance,
    request_of,
    settings,
)

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


def answer(request: Any) -> NoReturn:
    """Ask, show, and leave with the exit code."""
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
    answer(request_of("mobility", locals()))


@app.command()
def screws(
    case: CaseName,
    *,
    order: ScrewOrder = Order.DIRECTION,
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
        answer(request_of("relative_motion", given, **options))
    request = request_of("screws", given)
    if order is Order.LINEAR:
        from screwkit.reports.verdict import in_linear_order  # noqa: PLC0415

        request = replace(request, change=in_linear_order)
    answer(request)


@app.command()
def singularities(
    case: CaseName,
    *,
    every: Every = False,
    certificate: CertificateFile = None,
    slices: Slice = None,
    output: SlicePicture = None,
    distance: Distant = False,
    length: Length = None,
    within: Limits = None,
    strata: Strata = None,
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

    With --slice twice those where two symbols vary and all others have their values,
    with a picture of the curves. With --distance the nearest of each kind along the
    motion, from the posture of the file or of --at; a length counts as many radians as
    --length goes into it, and what lies beyond limits, --within, does not count: of
    symbols, or of freedoms, which count from the posture.

    Example: screwkit singularities nao_t14 --actuated 1,2,3,7

    Example: screwkit singularities 3rpr_planar --slice x=-4:8 --slice y=-4:8
    -o slice.pdf

    Example: screwkit singularities nao_t14 --distance --at q4=0.3 --at q9=1

    Example: screwkit singularities 3rpr_planar --distance --within phi=0:1

    Example: screwkit singularities nao_t14 --strata 2
    """
    others = {"--certificate": certificate, "--slice": slices, "-o": output}
    refuse_beside_distance(
        distance, length, within, {**others, "--all": every, "--strata": strata}
    )
    if distance:
        limits = list(within) if within else None
        answer(request_of("distance", locals(), length=length, within=limits))
    if strata is not None and slices:
        raise typer.BadParameter("--strata is of the whole loci, not of a slice")
    if certificate is not None and slices:
        raise typer.BadParameter("--certificate is of the whole loci, not of a slice")
    request = request_of(
        "singularities",
        locals(),
        slices=list(slices) if slices else None,
        output=None if output is None else str(output),
        certificate=None if certificate is None else True,
        strata=strata,
    )
    if certificate is not None:
        from screwkit.delivery import written_certificate  # noqa: PLC0415

        request = replace(request, change=written_certificate(certificate))
    if every:
        from screwkit.delivery import show_all  # noqa: PLC0415

        request = replace(request, show=show_all)
    answer(request)


@app.command()
def schemes(
    case: CaseName,
    *,
    size: Size = None,
    candidates: Candidates = None,
    balanced: Balanced = False,
    work: Work = None,
    rank: Rank = None,
    within: Within = None,
    length: Length = None,
    add: Add = False,
    every: Every = False,
    certificate: CertificateFile = None,
    output: SchemesFile = None,
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
        work=work,
        candidates=freedoms_or_none("--candidates", candidates),
        certificate=None if certificate is None else True,
        **extras(add, rank, within, length),
    )
    from screwkit import delivery  # noqa: PLC0415

    answer(
        replace(
            request,
            change=delivery.changed_schemes(certificate, balanced=balanced),
            show=delivery.show_all if every else None,
            deliver=None if output is None else delivery.deliver_schemes(output),
        )
    )


@app.command()
def manipulability(
    case: CaseName,
    *,
    length: Length = None,
    draw: Draw = None,
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
    answer(_drawn(request, draw))


@app.command()
def reach(
    case: CaseName,
    *,
    point: Point = None,
    turn: Turn = None,
    length: Length = None,
    draw: Draw = None,
    variant: Variant = None,
    set_values: Setting = None,
    actuated: Actuated = None,
    timeout: Timeout = None,
    memory: Memory = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Configurations in which the platform is where it is wanted, and their indices.

    Example: screwkit reach dual_planar_3r --point 1.2,1.4 --turn a3=0.3 --turn b3=-0.1
    """
    at = None  # the place says where the mechanism is moved
    request = request_of(
        "reach",
        locals(),
        point=None if point is None else list(names_in(point)),
        turned={
            name: list(names_in(t)) for name, t in settings("--turn", turn).items()
        },
        length=length,
    )
    answer(_drawn(request, draw))


def _drawn(request: Any, draw: Path | None) -> Any:
    """The request, with a picture beside its answer."""
    if draw is None:
        return request
    from screwkit.delivery import deliver_picture  # noqa: PLC0415

    return replace(request, beside=deliver_picture(draw))


@app.command()
def sweep(
    case: CaseName,
    *,
    vary: Vary = None,
    index: Index = "kinematic.min",
    output: MapFile = None,
    samples: Samples = None,
    best: Refined = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
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
    answer(
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
