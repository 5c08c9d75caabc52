"""The installed program as a person or a script runs it, in processes of its own."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Final

import pytest

from screwkit.reports import typeset

ROOT: Final = Path(__file__).parent.parent
PROGRAM: Final = [sys.executable, "-m", "screwkit.cli"]
_COUNT: Final = re.compile(r"^  (?:Grübler|Moroskine|Gogu|screws).*= 4\b", re.MULTILINE)
needs_tex = pytest.mark.skipif(
    shutil.which("pdflatex") is None, reason="TeX is not installed"
)
needs_proc = pytest.mark.skipif(
    not Path("/proc/self/status").exists(), reason="processes are looked up in /proc"
)


def environment(**more: str) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(ROOT), **more}


def run(*words: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*PROGRAM, *words],
        capture_output=True,
        text=True,
        timeout=240,
        check=False,
        cwd=cwd,
        env=environment(),
    )


def answer(*words: str, code: int = 0) -> str:
    done = run(*words)
    assert done.returncode == code, done.stderr
    return done.stdout


def squeezed(text: str) -> str:
    return " ".join(text.split())


def marked(mark: str) -> list[int]:
    """Processes that carry a mark in their environment: this test's own."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdecimal():
            try:
                carried = (entry / "environ").read_bytes()
                state = (entry / "stat").read_text().rpartition(")")[2].split()[0]
            except OSError:
                continue
            if mark.encode() in carried and state != "Z":
                found.append(int(entry.name))
    return found


def gone(mark: str) -> bool:
    """Whether all of them have ended, within half a second."""
    for _ in range(10):
        if not marked(mark):
            return True
        time.sleep(0.05)
    return False


def test_mobility_says_every_count_and_the_motion() -> None:
    text = answer("mobility", "nao_t14")
    counts = re.findall(_COUNT, text)
    assert len(counts) == 4
    assert "the object has 4 freedoms: 1T3R" in text
    assert "10 − 6·1" in text
    assert "*" not in text


def test_singularities_are_solved_in_words_and_fit() -> None:
    text = answer("singularities", "nao_t14")
    assert "q4 = 0, π" in text
    assert "q2 = atan(−r3/d3)" in text
    assert "q7 = atan(r3/d3)" in text
    assert "axes 3 and 5 are one line" in text
    assert "2 and 4 " in text
    assert "complete" in text
    assert max(map(len, text.splitlines())) <= 100


def test_schemes_are_counted_and_refused_with_reasons() -> None:
    text = squeezed(answer("schemes", "nao_t14"))
    assert "210 ways to actuate 4 freedoms: 139 admissible" in text
    assert "100 with the same number in every limb, 63" in text
    assert "1 1 2 6 7 the platform can turn about the line" in text


def test_screws_do_not_repeat_their_kind() -> None:
    text = answer("screws", "nao_t14")
    assert "force  along the line" in text
    assert "force  force" not in text
    assert not re.search(r"rotation +rotation", text)


def test_the_bundled_cases_are_listed_for_scripts() -> None:
    document = json.loads(answer("cases", "--json"))
    assert document["schema"]
    keys = {"name": str, "title": str, "source": str, "joints": int, "loops": int}
    for entry in document["cases"]:
        assert {key: type(entry[key]) for key in keys} == keys
    assert "nao_t14" in {entry["name"] for entry in document["cases"]}


@needs_tex
def test_a_report_is_an_article_within_its_margins(tmp_path: Path) -> None:
    path = tmp_path / "report.pdf"
    done = run("report", "nao_t14", "--format", "pdf", "-o", str(path))
    assert done.returncode == 0, done.stderr
    assert "wrote" in done.stderr
    assert not done.stdout
    log = typeset_again(path.with_suffix(".tex"))
    pages = re.search(r"Output written on .*\((\d+) pages", log)
    assert pages is not None
    assert int(pages[1]) > 3
    wide = [float(w) for w in re.findall(r"Overfull \\hbox \(([\d.]+)pt", log)]
    assert max(wide, default=0.0) <= 10.0


@needs_tex
@pytest.mark.parametrize("case", ["dual_scara", "dual_puma", "three_arms"])
def test_reports_are_whole_however_far_the_work_came(case: str, tmp_path: Path) -> None:
    path = tmp_path / "report.pdf"
    options = ["--format", "pdf", "-o", str(path), "--timeout", "8"]
    done = run("report", case, *options)
    assert done.returncode in (0, 1, 4), done.stderr
    assert path.read_bytes().startswith(b"%PDF")
    log = typeset_again(path.with_suffix(".tex"))
    wide = [float(w) for w in re.findall(r"Overfull \\hbox \(([\d.]+)pt", log)]
    assert max(wide, default=0.0) <= 10.0


