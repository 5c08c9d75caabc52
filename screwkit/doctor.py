"""What is installed, and for each missing thing what it is for and how to get it."""

from __future__ import annotations

import platform
import shutil
import sys
import webbrowser
from dataclasses import dataclass
from importlib import metadata
from typing import Final

from screwkit import errors
from screwkit.terminal import emit, emit_json

TEX_INSTALL: Final = "apt-get install texlive-latex-recommended latexmk"


@dataclass(frozen=True)
class Finding:
    """One thing looked for.

    Attributes:
        found: Version or path; empty where it is missing.
        needed: Whether screwkit answers nothing without it.
    """

    name: str
    found: str
    purpose: str
    install: str
    needed: bool = False


_PACKAGES: Final = (
    ("python-flint", "exact polynomials, ranks, factors", True),
    ("networkx", "loops of the mechanism's graph", True),
    ("pydantic", "reading mechanism files", True),
    ("PyYAML", "reading mechanism files", True),
    ("numpy", "numbers over many postures", True),
    ("scipy", "postures with closed loops", True),
    ("sympy", "expressions in and out of Python", True),
    ("typer", "the command line", True),
    ("rich", "progress on a terminal", True),
    ("matplotlib", "pictures", True),
    ("distributed", "sweeps on a Dask cluster", False),
)


def findings() -> tuple[Finding, ...]:
    """Everything that is looked for."""
    found = [
        Finding(
            "python",
            platform.python_version(),
            "3.11 or newer",
            "",
            needed=sys.version_info < (3, 11),
        )
    ]
    found += [
        Finding(name, _version(name), purpose, f"pip install {name}", needed)
        for name, purpose, needed in _PACKAGES
    ]
    found += [
        Finding("pdflatex", _program("pdflatex"), "reports as PDF", TEX_INSTALL),
        Finding("latexmk", _program("latexmk"), "reports as PDF", TEX_INSTALL),
        Finding(
            "browser",
            _browser(),
            "view --open; the page itself is made without",
            "apt-get install firefox-esr, or set BROWSER",
        ),
        Finding(
            "msolve",
            _program("msolve"),
            "certified real points of large systems (optional)",
            "apt-get install msolve",
        ),
    ]
    return tuple(found)


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""


def _program(name: str) -> str:
    return shutil.which(name) or ""


def _browser() -> str:
    """What `view --open` would use; empty where there is none."""
    try:
        found = webbrowser.get()
    except webbrowser.Error:
        return ""
    return str(getattr(found, "name", "")) or "the system's own"


def examine(*, as_json: bool) -> int:
    """Print the findings; 5 where something needed is missing."""
    all_found = findings()
    if as_json:
        tools = [
            {
                "name": one.name,
                "found": one.found or None,
                "purpose": one.purpose,
                "install": one.install,
                "needed": one.needed,
            }
            for one in all_found
        ]
        emit_json("", {"tools": tools})
    else:
        width = max(len(one.name) for one in all_found)
        for one in all_found:
            state = one.found or f"missing: for {one.purpose}; {one.install}"
            emit(f"{one.name.ljust(width)}  {state}\n")
    missing = any(one.needed and not one.found for one in all_found)
    return errors.EXIT_TOOL if missing else errors.EXIT_DONE
