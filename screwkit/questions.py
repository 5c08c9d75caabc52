"""The questions a case can be asked, one function each.

Thin on purpose: each passes the case's assembly to the analysis that answers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from screwkit.case import Case
from screwkit.progress import Progress, silent
from screwkit.results.analysis import Analysis
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Schemes
from screwkit.results.screws import Screws
from screwkit.results.singularities import Singularities


def mobility(case: Case, progress: Progress = silent) -> Mobility:
    """How movable the mechanism is, by every count, and why they differ."""
    from screwkit.analyses import mobility as analysis  # noqa: PLC0415

    progress("mobility", f"{len(case.assembly.joints)} joints")
    return analysis.mobility(case.assembly)


def screws(case: Case, order: str = "angular", progress: Progress = silent) -> Screws:
    """Twist and wrench systems of limbs and platform, each screw identified.

    Args:
        case: The mechanism.
        order: ``angular``: (ω; v) and (f; m); ``linear``: (v; ω) and (m; f).
        progress: Told about each stage.
    """
    from screwkit.analyses import screws as analysis  # noqa: PLC0415

    return analysis.screws(case.assembly, order=order, progress=progress)


def singularities(case: Case, progress: Progress = silent) -> Singularities:
    """Limb, constraint and actuation singularities in closed form."""
    from screwkit.analyses import singularities as analysis  # noqa: PLC0415

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

    return analysis.schemes(case.assembly, size, candidates, balanced, progress)


def analyze(
    case: Case,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] | None = None,
) -> Analysis:
    """All questions; one that cannot be decided does not stop the others."""
    from screwkit.analyses import everything  # noqa: PLC0415

    return everything.analyze(case, progress, finished)
