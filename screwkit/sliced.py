"""Singularities of a slice: the same question where two symbols vary, and a picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from screwkit.case import Case
from screwkit.errors import ScrewkitError
from screwkit.kinematics.values import with_values
from screwkit.reports.draw_slice import slice_picture
from screwkit.reports.figures import FORMS
from screwkit.reports.output import write
from screwkit.results.singularities import Singularities
from screwkit.sweeps.slices import curves_of, slice_of, slicing_of


def sliced_singularities(
    case: Case,
    slices: Sequence[str],
    output: Path,
    question: Callable[[Case], Singularities],
) -> Singularities:
    """The singularities of a slice, drawn.

    Args:
        case: The mechanism.
        slices: Two ranges, ``name=from:to`` or ``name=from:to:count``.
        output: .pdf, .svg or .png.
        question: What is asked where only the two symbols vary.

    Raises:
        ScrewkitError: If the file has another ending, or there is no slice to draw.
        ExpressionError: If there are not two ranges.
        UndecidedError: If another symbol has no value.
    """
    if not slices:
        raise ScrewkitError("what is drawn is a slice: --slice NAME=FROM:TO twice")
    if output.suffix not in FORMS:
        raise ScrewkitError(
            f"{output}: a slice is drawn as {', '.join(FORMS)}; give -o FILE"
        )
    slicing = slicing_of(case.mechanism, slices)
    mechanism = with_values(case.mechanism, slicing.fixed)
    answer = question(Case(mechanism, case.wanted, case.path, case.given))
    curves = curves_of(answer, slicing)
    drawn = slice_of(answer, slicing, curves)
    content = slice_picture(
        drawn,
        [curve.segments for curve in curves],
        case.mechanism.title or case.name,
        FORMS[output.suffix],
    )
    write(output, content)
    return replace(answer, slice=replace(drawn, file=str(output)))
