"""The architecture holds: imports run one way, and the checks of it can fail."""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

import screwkit
from screwkit import errors
from screwkit.doctor import findings

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "screwkit"
MODULES = sorted(PACKAGE.rglob("*.py"))
HEAVY = ("sympy", "flint", "networkx", "pydantic", "numpy", "scipy", "yaml")
LONGEST = 400
PYTEST = (sys.executable, "-m", "pytest", "-p", "no:cacheprovider")

has_linter = pytest.mark.skipif(
    find_spec("importlinter") is None, reason="import-linter comes with the extra dev"
)


def contracts() -> dict[str, Any]:
    read = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    found: dict[str, Any] = read["tool"]["importlinter"]
    return found


def lint(folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [
            sys.executable,
            "-c",
            "from importlinter.cli import lint_imports_command as c; c()",
            "--no-cache",
        ],
        cwd=folder,
        env={"PYTHONPATH": str(folder), "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=False,
    )


@has_linter
def test_contracts_hold() -> None:
    run = lint(ROOT)
    assert run.returncode == 0, run.stdout[-3000:]
    assert "0 broken" in run.stdout


@has_linter
@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("algebra/ring.py", "import screwkit.kinematics.loops"),
        ("reports/text.py", "import screwkit.analyses.mobility"),
        ("analyses/mobility.py", "import screwkit.analyses.schemes"),
        ("mechanism/model.py", "import flint"),
        ("case.py", "import sympy"),
    ],
)
def test_contracts_break_when_they_should(
    tmp_path: Path, module: str, line: str
) -> None:
    shutil.copytree(
        PACKAGE, tmp_path / "screwkit", ignore=shutil.ignore_patterns("__pycache__")
    )
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    path = tmp_path / "screwkit" / module
    path.write_text(path.read_text("utf-8") + f"\n{line}\n", "utf-8")
    run = lint(tmp_path)
    assert run.returncode != 0
    assert "BROKEN" in run.stdout


def test_every_part_has_its_place_among_the_layers() -> None:
    (layers,) = (c for c in contracts()["contracts"] if c["type"] == "layers")
    assert layers["exhaustive"]
    placed = {name.strip() for line in layers["layers"] for name in line.split("|")}
    parts = {
        path.stem
        for path in PACKAGE.iterdir()
        if (path.suffix == ".py" and path.stem != "__init__")
        or (path / "__init__.py").exists()
    }
    assert placed == parts


@pytest.mark.parametrize("name", screwkit.__all__)
def test_every_public_name_imports(name: str) -> None:
    assert getattr(screwkit, name) is not None
    assert name in dir(screwkit)


def test_what_a_caller_must_catch_is_public() -> None:
    own = {
        name
        for name, found in vars(errors).items()
        if isinstance(found, type) and issubclass(found, Exception)
    }
    # Standard output is the command line's affair.
    assert own - {"OutputError"} <= {*screwkit.__all__}
    with pytest.raises(screwkit.UnknownCaseError):
        screwkit.load("no_such_case")
    assert issubclass(screwkit.TooLargeError, screwkit.UndecidedError)


def test_an_unknown_name_is_refused() -> None:
    with pytest.raises(AttributeError, match="no attribute 'mobilty'"):
        getattr(screwkit, "mobilty")  # noqa: B009


def loaded_by(code: str) -> set[str]:
    """Top-level modules that a fresh interpreter has after running ``code``."""
    run = subprocess.run(
        [
            sys.executable,
            "-c",
            f"import sys, contextlib, io\n"
            f"with contextlib.redirect_stdout(io.StringIO()):\n"
            f"    try:\n        {code}\n"
            f"    except SystemExit:\n        pass\n"
            f"print(*{{name.partition('.')[0] for name in sys.modules}})",
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    return set(run.stdout.split())


@pytest.mark.parametrize(
    "code",
    ["import screwkit", "from screwkit.cli import main; main(['--help'])"],
    ids=["import", "help"],
)
def test_nothing_heavy_is_loaded_before_it_is_needed(code: str) -> None:
    loaded = loaded_by(code)
    assert "screwkit" in loaded
    assert not loaded & set(HEAVY)


def test_the_probe_of_loaded_modules_sees_what_is_loaded() -> None:
    assert "flint" in loaded_by(
        "import screwkit; screwkit.mobility(screwkit.load('dual_planar_arm'))"
    )


# -- what the sources must not contain -----------------------------------------------

FORBIDDEN_CALLS = {"eval", "exec", "sympify", "parse_expr", "S", "lambdify", "srepr"}
GENERATED_CODE = {"algebra/compiled.py": {"exec"}}
"""Runs code that it generated from exponents and its own identifiers."""


def calls(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Call):
            if isinstance(node.func, ast.Name):
                yield node.func.id
            elif isinstance(node.func, ast.Attribute):
                yield node.func.attr


def test_no_text_reaches_an_evaluator() -> None:
    seen = set()
    for path in MODULES:
        name = path.relative_to(PACKAGE).as_posix()
        found = FORBIDDEN_CALLS & set(calls(path))
        seen |= found
        assert found <= GENERATED_CODE.get(name, set()), f"{name}: {found}"
    assert seen == {"exec"}, "the one exception is gone: shorten the list"


def test_modules_stay_readable() -> None:
    assert len(MODULES) > 80
    long = {
        path.relative_to(ROOT).as_posix(): count
        for path in MODULES
        if (count := len(path.read_text("utf-8").splitlines())) > LONGEST
    }
    assert not long


def test_every_module_says_what_it_is() -> None:
    for path in MODULES:
        text = path.read_text("utf-8")
        if text.strip():
            assert ast.get_docstring(ast.parse(text)), path.name


KEY = re.compile(r"\[([A-Z][A-Za-z]+\d{4}|CoxLittleOShea|Bicchi[A-Z][a-z]+)\]")


def test_citation_keys_resolve() -> None:
    entries = set(
        re.findall(
            r"@\w+\{(\w+),", (ROOT / "docs" / "references.bib").read_text("utf-8")
        )
    )
    cited = {
        key
        for path in [*MODULES, *(ROOT / "docs").rglob("*.md")]
        for key in KEY.findall(path.read_text("utf-8"))
    }
    assert {"LongCaroKhalil2012", "Schwartz1980"} <= cited
    assert not cited - entries


def test_no_file_mentions_paths_of_a_machine() -> None:
    pattern = re.compile(r"(?<![\w.])/(?:work|home|root|Users|tmp)/")
    checked = 0
    for folder in ("screwkit", "tests", "docs", "cases", ".ci"):
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in {".py", ".md", ".yaml", ".json", ".bib"} or (
                folder == ".ci" and path.is_file()
            ):
                checked += 1
                if path != Path(__file__):
                    assert not pattern.search(path.read_text("utf-8")), path
    assert checked > 150


# -- collectors that find nothing would pass vacuously -------------------------------


def test_collectors_find_something() -> None:
    run = subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "--collect-only",
            "-q",
            "-p",
            "no:cacheprovider",
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    lines = run.stdout.splitlines()
    # only the package's own modules: tests have no examples in their docstrings
    doctests = [line for line in lines if line.startswith("screwkit/")]
    tests = [line for line in lines if line.startswith("tests/")]
    assert len(tests) > 300
    assert doctests, "no doctest was collected"


def test_what_doctor_needs_is_what_is_installed() -> None:
    read = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    required = {
        re.split(r"[<>=\[ ]", line)[0].lower()
        for line in read["project"]["dependencies"]
    }
    needed = {f.name.lower() for f in findings() if f.needed and f.install}
    assert needed <= required
