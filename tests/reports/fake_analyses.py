"""Analyses that answer at once, never, or by dying: what the guard is tested on."""

from __future__ import annotations

import os
import subprocess
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from reports import samples

from screwkit.errors import Fault, MechanismFileError, TooLargeError

Progress = Callable[..., None]


def quick(_case: object) -> Any:
    return samples.MOBILITY


def noisy(_case: object, progress: Progress) -> Any:
    print("a library talks")  # noqa: T201
    progress("expanding minors", "6 x 10")
    return samples.SCHEMES


def slow(_case: object, progress: Progress, finished: Progress, witness: str) -> Any:
    child = subprocess.Popen(["sleep", "60"])
    Path(witness).write_text(str(child.pid), encoding="ascii")
    finished("description", samples.DESCRIPTION)
    finished("mobility", samples.MOBILITY)
    progress("expanding minors", "6 x 10")
    time.sleep(60)


def growing(_case: object, finished: Progress) -> None:
    finished("mobility", samples.MOBILITY)
    finished("distance", replace(samples.MOBILITY, title="so far"))
    finished("distance", replace(samples.MOBILITY, title="farther"))
    raise TooLargeError("the rest is too large")


def dies(_case: object) -> None:
    os.abort()


def greedy(_case: object) -> int:
    return len(bytearray(1 << 34))


NO_ROOM = "libopenblas.so: failed to map segment from shared object"


def without_room(_case: object) -> None:
    raise ImportError(NO_ROOM)


def without_room_inside(_case: object) -> None:
    try:
        without_room(_case)
    except ImportError as error:
        raise ImportError("importing the C extensions failed") from error


def broken_import(_case: object) -> None:
    from screwkit.errors import no_such_error  # type: ignore[attr-defined]  # noqa: F401, PLC0415


def nothing_may_run(_case: object) -> None:
    raise ImportError(f"{NO_ROOM}: Operation not permitted")


def too_large(_case: object) -> None:
    raise TooLargeError("15 million terms; try --set some of the dimensions")


def wrong_file(_case: object) -> None:
    raise MechanismFileError(
        "arm.yaml",
        (Fault(14, 38, "unknown name 'd_3'"), Fault(22, 12, "the axis is zero")),
    )


def defective(_case: object) -> None:
    raise RuntimeError("a defect")
