"""Symbolic screw theory: mobility, singularities and actuation, derived exactly."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from screwkit.case import Case as Case
    from screwkit.case import bundled_cases as bundled_cases
    from screwkit.case import load as load
    from screwkit.errors import ExpressionError as ExpressionError
    from screwkit.errors import FrameMismatchError as FrameMismatchError
    from screwkit.errors import MechanismFileError as MechanismFileError
    from screwkit.errors import MissingToolError as MissingToolError
    from screwkit.errors import ScrewkitError as ScrewkitError
    from screwkit.errors import TooLargeError as TooLargeError
    from screwkit.errors import UndecidedError as UndecidedError
    from screwkit.errors import UnfitValueError as UnfitValueError
    from screwkit.errors import UnknownCaseError as UnknownCaseError
    from screwkit.errors import UnknownNameError as UnknownNameError
    from screwkit.errors import UnwritableError as UnwritableError
    from screwkit.metric_questions import manipulability as manipulability
    from screwkit.metric_questions import reach as reach
    from screwkit.metric_questions import sweep as sweep
    from screwkit.metric_questions import view as view
    from screwkit.motion_questions import assemble as assemble
    from screwkit.motion_questions import follow as follow
    from screwkit.motion_questions import move as move
    from screwkit.questions import analyze as analyze
    from screwkit.questions import distance as distance
    from screwkit.questions import mobility as mobility
    from screwkit.questions import relative_motion as relative_motion
    from screwkit.questions import schemes as schemes
    from screwkit.questions import screws as screws
    from screwkit.questions import singularities as singularities

__version__ = "0.1.0"

_HOMES = {
    "Case": "screwkit.case",
    "ExpressionError": "screwkit.errors",
    "FrameMismatchError": "screwkit.errors",
    "MechanismFileError": "screwkit.errors",
    "MissingToolError": "screwkit.errors",
    "ScrewkitError": "screwkit.errors",
    "TooLargeError": "screwkit.errors",
    "UndecidedError": "screwkit.errors",
    "UnfitValueError": "screwkit.errors",
    "UnknownCaseError": "screwkit.errors",
    "UnknownNameError": "screwkit.errors",
    "UnwritableError": "screwkit.errors",
    "bundled_cases": "screwkit.case",
    "load": "screwkit.case",
    "analyze": "screwkit.questions",
    "assemble": "screwkit.motion_questions",
    "distance": "screwkit.questions",
    "follow": "screwkit.motion_questions",
    "manipulability": "screwkit.metric_questions",
    "move": "screwkit.motion_questions",
    "mobility": "screwkit.questions",
    "reach": "screwkit.metric_questions",
    "relative_motion": "screwkit.questions",
    "schemes": "screwkit.questions",
    "screws": "screwkit.questions",
    "singularities": "screwkit.questions",
    "sweep": "screwkit.metric_questions",
    "view": "screwkit.metric_questions",
}
__all__ = [
    "Case",
    "ExpressionError",
    "FrameMismatchError",
    "MechanismFileError",
    "MissingToolError",
    "ScrewkitError",
    "TooLargeError",
    "UndecidedError",
    "UnfitValueError",
    "UnknownCaseError",
    "UnknownNameError",
    "UnwritableError",
    "__version__",
    "analyze",
    "assemble",
    "bundled_cases",
    "distance",
    "follow",
    "load",
    "manipulability",
    "mobility",
    "move",
    "reach",
    "relative_motion",
    "schemes",
    "screws",
    "singularities",
    "sweep",
    "view",
]


def __getattr__(name: str) -> Any:
    """Load public names when they are first used: ``import screwkit`` stays fast."""
    if name not in _HOMES:
        raise AttributeError(f"module 'screwkit' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
