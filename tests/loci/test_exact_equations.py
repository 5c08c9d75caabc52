"""Where all equations of a component vanish the posture is singular, without exception.

Zeros of the equations are found by least squares from random starts; whether they are
singular is decided by elementary geometry, with a gap, and not by the engine.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np
import pytest
from loci.numeric import Array, value
from scipy.optimize import least_squares

import screwkit as sk
from screwkit.loci import exact_equations

Posture = Mapping[str, float]
STARTS = 40


@cache
def components(name: str) -> tuple[tuple[str, ...], ...]:
    found = sk.singularities(sk.load(name)).constraint
    assert found.complete
    return tuple(component.equations for component in found.components)


def is_in_line(at: Posture) -> bool:
    """Parallel screws of one pitch span less where they stand in one line, from above.

    One of them stands at the origin.
    """
    places = np.array([[at[f"x{k}"], at[f"y{k}"]] for k in (1, 2, 3)])
    return lost(places, 2)


def has_dependent_lines(at: Posture) -> bool:
    """Stretched or folded legs of the 3-RRR carry forces along their lines."""
    c, s = np.cos(at["phi"]), np.sin(at["phi"])
    turn = np.array([[c, -s], [s, c]])
    base = [(0, 0), (at["a2"], 0), (at["a3x"], at["a3y"])]
    plate = [(0, 0), (at["b2x"], at["b2y"]), (at["b3x"], at["b3y"])]
    lines = []
    for k in range(3):
        start = np.array(base[k])
        end = np.array([at["x"], at["y"]]) + turn @ np.array(plate[k])
        angle = at[f"theta{k + 1}"]
        along = np.array([np.cos(angle), np.sin(angle)])
        reach = end - start
        if abs(along[0] * reach[1] - along[1] * reach[0]) < 1e-6:
            moment = start[0] * along[1] - start[1] * along[0]
            lines.append([*along, moment])
    return len(lines) > 1 and lost(np.array(lines), min(len(lines), 3))


def locks_the_six_bar(at: Posture) -> bool:
    """Rates of the planar loops A B C D and A B E F G, both with the coupler's."""
    a, d, g = (0.0, 0.0), (at["d"], 0.0), (at["xg"], at["yg"])
    b, c, e, f = ((at[f"x{k}"], at[f"y{k}"]) for k in "bcef")
    rates = np.zeros((6, 7))
    for column, (x, y) in enumerate((a, b, c, d, e, f, g)):
        twist = np.array([1, y, -x])
        if column in {0, 1, 2, 3}:
            rates[:3, column] = twist
        if column in {0, 1, 4, 5, 6}:
            rates[3:, column] = twist
    return lost(rates, 6)


def lost(rows: Array, rank: int) -> bool:
    singular = np.linalg.svd(rows, compute_uv=False)
    small = singular[rank - 1] / singular[0]
    assert not 1e-5 < small < 1e-4, "no gap"
    return bool(small < 1e-5)


@pytest.mark.parametrize(
    ("name", "is_singular"),
    [
        ("4H_equal_pitch", is_in_line),
        ("3rrr_planar", has_dependent_lines),
        ("stephenson_six_bar", locks_the_six_bar),
    ],
)
def test_zeros_of_all_equations_are_singular(
    name: str, is_singular: Callable[[Posture], bool]
) -> None:
    mechanism = sk.load(name).mechanism
    names = [p.name for p in mechanism.parameters]
    source = np.random.default_rng(3)
    met = 0
    for equations in components(name):

        def residuals(x: Array, equations: tuple[str, ...] = equations) -> list[float]:
            at = dict(zip(names, map(float, x), strict=True))
            return [value(text, at) for text in equations]

        for _ in range(STARTS):
            start = source.uniform(-2, 2, len(names))
            found = least_squares(residuals, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
            if np.abs(found.fun).max() < 1e-11:
                met += 1
                assert is_singular(dict(zip(names, map(float, found.x), strict=True)))
    assert met > STARTS / 2


def test_equations_that_could_not_be_taken_apart_are_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without a case distinction nothing is known of their zeros."""
    monkeypatch.setattr(exact_equations, "_BUDGET", 0)
    found = sk.singularities(sk.load("4H_equal_pitch")).constraint
    assert len(found.components) == 1
    assert not found.complete
    assert "one component may hold at regular postures too" in found.reason
