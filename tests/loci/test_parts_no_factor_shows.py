"""Where the numerator and the denominator of a solution vanish together, on no factor.

The columns (p, 1, r) and (s, z, w) are dependent on one curve, z = s/p over p·w = r·s.
The equations z·p = s and p·w = r·s hold on the lines p = s = 0 too, where the columns
are independent in general; of these four lines no factor of an equation tells.
"""

from __future__ import annotations

import numpy as np
from loci.numeric import value as number
from scipy.optimize import least_squares

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.parse import parse
from screwkit.algebra.points import rank_at
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.splitting import split
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.loci.exact_equations import Singularity, with_exact_equations
from screwkit.loci.pieces import Piece

P, S, R, W = "x^3 + y^2 - 3", "y^3 - x^2 + x - 1", "y - 2", "x + 3"


def value(text: str, x: float, y: float, z: float) -> float:
    return number(text, {"x": x, "y": y, "z": z})


def zeros_of_both(at: tuple[float, float]) -> list[float]:
    return [value(text, at[0], at[1], 0) for text in (P, S)]


def test_equations_of_a_component_leave_out_lines_beside_it() -> None:
    survey = SurveyRing()
    evaluate(parse("x + y + z"), survey)
    ring = TrigonometricRing(survey)
    columns = [
        [ring.normal(evaluate(parse(text), ring)) for text in column]
        for column in ((P, "1", R), (S, "z", W))
    ]
    (p, one, r), (s, z, w) = columns
    root = Branch(ring, Assumptions())
    (curve,) = restricted(root, p * w - r * s)
    on_curve = split(curve, p * z - one * s)
    assert on_curve is not None
    assert on_curve.solved is not None
    piece = Piece((p * z - s, p * w - r * s), (on_curve.solved,))
    singular = Singularity(
        root,
        lambda: columns,
        lambda branch: all(rank_at(columns, *at) < 2 for at in branch.points),
        FactorLibrary(ring),
    )
    (found,) = with_exact_equations([piece], singular).pieces
    texts = [equation_text(ring, e) for e in found.equations]
    met = 0
    for start in ((1, 1), (1.4, 1.2), (-1, 1)):
        solved = least_squares(
            lambda v: [value(t, v[0], v[1], 0) for t in (P, S)], start
        )
        x, y = map(float, solved.x)
        if solved.cost > 1e-18:
            continue
        met += 1
        for height in (0.7, -1.9):
            rows = [
                [value(t, x, y, height) for t in c] for c in ((P, "1", R), (S, "z", W))
            ]
            assert np.linalg.svd(np.array(rows), compute_uv=False)[1] > 1e-2
            assert max(abs(value(t, x, y, height)) for t in texts) > 1e-3
    assert met
