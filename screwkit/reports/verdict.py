"""What an answer means to a script: decided and positive, or not; and its parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from screwkit.reports.about_screws import LINEAR
from screwkit.results.analysis import Analysis, Description
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Schemes
from screwkit.results.screws import IdentifiedScrew, LimbScrews, PlatformScrews, Screws
from screwkit.results.singularities import Singularities
from screwkit.results.undecided import Undecided
from screwkit.results.verification import Verification
from screwkit.results.view import View


def is_plain_yes(result: Any) -> bool:
    """Whether nothing in the answer is undecided or negative.

    Negative are a declared scheme that is not admissible, a size without an admissible
    scheme, and a claim said to hold that does not.
    """
    match result:
        case Undecided():
            return False
        case Mobility():
            moved = result.at_posture
            reached = moved is None or (moved.closed and not moved.reason)
            return result.full_cycle.status != "undecided" and reached
        case Singularities():
            locked = result.actuation
            fine = locked is None or (locked.admissible and locked.complete)
            limbs = all(limb.complete for limb in result.limb)
            met = result.strata is None or result.strata.complete
            return fine and limbs and result.constraint.complete and met
        case Verification():
            return result.accepted
        case Screws():
            return all(screw.coordinates for screw in _screws_of(result))
        case View():
            return not result.undecided
        case Schemes():
            return result.complete and (result.admissible > 0 or result.total == 0)
        case Analysis():
            answers = (
                result.mobility,
                result.screws,
                result.singularities,
                result.schemes,
                result.manipulability,
                result.distance,
            )
            broken = any(
                claim.holds and claim.agrees is False for claim in result.claims
            )
            return not broken and all(map(is_plain_yes, answers))
        case _:
            return True


def _screws_of(answer: Screws) -> list[IdentifiedScrew]:
    """Every screw of an answer; those too long to be written have no coordinates."""
    systems: list[LimbScrews | PlatformScrews] = [*answer.limbs, answer.platform]
    added = [w.screw for w in answer.actuation_wrenches if w.screw is not None]
    return [s for x in systems for s in (*x.twists, *x.wrenches)] + added


def partial_analysis(parts: Sequence[tuple[str, Any]], reason: str) -> Analysis | None:
    """The finished parts of `analyze` with the rest undecided.

    None while not even the description of the mechanism is there.
    """
    done = dict(parts)
    description = done.get("description")
    if not isinstance(description, Description):
        return None
    open_question = Undecided(reason)
    return Analysis(
        case=description.case,
        title=description.title,
        description=description,
        mobility=done.get("mobility", open_question),
        screws=done.get("screws", open_question),
        singularities=done.get("singularities", open_question),
        schemes=done.get("schemes", open_question),
        manipulability=done.get("manipulability", open_question),
        distance=done.get("distance"),
    )


def in_linear_order(answer: Screws) -> Screws:
    """The same screws as (v; ω) and (m; f)."""
    if answer.order == LINEAR:
        return answer

    def twists(screws: tuple[IdentifiedScrew, ...]) -> tuple[IdentifiedScrew, ...]:
        return tuple(_swapped(screw, wrench=False) for screw in screws)

    def wrenches(screws: tuple[IdentifiedScrew, ...]) -> tuple[IdentifiedScrew, ...]:
        return tuple(_swapped(screw, wrench=True) for screw in screws)

    return replace(
        answer,
        order=LINEAR,
        limbs=tuple(
            replace(limb, twists=twists(limb.twists), wrenches=wrenches(limb.wrenches))
            for limb in answer.limbs
        ),
        platform=replace(
            answer.platform,
            twists=twists(answer.platform.twists),
            wrenches=wrenches(answer.platform.wrenches),
        ),
        actuation_wrenches=tuple(
            replace(
                entry,
                screw=None
                if entry.screw is None
                else _swapped(entry.screw, wrench=True),
            )
            for entry in answer.actuation_wrenches
        ),
    )


def _swapped(screw: IdentifiedScrew, *, wrench: bool) -> IdentifiedScrew:
    planar = 2 if wrench else 1
    half = planar if len(screw.coordinates) == 3 else len(screw.coordinates) // 2
    return replace(
        screw, coordinates=screw.coordinates[half:] + screw.coordinates[:half]
    )
