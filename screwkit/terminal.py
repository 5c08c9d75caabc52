"""From a request to what the user sees: one answer, one exit code.

Results go to standard output, everything else to standard error, one line a message.
With ``--json`` standard output carries exactly one document, also when the answer is a
refusal.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final, assert_never

from screwkit import errors
from screwkit.errors import Fault
from screwkit.guard import Answered, Died, Refused, Stage, Stopped, run
from screwkit.worker import Job

_QUIET_SECONDS: Final = 1.0
_REFRESH: Final = 5.0


@dataclass(frozen=True)
class Request:
    """A job and how its answer is wanted.

    Attributes:
        change: Applied to the answer before it is shown.
        show: Makes the text of an answer; the usual sections if None.
        deliver: Takes the answer in place of standard output, and returns lines about
            what it did.
    """

    job: Job
    as_json: bool = False
    timeout: float | None = None
    quiet: bool = False
    debug: bool = False
    change: Callable[[Any], Any] | None = None
    show: Callable[[Any], str] | None = None
    deliver: Callable[[Any], list[str]] | None = None
    beside: Callable[[Any], list[str]] | None = None


def ask(request: Request) -> int:
    """Have the job done, show what came of it, return the exit code."""
    watch = None if request.quiet else Ticker()
    try:
        outcome = run(
            request.job, timeout=request.timeout, watch=watch, meanwhile=_prepare
        )
    finally:
        if watch is not None:
            watch.close()
    match outcome:
        case Answered(result):
            return _answered(request, result)
        case Refused():
            return _refused(request, outcome)
        case Died(reason, _, parts):
            _partial(request, reason, parts)
            return errors.EXIT_NEGATIVE
        case Stopped("timeout", stage, parts):
            reason = f"out of time after {request.timeout:g} s ({_where(stage)})"
            _partial(request, reason, parts)
            return errors.EXIT_TIMEOUT
        case Stopped(_, stage, parts):
            _partial(request, f"interrupted ({_where(stage)})", parts)
            return errors.EXIT_INTERRUPTED
        case _:
            assert_never(outcome)


def _prepare() -> None:
    """Load what shows answers, while the child loads what finds them."""
    import screwkit.reports.records  # noqa: PLC0415
    import screwkit.reports.sections  # noqa: PLC0415
    import screwkit.reports.text  # noqa: F401, PLC0415


def _where(stage: Stage) -> str:
    return f"{stage.name}, {stage.size}" if stage.size else stage.name


def _answered(request: Request, result: Any) -> int:
    from screwkit.reports.verdict import is_plain_yes  # noqa: PLC0415

    code = errors.EXIT_DONE if is_plain_yes(result) else errors.EXIT_NEGATIVE
    shown = request.change(result) if request.change else result
    if request.deliver is not None:
        lines = request.deliver(shown)
        if request.as_json:
            emit_json(request.job.case, {"written": lines})
        elif not request.quiet:
            note(*lines)
        # A report says itself what is open: it is done once it is written.
        return errors.EXIT_DONE if request.job.question == "analyze" else code
    _show(request, shown)
    if request.beside is not None:
        lines = request.beside(shown)
        if not request.quiet:
            note(*lines)
    return code


def _show(request: Request, result: Any) -> None:
    if request.as_json:
        from screwkit.reports.records import to_json  # noqa: PLC0415

        emit(json.dumps(to_json(result, request.job.case), indent=1) + "\n")
    elif request.show is not None:
        emit(request.show(result))
    else:
        emit(text_of(result))


def text_of(result: Any) -> str:
    """An answer as the terminal shows it."""
    from screwkit.reports.sections import answer_blocks  # noqa: PLC0415
    from screwkit.reports.text import Page, render  # noqa: PLC0415

    bold = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    return render(answer_blocks(result), Page(bold=bold))


def line_of(text: str) -> str:
    """A sentence as the terminal shows it."""
    from screwkit.reports.blocks import Words  # noqa: PLC0415
    from screwkit.reports.text import inline  # noqa: PLC0415

    return inline((Words(text),)) + "\n"


def _refused(request: Request, refusal: Refused) -> int:
    """A refusal in words and its exit code."""
    match refusal.kind:
        case "file":
            return faulty(
                request.job.case,
                refusal.source,
                refusal.faults,
                as_json=request.as_json,
            )
        case "undecided":
            _partial(request, refusal.message, refusal.parts)
            return errors.EXIT_NEGATIVE
        case "defect":
            if request.debug:
                note(refusal.trace)
            message = f"internal error: {refusal.message} (--debug shows where)"
            return failed(request, "defect", message, errors.EXIT_NEGATIVE)
        case "tool":
            return failed(request, "tool", refusal.message, errors.EXIT_TOOL)
        case _:
            return failed(request, "usage", refusal.message, errors.EXIT_USAGE)


def failed(request: Request, kind: str, message: str, code: int) -> int:
    """One line on standard error, the same in the document, and the code."""
    note(f"screwkit: {message}")
    if request.as_json:
        emit_json(request.job.case, {"error": {"kind": kind, "message": message}})
    return code


def faulty(case: str, source: str, faults: tuple[Fault, ...], *, as_json: bool) -> int:
    """All faults of a file, one a line."""
    note(*(fault.located_in(source) for fault in faults))
    number = "1 error" if len(faults) == 1 else f"{len(faults)} errors"
    note(f"{number}; nothing was computed")
    if as_json:
        from screwkit.reports.records import faults_to_json  # noqa: PLC0415

        emit_json(case, faults_to_json(source, faults))
    return errors.EXIT_FILE


def _partial(request: Request, reason: str, parts: tuple[tuple[str, Any], ...]) -> None:
    """What was finished, and that the rest is undecided."""
    from screwkit.reports.verdict import partial_analysis  # noqa: PLC0415
    from screwkit.results.undecided import Undecided  # noqa: PLC0415

    open_question = Undecided(reason)
    whole = partial_analysis(parts, reason)
    if request.deliver is not None:
        if whole is not None:
            _deliver_what_can_be(request.deliver, whole)
        note(f"undecided: {reason}")
        if request.as_json:
            emit_json(request.job.case, {"status": "undecided", "reason": reason})
    elif request.as_json:
        _partial_json(request, open_question, whole, parts)
    elif whole is not None:
        emit(text_of(whole))
    else:
        for _, part in parts:
            if part is not None:
                emit(text_of(part))
        emit(text_of(open_question))


def _deliver_what_can_be(deliver: Callable[[Any], list[str]], whole: Any) -> None:
    """A part of an answer; that the rest is open is told without a tool as well."""
    try:
        note(*deliver(whole))
    except errors.MissingToolError as error:
        note(str(error))


def _partial_json(
    request: Request, refusal: Any, whole: Any, parts: tuple[tuple[str, Any], ...]
) -> None:
    from screwkit.reports.records import to_json  # noqa: PLC0415
    from screwkit.reports.wire import encode  # noqa: PLC0415

    head = to_json(refusal, request.job.case)
    if whole is not None:
        emit(json.dumps({**to_json(whole), **head}, indent=1) + "\n")
        return
    finished: dict[str, Any] = {"asked": request.job.question}
    for name, part in parts:
        if part is not None:
            finished.setdefault("finished", []).append({"part": name, **encode(part)})
    emit(json.dumps({**head, **finished}, indent=1) + "\n")


def emit(text: str) -> None:
    """Write to standard output."""
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader (head, less) has seen enough.
        _write_no_more()
    except OSError as error:
        _write_no_more()
        raise errors.OutputError(error) from None


def _write_no_more() -> None:
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def emit_json(case: str, content: Mapping[str, Any]) -> None:
    """Write one document to standard output."""
    from screwkit.reports.records import document  # noqa: PLC0415

    emit(json.dumps(document(case, content), indent=1) + "\n")


def note(*lines: str) -> None:
    """Write lines to standard error."""
    from screwkit.reports.printing import for_terminal  # noqa: PLC0415

    for line in lines:
        sys.stderr.write(for_terminal(line.rstrip("\n")) + "\n")
    sys.stderr.flush()


def _status_line(text: str) -> Any:
    """Text in which square brackets are no markup."""
    from rich.text import Text  # noqa: PLC0415

    from screwkit.reports.printing import printable  # noqa: PLC0415

    return Text(printable(text))


class Ticker:
    """Progress on standard error for work that takes more than a second.

    A terminal gets one line that changes; a file gets a line for each new stage.
    """

    def __init__(self) -> None:
        self._live: Any = None
        self._last = ("", 0.0)

    def __call__(self, stage: Stage) -> None:
        """Show where the work is."""
        if stage.elapsed < _QUIET_SECONDS:
            return
        text = f"{_where(stage)}  {stage.elapsed:.0f} s"
        if sys.stderr.isatty():
            self._status().update(_status_line(text))
        elif (
            stage.name != self._last[0] or stage.elapsed > 2 * self._last[1] + _REFRESH
        ):
            self._last = (stage.name, stage.elapsed)
            note(f"  {text}")

    def _status(self) -> Any:
        if self._live is None:
            from rich.console import Console  # noqa: PLC0415

            self._live = Console(stderr=True).status("", spinner="line")
            self._live.start()
        return self._live

    def close(self) -> None:
        """Take the changing line away."""
        if self._live is not None:
            self._live.stop()
