"""Of a minor that is a product beside a piece's other equations one factor is left."""

from __future__ import annotations

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search, imposed
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.loci.exact_equations import Singularity, without_products
from screwkit.loci.pieces import Piece

# x = 0 and a·sin p = b·cos p, with a sum that is x times something and w·(…) times it.
FIRST = "x"
SECOND = "a*sin(p) - b*cos(p)"
MINOR = "x*(a + w^2) + w*sin(q)*(a*sin(p) - b*cos(p))"


def test_a_factor_that_vanishes_on_the_piece_takes_the_place_of_a_product() -> None:
    survey = SurveyRing()
    for own in (FIRST, SECOND, MINOR):
        evaluate(parse(own), survey)
    ring = TrigonometricRing(survey)
    first, second, minor = (evaluate(parse(t), ring) for t in (FIRST, SECOND, MINOR))
    root = Branch(ring, Assumptions(frozenset({"a", "b"})))
    library = FactorLibrary(ring)
    branches = [root]
    for equation in (first, second):
        search = Search(library)
        branches = [b for a in branches for b in imposed(a, equation, search)]
    singular = Singularity(root, list, lambda branch: True, library)
    piece = Piece((first, ring.normal(minor)), tuple(branches))
    found = without_products(piece, singular)
    assert [text(ring, own) for own in found.equations] == [FIRST, SECOND]
