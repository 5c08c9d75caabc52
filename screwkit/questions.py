"""The questions a case can be asked, one function each.

Thin on purpose: each passes the case's assembly to the analysis that answers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from screwkit.case import Case
from screwkit.errors import MechanismFileError, UndecidedError
from screwkit.metric_questions import manipulability, measure_of
from screwkit.progress import Progress, silent
from screwkit.reports import showing  # noqa: F401 -- answers show themselves
from screwkit.results.analysis import Analysis
from screwkit.results.distance import Distance
from screwkit.results.mobility import Mobility, MotionCase
from screwkit.results.schemes import Ranking, Schemes
from screwkit.results.screws import RelativeMotion, Screws
from screwkit.results.singularities import Singularities
from screwkit.results.undecided import Undecided

if TYPE_CHECKING:
    from screwkit.loci.platform_state import States


def mobility(
    case: Case,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
) -> Mobility:
    """How movable the mechanism is, by every count, and why they differ."""
    from screwkit.analyses import mobility as analysis  # noqa: PLC0415
    from screwkit.analyses import moved as moved_analysis  # noqa: PLC0415

    table = moved_analysis.closed_table(case.network)
    if table is not None:
        answer = moved_analysis.table_mobility(case.network, table)
    else:
        cases = _motion_cases(case)
        answer = analysis.mobility(case.network, cases, progress, finished)
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
    """Refuse postures that are known in numbers alone.

    Raises:
        UndecidedError: If loops tie the joint variables that were given, or the table
            is not closed at 0.
    """
    if case.wanted:
        raise UndecidedError(
            f"loops tie {', '.join(case.wanted)} to other joint variables, so that the "
            f"posture asked for is known in numbers alone, and nothing can be proved "
            f"there: mobility and manipulability answer at it; without --at this "
            f"question is answered for every posture that the file describes"
        )
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


def singularities(
    case: Case,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
    certificate: bool = False,
    slices: Sequence[str] = (),
    output: str | Path = "",
    strata: int = 0,
) -> Singularities:
    """Limb, constraint and actuation singularities in closed form.

    Args:
        case: The mechanism.
        progress: Told about each stage.
        finished: Given each part as soon as it is there, by name.
        certificate: Look for proofs, too, and write them down.
        slices: Two ranges, ``"x=-1:1"`` or ``"x=-1:1:201"``: the answer is about the
            slice in which these two symbols vary and all others have their values.
        output: Draw the curves of the slice, .pdf, .svg or .png.
        strata: Tell what happens where up to so many components meet; 0 does not.
            Of the whole loci; a slice has none.

    Raises:
        UndecidedError: If a symbol of a slice has no value.
        ExpressionError: If there are slices, but not two ranges.
        ScrewkitError: If a slice has no file, or a file no slice.
    """
    from screwkit.analyses import singularities as analysis  # noqa: PLC0415

    case.need_loci()
    if slices or output:
        from screwkit.sliced import sliced_singularities  # noqa: PLC0415

        return sliced_singularities(case, slices, Path(output), singularities)
    if case.network.tied and not case.wanted:
        from screwkit.analyses.tied_branch import tied_graph  # noqa: PLC0415
        from screwkit.analyses.tied_singularities import (  # noqa: PLC0415
            tied_singularities,
        )

        tied = tied_graph(case.network)
        closed = tied_singularities(tied, progress=progress, finished=finished)
        if strata:
            from screwkit.analyses.tied_strata import tied_strata  # noqa: PLC0415

            met = tied_strata(tied, closed, strata, progress)
            closed = replace(closed, strata=met)
        if certificate:
            from screwkit.verification import certified_answer  # noqa: PLC0415

            closed = certified_answer(case, closed, progress)
        return closed
    _need_exact_posture(case)
    if case.graph is not None:
        from screwkit.analyses.graph_singularities import (  # noqa: PLC0415
            graph_singularities,
        )

        answer = graph_singularities(case.graph, progress=progress, finished=finished)
    else:
        answer = analysis.singularities(
            case.assembly, progress=progress, finished=finished
        )
    answer = replace(answer, one_posture=not case.network.has_symbols)
    if strata:
        from screwkit.analyses.strata import strata as found  # noqa: PLC0415

        together = found(_states(case, answer), answer, strata, progress)
        answer = replace(answer, strata=together)
    if certificate:
        from screwkit.verification import certified_answer  # noqa: PLC0415

        answer = certified_answer(case, answer, progress)
    return answer


def _states(case: Case, answer: Singularities) -> States:
    """What the platform does at the postures of a case, with the scheme of an answer.

    Limbs with loops inside are seen as parts of the joint graph.
    """
    from screwkit.kinematics.whole_graph import WholeGraph  # noqa: PLC0415
    from screwkit.loci.graph_states import GraphStates  # noqa: PLC0415
    from screwkit.loci.platform_state import PlatformStates  # noqa: PLC0415

    scheme = None if answer.actuation is None else answer.actuation.actuated
    if case.graph is not None:
        return GraphStates(case.graph, scheme)
    if case.assembly.has_blocks:
        return GraphStates(WholeGraph(case.mechanism), scheme)
    return PlatformStates(case.assembly, scheme)


def distance(
    case: Case,
    length: str = "",
    progress: Progress = silent,
    within: Sequence[str] = (),
    finished: Callable[[str, Any], None] = lambda name, part: None,
) -> Distance:
    """How far the posture is from the nearest singularity of each kind.

    Args:
        case: The mechanism; a number for each of its symbols.
        length: A length that counts as one radian; a number or an expression of
            constants, the characteristic length by default.
        progress: Told about each stage.
        within: Limits of symbols that move the mechanism, ``"x=-0.1:0.1"`` each, or of
            freedoms, which count from the posture; what is outside does not count.
        finished: Given the answer so far after each singularity.

    Raises:
        UndecidedError: If a symbol has no value, the posture is not reached, or no
            joint moves.
        UnknownNameError: If a limit is of nothing that moves.
        ExpressionError: If the length is no positive constant, or a limit no range, or
            the posture outside the limits.
        MechanismFileError: If no limb holds the platform.
    """
    from screwkit.distances import distance_of  # noqa: PLC0415

    case.need_loci()
    return distance_of(case, measure_of(length), within, progress, finished)


def schemes(
    case: Case,
    size: int | None = None,
    candidates: Sequence[str] | None = None,
    balanced: bool = False,
    progress: Progress = silent,
    work: int | None = None,
    finished: Callable[[str, Any], None] = lambda name, part: None,
    rank: int = 0,
    within: Sequence[str] = (),
    length: str = "",
    add: bool = False,
    certificate: bool = False,
) -> Schemes:
    """Every actuation scheme of a size, admissible or why not.

    Args:
        case: The mechanism.
        size: Number of actuated freedoms; the platform's twist dimension by default.
        candidates: Joints that may be actuated; all by default.
        balanced: List only schemes with the same number from every limb.
        progress: Told about each stage.
        work: Terms of determinants to expand for all loci together; 1 000 000 by
            default.  What is left is undecided.
        finished: Given the answer without loci as soon as it is there.
        rank: Order the admissible schemes by their conditioning over so many closed
            postures; 0 does not.
        within: Ranges from which these are drawn, ``"x=-0.1:0.1"`` each; by default
            angles are drawn from the circle and lengths around their values.
        length: That counts as one radian in the ranking; the characteristic length by
            default.
        add: Find which added actuators remove which singularities of the declared
            scheme.
        certificate: Write down, for `verify`, which schemes hold the platform.

    Raises:
        UnknownNameError: If a candidate or a symbol is unknown.
        UndecidedError: If a certificate is asked for where loops tie joint variables.
        ExpressionError: If a range is none, or the length is no positive constant.
    """
    from screwkit.analyses import schemes as analysis  # noqa: PLC0415
    from screwkit.verification import need_free_joints, with_certificate  # noqa: PLC0415

    case.need_loci()
    graph = case.graph
    if certificate:
        need_free_joints(case)
    if case.network.tied and not case.wanted:
        from screwkit.analyses.tied_branch import tied_graph  # noqa: PLC0415

        graph = tied_graph(case.network)
    else:
        _need_exact_posture(case)
    asked = (
        size,
        candidates,
        balanced,
        progress,
        analysis.WORK if work is None else work,
        finished,
        _ranked(case, rank, within, length) if rank else None,
        add,
    )
    free = case.network.has_symbols
    if graph is not None:
        from screwkit.analyses.graph_schemes import graph_schemes  # noqa: PLC0415

        answer = graph_schemes(graph, *asked)
        free = free or bool(case.network.tied)
    else:
        answer = analysis.schemes(case.assembly, *asked)
    answer = replace(answer, one_posture=not free)
    return with_certificate(case, answer) if certificate else answer


def _ranked(
    case: Case, postures: int, within: Sequence[str], length: str
) -> Callable[[Sequence[tuple[str, ...]]], Ranking | Undecided]:
    """Orders schemes, or says why it cannot."""
    from screwkit.algebra.batch import BatchRing  # noqa: PLC0415
    from screwkit.algebra.evaluation import evaluate  # noqa: PLC0415
    from screwkit.analyses.ranking import ranking  # noqa: PLC0415

    measure = measure_of(length)
    value = None if measure is None else float(evaluate(measure, BatchRing({})))

    def ranked(schemes: Sequence[tuple[str, ...]]) -> Ranking | Undecided:
        try:
            return ranking(case.mechanism, schemes, postures, within, value)
        except UndecidedError as error:
            return Undecided(str(error))

    return ranked


def analyze(
    case: Case,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
    rank: int = 0,
    within: Sequence[str] = (),
    add: bool = False,
    strata: int = 0,
    distances: bool = False,
) -> Analysis:
    """All questions; one that cannot be decided does not stop the others.

    Args:
        case: The mechanism.
        progress: Told about each stage.
        finished: Given each part as soon as it is there, by name.
        rank: As for `schemes`, with ``within`` and ``add``.
        within: Ranges of symbols.
        add: Added actuators.
        strata: As for `singularities`.
        distances: Answer `distance` too.
    """
    from screwkit.claims import checked_claims  # noqa: PLC0415
    from screwkit.mechanism.description import description  # noqa: PLC0415
    from screwkit.reports.wire import part_to_json  # noqa: PLC0415

    about = description(case.mechanism)
    finished("description", about)
    answers: dict[str, Any] = {}
    asked: dict[str, Callable[..., Any]] = {
        "mobility": mobility,
        "screws": screws,
        "singularities": partial(singularities, strata=strata),
        "schemes": partial(schemes, rank=rank, within=within, add=add),
        "manipulability": manipulability,
    }
    if distances:
        asked["distance"] = partial(distance, finished=finished)
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
