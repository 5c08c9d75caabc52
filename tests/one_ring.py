"""Expressions that are written down, in one ring of sines and cosines."""

from __future__ import annotations

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def in_one_ring(*texts: str) -> tuple[TrigonometricRing, list[Polynomial]]:
    """The ring that all of them need, and each in normal form."""
    parsed = [parse(text) for text in texts]
    survey = SurveyRing()
    for expression in parsed:
        evaluate(expression, survey)
    ring = TrigonometricRing(survey)
    return ring, [ring.normal(evaluate(expression, ring)) for expression in parsed]
