"""Evaluates an objective over many points, in chunks, here or on any executor.

A chunk is a range of points of the grid: its result depends on nothing else, so the
values do not depend on how the work was cut or who did it.  Chunks that are done can be
kept in a file, from which an interrupted sweep goes on.
"""

from __future__ import annotations

import hashlib
import json
import pickle
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.errors import UnwritableError
from screwkit.sweeps.objective import Objective

CHUNK = 65_536
"""Points at a time: some tenths of a second for a mechanism of usual size."""


class Points(Protocol):
    """Where an objective is evaluated."""

    @property
    def size(self) -> int:
        """How many points."""
        ...

    def points(self, start: int, stop: int) -> dict[str, Array]:
        """Values by name at some of them."""
        ...


def swept(
    objective: Objective,
    points: Points,
    executor: Executor | None = None,
    kept_in: Path | None = None,
    chunk: int = CHUNK,
    done: Callable[[int, int], None] = lambda number, of: None,
) -> Array:
    """The objective at all points, shape (size,).

    Args:
        objective: What is evaluated.
        points: A grid or samples.
        executor: Anything with the interface of `concurrent.futures.Executor`, such as
            ``Client.get_executor()`` of Dask; None evaluates here.
        kept_in: A file of finished chunks, read if it belongs to the same sweep.
        chunk: Points at a time.
        done: Told how many points are done, and of how many.
    """
    found = np.empty(points.size)
    ranges = [
        (start, min(start + chunk, points.size))
        for start in range(0, points.size, chunk)
    ]
    store = _Store(kept_in, fingerprint(objective, points)) if kept_in else None
    known = store.known() if store else {}
    left = []
    finished = 0
    for span in ranges:
        if span in known:
            found[slice(*span)] = known[span]
            finished += span[1] - span[0]
        else:
            left.append(span)
    for span, values in _evaluated(objective, points, left, executor):
        found[slice(*span)] = values
        if store:
            store.add(span, values)
        finished += span[1] - span[0]
        done(finished, points.size)
    return found


def evaluate_chunk(
    objective: Objective, points: Points, start: int, stop: int
) -> Array:
    """One chunk; a plain function, so that it can be sent to another process."""
    return np.asarray(objective(points.points(start, stop)), dtype=float)


def _evaluated(
    objective: Objective,
    points: Points,
    spans: list[tuple[int, int]],
    executor: Executor | None,
) -> Iterator[tuple[tuple[int, int], Array]]:
    if executor is None:
        for span in spans:
            yield span, evaluate_chunk(objective, points, *span)
        return
    futures: list[tuple[tuple[int, int], Future[Array]]] = [
        (span, executor.submit(evaluate_chunk, objective, points, *span))
        for span in spans
    ]
    for span, future in futures:
        yield span, future.result()


def fingerprint(objective: Objective, points: Points) -> str:
    """What a file of chunks must belong to."""
    return hashlib.sha256(pickle.dumps((objective, points))).hexdigest()


@dataclass(frozen=True)
class _Store:
    """Finished chunks, one line of JSON each; the first line names the sweep."""

    path: Path
    name: str

    def known(self) -> dict[tuple[int, int], Array]:
        """The chunks in the file; none if it belongs to another sweep.

        Raises:
            UnwritableError: If the file cannot be begun or mended.
        """
        found: dict[tuple[int, int], Array] = {}
        kept = [self.name]
        if self.path.exists():
            text = self.path.read_text(encoding="utf-8", errors="replace")
            lines = text.splitlines()
            if lines and lines[0] == self.name:
                for line in lines[1:]:
                    try:
                        start, stop, texts = json.loads(line)
                        values = np.array([float.fromhex(x) for x in texts])
                    except (ValueError, TypeError):  # where it was interrupted
                        break
                    found[start, stop] = values
                    kept.append(line)
                if len(kept) == len(lines) and text.endswith("\n"):
                    return found
        try:  # without the half of a line, to which the next one would be joined
            self.path.write_text("\n".join(kept) + "\n", encoding="utf-8")
        except OSError as error:
            raise UnwritableError(self.path, error) from None
        return found

    def add(self, span: tuple[int, int], values: Array) -> None:
        """Append a chunk."""
        line = json.dumps([*span, [float(x).hex() for x in values]])
        with self.path.open("a", encoding="utf-8") as file:
            file.write(line + "\n")
