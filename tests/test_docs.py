"""The documentation is executed: README blocks, examples, tables and links."""

from __future__ import annotations

import importlib.util
import re
import runpy
from pathlib import Path
from types import ModuleType

import pytest

from screwkit.mechanism.model import JointType
from screwkit.mechanism.schema import json_schema

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
README = (ROOT / "README.md").read_text("utf-8")
EXAMPLES = sorted((DOCS / "examples").glob("*.py"))
PAGES = [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]
PYTHON = re.compile(r"```python\n(.*?)```", re.DOTALL)
PARTS = ("Context", "Decision", "Consequences", "What would change our mind")


def refresh() -> ModuleType:
    spec = importlib.util.spec_from_file_location("refresh", DOCS / "refresh.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_readme_shows_what_the_commands_print() -> None:
    """After a change of output: python docs/refresh.py."""
    page = refresh()
    blocks = list(page.BLOCK.finditer(README))
    assert len(blocks) == README.count("<!-- run:") == 4
    for block in blocks:
        assert block["shown"] == page.shown(block)
        assert block["shown"].count("\n") > 8


def test_readme_has_the_two_lines() -> None:
    lines = README.splitlines()
    (install,) = [x for x in lines if x.startswith("python3 -m venv")]
    assert "pip install '.[test]'" in install
    assert "screwkit report nao_t14 --format pdf -o report.pdf" in install
    assert ".venv/bin/python -m pytest -n 2" in lines
    assert "externally-managed-environment" in README
    assert "LGPL-3.0-or-later" in README


def test_python_blocks_run() -> None:
    blocks = [
        (page, block)
        for page in PAGES
        for block in re.findall(
            r"```python\n(.*?)```", page.read_text("utf-8"), re.DOTALL
        )
    ]
    assert blocks
    for page, block in blocks:
        exec(compile(block, str(page), "exec"), {"__name__": "readme"})


def test_there_are_examples() -> None:
    assert len(EXAMPLES) >= 2


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(path), run_name="__main__")
    assert capsys.readouterr().out


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.stem)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#:]+)\)", page.read_text("utf-8")):
        assert (page.parent / target).exists(), target


def test_file_format_names_every_key_and_joint() -> None:
    text = (DOCS / "file_format.md").read_text("utf-8")
    keys = set(json_schema()["properties"])
    named = set(re.findall(r"`(\w+)`", text))
    assert keys
    assert not keys - named
    assert not {str(kind) for kind in JointType} - named


def test_decisions_are_numbered_and_complete() -> None:
    decisions = sorted((DOCS / "decisions").glob("*.md"))
    assert [path.name[:4] for path in decisions] == [
        f"{n:04}" for n in range(1, len(decisions) + 1)
    ]
    for path in decisions:
        text = path.read_text("utf-8")
        for part in (
            "Context",
            "Decision",
            "Consequences",
            "What would change our mind",
        ):
            assert f"**{part}.**" in text, f"{path.name}: {part}"
