"""The questions whose answers are measured: indices, configurations, maps.

Thin on purpose: each passes the mechanism to the analysis that answers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from screwkit.algebra.expression import Expression
from screwkit.case import Case
from screwkit.errors import ExpressionError, ScrewkitError, UndecidedError
from screwkit.progress import Progress, silent
from screwkit.reports import showing  # noqa: F401 -- answers show themselves
from screwkit.results.manipulability import Manipulability
from screwkit.results.reach import Reach
from screwkit.results.sweep import Sweep
from screwkit.results.view import View

if TYPE_CHECKING:
    from screwkit.sweeps.answer import Map


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
        ExpressionError: If the length is no positive constant.
        MechanismFileError: If no limb holds the platform.
    """
    from screwkit.analyses import manipulability as analysis  # noqa: PLC0415

    _need_held(case)
    measure = measure_of(length)
    return analysis.manipulability(case.network, case.wanted, measure, progress)


def reach(
    case: Case,
    point: Sequence[float | str] = (),
    turned: Mapping[str, float | str | Sequence[float | str]] | None = None,
    length: str = "",
    progress: Progress = silent,
) -> Reach:
    """Configurations in which the platform stands where it is wanted, measured.

    Args:
        case: The mechanism; a number for each of its symbols.
        point: Where the reference point of the platform is wanted, in base
            coordinates: x, y and, unless the file is planar, z.  None leaves it free.
        turned: Links of given orientation: by which angle each is turned from the
            posture of the file, or by which rotation vector in base axes.
        length: As for `manipulability`.
        progress: Told about each stage.

    Raises:
        UnknownNameError: If a link is unknown.
        ExpressionError: If a number is none, or there are too many or too few.
        UndecidedError: If a symbol has no value, or no configuration is found.
        MechanismFileError: If no limb holds the platform.
    """
    from screwkit.analyses import reach as analysis  # noqa: PLC0415
    from screwkit.analyses.places import place_of, turns_of  # noqa: PLC0415

    _need_held(case)
    place = place_of(case.mechanism, point)
    turns = turns_of(case.mechanism, turned or {})
    return analysis.reach(case.network, place, turns, measure_of(length), progress)


def _need_held(case: Case) -> None:
    """Refuse a platform that is not held, and one that is the base itself."""
    base = case.mechanism.base
    if base == case.mechanism.platform:
        raise UndecidedError(
            f"base and platform are one body, {base!r}: it has no velocity and no "
            f"force of its own to be measured"
        )
    case.need_held_platform()


def measure_of(length: str) -> Expression | None:
    """The length that counts as one radian; None where none is given.

    Raises:
        ExpressionError: If it is no positive constant.
    """
    from screwkit.algebra.batch import BatchRing  # noqa: PLC0415
    from screwkit.algebra.evaluation import evaluate  # noqa: PLC0415
    from screwkit.algebra.parse import parse  # noqa: PLC0415

    if not length:
        return None
    try:
        measure = parse(str(length), ())
    except ExpressionError as error:
        raise ExpressionError(
            f"{length!r} is no length that counts as one radian: {error}; a number is "
            f"expected"
        ) from None
    if not float(evaluate(measure, BatchRing({}))) > 0:
        raise ExpressionError(
            f"a length that counts as one radian is positive, and {length} is not"
        )
    return measure


def view(case: Case, output: str | Path = "", progress: Progress = silent) -> View:
    """The mechanism at its posture, with the screws of its platform, as a picture.

    Args:
        case: The mechanism; a number for each of its symbols.
        output: Write one page with an interactive picture to this file, .html.
        progress: Told about each stage.

    Raises:
        UndecidedError: If a symbol has no value, or the posture is not reached.
        ScrewkitError: If the file has another ending.
        UnwritableError: If the file cannot be written.
    """
    from screwkit.analyses import view as analysis  # noqa: PLC0415
    from screwkit.reports.output import write  # noqa: PLC0415
    from screwkit.reports.view_page import ENDINGS, view_page  # noqa: PLC0415

    place = Path(output) if output else None
    if place is not None and place.suffix.lower() not in ENDINGS:
        raise ScrewkitError(f"{place}: a view is written as {' or '.join(ENDINGS)}")
    answer = analysis.view(case.network, case.wanted, progress)
    given = tuple(f"{name} = {value}" for name, value in case.given.values.items())
    answer = replace(answer, given=given)
    if place is None:
        return answer
    write(place, view_page(answer))
    return replace(answer, file=str(place))


def view_answer(case: Case, output: str = "", progress: Progress = silent) -> View:
    """`view`, written in any case: beside the case's own file if no place is given.

    The page of a bundled case goes to the current folder.

    Args:
        case: The mechanism.
        output: As for `view`.
        progress: Told about each stage.
    """
    own = None if case.is_bundled else case.path
    folder = Path() if own is None else own.parent
    return view(case, output or folder / f"{case.name}_view.html", progress)


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
        case.mechanism,
        vary,
        index,
        samples,
        best,
        kept,
        executor,
        progress,
        case.wanted,
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
