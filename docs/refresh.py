"""Write what the commands print into the blocks of the README: python docs/refresh.py.

A block is marked by a comment ``run: COMMAND`` or ``run: COMMAND, lines FIRST-LAST``;
a test fails as long as the README shows anything else.
"""

from __future__ import annotations

import re
import subprocess
import sys
from functools import cache
from pathlib import Path

README = Path(__file__).parents[1] / "README.md"
BLOCK = re.compile(
    r"(<!-- run: (?P<words>[^,>]+?)(?:, lines (?P<first>\d+)-(?P<last>\d+))? -->\n"
    r"```text\n)(?P<shown>.*?)(```)",
    re.DOTALL,
)


@cache
def printed(words: str) -> str:
    """What a command prints to standard output."""
    run = subprocess.run(
        [sys.executable, "-m", "screwkit.cli", *words.split(), "--quiet"],
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return "\n".join(line.rstrip() for line in run.stdout.splitlines()) + "\n"


def shown(match: re.Match[str]) -> str:
    """What the block should show."""
    text = printed(match["words"])
    if match["first"]:
        lines = text.splitlines()[int(match["first"]) - 1 : int(match["last"])]
        text = "\n".join(lines) + "\n"
    return text


def refreshed(text: str) -> str:
    """The page with every block as the commands print it now."""
    return BLOCK.sub(lambda match: match[1] + shown(match) + "```", text)


if __name__ == "__main__":
    README.write_text(refreshed(README.read_text("utf-8")), "utf-8")
