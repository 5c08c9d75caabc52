"""Settings that all tests share."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("untimed", deadline=None)  # no unit test is a stopwatch
settings.load_profile("untimed")
