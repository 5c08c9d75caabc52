"""The child process in which exact work runs: one job in, progress and answer out.

FLINT can neither be interrupted nor survive running out of memory, so whoever asks
stays outside and may end this process at any moment.  One line of JSON is read from
standard input; lines of JSON with progress, finished parts and the answer or the
refusal go to standard output.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import traceback
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from typing import IO, Any, Final

TARGETS: Final = {
    "mobility": "screwkit.questions:mobility",
    "relative_motion": "screwkit.questions:relative_motion",
    "screws": "screwkit.questions:screws",
    "singularities": "screwkit.questions:singularities",
    "distance": "screwkit.questions:distance",
    "schemes": "screwkit.questions:schemes",
    "manipulability": "screwkit.metric_questions:manipulability",
    "reach": "screwkit.metric_questions:reach",
    "sweep": "screwkit.metric_questions:sweep_answer",
    "verify": "screwkit.verification:verify",
    "view": "screwkit.metric_questions:view_answer",
    "analyze": "screwkit.questions:analyze",
}

# The words of the C library: https://sourceware.org/git/glibc.git, elf/dl-load.c.
_NO_ROOM: Final = (
    "failed to map segment from shared object",
    "Cannot allocate memory",
)


@dataclass(frozen=True)
class Job:
    """What is to be computed.

    Attributes:
        variant: One of the variants of the case.
        at: Values of joint variables and free symbols, as texts.
        target: ``module:function`` called with the case; the question's own if empty.
        options: Keyword arguments of the function.
        memory: Bytes of address space that the child may use; None for no limit.
    """

    question: str
    case: str
    set_values: Mapping[str, str] = field(default_factory=dict)
    actuated: tuple[str, ...] | None = None
    options: Mapping[str, Any] = field(default_factory=dict)
    memory: int | None = None
    target: str = ""
    variant: str | None = None
    at: Mapping[str, str] = field(default_factory=dict)

    def to_line(self) -> str:
        """The job as one line of JSON."""
        return json.dumps(asdict(self)) + "\n"


def job_from_line(line: str) -> Job:
    """The job that `Job.to_line` wrote."""
    data = json.loads(line)
    if data["actuated"] is not None:
        data["actuated"] = tuple(data["actuated"])
    return Job(**data)


def main() -> None:
    """Serve one job and leave; never returns an error by exit code."""
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as output:
        os.dup2(2, 1)  # what libraries print must not reach the parent as an answer
        _die_with_parent()

        def send(message: Mapping[str, Any]) -> None:
            output.write(json.dumps(message) + "\n")
            output.flush()

        serve(sys.stdin, send)


def serve(source: IO[str], send: Callable[[Mapping[str, Any]], None]) -> None:
    """Read a job, send its messages."""
    from screwkit import errors  # noqa: PLC0415
    from screwkit.reports.wire import encode, part_to_json  # noqa: PLC0415

    try:
        job = job_from_line(source.readline())
        _limit_memory(job.memory)
        result = _answer(job, send)
        send({"result": part_to_json(result)})
    except errors.MechanismFileError as error:
        faults = [encode(fault) for fault in error.faults]
        send(_refusal("file", str(error), source=error.source, faults=faults))
    except (
        errors.UnknownCaseError,
        errors.UnknownNameError,
        errors.ExpressionError,
    ) as error:
        send(_refusal("usage", str(error)))
    except errors.MissingToolError as error:
        send(_refusal("tool", str(error)))
    except errors.UndecidedError as error:
        send(_refusal("undecided", str(error)))
    except MemoryError:
        send(_refusal("undecided", out_of_memory(job.memory)))
    except ImportError as error:
        send(_unloaded(error, job.memory))
    except errors.ScrewkitError as error:
        send(_refusal("usage", str(error)))
    except Exception as error:  # noqa: BLE001, RUF100 -- a defect is reported, not lost
        text = f"{type(error).__name__}: {error}"
        send(_refusal("defect", text, trace=traceback.format_exc()))


def out_of_memory(limit: int | None) -> str:
    """What is said where memory did not suffice, and what would help."""
    said = "the exact computation ran out of memory"
    if limit is None:
        return said
    return f"{said} (limit {limit / 2**30:.2g} GB; --memory raises it)"


def usual_memory() -> int | None:
    """The limit where none is asked for: three quarters of the machine's memory.

    None where the system does not tell.
    """
    try:
        whole = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return None
    return max(3 * whole // 4, 2 << 30) if whole > 0 else None


def _refusal(kind: str, message: str, **more: Any) -> dict[str, Any]:
    return {"refusal": {"kind": kind, "message": message, **more}}


def _unloaded(error: ImportError, memory: int | None) -> dict[str, Any]:
    """A library that is broken or missing is a defect; one that does not fit is not."""
    if memory is None or not _wants_room(error):
        text = f"{type(error).__name__}: {error}"
        return _refusal("defect", text, trace=traceback.format_exc())
    return _refusal(
        "undecided",
        f"the libraries alone do not fit into {memory / 2**30:.2g} GB; "
        f"raise the limit (--memory)",
    )


def _wants_room(error: BaseException | None) -> bool:
    """Whether a library failed to load because there was no memory for it.

    Libraries that try several ways, as numpy does, hide the first error behind an
    own one.  Where the system names a reason besides memory, such as a folder from
    which nothing may be run, that is meant.
    """
    while error is not None:
        said = str(error)
        if isinstance(error, MemoryError) or said.endswith(_NO_ROOM):
            return True
        error = error.__cause__ or error.__context__
    return False


def _answer(job: Job, send: Callable[[Mapping[str, Any]], None]) -> Any:
    """Load the case and call the analysis, passing on what it reports."""
    from importlib import import_module  # noqa: PLC0415
    from inspect import Parameter, signature  # noqa: PLC0415

    from screwkit.reports.wire import part_to_json  # noqa: PLC0415

    def progress(stage: str, size: str = "") -> None:
        send({"progress": {"stage": str(stage), "size": str(size)}})

    def finished(name: str, part: Any) -> None:
        send({"part": {"name": name, **part_to_json(part)}})

    progress("reading the case")
    loaded = _load(job)
    module, _, name = (job.target or TARGETS[job.question]).partition(":")
    function = getattr(import_module(module), name)
    accepted = signature(function).parameters
    every = any(p.kind is Parameter.VAR_KEYWORD for p in accepted.values())
    reports = {"progress": progress, "finished": finished}
    hooks = {key: hook for key, hook in reports.items() if every or key in accepted}
    return function(loaded, **job.options, **hooks)


def _load(job: Job) -> Any:
    if job.target and not job.case:
        return None
    from screwkit.case import load  # noqa: PLC0415

    return load(
        job.case,
        set_values=dict(job.set_values),
        actuated=job.actuated,
        variant=job.variant,
        at=dict(job.at),
    )


def _limit_memory(limit: int | None) -> None:
    if limit is None:
        return
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource  # noqa: PLC0415 -- not on every system

        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _die_with_parent() -> None:
    """Ask Linux to end this process when its parent is gone."""
    if not sys.platform.startswith("linux"):
        return
    with contextlib.suppress(Exception):
        import ctypes  # noqa: PLC0415 -- costly, and only needed here

        set_parent_death_signal, kill = 1, 9
        ctypes.CDLL(None).prctl(set_parent_death_signal, kill)


if __name__ == "__main__":
    main()
