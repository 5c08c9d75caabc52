"""A sweep from its names to its answer: the question that `sweep` puts.

References: [BicchiPrattichizzo] §V.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.expression import Expression
from screwkit.algebra.names import counted
from screwkit.errors import ExpressionError
from screwkit.kinematics.values import given_before
from screwkit.mechanism.model import Mechanism
from screwkit.progress import Progress, silent
from screwkit.results.sweep import Extremum, Sweep
from screwkit.sweeps.files import check_ending, write_values
from screwkit.sweeps.grid import Axis, Grid, axis_of, grid_of, refuse_unfit
from screwkit.sweeps.objective import objective_of
from screwkit.sweeps.optimum import refined
from screwkit.sweeps.run import swept
from screwkit.sweeps.samples import Samples

SHOWN = 4096
"""Values up to which the answer itself holds them."""


@dataclass(frozen=True, eq=False)
class Map:
    """Values over a grid or over samples, as arrays.

    Attributes:
        answer: In words and numbers.
        axes: The values of each varied symbol: along the grid, or point by point.
        values: Of the index, in the shape of the grid.
    """

    answer: Sweep
    axes: dict[str, Array]
    values: Array


def sweep_map(
    mechanism: Mechanism,
    vary: Sequence[str],
    index: str = "kinematic.min",
    samples: int = 0,
    best: Literal["", "least", "greatest"] = "",
    output: Path | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
    wanted: Mapping[str, Expression] | None = None,
) -> Map:
    """Evaluate an index over ranges of symbols and joint variables.

    Args:
        mechanism: Its scheme decides what is actuated.
        vary: Ranges, ``name=start:stop:count`` each.
        index: ``kinematic.min``, ``force.condition``, ``locus``, …
        samples: Take so many points of the box instead of the grid.
        best: Refine the least or the greatest value.
        output: Write all values to this file, .csv or .npz; finished chunks are kept
            beside it until it is written.
        executor: Evaluates chunks; here by default.
        progress: Told how far it is.
        wanted: Values at which joint variables that loops tie together are kept.

    Raises:
        UnknownNameError: If an index or a symbol is unknown.
        ExpressionError: If a range is none.
        UnfitValueError: If a range has values that the file excludes.
        UndecidedError: If the index has no finite values, or a table no closed posture.
        ScrewkitError: If the ending of the file is unknown.
    """
    known = [p.name for p in mechanism.parameters] + list(mechanism.joint_variables)
    if not vary:
        raise ExpressionError("nothing is varied; give a range, --vary NAME=A:B:COUNT")
    if output is not None:
        check_ending(output)
    given = given_before(mechanism)
    axes = tuple(axis_of(text, known, given) for text in vary)
    refuse_unfit(axes, mechanism.parameters, zero=False)
    points = Samples(axes, samples) if samples else grid_of(axes)
    varied = tuple(axis.name for axis in axes)
    objective = objective_of(mechanism, index, varied, wanted)
    progress("sweep", f"{index} at {counted(points.size, 'point')}")
    kept = None if output is None else output.with_name(output.name + ".parts")
    values = swept(
        objective,
        points,
        executor,
        kept,
        done=lambda number, of: progress("sweep", f"{number} of {of} points"),
    )
    found = None
    if best and np.isfinite(values).any():
        progress("sweep", "refining the best point")
        whole = points.points(0, points.size)
        table = np.stack([whole[axis.name] for axis in axes], axis=1)
        value, place = refined(
            objective, axes, table, values, greatest=best == "greatest"
        )
        found = Extremum(value, place)
    if output is not None:
        write_values(output, points, index, values)
        if kept is not None:
            kept.unlink(missing_ok=True)
    answer = _answer(mechanism, index, axes, points, values, found, output)
    arrays = (
        {axis.name: axis.values for axis in axes}
        if isinstance(points, Grid)
        else points.points(0, points.size)
    )
    return Map(answer, arrays, values.reshape(points.shape))


def _answer(
    mechanism: Mechanism,
    index: str,
    axes: tuple[Axis, ...],
    points: Grid | Samples,
    values: Array,
    best: Extremum | None,
    output: Path | None,
) -> Sweep:
    finite = np.isfinite(values)

    def extremum(number: int) -> Extremum:
        place = points.points(number, number + 1)
        where = tuple(float(place[axis.name][0]) for axis in axes)
        return Extremum(float(values[number]), where)

    least = greatest = None
    if finite.any():
        least = extremum(int(np.argmin(np.where(finite, values, np.inf))))
        greatest = extremum(int(np.argmax(np.where(finite, values, -np.inf))))
    few = values.size <= SHOWN
    numbers = [float(x) if ok else None for x, ok in zip(values, finite, strict=True)]
    return Sweep(
        case=mechanism.name,
        title=mechanism.title,
        index=index,
        vary=tuple(axis.name for axis in axes),
        shape=points.shape,
        ranges=tuple((axis.start, axis.stop) for axis in axes),
        least=least,
        greatest=greatest,
        best=best,
        singular=int(np.isinf(values).sum()),
        undefined=int(np.isnan(values).sum()),
        file="" if output is None else str(output),
        numbers=tuple(numbers) if few else (),
    )
