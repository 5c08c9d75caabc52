"""Tests of one mechanism in one process, which answers once."""

from __future__ import annotations

from typing import Any

import pytest


def grouped(about: str, *names: str) -> list[Any]:
    """Parameters of tests that share answers about each of these mechanisms."""
    return [
        pytest.param(name, marks=pytest.mark.xdist_group(f"{about} {name}"))
        for name in names
    ]
