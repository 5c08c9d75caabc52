"""Runs a job in a child process and stays in charge of it.

The child is watched, not waited for: progress is passed on as it comes, and on a
deadline or a signal the whole process group is killed within a moment.  A child that
dies of itself is an answer too: undecided, because it died.
"""

from __future__ import annotations

import contextlib
import json
import os
import selectors
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import IO, Any, Final, Literal, TypeAlias

from screwkit.errors import Fault
from screwkit.worker import Job, out_of_memory

TICK: Final = 0.1
_START: Final = (
    "import sys; r = sys.argv[1]; r in sys.path or sys.path.insert(0, r); "
    "from screwkit.worker import main; main()"
)

_ENVIRONMENT: Final = {
    "OPENBLAS_NUM_THREADS": "1",  # small matrices only
    "PYDANTIC_DISABLE_PLUGINS": "1",  # none is wanted; to look for them takes time
}


@dataclass(frozen=True)
class Stage:
    """Where the child is: what it does, on what size, since how many seconds."""

    name: str
    size: str
    elapsed: float


@dataclass(frozen=True)
class Answered:
    """The job is done."""

    result: Any


@dataclass(frozen=True)
class Refused:
    """The job could not be begun or was given up.

    Attributes:
        kind: ``file``, ``usage``, ``tool``, ``undecided`` or ``defect``.
        trace: The traceback of a defect.
    """

    kind: str
    message: str
    source: str = ""
    faults: tuple[Fault, ...] = ()
    trace: str = ""
    parts: tuple[tuple[str, Any], ...] = ()


@dataclass(frozen=True)
class Stopped:
    """The job was ended from outside; ``parts`` were finished before."""

    cause: Literal["timeout", "interrupted"]
    stage: Stage
    parts: tuple[tuple[str, Any], ...]


@dataclass(frozen=True)
class Died:
    """The child ended without an answer."""

    reason: str
    stage: Stage
    parts: tuple[tuple[str, Any], ...]


Outcome: TypeAlias = Answered | Refused | Stopped | Died
Watcher: TypeAlias = Callable[[Stage], None]


class _Child:
    """A running job and what it has said so far."""

    def __init__(self, job: Job, errors: IO[bytes]) -> None:
        root = str(Path(__file__).resolve().parent.parent)
        self.started = time.monotonic()
        self.stage = Stage("starting", "", 0.0)
        self.parts: list[tuple[str, Any]] = []
        self.final: Answered | Refused | None = None
        self._pending = b""
        self.process = subprocess.Popen(  # noqa: S603, RUF100
            [sys.executable, "-P", "-c", _START, root],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            start_new_session=True,
            env={**_ENVIRONMENT, **os.environ},
        )
        with contextlib.suppress(BrokenPipeError):
            assert self.process.stdin is not None
            self.process.stdin.write(job.to_line().encode())
            self.process.stdin.close()

    @property
    def elapsed(self) -> float:
        return time.monotonic() - self.started

    def read(self, chunk: bytes) -> None:
        """Take in what the child wrote."""
        *lines, self._pending = (self._pending + chunk).split(b"\n")
        for line in lines:
            self._take(json.loads(line))

    def _take(self, message: dict[str, Any]) -> None:
        from screwkit.reports.records import part_from_json  # noqa: PLC0415

        if "progress" in message:
            said = message["progress"]
            self.stage = Stage(said["stage"], said["size"], self.elapsed)
        elif "part" in message:
            part = message["part"]
            # A part that has grown takes the place of what it was before.
            self.parts = [one for one in self.parts if one[0] != part["name"]]
            self.parts.append((part["name"], part_from_json(part)))
        elif "result" in message:
            self.final = Answered(part_from_json(message["result"]))
        elif "refusal" in message:
            said = dict(message["refusal"])
            faults = tuple(Fault(**fault) for fault in said.pop("faults", ()))
            self.final = Refused(**said, faults=faults, parts=tuple(self.parts))

    def end(self) -> None:
        """Kill the child and its children; leaves no zombie."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if hasattr(os, "killpg"):
                os.killpg(self.process.pid, signal.SIGKILL)
            else:
                self.process.kill()
        self.process.wait()
        if self.process.stdout is not None:
            self.process.stdout.close()


def run(
    job: Job,
    *,
    timeout: float | None = None,
    watch: Watcher | None = None,
    meanwhile: Callable[[], None] | None = None,
) -> Outcome:
    """Run a job to its end, its deadline or a signal.

    Args:
        job: What to compute.
        timeout: Seconds; None for none.
        watch: Called about ten times a second with the current stage.
        meanwhile: Called once, while the child starts; must be short.
    """
    with tempfile.TemporaryFile() as errors, _signals_raise():
        child: _Child | None = None
        try:
            child = _Child(job, errors)
            if meanwhile is not None:
                meanwhile()
            return _followed(child, errors, timeout, watch, job.memory)
        except KeyboardInterrupt:
            if child is None:
                return Stopped("interrupted", Stage("starting", "", 0.0), ())
            return Stopped("interrupted", child.stage, tuple(child.parts))
        finally:
            if child is not None:
                child.end()


def _followed(
    child: _Child,
    errors: IO[bytes],
    timeout: float | None,
    watch: Watcher | None,
    memory: int | None,
) -> Outcome:
    assert child.process.stdout is not None
    descriptor = child.process.stdout.fileno()
    with selectors.DefaultSelector() as selector:
        selector.register(descriptor, selectors.EVENT_READ)
        while True:
            left = TICK if timeout is None else min(TICK, timeout - child.elapsed)
            if left <= 0:
                return Stopped("timeout", child.stage, tuple(child.parts))
            if selector.select(left):
                chunk = os.read(descriptor, 1 << 16)
                if not chunk:
                    break
                child.read(chunk)
                if child.final is not None:
                    return child.final
            elif watch is not None:
                stage = child.stage
                watch(Stage(stage.name, stage.size, child.elapsed))
    code = child.process.wait()
    errors.seek(0)
    said = errors.read().decode(errors="replace")
    return Died(_cause(code, said, memory), child.stage, tuple(child.parts))


def _cause(code: int, said: str, memory: int | None) -> str:
    """Why a child died, in words."""
    limit = f" (limit {memory / 2**30:.2g} GB; --memory raises it)" if memory else ""
    if "memory" in said.lower():
        return out_of_memory(memory)
    if code == -signal.SIGABRT:
        return f"the exact arithmetic aborted, as it does without memory{limit}"
    if code == -signal.SIGKILL:
        return "the computation was killed from outside, perhaps for want of memory"
    if code < 0:
        return f"the computation was ended by {signal.Signals(-code).name}{limit}"
    last = said.strip().rsplit("\n", maxsplit=1)[-1]
    because = f": {last}" if last else ""
    return f"the computation ended without an answer (code {code}){because}"


@contextlib.contextmanager
def _signals_raise() -> Iterator[None]:
    """Let SIGTERM and SIGHUP end the work as Ctrl-C does."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    wanted = (signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM))
    before = {number: signal.signal(number, stop) for number in set(wanted)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
