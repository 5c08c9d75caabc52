"""The command line in this process."""

from __future__ import annotations

import pytest

from screwkit import cli


def screwkit(*words: str) -> int:
    """The exit code of a command."""
    with pytest.raises(SystemExit) as stop:
        cli.main(list(words))
    code = stop.value.code
    assert isinstance(code, int)
    return code
