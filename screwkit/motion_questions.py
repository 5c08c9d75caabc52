"""The questions whose answers are motions: assemble, move, follow.

Thin on purpose: each passes the mechanism to the closure solver.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from screwkit.case import Case
from screwkit.reports import showing  # noqa: F401 -- answers show themselves
from screwkit.results.motion import MotionPath


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
