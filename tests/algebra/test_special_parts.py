"""Parts that tie no dimensions are found beside one that does."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, Pending, restricted
from screwkit.algebra.decomposition import beside_special, common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.points import PRIME, residue, root_modulo
from screwkit.algebra.search import Search

# Three legs in vertical planes through the z axis point along (cos, sin) of p, q, r
# from (a, 0) to (b + x·e, z); the last condition says that they lie in one plane.
LEGS = (
    "sin(p)*(a - b - x) + z*cos(p)",
    "sin(q)*(2*a - 2*b + x) + 2*z*cos(q)",
    "sin(r)*(2*a - 2*b + x) + 2*z*cos(r)",
)
ONE_PLANE = "sin(p)*cos(q)*cos(r) + cos(p)*sin(q)*cos(r) + cos(p)*cos(q)*sin(r)"

A, B = 7, 3


def angle(tangent: int) -> tuple[int, int] | None:
    """(sin, cos) of an angle, modulo the prime."""
    root = root_modulo((1 + tangent * tangent) % PRIME, PRIME)
    if not root:
        return None
    cosine = pow(root, -1, PRIME)
    return tangent * cosine % PRIME, cosine


def flat() -> dict[str, int]:
    """All legs in the plane z = 0."""
    return {"p": 0, "q": 0, "r": 0, "x": 5, "z": 0}


def oblique() -> dict[str, int]:
    """Where x = 2 (a − b): tan p = z/(a − b), tan q = tan r = −half that."""
    heights = (z for z in range(1, 500, 2) if angle(z) and angle(-z * (PRIME + 1) // 2))
    turn = next(heights)
    half = -turn * ((PRIME + 1) // 2) % PRIME
    return {"p": turn, "q": half, "r": half, "x": 2 * (A - B), "z": turn * (A - B)}


@pytest.mark.parametrize("posture", [flat, oblique])
def test_legs_in_one_plane(posture: Callable[[], dict[str, int]]) -> None:
    """Points are drawn where z = x = a − b = 0, which leaves all other postures."""
    values = posture()
    ring, conditions = in_one_ring(*LEGS, ONE_PLANE)
    places = dict(zip(ring.symbols, ring.symbol_indices(), strict=True))
    root = Branch(
        ring,
        Assumptions(frozenset({"a", "b"})),
        dimensions=(places["a"], places["b"]),
    )
    point = [0] * len(ring.names)
    for name, value in {"a": A, "b": B, "x": values["x"], "z": values["z"]}.items():
        point[places[name]] = value
    for number, unknown in enumerate("pqr"):
        turned = angle(values[unknown])
        assert turned is not None
        point[ring.sine_index(number)], point[ring.cosine_index(number)] = turned
    assert [residue(c, point) for c in conditions] == [0] * 4

    *legs, plane = conditions
    branch = root
    for leg in legs:
        (branch,) = restricted(branch, leg)
    found = common_zeros(branch, [plane], Search(FactorLibrary(ring)))

    assert found.complete
    assert found.special
    assert any(
        not any(residue(c, point) for c in branch.conditions)
        for branch in found.branches
    )


def pending(*texts: str, dimensions: str) -> Branch:
    """A branch on which all of these are pending."""
    ring, conditions = in_one_ring(*texts)
    places = dict(zip(ring.symbols, ring.symbol_indices(), strict=True))
    return Branch(
        ring,
        Assumptions(frozenset(dimensions)),
        tuple(conditions),
        pending=tuple(Pending(own, own) for own in conditions),
        dimensions=tuple(places[name] for name in dimensions),
    )


def test_two_conditions_of_one_angle_tie_dimensions_everywhere() -> None:
    """Tan p is −d/f and −e/g, so that d·g = e·f; no sine and cosine vanish at once."""
    branch = pending("d*cos(p) + f*sin(p)", "e*cos(p) + g*sin(p)", dimensions="defg")
    assert branch.is_special
    search = Search(FactorLibrary(branch.ring))
    assert beside_special(branch, search) == ()