def typeset_again(source: Path) -> str:
    """The log of setting the source that a report leaves beside its PDF."""
    figures = {
        path.relative_to(source.parent).as_posix(): path.read_bytes()
        for path in source.parent.glob("figs/*")
    }
    pdf, log = typeset.typeset(source.read_text(encoding="utf-8"), files=figures)
    assert pdf.startswith(b"%PDF")
    return log


HOSTILE: Final = r"""screwkit: 1
name: hostile
title: '50% of \input{/etc/passwd} $x^2_ & <script>alert(1)</script> ~#{}'
source: '\write18{touch owned} & co_'
space: planar
geometry: posture
base: ground
platform: plate
links: [ground, bar, plate]
parameters: {l: {value: 1, positive: true}}
joints:
  - {name: 'A_1', type: revolute, parent: ground, child: bar, point: [0, 0]}
  - {name: '\def', type: revolute, parent: bar, child: plate, point: [l, 0]}
actuated: ['A_1', '\def']
"""


@needs_tex
def test_a_hostile_file_is_only_text(tmp_path: Path) -> None:
    case = tmp_path / "hostile.yaml"
    case.write_text(HOSTILE, encoding="utf-8")
    for form in ("pdf", "html"):
        path = tmp_path / f"report.{form}"
        done = run("report", str(case), "--format", form, "-o", str(path), cwd=tmp_path)
        assert done.returncode in (0, 1), done.stderr
        assert path.stat().st_size > 1000
    source = (tmp_path / "report.tex").read_text(encoding="utf-8")
    assert r"\input" not in source
    assert r"\write18" not in source
    assert "<script" not in (tmp_path / "report.html").read_text(encoding="utf-8")
    assert not (tmp_path / "owned").exists()


@needs_proc
def test_a_deadline_is_kept_and_leaves_nothing() -> None:
    mark = f"SCREWKIT_TEST_MARK=deadline-{os.getpid()}"
    name, value = mark.split("=")
    started = time.monotonic()
    done = subprocess.run(
        [*PROGRAM, "schemes", "nao_t14", "--timeout", "0.5", "--json"],
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
        env=environment(**{name: value}),
    )
    assert time.monotonic() - started < 2.5
    assert done.returncode == 4
    assert json.loads(done.stdout)["status"] == "undecided"
    assert gone(mark)


@needs_proc
def test_an_interrupt_is_obeyed_and_leaves_nothing() -> None:
    mark = f"SCREWKIT_TEST_MARK=interrupt-{os.getpid()}"
    name, value = mark.split("=")
    process = subprocess.Popen(
        [*PROGRAM, "schemes", "dual_puma", "--json"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env=environment(**{name: value}),
    )
    try:
        for _ in range(100):
            if len(marked(mark)) > 1:
                break
            time.sleep(0.05)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        sent = time.monotonic()
        output, _ = process.communicate(timeout=10)
    finally:
        process.kill()
        process.wait()
    assert time.monotonic() - sent < 2.0
    assert process.returncode == 130
    assert json.loads(output)["status"] == "undecided"
    assert gone(mark)


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["cases"], 0),
        (["check", "nao_t14"], 0),
        (["schemes", "dual_iiwa", "--candidates", "A1,A2", "--size", "1"], 1),
        (["mobility", "nao_t14", "--set", "nothing=1"], 2),
        (["mobility", "nao_t14", "--actuated", "99"], 2),
        (["mobility", "no_such_case"], 2),
        (["mobilty", "nao_t14"], 2),
        (["screws", "nao_t14", "--at", "q22=0"], 2),
        (["check", "BAD"], 3),
        (["mobility", "BAD"], 3),
        (["analyze", "nao_t14", "--timeout", "0.4"], 4),
    ],
)
def test_exit_codes_and_always_one_document(
    words: list[str], code: int, tmp_path: Path
) -> None:
    bad = tmp_path / "bad.yaml"
    bad.write_text("screwkit: 1\nname: x y\nfoo: 1\n", encoding="utf-8")
    given = [str(bad) if word == "BAD" else word for word in words]
    done = run(*given, "--json")
    assert done.returncode == code, done.stderr
    document: dict[str, Any] = json.loads(done.stdout)
    assert {"schema", "case", "version"} <= set(document)
    if code == 3:
        assert document["error"]["kind"] == "file"
    elif code == 2:
        assert document["error"]["kind"] == "usage"
    elif code == 4:
        assert document["status"] == "undecided"
