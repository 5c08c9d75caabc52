"""The questions a case can be asked, one function each.

Thin on purpose: each passes the case's assembly to the analysis that answers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from screwkit.case import Case
from screwkit.errors import MechanismFileError, ScrewkitError, UndecidedError
from screwkit.progress import Progress, silent
from screwkit.results.analysis import Analysis
from screwkit.results.manipulability import Manipulability
from screwkit.results.mobility import Mobility, MotionCase
from screwkit.results.motion import MotionPath
from screwkit.results.schemes import Schemes
from screwkit.results.screws import RelativeMotion, Screws
from screwkit.results.singularities import Singularities
from screwkit.results.sweep import Sweep
from screwkit.results.undecided import Undecided

if TYPE_CHECKING:
    from screwkit.sweeps.answer import Map


def mobility(case: Case, progress: Progress = silent) -> Mobility:
    """How movable the mechanism is, by every count, and why they differ."""
    from screwkit.analyses import mobility as analysis  # noqa: PLC0415
    from screwkit.analyses import moved as moved_analysis  # noqa: PLC0415

    table = moved_analysis.closed_table(case.network)
    if table is not None:
        answer = moved_analysis.table_mobility(case.network, table)
    else:
        cases = _motion_cases(case)
        answer = analysis.mobility(case.network, cases, progress=progress)
    if case.wanted:
        progress("mobility", "moving the mechanism")
        start = None if table is None else table.values
        moved = moved_analysis.at_posture(case.network, case.wanted, start)
        answer = replace(answer, at_posture=moved)
    return answer


def _motion_cases(case: Case) -> Callable[[str], tuple[MotionCase, ...]] | None:
    """Where the motion type changes; None where limbs are no serial chains."""
    from screwkit.analyses.motion_type import motion_cases  # noqa: PLC0415

    try:
        assembly = case.assembly
    except UndecidedError:
        return None
    return partial(motion_cases, assembly)


def _need_exact_posture(case: Case) -> None:
    """Refuse tables that are closed only where numbers put them.

    Raises:
        UndecidedError: If the table is not closed at 0.
    """
    if case.mechanism.geometry != "mdh" or not case.network.tied:
        return
    from screwkit.analyses.moved import closed_table  # noqa: PLC0415

    if closed_table(case.network) is not None:
        raise UndecidedError(
            f"{case.network.tied}; the table is not closed at 0, and its closed "
            f"postures are known in numbers alone (`mobility` answers there)"
        )


def screws(case: Case, order: str = "angular", progress: Progress = silent) -> Screws:
    """Twist and wrench systems of limbs and platform, each screw identified.

    Args:
        case: The mechanism.
        order: ``angular``: (ω; v) and (f; m); ``linear``: (v; ω) and (m; f).
        progress: Told about each stage.
    """
    from screwkit.analyses import screws as analysis  # noqa: PLC0415

    _need_exact_posture(case)
    answer = analysis.screws(case.assembly, order=order, progress=progress)
    return replace(answer, generic=not case.assembly.at_numbers)


def relative_motion(
    case: Case, body: str = "", relative_to: str = "", order: str = "angular"
) -> RelativeMotion:
    """The twist system of any body relative to any other.

    Args:
        case: The mechanism.
        body: A link; the platform by default.
        relative_to: Another; the base by default.
        order: ``angular``: (ω; v); ``linear``: (v; ω).
    """
    from screwkit.analyses import relative as analysis  # noqa: PLC0415

    link = body or case.mechanism.platform
    _need_exact_posture(case)
    return analysis.relative_motion(case.network, link, relative_to, order)


def assemble(
    case: Case, guess: Mapping[str, float], fixed: Sequence[str] = ()
) -> MotionPath:
    """A closed posture near a guess; see `screwkit.finite.paths.assemble`."""
    from screwkit.finite import paths  # noqa: PLC0415

    return paths.assemble(case.network, guess, fixed)


def move(case: Case, to: Mapping[str, float]) -> MotionPath:
    """Move freedoms to given values; see `screwkit.finite.paths.move`."""
    from screwkit.finite import paths  # noqa: PLC0415

    return paths.move(case.network, to)


def follow(
    case: Case, heading: Mapping[str, float], steps: int = 40, stride: float = 0.1
) -> MotionPath:
    """Follow a motion along its branch; see `screwkit.finite.paths.follow`."""
    from screwkit.finite import paths  # noqa: PLC0415

    return paths.follow(case.network, heading, steps, stride)


def singularities(case: Case, progress: Progress = silent) -> Singularities:
    """Limb, constraint and actuation singularities in closed form."""
    from screwkit.analyses import singularities as analysis  # noqa: PLC0415

    _need_exact_posture(case)
    return analysis.singularities(case.assembly, progress=progress)


def schemes(
    case: Case,
    size: int | None = None,
    candidates: Sequence[str] | None = None,
    balanced: bool = False,
    progress: Progress = silent,
) -> Schemes:
    """Every actuation scheme of a size, admissible or why not."""
    from screwkit.analyses import schemes as analysis  # noqa: PLC0415

    _need_exact_posture(case)
    return analysis.schemes(case.assembly, size, candidates, balanced, progress)


def manipulability(
    case: Case, length: str = "", progress: Progress = silent
) -> Manipulability:
    """Who moves with whom, and how fast, strong and accurate the platform is.

    Args:
        case: The mechanism; a number for each of its symbols.
        length: A length that counts as one radian where the file gives no weights; a
            number or an expression of constants.
        progress: Told about each stage.

    Raises:
        UndecidedError: If a symbol has no value, or the posture is not reached.
        ExpressionError: If the length is no constant expression.
        MechanismFileError: If no limb holds the platform.
    """
    from screwkit.algebra.parse import parse  # noqa: PLC0415
    from screwkit.analyses import manipulability as analysis  # noqa: PLC0415
    from screwkit.mechanism.graph import holding_joints  # noqa: PLC0415

    mechanism = case.mechanism
    if not holding_joints(mechanism):
        raise case.refuse(
            ("platform",),
            f"no limb holds the platform {mechanism.platform!r}: connect it with the "
            f"base, or name another body as platform",
        )
    measure = parse(str(length), ()) if length else None
    return analysis.manipulability(case.network, case.wanted, measure, progress)


def sweep(
    case: Case,
    vary: Sequence[str],
    index: str = "kinematic.min",
    samples: int = 0,
    best: Literal["", "least", "greatest"] = "",
    output: str | Path = "",
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Map:
    """An index over ranges of symbols and joint variables.

    Args:
        case: The mechanism.
        vary: Ranges, ``"alpha=-pi:pi:181"`` each.
        index: ``kinematic`` or ``force`` with ``.min``, ``.max``, ``.condition``,
            ``.product`` or ``.misfit``; ``locus`` or ``sigma_min``.
        samples: Take so many evenly spread points of the box instead of the grid.
        best: Refine the ``least`` or the ``greatest`` value.
        output: Write all values to this file, .csv or .npz, or draw a map of one or
            two symbols, .pdf, .svg or .png.
        executor: Evaluates the chunks: any `concurrent.futures.Executor`, or one of
            Dask, ``Client(…).get_executor()``.
        progress: Told how far it is.

    Returns:
        The values as arrays, and the answer in numbers and words.

    Raises:
        UnknownNameError: If an index or a symbol is unknown.
        ExpressionError: If a range is none.
        UndecidedError: If the index has no finite values, or a symbol no value.
    """
    from screwkit.reports.figures import FORMS  # noqa: PLC0415
    from screwkit.sweeps.answer import sweep_map  # noqa: PLC0415

    place = Path(output) if output else None
    drawn = place is not None and place.suffix in FORMS
    kept = None if drawn else place
    found = sweep_map(
        case.mechanism, vary, index, samples, best, kept, executor, progress
    )
    if place is None or not drawn:
        return found
    from screwkit.reports.draw_map import map_picture  # noqa: PLC0415
    from screwkit.reports.output import write  # noqa: PLC0415

    answer = found.answer
    if samples:
        raise ScrewkitError("samples are no grid; write .npz or .csv")
    content = map_picture(
        answer.vary,
        [found.axes[name].tolist() for name in answer.vary],
        found.values.tolist(),
        index,
        FORMS[place.suffix],
        () if answer.best is None else answer.best.values,
    )
    write(place, content)
    return replace(found, answer=replace(answer, file=str(place)))


def sweep_answer(
    case: Case,
    vary: Sequence[str],
    index: str = "kinematic.min",
    samples: int = 0,
    best: Literal["", "least", "greatest"] = "",
    output: str = "",
    workers: int = 0,
    scheduler: str = "",
    progress: Progress = silent,
) -> Sweep:
    """`sweep` on worker processes, or on a Dask cluster; without the arrays.

    Args:
        case: The mechanism.
        vary: As for `sweep`, with ``index``, ``samples``, ``best`` and ``output``.
        index: What is evaluated.
        samples: Points of the box instead of a grid.
        best: Which value is refined.
        output: A file for all values.
        workers: Processes on this machine; 0 for this one.
        scheduler: Address of a Dask scheduler; empty for none.
        progress: Told how far it is.

    Raises:
        MissingToolError: If Dask is asked for and not installed.
    """
    from screwkit.sweeps.executors import executor_of  # noqa: PLC0415

    with executor_of(workers, scheduler) as executor:
        found = sweep(case, vary, index, samples, best, output, executor, progress)
    return found.answer


def analyze(
    case: Case,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
) -> Analysis:
    """All questions; one that cannot be decided does not stop the others.

    Args:
        case: The mechanism.
        progress: Told about each stage.
        finished: Given each part as soon as it is there, by name.
    """
    from screwkit.claims import checked_claims  # noqa: PLC0415
    from screwkit.mechanism.description import description  # noqa: PLC0415
    from screwkit.reports.records import part_to_json  # noqa: PLC0415

    about = description(case.mechanism)
    finished("description", about)
    answers: dict[str, Any] = {}
    asked: dict[str, Callable[..., Any]] = {
        "mobility": mobility,
        "screws": screws,
        "singularities": singularities,
        "schemes": schemes,
        "manipulability": manipulability,
    }
    for name, question in asked.items():
        try:
            answers[name] = question(case, progress=progress)
        except UndecidedError as error:
            answers[name] = Undecided(str(error))
        except MechanismFileError as error:
            answers[name] = Undecided("; ".join(f.message for f in error.faults))
        finished(name, answers[name])
    documents = {
        name: part_to_json(answer)["value"] for name, answer in answers.items()
    }
    return Analysis(
        case=case.name,
        title=case.mechanism.title,
        description=about,
        claims=checked_claims(case.claims, documents),
        **answers,
    )
