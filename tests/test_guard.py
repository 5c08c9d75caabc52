"""The exact work in its child process: progress, deadlines, deaths, refusals."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from reports import samples

from screwkit.guard import Answered, Died, Refused, Stage, Stopped, run
from screwkit.worker import Job, job_from_line

TESTS = Path(__file__).parent
ROOT = TESTS.parent


@pytest.fixture(autouse=True)
def _reachable(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The child finds the fake analyses, and starts in a folder of its own."""
    monkeypatch.setenv("PYTHONPATH", f"{ROOT}{os.pathsep}{TESTS}")
    monkeypatch.chdir(tmp_path)


def job(name: str, **options: str) -> Job:
    target = f"reports.fake_analyses:{name}"
    return Job("mobility", "", options=options, target=target)


def gone(pid: int) -> bool:
    """Whether a process has ended, or is about to be collected."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").split()[2]
    except FileNotFoundError:
        return True
    return state == "Z"


def wait_for(condition: Path, seconds: float = 5.0) -> str:
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if condition.exists() and condition.read_text(encoding="ascii"):
            return condition.read_text(encoding="ascii")
        time.sleep(0.02)
    raise AssertionError(f"{condition} did not appear")


def test_a_job_survives_its_line() -> None:
    asked = Job("schemes", "arm.yaml", {"d3": "0.02"}, ("1", "2"), {"size": 4}, 10**9)
    assert job_from_line(asked.to_line()) == asked


def test_an_answer_comes_back_whole() -> None:
    assert run(job("quick")) == Answered(samples.MOBILITY)


def test_prints_of_libraries_do_not_spoil_the_answer() -> None:
    assert run(job("noisy")) == Answered(samples.SCHEMES)


def test_out_of_time_keeps_the_parts_and_kills_the_family(tmp_path: Path) -> None:
    witness = tmp_path / "pid"
    stages: list[Stage] = []
    started = time.monotonic()
    outcome = run(job("slow", witness=str(witness)), timeout=1.0, watch=stages.append)
    assert time.monotonic() - started < 2.5
    assert isinstance(outcome, Stopped)
    assert outcome.cause == "timeout"
    assert dict(outcome.parts)["mobility"] == samples.MOBILITY
    assert stages[-1].name == "expanding minors"
    time.sleep(0.1)
    assert gone(int(wait_for(witness)))


def test_a_part_that_grows_is_kept_once() -> None:
    outcome = run(job("growing"))
    assert isinstance(outcome, Refused)
    titles = [(name, part.title) for name, part in outcome.parts]
    assert titles == [("mobility", samples.MOBILITY.title), ("distance", "farther")]


def test_a_death_is_an_undecided_answer() -> None:
    outcome = run(job("dies"))
    assert isinstance(outcome, Died)
    assert "aborted" in outcome.reason


def test_the_memory_limit_is_kept() -> None:
    greedy = Job("mobility", "", target="reports.fake_analyses:greedy", memory=1 << 30)
    outcome = run(greedy)
    assert isinstance(outcome, Refused)
    assert outcome.kind == "undecided"
    assert outcome.message == (
        "the exact computation ran out of memory (limit 1 GB; --memory raises it)"
    )


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("without_room", "undecided"),
        ("without_room_inside", "undecided"),
        ("broken_import", "defect"),
        ("nothing_may_run", "defect"),
    ],
)
def test_only_what_finds_no_room_asks_for_more_memory(name: str, kind: str) -> None:
    target = f"reports.fake_analyses:{name}"
    outcome = run(Job("mobility", "", target=target, memory=4 << 30))
    assert isinstance(outcome, Refused)
    assert outcome.kind == kind
    assert ("do not fit into 4 GB" in outcome.message) == (kind == "undecided")


@pytest.mark.parametrize(
    ("name", "kind"),
    [("too_large", "undecided"), ("wrong_file", "file"), ("defective", "defect")],
)
def test_refusals_keep_their_kind(name: str, kind: str) -> None:
    outcome = run(job(name))
    assert isinstance(outcome, Refused)
    assert outcome.kind == kind
    if kind == "file":
        assert [fault.line for fault in outcome.faults] == [14, 22]
    if kind == "defect":
        assert "Traceback" in outcome.trace


DRIVER = """
import sys
from screwkit.terminal import Request, ask
from screwkit.worker import Job
job = Job("analyze", "", options={"witness": sys.argv[1]},
          target="reports.fake_analyses:slow")
sys.exit(ask(Request(job, timeout=float(sys.argv[2]), as_json="--json" in sys.argv)))
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_everything_with_130(
    number: signal.Signals, tmp_path: Path
) -> None:
    witness = tmp_path / "pid"
    with subprocess.Popen(
        [sys.executable, "-c", DRIVER, str(witness), "60"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        grandchild = int(wait_for(witness))
        time.sleep(0.3)
        sent = time.monotonic()
        process.send_signal(number)
        output, errors = process.communicate(timeout=5)
    assert time.monotonic() - sent < 2
    assert process.returncode == 130
    assert "the object has 4 freedoms: 1T3R" in output
    assert "undecided: interrupted (expanding minors, 6 x 10)" in output
    assert "Traceback" not in errors
    assert gone(grandchild)


def test_out_of_time_is_4_and_one_document(tmp_path: Path) -> None:
    import json  # noqa: PLC0415

    witness = tmp_path / "pid"
    done = subprocess.run(
        [sys.executable, "-c", DRIVER, str(witness), "1", "--json"],
        capture_output=True,
        text=True,
        timeout=10,
        check=False,
    )
    assert done.returncode == 4
    document = json.loads(done.stdout)
    assert document["mobility"]["loop_rank"] == 6
    assert document["schemes"]["status"] == "undecided"
    assert "out of time after 1 s" in document["reason"]
