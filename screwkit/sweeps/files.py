"""Swept values as files: a table of points, or arrays over the grid.

``.csv`` has a line for each point, ``.npz`` the values in the shape of the grid with
one array for each axis.  A file is written whole or not at all.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.errors import ScrewkitError, UnwritableError
from screwkit.sweeps.grid import Grid
from screwkit.sweeps.samples import Samples

ENDINGS: Final = (".csv", ".npz")
BLOCK: Final = 100_000
"""Lines that are made at a time."""


def write_values(path: Path, points: Grid | Samples, index: str, values: Array) -> None:
    """Write the values of an index at all points.

    Args:
        path: Its ending decides the form.
        points: Where the values were taken.
        index: Its name.
        values: Shape (points.size,).

    Raises:
        ScrewkitError: If the ending is unknown.
        UnwritableError: If the file cannot be written.
    """
    check_ending(path)
    try:
        _write(path, points, index, values)
    except OSError as error:
        raise UnwritableError(path, error) from None


def check_ending(path: Path) -> None:
    """Refuse what `write_values` would not write.

    Raises:
        ScrewkitError: If the ending is unknown.
    """
    if path.suffix not in ENDINGS:
        raise ScrewkitError(
            f"{path}: a sweep is written as {' or '.join(ENDINGS)}, and drawn as .pdf, "
            f".svg or .png"
        )


def _write(path: Path, points: Grid | Samples, index: str, values: Array) -> None:
    folder = path.resolve().parent
    descriptor, name = tempfile.mkstemp(dir=folder, suffix=path.suffix)
    os.close(descriptor)
    temporary = Path(name)
    try:
        if path.suffix == ".csv":
            _write_table(temporary, points, index, values)
        else:
            _write_arrays(temporary, points, index, values)
        temporary.chmod(0o644)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def _write_table(path: Path, points: Grid | Samples, index: str, values: Array) -> None:
    names = [axis.name for axis in points.axes]
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.write(",".join([*names, index]) + "\n")
        for start in range(0, points.size, BLOCK):
            stop = min(start + BLOCK, points.size)
            part = points.points(start, stop)
            columns = [*(part[name] for name in names), values[start:stop]]
            file.writelines(
                ",".join(repr(float(x)) for x in row) + "\n"
                for row in zip(*columns, strict=True)
            )


def _write_arrays(
    path: Path, points: Grid | Samples, index: str, values: Array
) -> None:
    if isinstance(points, Grid):
        axes = {axis.name: axis.values for axis in points.axes}
    else:
        axes = points.points(0, points.size)
    arrays: dict[str, Array] = {f"axis_{name}": v for name, v in axes.items()}
    arrays["values"] = values.reshape(points.shape)
    with path.open("wb") as file:
        np.savez(file, index=np.array(index), **arrays)  # type: ignore[arg-type]
