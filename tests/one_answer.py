"""Answers that tests of several modules share, in the process of a group."""

from __future__ import annotations

from functools import cache

import screwkit as sk
from screwkit.results.singularities import Singularities
from screwkit.results.strata import Strata


@cache
def with_strata(name: str, together: int = 2) -> tuple[Singularities, Strata]:
    """The singularities of a bundled case, with strata of so many components."""
    answer = sk.singularities(sk.load(name), strata=together)
    assert answer.strata is not None
    return answer, answer.strata
