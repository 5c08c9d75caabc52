"""What options refuse: which one, why, and what there is instead."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import screwkit
from reports import samples

import screwkit as sk
from screwkit import guard, terminal
from screwkit.analyses.places import turns_of
from screwkit.errors import (
    ExpressionError,
    ScrewkitError,
    UnfitValueError,
    UnknownNameError,
)
from screwkit.reports import typeset
from screwkit.sliced import sliced_singularities
from screwkit.sweeps.executors import executor_of

ROOT = Path(__file__).parent.parent
CASE = "3rpr_planar"  # a2 is declared positive, a3x is not


@pytest.mark.parametrize("memory", ["1e10", "1e300"])
def test_more_memory_than_can_be_counted_is_no_limit(memory: str) -> None:
    assert screwkit("screws", "bennett", "--memory", memory, "--quiet") == 0


def test_a_symbol_that_has_its_value_is_not_called_unknown() -> None:
    with pytest.raises(UnknownNameError, match=r"'x' has been given a value already"):
        sk.load(CASE, set_values={"x": "1"}, at={"x": "2"})
    with pytest.raises(UnknownNameError, match=r"'x' has been given a value already"):
        sk.sweep(sk.load(CASE, set_values={"x": "1"}), ["x=0:1:3"])
    with pytest.raises(UnknownNameError, match=r"'x' has been given a value already"):
        sk.schemes(sk.load(CASE, set_values={"x": "1"}), rank=3, within=["x=0:1"])


def test_what_there_is_instead_is_listed() -> None:
    case = sk.load(CASE)
    with pytest.raises(
        UnknownNameError, match=r"'zz' in 3rpr_planar; there are base, pla"
    ):
        sk.relative_motion(case, "zz")
    with pytest.raises(UnknownNameError, match=r"'zz'; there are platform, cyl1"):
        turns_of(case.mechanism, {"zz": "1"})
    with pytest.raises(UnknownNameError, match=r"'foo'; there are kinematic.min, "):
        sk.sweep(case, ["x=0:1:3"], "foo")
    with pytest.raises(UnknownNameError, match=r"'zz' to vary; there are a2, a3x"):
        sk.sweep(case, ["zz=0:1:3"])


def test_a_number_that_is_none_is_told_with_what_it_was_for() -> None:
    case = sk.load(CASE)
    with pytest.raises(ExpressionError, match=r"'x=0:nan:3': unknown name 'nan'; the "):
        sk.sweep(case, ["x=0:nan:3"])
    with pytest.raises(ExpressionError, match=r"'x=0:foo': unknown name 'foo'; the e"):
        sk.schemes(case, rank=3, within=["x=0:foo"])
    with pytest.raises(ExpressionError, match=r"'a2' is no length that counts as one "):
        sk.manipulability(case, length="a2")


def test_ranges_hold_what_the_file_demands() -> None:
    case = sk.load(CASE)
    for text in ("a2=0:1:3", "a2=1:-1:3"):
        with pytest.raises(UnfitValueError, match=r"'a2' is declared positive, but"):
            sk.sweep(case, [text])
    assert sk.sweep(case, ["a2=0.5:1:2"]).values.shape == (2,)
    assert sk.sweep(case, ["a3x=-1:1:2"]).values.shape == (2,)


@pytest.mark.parametrize(
    ("ranges", "said"),
    [
        (["a2=-1:1", "y=0:1"], r"'a2' is declared positive"),
        (["x=0:1", "y"], r"^'y' is no range; write NAME=FROM:TO$"),
        (["x=0", "y=0:1"], r"^'x=0' is no range; write NAME=FROM:TO$"),
        (["x=0:1:1000000", "y=0:1:1000000"], r"1e\+12 points are more than"),
        (["zz=0:1", "y=0:1"], r"no symbol 'zz' to vary; there are"),
    ],
)
def test_a_slice_tells_of_its_ranges_before_its_file(
    ranges: list[str], said: str
) -> None:
    with pytest.raises(ScrewkitError, match=said):
        sliced_singularities(sk.load(CASE), ranges, Path(), sk.singularities)


def test_a_scheduler_that_does_not_answer_is_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import distributed  # noqa: PLC0415

    def away(address: str) -> None:
        raise OSError(f"Timed out trying to connect to {address}")

    monkeypatch.setattr(distributed, "Client", away)
    with (
        pytest.raises(ScrewkitError, match=r"no Dask scheduler answers at 'tcp://x:1'"),
        executor_of(0, "tcp://x:1"),
    ):
        pass


def test_one_point_is_no_points() -> None:
    answer = sk.sweep(sk.load(CASE), ["x=1:1:1"]).answer
    assert "kinematic.min at 1 point: " in terminal.text_of(answer)


def test_without_actuators_nothing_holds() -> None:
    (scheme,) = sk.schemes(sk.load(CASE), size=0).schemes
    assert scheme.reason == "without actuators nothing holds the platform's 3 freedoms"


@pytest.mark.parametrize(
    ("form", "ending"), [("latex", "pdf"), ("latex", "html"), ("pdf", "tex")]
)
def test_a_report_of_another_ending_is_2(
    form: str, ending: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert screwkit("report", CASE, "--format", form, "-o", f"a.{ending}") == 2
    assert f"a.{ending}: a report with this ending" in capsys.readouterr().err
    assert not Path(f"a.{ending}").exists()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is full")
@pytest.mark.parametrize("words", ["doctor", "cases --json", "check nao_t14"])
@pytest.mark.parametrize(
    ("output", "said"),
    [("> /dev/full", "no space left on device"), (">&-", "it is closed")],
)
def test_an_output_that_takes_nothing_is_2_in_one_line(
    words: str, output: str, said: str
) -> None:
    done = subprocess.run(
        f"{sys.executable} -m screwkit.cli {words} {output}",
        shell=True,
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert done.returncode == 2
    assert done.stderr == f"screwkit: cannot write to standard output: {said}\n"


@pytest.mark.parametrize(("options", "code"), [((), 5), (("--timeout", "9"), 4)])
def test_no_tex_is_5_and_no_time_4(
    options: tuple[str, ...],
    code: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def outcome(*_: object, **__: object) -> guard.Outcome:
        if not options:
            return guard.Answered(samples.ANALYSIS)
        parts = (("description", samples.DESCRIPTION), ("mobility", samples.MOBILITY))
        return guard.Stopped("timeout", guard.Stage("screws", "", 9.0), parts)

    monkeypatch.setattr(terminal, "run", outcome)
    monkeypatch.setattr(typeset, "is_available", lambda: False)
    place = str(tmp_path / "a.pdf")
    words = ("report", "nao_t14", "--format", "pdf", "-o", place, *options)
    assert screwkit(*words) == code
    errors = capsys.readouterr().err
    assert "and no PDF: pdflatex is not installed" in errors
    assert ("undecided: out of time" in errors) == (code == 4)
    assert (tmp_path / "a.tex").exists()
