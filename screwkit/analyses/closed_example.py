"""A closed posture on which conditions hold, in numbers."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

from screwkit.algebra.expression import Expression
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.values import declared_values
from screwkit.metrics.closed_search import numbers_of, real_solution


def closed_example(
    graph: TiedGraph, equations: Sequence[Polynomial]
) -> tuple[tuple[str, float], ...] | None:
    """Joint variables at which loops are closed and equations hold.

    Angles are in (-pi, pi]; a joint variable that no equation contains is left out: it
    follows from the others.

    Args:
        graph: The mechanism.
        equations: In its ring.

    Returns:
        Empty where none was met, None where a dimension has no value.
    """
    ring, mechanism = graph.framed.ring, graph.mechanism
    values = declared_values(mechanism)
    wanted = (*equations, *graph.closing)
    used = {u for equation in wanted for u in unknowns(ring, equation)}
    angles = {
        name
        for i, form in enumerate(ring.basis)
        if ("angle", i) in used
        for name, _ in form
    }
    places = zip(ring.symbol_indices(), ring.symbols, strict=True)
    met = angles | {name for index, name in places if ("x", index) in used}
    if any(p.name in met and p.name not in values for p in mechanism.parameters):
        return None
    given = numbers_of({n: x for n, x in values.items() if n in met})
    joints = [v for v in mechanism.joint_variables if v in met and v not in given]
    written: list[Expression] = [
        parse(equation_text(ring, equation), limits=RESULT_LIMITS)
        for equation in (*equations, *graph.closing)
    ]
    reach = {name: pi if name in angles else 1.0 for name in joints}
    found = real_solution(written, reach, given)
    if found is None:
        return ()
    return tuple(
        (name, pi - (pi - x) % (2 * pi) if name in angles else x)
        for name, x in found.items()
    )
