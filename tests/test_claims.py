"""Claims about equations: equal up to a factor, however they are written."""

from __future__ import annotations

import pytest

from screwkit.claims import checked_claims
from screwkit.mechanism.model import Claim


@pytest.mark.parametrize(
    ("claimed", "computed", "agree"),
    [
        ("x + sqrt(3)*y", "sqrt(3)*x + 3*y", True),  # √3 times the other
        ("x + sqrt(3)*y", "x - sqrt(3)*y", False),
        ("(a + sqrt(2))*x", "a*x + sqrt(2)*x", True),
        ("2*x*(x + y)", "x**2 + x*y", True),
        ("x**2 + y", "x**2 - y", False),
    ],
)
def test_equations_agree_up_to_a_factor(
    claimed: str, computed: str, agree: bool
) -> None:
    place = "singularities.constraint.components"
    claim = Claim(f"{place}#equations", [[claimed]], "derived", "by construction")
    found = [{"equations": [computed]}]
    documents = {"singularities": {"constraint": {"components": found}}}
    (check,) = checked_claims([claim], documents)
    assert check.agrees is agree
