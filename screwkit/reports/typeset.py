"""LaTeX to PDF in a fresh folder, with limits.

TeX is a program that runs what it reads: no shell escape, no files outside its folder,
a minute at most, and nothing left running afterwards.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Final

from screwkit.errors import MissingToolError, ScrewkitError

INSTALL: Final = "apt-get install texlive-latex-recommended latexmk"
SECONDS: Final = 60.0
_RUNS: Final = 4
_ENVIRONMENT: Final = {"openin_any": "p", "openout_any": "p", "shell_escape": "f"}
_RERUN: Final = ("Rerun to get", "Rerun LaTeX", "Table widths have changed")


class TypesettingError(ScrewkitError):
    """TeX refused the document; the message is its first error with the line."""


def is_available() -> bool:
    """Whether a PDF can be made here."""
    return shutil.which("pdflatex") is not None


def typeset(
    source: str,
    *,
    seconds: float = SECONDS,
    files: Mapping[str, bytes] | None = None,
) -> tuple[bytes, str]:
    """The PDF of a document, and the log of its last run.

    Args:
        source: LaTeX.
        seconds: For each run.
        files: What the document includes, by the path it gives.

    Raises:
        MissingToolError: If TeX is not installed.
        TypesettingError: If TeX fails or takes too long.
    """
    if not is_available():
        raise MissingToolError(f"pdflatex is not installed; {INSTALL}")
    with tempfile.TemporaryDirectory(prefix="screwkit-tex-") as folder:
        place = Path(folder)
        (place / "report.tex").write_text(source, encoding="utf-8")
        for name, content in (files or {}).items():
            (place / name).parent.mkdir(exist_ok=True)
            (place / name).write_bytes(content)
        command, runs = _command()
        log = ""
        for _ in range(runs):
            _run(command, place, seconds)
            log = _log(place)
            if not any(sign in log for sign in _RERUN):
                break
        pdf = place / "report.pdf"
        if not pdf.exists():
            raise TypesettingError(first_error(log))
        return pdf.read_bytes(), log


def _command() -> tuple[list[str], int]:
    """Latexmk where it is installed, else pdflatex as often as it asks for."""
    options = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    if shutil.which("latexmk") is None:
        return ["pdflatex", *options, "report.tex"], _RUNS
    # -norc: a folder's or user's latexmkrc is a program.
    return ["latexmk", "-norc", "-pdf", "-bibtex-", *options, "report.tex"], 1


def _run(command: list[str], place: Path, seconds: float) -> None:
    """One run; TeX's own failures are read from its log."""
    process = subprocess.Popen(
        command,
        cwd=place,
        env={**os.environ, **_ENVIRONMENT},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        code = process.wait(timeout=seconds)
    except subprocess.TimeoutExpired as error:
        raise TypesettingError(f"TeX took longer than {seconds:g} s") from error
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    if code != 0:
        raise TypesettingError(first_error(_log(place)))


def _log(place: Path) -> str:
    log = place / "report.log"
    return log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""


def first_error(log: str) -> str:
    r"""TeX's first error and its line, from a log.

    >>> first_error("junk\n! Undefined control sequence.\nl.12 foo\n")
    'TeX: Undefined control sequence. (line 12)'
    """
    error = re.search(r"^! (.+)$", log, re.MULTILINE)
    if error is None:
        return "TeX failed without saying why"
    line = re.search(r"^l\.(\d+)", log[error.end() :], re.MULTILINE)
    where = f" (line {line[1]})" if line else ""
    return f"TeX: {error[1]}{where}"
