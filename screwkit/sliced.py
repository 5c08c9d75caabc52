"""Singularities of a slice: the same question where two symbols vary, and a picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from screwkit.algebra.names import limb_called
from screwkit.case import Case
from screwkit.errors import ScrewkitError
from screwkit.kinematics.values import with_values
from screwkit.mechanism.model import Mechanism
from screwkit.reports.draw_slice import slice_picture
from screwkit.reports.figures import FORMS
from screwkit.reports.output import write
from screwkit.results.singularities import Singularities
from screwkit.sweeps.slices import Slicing, curves_of, slice_of, slicing_of


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
    slicing = slicing_of(case.mechanism, slices)
    if output.suffix not in FORMS:
        named = f"{output}: " if output.name else ""
        raise ScrewkitError(
            f"{named}a slice is drawn as {', '.join(FORMS)}; give -o FILE"
        )
    mechanism = with_values(case.mechanism, slicing.fixed)
    inside = Case(_varied(mechanism, slicing), case.wanted, case.path, case.given)
    answer = question(inside)
    curves = curves_of(answer, slicing)
    drawn = slice_of(answer, slicing, curves)
    remarks = [*_lost_everywhere(case, inside), *filter(None, [drawn.remark])]
    given = (f"{name} = {value}" for name, value in case.given.values.items())
    drawn = replace(drawn, remark="; ".join(remarks), fixed=(*given, *drawn.fixed))
    content = slice_picture(
        drawn,
        [curve.segments for curve in curves],
        case.mechanism.title or case.name,
        FORMS[output.suffix],
    )
    write(output, content)
    return replace(answer, slice=replace(drawn, file=str(output)))


def _varied(mechanism: Mechanism, slicing: Slicing) -> Mechanism:
    """A dimension that varies in a slice is no fixed one: its values are the locus."""
    varied = {axis.name for axis in slicing.axes}
    parameters = tuple(
        replace(p, free=p.free or p.name in varied) for p in mechanism.parameters
    )
    return replace(mechanism, parameters=parameters)


def _lost_everywhere(case: Case, inside: Case) -> list[str]:
    """What has a smaller rank in the whole slice than for other values.

    No curve shows that, because it is not special within the slice.
    """
    if case.graph is not None and inside.graph is not None:
        ranks = [graph.generic_state().loop for graph in (case.graph, inside.graph)]
        return _lost_by_loops(*ranks)
    before, after = case.assembly, inside.assembly
    found = []
    for limb in before.limbs:
        general, here = (a.generic_rank(limb.joints) for a in (before, after))
        if here < general:
            found.append(
                f"{limb_called(limb.name)} is singular in the whole slice: "
                f"rank {here}, in general {general}"
            )
    return [*found, *_lost_by_loops(before.loop_rank, after.loop_rank)]


def _lost_by_loops(general: int, here: int) -> list[str]:
    if here >= general:
        return []
    return [
        f"the constraints of the loops have rank {here} in the whole slice, in general "
        f"{general}"
    ]
