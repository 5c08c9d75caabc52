"""Arms that point to where their rods end, and rods that are parallel to one plane.

In a Delta robot with platforms of one size each arm turns in a vertical plane, from one
place, and its rod goes on to (x, y, z).  Where all arms are in line with their rods in
that plane, one more condition says that the rods are parallel to one plane.  No unknown
occurs in that condition alone.
"""

from __future__ import annotations

from dataclasses import replace
from math import atan2, cos, pi, sin

import numpy as np
from loci.numeric import value
from one_ring import in_one_ring
from scipy.optimize import brentq

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.fixed_directions import fixed_directions
from screwkit.algebra.one_part import one_norm_beside
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search

OUT = [("1", "0"), ("(-1/2)", "(sqrt(3)/2)"), ("(-1/2)", "(-sqrt(3)/2)")]
ARMS = [f"sin(q{k})*({a}*x + {b}*y) - cos(q{k})*z" for k, (a, b) in enumerate(OUT)]


def one_plane() -> str:
    """The determinant of the rods' directions."""
    rods = [
        (f"(x - cos(q{k})*{a})", f"(y - cos(q{k})*{b})", f"(z - sin(q{k}))")
        for k, (a, b) in enumerate(OUT)
    ]
    terms = [
        f"{rods[i][0]}*({rods[j][1]}*{rods[k][2]} - {rods[j][2]}*{rods[k][1]})"
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    ]
    return " + ".join(terms)


def posture(x: float, y: float, z: float, sheets: tuple[int, ...]) -> dict[str, float]:
    """With each arm along its rod or against it."""
    found = {"x": x, "y": y, "z": z}
    for k, sheet in enumerate(sheets):
        out = 2 * pi * k / 3
        found[f"q{k}"] = atan2(z, x * cos(out) + y * sin(out)) + pi * sheet
    return found


def singular_postures() -> list[dict[str, float]]:
    """Where the determinant changes its sign, found by numbers."""
    source = np.random.default_rng(2)
    plane = one_plane()
    found: list[dict[str, float]] = []
    while len(found) < 4:
        y, z = (float(v) for v in source.uniform(-2, 2, 2))
        sheets = tuple(int(v) for v in source.integers(0, 2, 3))

        def along(
            x: float, y: float = y, z: float = z, s: tuple[int, ...] = sheets
        ) -> float:
            return value(plane, posture(x, y, z, s))

        places = np.linspace(-3, 3, 60)
        signs = [along(float(x)) > 0 for x in places]
        for k in range(59):
            if signs[k] != signs[k + 1]:
                x = brentq(along, places[k], places[k + 1], xtol=1e-14)
                found.append(posture(float(x), y, z, sheets))
                break
    return found


def test_rods_parallel_to_one_plane() -> None:
    """One part of codimension 4, given by one more equation than the arms'."""
    ring, (*arms, plane) = in_one_ring(*ARMS, one_plane())
    branch = Branch(ring, Assumptions(frozenset()), directed=True)
    for arm in arms:
        (branch,) = restricted(branch, arm)
    search = Search(FactorLibrary(ring), bound=4)
    zeros = common_zeros(branch, [plane], search)
    assert zeros.complete
    each = [
        [text(ring, equation) for equation in part.equations(())]
        for part in zeros.branches
        if part.codimension == 4
    ]
    (told,) = [equations for equations in each if "z" not in equations]
    for at in singular_postures():
        assert max(abs(value(equation, at)) for equation in told) < 1e-9
        beside = posture(at["x"] + 0.1, at["y"], at["z"], (0, 0, 0))
        assert max(abs(value(equation, beside)) for equation in told) > 1e-6


def test_norms_that_are_irreducible() -> None:
    """With w² = x² + y² for w = x·cos q − y·sin q."""
    length = "(x*cos(q) - y*sin(q))"
    cases = {
        f"u + {length}": [],  # u² − w²
        f"sqrt(3)*u + {length}": [],
        # u times that, and u = 0 is beside it; so is y = 0 where w = x.
        f"u*(u + {length})": ["u"],
        f"u*y + {length} - x": ["y"],
        f"({length} - u)*({length} + 2*u)": None,
        "x + 2*y + 3": None,  # its square: both sheets over one line
    }
    for condition, beside in cases.items():
        ring, (fixed, last) = in_one_ring("x*sin(q) + y*cos(q)", condition)
        (branch,) = restricted(
            replace(Branch(ring, Assumptions(frozenset())), directed=True), fixed
        )
        found = one_norm_beside(branch, last, fixed_directions(branch))
        told = None if found is None else [text(ring, own) for own in found]
        assert told == beside, condition
