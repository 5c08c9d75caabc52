"""The commands: exit codes, one document, one line an error, nothing heavy at start."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from functools import cache
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from command_line import screwkit
from reports import samples

from screwkit import catalogue, guard, terminal
from screwkit.errors import Fault
from screwkit.reports.records import json_schema_of_results
from screwkit.requests import freedoms_in
from screwkit.results.screws import Screws

ROOT = Path(__file__).parent.parent
ANSWERS = {
    "mobility": samples.MOBILITY,
    "screws": samples.SCREWS,
    "singularities": samples.SINGULARITIES,
    "schemes": samples.SCHEMES,
    "analyze": samples.ANALYSIS,
}


def why_unfit(schema: Any, data: Any, whole: Any = None, place: str = "$") -> str:
    """Where a document breaks a JSON Schema, of what the schemas here make use of."""
    whole = whole or schema
    if "$ref" in schema:
        name = schema["$ref"].rpartition("/")[2]
        return why_unfit(whole["$defs"][name], data, whole, place)
    if "const" in schema and data != schema["const"]:
        return f"{place} is not {schema['const']!r}"
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if kinds and not any(_is_of(kind, data) for kind in kinds):
        return f"{place} is no {kinds}"
    if isinstance(data, dict):
        missing = set(schema.get("required", ())) - set(data)
        if missing:
            return f"{place} has no {sorted(missing)}"
        properties = schema.get("properties", {})
        for key in properties.keys() & data.keys():
            if why := why_unfit(properties[key], data[key], whole, f"{place}.{key}"):
                return why
    if isinstance(data, list) and "items" in schema:
        for number, item in enumerate(data):
            if why := why_unfit(schema["items"], item, whole, f"{place}.{number}"):
                return why
    for part in schema.get("allOf", []):
        if why := why_unfit(part, data, whole, place):
            return why
    told = [why_unfit(part, data, whole, place) for part in schema.get("anyOf", [])]
    return "" if not all(told) else " and ".join(told)


def _is_of(kind: str, data: Any) -> bool:
    if isinstance(data, bool):
        return kind == "boolean"
    types: dict[str, type | tuple[type, ...]] = {
        "object": dict,
        "array": list,
        "string": str,
        "integer": int,
        "number": (int, float),
        "null": type(None),
    }
    return kind in types and isinstance(data, types[kind])


class Answering:
    """Stands for the engine: remembers the job and gives the prepared outcome."""

    def __init__(self) -> None:
        self.jobs: list[Any] = []
        self.outcome: guard.Outcome | None = None

    def __call__(self, job: Any, **_: Any) -> guard.Outcome:
        self.jobs.append(job)
        return self.outcome or guard.Answered(ANSWERS[job.question])


@pytest.fixture
def engine(monkeypatch: pytest.MonkeyPatch) -> Answering:
    answering = Answering()
    monkeypatch.setattr(terminal, "run", answering)
    return answering


def python(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *words],
        capture_output=True,
        text=True,
        timeout=20,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("command", ["mobility", "screws", "schemes"])
def test_an_answer_is_0(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert screwkit(command, "nao_t14") == 0
    output, errors = capsys.readouterr()
    assert output.startswith(samples.TITLE)
    assert not errors


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("command", list(ANSWERS))
def test_json_is_one_document(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    screwkit(command, "nao_t14", "--json")
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "screwkit/1"
    assert document["case"] == "nao_t14"
    assert isinstance(document["version"], str)


@pytest.mark.usefixtures("engine")
def test_what_is_not_proved_complete_is_1() -> None:
    assert screwkit("singularities", "nao_t14") == 1


def test_the_program_tells_its_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert screwkit("--version") == 0
    said = capsys.readouterr().out.split()
    assert said == ["screwkit", metadata.version("screwkit")]


def test_a_scheme_that_is_not_admissible_is_1(engine: Answering) -> None:
    answer = samples.SINGULARITIES
    assert answer.actuation is not None
    complete = replace(answer, constraint=replace(answer.constraint, complete=True))
    engine.outcome = guard.Answered(complete)
    assert screwkit("singularities", "nao_t14") == 0
    refused = replace(answer.actuation, admissible=False, components=())
    engine.outcome = guard.Answered(replace(complete, actuation=refused))
    assert screwkit("singularities", "nao_t14") == 1


def test_options_reach_the_job(engine: Answering) -> None:
    values = ["--set", "d3=0.02", "--set", "r3=1/3"]
    limits = ["--actuated", "1,2,3:0", "--memory", "2"]
    screwkit("mobility", "arm.yaml", *values, *limits)
    (job,) = engine.jobs
    assert job.case == "arm.yaml"
    assert job.set_values == {"d3": "0.02", "r3": "1/3"}
    assert job.actuated == ("1", "2", "3:0")
    assert job.memory == 2 << 30


def test_without_a_limit_three_quarters_of_the_memory_are_taken(
    engine: Answering, monkeypatch: pytest.MonkeyPatch
) -> None:
    sizes = {"SC_PAGE_SIZE": 4096, "SC_PHYS_PAGES": 1 << 21}  # 8 GB
    monkeypatch.setattr(os, "sysconf", sizes.__getitem__)
    screwkit("mobility", "arm.yaml")
    assert engine.jobs[0].memory == 6 << 30


def test_options_of_schemes_reach_the_analysis(engine: Answering) -> None:
    screwkit("schemes", "nao_t14", "--size", "5", "--candidates", "1,2,3")
    assert engine.jobs[0].options == {"size": 5, "candidates": ["1", "2", "3"]}


def test_a_distance_is_a_question_of_its_own(engine: Answering) -> None:
    asked = ["singularities", "nao_t14", "--distance", "--at", "q4=0.3"]
    screwkit(*asked, "--length", "1/2", "--within", "q4=0:1")
    (job,) = engine.jobs
    options = {"length": "1/2", "within": ["q4=0:1"]}
    assert (job.question, job.options) == ("distance", options)
    assert job.at == {"q4": "0.3"}


@pytest.mark.parametrize("command", ["analyze", "report"])
def test_distances_are_a_part_where_asked_for(engine: Answering, command: str) -> None:
    screwkit(command, "nao_t14", "--distance")
    screwkit(command, "nao_t14")
    assert [job.options for job in engine.jobs] == [{"distances": True}, {}]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--length", "2"], "give --distance with it"),
        (["--within", "q4=0:1"], "give --distance with it"),
        (["--distance", "--all"], "ask without --all"),
        (["--distance", "--slice", "x=0:1"], "ask without --slice"),
        (["--distance", "--certificate", "c.json"], "ask without --certificate"),
    ],
)
def test_a_distance_goes_without_what_is_of_loci(
    engine: Answering, capsys: pytest.CaptureFixture[str], options: list[str], said: str
) -> None:
    assert screwkit("singularities", "nao_t14", *options) == 2
    assert said in " ".join(capsys.readouterr().err.split())
    assert not engine.jobs


@pytest.mark.parametrize("command", ["schemes", "analyze", "report"])
def test_a_ranking_reaches_the_analysis(
    engine: Answering, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    screwkit(
        command, "nao_t14", "--rank", "9", "--within", "q1=0:1", "--within", "a=0:2"
    )
    assert engine.jobs[0].options == {"rank": 9, "within": ["q1=0:1", "a=0:2"]}
    screwkit(command, "nao_t14", "--add")
    assert engine.jobs[1].options == {"add": True}


def test_a_wrong_file_is_3_with_all_faults(
    engine: Answering, capsys: pytest.CaptureFixture[str]
) -> None:
    faults = (Fault(14, 38, "unknown name 'd_3'"), Fault(22, 12, "the axis is zero"))
    engine.outcome = guard.Refused("file", "", source="arm.yaml", faults=faults)
    assert screwkit("mobility", "arm.yaml", "--json") == 3
    output, errors = capsys.readouterr()
    assert errors.splitlines() == [
        "arm.yaml:14:38  unknown name 'd_3'",
        "arm.yaml:22:12  the axis is zero",
        "2 errors; nothing was computed",
    ]
    assert json.loads(output)["error"]["faults"][1]["column"] == 12


@pytest.mark.parametrize(
    ("kind", "code"), [("usage", 2), ("tool", 5), ("undecided", 1), ("defect", 1)]
)
def test_refusals_have_their_codes(
    kind: str, code: int, engine: Answering, capsys: pytest.CaptureFixture[str]
) -> None:
    engine.outcome = guard.Refused(kind, "because")
    assert screwkit("mobility", "nao_t14", "--json") == code
    document = json.loads(capsys.readouterr().out)
    if kind == "undecided":
        assert document["status"] == "undecided"
        assert document["reason"] == "because"
    else:
        assert document["error"]["kind"] == kind


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["mobilty", "nao_t14"], "Did you mean 'mobility'"),
        (["mobility"], "Missing argument"),
        (["mobility", "nao_t14", "--set", "d3"], "is not NAME=VALUE"),
        (["mobility", "nao_t14", "--at", "q2"], "is not NAME=VALUE"),
        (["screws", "nao_t14", "--order", "odd"], "--order"),
        (["mobility", "a.yaml", "--set", "a=1", "--set", "a=2"], "gives 'a' two val"),
        (["mobility", "a.yaml", "--actuated", "A,B, A"], "names 'A' twice"),
        (["mobility", "a.yaml", "--actuated", ""], "has an empty name"),
        (["mobility", "a.yaml", "--actuated", "A,,B"], "has an empty name"),
        (["mobility", "a.yaml", "--actuated", 'A,"B'], "stands in quotes"),
        (["mobility", "a.yaml", "--actuated", "A\nB"], "stands in quotes"),
        (["schemes", "a.yaml", "--candidates", "A,"], "--candidates 'A,' has an empty"),
        (["mobility", "a.yaml", "--memory", "inf"], "--memory inf is no number"),
        (["mobility", "a.yaml", "--timeout", "inf"], "--timeout inf is no number"),
        (["schemes", "a.yaml", "--within", "a=0:1"], "give --rank POSTURES with it"),
        (["schemes", "a.yaml", "--length", "2"], "give --rank POSTURES with it"),
        (["schemes", "a.yaml", "-o", "x.foo"], "written as .tex, .csv, .json, .txt"),
        (["schemes", "a.yaml", "-o", "x"], "x: schemes are written as .tex, .csv"),
        (["check", ""], "the name of the case is empty"),
        (["check", "bad.yaml"], "no such file: 'bad.yaml'"),
        (["check", "nao_t14.yaml"], "did you mean the bundled case 'nao_t14'?"),
        (["check", "nowhere/a.yaml"], "there is no folder 'nowhere'"),
        (
            ["check", "3rpr_planar", "--variant", "x"],
            "it has concurrent_legs, ",
        ),
        (["check", "nao_t14", "--set", "foo=3"], "no symbol 'foo' in nao_t14; it has "),
        (["check", "nao_t14", "--set", "d3=foo"], "--set d3=foo: unknown name 'foo'"),
        (
            ["check", "five_bar#distal_collinear", "--variant", "stretched_leg"],
            "two variants are named",
        ),
    ],
)
@pytest.mark.usefixtures("engine")
def test_usage_is_2_in_one_line(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert screwkit(*words, "--json") == 2
    output, errors = capsys.readouterr()
    assert said in errors
    assert len(errors.splitlines()) == 1
    assert json.loads(output)["error"]["kind"] == "usage"


def test_a_name_with_a_comma_stands_in_quotes() -> None:
    assert freedoms_in("--actuated", '"a,b", left hip') == ("a,b", "left hip")


def test_linear_order_swaps_both_halves(
    engine: Answering, capsys: pytest.CaptureFixture[str]
) -> None:
    screwkit("screws", "nao_t14", "--order", "linear", "--json")
    document = json.loads(capsys.readouterr().out)
    assert document["order"] == "moment-direction"
    twist = ["-b1", "0", "0", "0", "1", "0"]
    assert document["limbs"][0]["twists"][0] == twist
    assert isinstance(ANSWERS["screws"], Screws)
    assert len(engine.jobs) == 1


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("ending", [".tex", ".csv", ".json", ".txt"])
def test_schemes_go_to_a_file(
    ending: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"schemes{ending}"
    assert screwkit("schemes", "nao_t14", "-o", str(path)) == 0
    output, errors = capsys.readouterr()
    assert not output
    assert errors == f"wrote {path}\n"
    assert "1" in path.read_text(encoding="utf-8")
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("change", [{"complete": False}, {"admissible": 0}])
def test_a_file_does_not_change_what_the_answer_is(
    change: dict[str, Any], engine: Answering, tmp_path: Path
) -> None:
    """1: done, and the answer is negative or undecided; written or shown."""
    engine.outcome = guard.Answered(replace(samples.SCHEMES, **change))
    path = tmp_path / "schemes.csv"
    assert screwkit("schemes", "nao_t14", "--quiet") == 1
    assert screwkit("schemes", "nao_t14", "--quiet", "-o", str(path)) == 1
    assert path.exists()


@pytest.mark.parametrize("as_json", [False, True])
def test_an_interrupt_while_libraries_load_leaves_quietly(as_json: bool) -> None:
    """Ctrl-C arrives when the first library beside our own is asked for."""
    code = (
        "import os, signal, sys\n"
        "class Interrupting:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        "        if name == 'typer':\n"
        "            os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.meta_path.insert(0, Interrupting())\n"
        "from screwkit.cli import main\n"
        "main(sys.argv[1:])\n"
    )
    words = ["mobility", "nao_t14", *(["--json"] if as_json else [])]
    done = python("-c", code, *words)
    assert done.returncode == 130
    assert done.stderr == "screwkit: interrupted\n"
    if as_json:
        told = json.loads(done.stdout)
        assert told["error"] == {"kind": "interrupted", "message": "interrupted"}
        assert told.keys() >= {"schema", "case", "version"}
    else:
        assert not done.stdout


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize(
    "words",
    [
        ("schemes", "nao_t14", "-o", "{}/a.csv"),
        ("report", "nao_t14", "--format", "html", "-o", "{}/a.html"),
        ("report", "nao_t14", "-o", "{}/a.tex"),
    ],
)
def test_what_cannot_be_written_is_2_in_words(
    words: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "file"
    file.touch()
    assert screwkit(*(word.format(file) for word in words)) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"screwkit: cannot write {file}/a.")
    assert "Errno" not in line


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("command", ["singularities", "schemes"])
def test_all_shows_lists_in_full(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    screwkit(command, "nao_t14", "--all")
    text = capsys.readouterr().out
    assert text.startswith(samples.TITLE)
    assert "--all" not in text


def test_check_takes_the_common_options(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--set", "d3=0.02", "--actuated", "1,2,3,6", "--timeout", "5"]
    assert screwkit("check", "nao_t14", *options) == 0
    assert "12 bodies, 12 joints with 10 freedoms, 1 loop" in capsys.readouterr().out
    assert screwkit("check", "nao_t14", "--set", "nothing=1") == 2


def test_nothing_that_is_printed_commands_the_terminal(
    engine: Answering, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    evil = "\x1b[2J\u202ex"
    text = (ROOT / "tests" / "mechanism" / "four_bar.yaml").read_text("utf-8")
    path = tmp_path / f"{evil}.yaml"
    path.write_text(text.replace("title: Planar", f"title: {evil!a} #"), "utf-8")
    screwkit("check", str(path))
    screwkit("check", str(tmp_path / evil / "none.yaml"))
    engine.outcome = guard.Refused("file", "", str(path), (Fault(1, 1, evil),))
    screwkit("mobility", "arm.yaml")
    engine.outcome = guard.Refused("usage", evil)
    screwkit("mobility", "arm.yaml")
    engine.outcome = guard.Answered(replace(samples.MOBILITY, title=evil))
    screwkit("mobility", "arm.yaml")
    output, errors = capsys.readouterr()
    assert output.startswith(f"{tmp_path}/ [2J x.yaml: right")
    assert (output + errors).replace("\n", "").isprintable()


def test_a_variant_reaches_the_job_with_its_case(engine: Answering) -> None:
    screwkit("mobility", "arm.yaml", "--variant", "short")
    assert (engine.jobs[0].case, engine.jobs[0].variant) == ("arm.yaml", "short")


@pytest.mark.parametrize("command", ["check", "mobility", "analyze"])
def test_an_unknown_variant_is_2(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert screwkit(command, "nao_t14", "--variant", "x", "--quiet") == 2
    assert "no variant 'x' of nao_t14" in capsys.readouterr().err


def test_cases_say_what_they_are_known_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert screwkit("cases", "--json") == 0
    listed = json.loads(capsys.readouterr().out)["cases"]
    keys = {"name", "title", "source", "joints", "loops", "known_for", "variants"}
    assert all(entry.keys() == keys for entry in listed)
    assert catalogue._headline("Four-bar", "being simple") == "Four-bar – being simple"
    assert catalogue._headline("Four-bar", "a long story " * 9) == "Four-bar"


@pytest.mark.usefixtures("engine")
def test_a_latex_report_has_fragments_and_results(tmp_path: Path) -> None:
    path = tmp_path / "paper" / "arms.tex"
    assert screwkit("report", "nao_t14", "-o", str(path), "--quiet") == 0
    folder = path.parent
    assert {entry.name for entry in folder.iterdir()} == {
        "arms.tex",
        "fragments",
        "results.json",
    }
    assert (folder / "fragments" / "geometry.tex").exists()
    results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
    assert results["question"] == "analyze"


def test_partial_reports_are_4(engine: Answering, tmp_path: Path) -> None:
    parts = (
        ("description", samples.DESCRIPTION),
        ("mobility", samples.MOBILITY),
    )
    stage = guard.Stage("expanding", "", 1.0)
    engine.outcome = guard.Stopped("timeout", stage, parts)
    path = tmp_path / "report.html"
    words = ["--format", "html", "-o", str(path), "--timeout", "1"]
    assert screwkit("report", "nao_t14", *words) == 4
    assert "Undecided" in path.read_text(encoding="utf-8")


def test_a_certificate_is_written_and_checked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "proof.json"
    words = ("singularities", "generic_6r", "--certificate", str(path), "--quiet")
    assert screwkit(*words) == 0
    capsys.readouterr()
    assert screwkit("verify", str(path), "generic_6r") == 0
    assert "accepted" in capsys.readouterr().out
    assert screwkit("verify", str(path), "bennett") == 1
    assert "another mechanism" in capsys.readouterr().out
    document = json.loads(path.read_text(encoding="utf-8"))
    document["parts"][0]["rank"] -= 1
    path.write_text(json.dumps(document), encoding="utf-8")
    assert screwkit("verify", str(path), "--json") == 1
    answer = json.loads(capsys.readouterr().out)
    assert answer["question"] == "verify"
    assert answer["accepted"] is False
    assert "rank" in answer["reason"]
    assert screwkit("verify", str(tmp_path / "none.json")) == 2


def test_a_certificate_speaks_of_all_schemes_though_some_are_listed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "schemes.json"
    words = ("schemes", "five_bar", "--balanced", "--json", "--certificate", str(path))
    assert screwkit(*words) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["certificate"] == str(path)
    document = json.loads(path.read_text(encoding="utf-8"))
    claims = document["schemes"]["schemes"]
    assert len(claims) == printed["total"] > len(printed["schemes"])
    assert screwkit("verify", str(path), "five_bar") == 0
    said = f"{len(claims)} schemes: {printed['admissible']} admissible"
    assert said in capsys.readouterr().out


def test_help_is_quick_and_light() -> None:
    heavy = ("sympy", "flint", "networkx", "pydantic", "numpy", "scipy")
    program = (
        "import sys\n"
        "from screwkit import cli\n"
        "try:\n    cli.main(['--help'])\n"
        "except SystemExit as stop:\n"
        f"    loaded = [m for m in {heavy!r} if m in sys.modules]\n"
        "    print('LOADED', loaded, stop.code)\n"
    )
    started = time.monotonic()
    done = python("-c", program)
    assert time.monotonic() - started < 2.0
    assert "LOADED [] 0" in done.stdout
    assert "screwkit mobility nao_t14" in done.stdout


def test_a_closed_pipe_is_no_error() -> None:
    command = f"{sys.executable} -m screwkit.cli doctor | head -n 1"
    done = subprocess.run(
        command,
        shell=True,
        capture_output=True,
        text=True,
        timeout=20,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert done.stdout.startswith("python")
    assert not done.stderr


def test_doctor_and_schema_answer_in_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert screwkit("doctor", "--json") == 0
    tools = json.loads(capsys.readouterr().out)["tools"]
    assert {"python", "pdflatex", "msolve"} <= {tool["name"] for tool in tools}
    assert screwkit("schema", "results") == 0
    assert json.loads(capsys.readouterr().out)["$defs"]["Mobility"]


@pytest.mark.usefixtures("engine")
@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="TeX is not installed")
def test_a_pdf_report_leaves_its_source_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "report.pdf"
    assert screwkit("report", "nao_t14", "--format", "pdf", "-o", str(path)) == 0
    assert path.read_bytes().startswith(b"%PDF")
    assert sorted(entry.name for entry in tmp_path.iterdir()) == [
        "report.pdf",
        "report.tex",
    ]


needs_engine = pytest.mark.skipif(
    find_spec("screwkit.case") is None, reason="the engine is not there yet"
)


@needs_engine
def test_a_bundled_case_end_to_end(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "screwkit.cli", "mobility", "nao_t14", "--json"],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["platform"]["motion_type"] == "1T3R"


@needs_engine
def test_an_unknown_case_is_2() -> None:
    done = python("-m", "screwkit.cli", "mobility", "no_such_case", "--quiet")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1


def test_check_tells_all_faults_of_a_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text("screwkit: 1\nname: x y\nfoo: 1\n", encoding="utf-8")
    assert screwkit("check", str(path)) == 3
    errors = capsys.readouterr().err.splitlines()
    assert any(line.startswith(f"{path}:3:1  unknown key 'foo'") for line in errors)
    assert errors[-1] == f"{len(errors) - 1} errors; nothing was computed"


def test_check_summarises_a_right_file(capsys: pytest.CaptureFixture[str]) -> None:
    path = ROOT / "cases" / "nao_t14.yaml"
    assert screwkit("check", str(path)) == 0
    assert "12 bodies, 12 joints with 10 freedoms" in capsys.readouterr().out
    assert screwkit("check", str(path), "--json") == 0
    assert json.loads(capsys.readouterr().out)["valid"] is True


# -- bodies, postures and documents, without a stand-in for the engine -----------------


@cache
def asked(*words: str) -> tuple[int, str, str]:
    """Exit code, output and errors of a command that runs in its own process.

    Without what tells of progress, which depends on how busy the machine is.
    """
    done = python("-m", "screwkit.cli", *words)
    told = [line for line in done.stderr.splitlines(True) if line[:2] != "  "]
    return done.returncode, done.stdout, "".join(told)


def test_body_and_relative_to_reach_the_job(engine: Answering) -> None:
    engine.outcome = guard.Answered(samples.SCREWS)
    screwkit("screws", "nao_t14", "--body", "r3", "--relative-to", "l3")
    (job,) = engine.jobs
    assert job.question == "relative_motion"
    wanted = {"body": "r3", "relative_to": "l3", "order": "angular"}
    assert dict(job.options) == wanted
    screwkit("screws", "nao_t14", "--relative-to", "l3", "--order", "linear")
    wanted = {"body": "", "relative_to": "l3", "order": "linear"}
    assert dict(engine.jobs[1].options) == wanted


def test_at_reaches_the_job(engine: Answering) -> None:
    screwkit("mobility", "nao_t14", "--at", "q4=0", "--at", "q9=-pi/3")
    assert engine.jobs[0].at == {"q4": "0", "q9": "-pi/3"}


@needs_engine
def test_memory_that_the_libraries_alone_need() -> None:
    code, output, _ = asked("mobility", "bennett", "--memory", "0.1")
    assert code == 1
    assert "do not fit into 0.1 GB; raise the limit" in output or "memory" in output
    assert "internal error" not in output


@needs_engine
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--size", "99"), "schemes of 99 joints are asked for, but bennett has 4 can"),
        (("--candidates", "A", "--size", "2"), "bennett has 1 candidate (A)"),
    ],
)
def test_more_joints_than_candidates_is_2(words: tuple[str, ...], said: str) -> None:
    code, output, errors = asked("schemes", "bennett", *words)
    assert (code, output) == (2, "")
    assert said in errors


@needs_engine
def test_a_body_of_a_four_bar_relative_to_another() -> None:
    """Crank and rocker are hinged to the base: seen from each other they turn."""
    words = ("screws", "four_bar_planar", "--body", "crank", "--relative-to", "rocker")
    code, output, errors = asked(*words, "--json")
    assert (code, errors) == (0, "")
    document = json.loads(output)
    assert document["question"] == "relative_motion"
    assert (document["body"], document["relative_to"]) == ("crank", "rocker")
    assert (document["twist_dimension"], document["wrench_dimension"]) == (1, 5)
    (twist,) = document["twist_details"]
    assert twist["kind"] == "rotation"


@needs_engine
@pytest.mark.parametrize(
    "words", [("--body", "cranc"), ("--relative-to", "cranc"), ("--body", "Crank")]
)
def test_an_unknown_body_is_2_with_the_nearest(words: tuple[str, str]) -> None:
    code, output, errors = asked("screws", "four_bar_planar", *words, "--json")
    assert code == 2
    (line,) = errors.splitlines()
    assert f"no link {words[1]!r}" in line
    assert "did you mean 'crank'" in line
    assert json.loads(output)["error"]["kind"] == "usage"


@needs_engine
@pytest.mark.parametrize(
    ("angle", "code", "closed"), [("-1/5", 0, True), ("pi", 1, False)]
)
def test_mobility_where_the_mechanism_was_moved(
    angle: str, code: int, closed: bool
) -> None:
    words = ("mobility", "four_bar_planar", "--at", f"qA={angle}")
    told, output, _ = asked(*words, "--json")
    assert told == code
    there = json.loads(output)["at_posture"]
    assert there["closed"] is closed
    assert bool(there["reason"]) is not closed
    assert there["variables"] == ["qA", "qB", "qC", "qD"]


@needs_engine
@pytest.mark.parametrize(
    ("at", "said"),
    [
        ("q11=0", "did you mean 'q1"),
        ("q4=", "q4"),
        ("q4=q5", "unknown name 'q5'"),
    ],
)
def test_what_at_cannot_take_is_2(at: str, said: str) -> None:
    code, output, errors = asked("mobility", "nao_t14", "--at", at, "--json")
    assert code == 2
    (line,) = errors.splitlines()
    assert said in line
    assert json.loads(output)["error"]["kind"] == "usage"


@needs_engine
@pytest.mark.parametrize(
    "words",
    [
        ("mobility", "four_bar_planar", "--at", "qA=-1/5"),
        ("mobility", "four_bar_planar", "--at", "qA=pi"),
        ("screws", "four_bar_planar", "--body", "crank", "--relative-to", "rocker"),
        ("screws", "watt_six_bar"),
        ("screws", "peaucellier"),
    ],
    ids=" ".join,
)
def test_documents_fit_the_schema_of_results(words: tuple[str, ...]) -> None:
    _, output, _ = asked(*words, "--json")
    document = json.loads(output)
    assert why_unfit(json_schema_of_results(), document) == ""
    # The reading of the schema is no rubber stamp.
    broken = document | {"case": 3}
    assert why_unfit(json_schema_of_results(), broken)
    assert why_unfit(json_schema_of_results(), document | {"question": "none"})
