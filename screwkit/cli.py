"""The entry point: loads the program, and leaves quietly if that is interrupted.

Libraries take a third of a second to load, and may turn Ctrl-C into errors of their
own; nothing is lost by leaving at once.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

from screwkit import __version__
from screwkit.conventions import RESULT_SCHEMA
from screwkit.errors import EXIT_INTERRUPTED


def main(arguments: list[str] | None = None) -> NoReturn:
    """Run the command line and leave with its exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    with _leaving_quietly(as_json="--json" in words):
        from screwkit.program import run  # noqa: PLC0415
    sys.exit(run(words))


@contextmanager
def _leaving_quietly(*, as_json: bool) -> Iterator[None]:
    """End at once on Ctrl-C, as the program does later on."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def leave(_number: int, _frame: FrameType | None) -> NoReturn:
        if as_json:
            os.write(1, f"{json.dumps(_interrupted(), indent=1)}\n".encode())
        os.write(2, b"screwkit: interrupted\n")
        os._exit(EXIT_INTERRUPTED)

    before = signal.signal(signal.SIGINT, leave)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _interrupted() -> dict[str, object]:
    told = {"kind": "interrupted", "message": "interrupted"}
    return {"schema": RESULT_SCHEMA, "case": "", "version": __version__, "error": told}


if __name__ == "__main__":
    main()
