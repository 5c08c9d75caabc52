"""Contacts and planar joints whose normal moves: their two sides are zero nowhere."""

from __future__ import annotations

import pytest
import sympy

from screwkit.analyses.singularities import limb_singularities
from screwkit.case import Case, load_text
from screwkit.errors import UndecidedError
from screwkit.questions import singularities
from screwkit.results.singularities import LimbSingularities

EULER = "{euler: xyz, angles: [a, b, c]}"
ANGLES = "a: {value: 0.2, angle: true}, b: {value: 0.3, angle: true}, " + (
    "c: {value: 0.1, angle: true}"
)
FILE = """
screwkit: 1
name: moving_normal
title: A limb on the platform by a joint whose normal moves
space: spatial
geometry: posture
base: base
platform: platform
links: [base, platform, middle]
variables: {{x: 0.3, y: 0.2, z: 1, {symbols}}}
pose: {{translation: [x, y, z], rotation: {rotation}}}
points:
  A: [2, 0, 0]
  B: {{link: platform, at: [1, 0, 0]}}
vectors:
  n: {normal}
joints:
  - {{name: S, {first}, parent: base, child: middle, point: A}}
  - {{name: N, type: {kind}, parent: middle, child: platform, point: B, normal: n}}
"""


def limb(
    kind: str,
    first: str = "type: spherical",
    normal: str = "{link: platform, at: [0, 0, 1]}",
    rotation: str = EULER,
    symbols: str = ANGLES,
) -> Case:
    return load_text(
        FILE.format(
            kind=kind, first=first, normal=normal, rotation=rotation, symbols=symbols
        )
    )


def only(case: Case) -> LimbSingularities:
    return limb_singularities(case.assembly, case.assembly.limbs[0])


@pytest.mark.parametrize("kind", ["planar", "plane"])
@pytest.mark.parametrize(
    ("normal", "rotation", "symbols"),
    [
        ("{link: platform, at: [0, 0, 1]}", EULER, ANGLES),
        ("{link: platform, at: [1, 2, 3]}", EULER, ANGLES),
        (
            "{link: platform, at: [0, 0, 1]}",
            "{quaternion: [p, q, r, s]}",
            "p: 1, q: 0.1, r: 0.2, s: 0.3",
        ),
        # At right angles to a vector that moves, and to no axis.
        ("cross(u, w)", EULER, ANGLES),
        # At a fixed angle to an axis.
        ("[2*cos(a), 2*sin(a), 1]", "{axis: z, angle: b}", ANGLES),
    ],
)
def test_a_ball_and_a_plane_never_lose_a_freedom(
    kind: str, normal: str, rotation: str, symbols: str
) -> None:
    """Turns about a centre and slides in a plane: 3 + 2, wherever the plane is.

    The fifth twist, the turn about the normal through B, is that through A and a slide.
    Products of the normal with axes of the base are parallel where a coordinate of it
    is 0, and were said to be a loss.
    """
    if normal == "cross(u, w)":
        normal += "\n  u: [cos(c), 1, sin(c)]\n  w: [x, 7, z]"
    found = only(limb(kind, "type: spherical", normal, rotation, symbols))
    assert found.generic_rank == 5
    assert found.components == ()
    assert found.complete or "1, 2, 3" in normal  # undecided there


def test_a_soft_finger_is_lost_in_its_plane_alone() -> None:
    """Two turns through B at right angles to n: with a ball at A, where n·(A − B) = 0.

    At a = 0, b = 0 that is z = 0.
    """
    found = only(limb("soft_finger"))
    assert found.complete
    (component,) = found.components
    (equation,) = component.equations
    level = sympy.sympify(str(equation)).subs({"a": 0, "b": 0})
    assert sympy.simplify(level / sympy.Symbol("z")).is_number


def test_a_point_is_lost_where_the_centre_is_above_it() -> None:
    """Slides at right angles to n, and turns that move B at right angles to B − A.

    The planes are one where B − A is along n: two equations, all regular at x = 1 (B
    above A is at x = 1 with the platform level).
    """
    found = only(limb("point"))
    assert found.complete
    (component,) = found.components
    assert component.codimension == 2
    level = {"a": 0, "b": 0, "c": 0}
    on = [sympy.sympify(str(e)).subs(level) for e in component.equations]
    assert all(e.subs({"x": 1, "y": 0}) == 0 for e in on)
    assert any(e.subs({"x": 2, "y": 0}) != 0 for e in on)


def test_axes_parallel_where_a_side_was_zero_are_found() -> None:
    """A cylinder along z and a plane that is level: two parallel turns and slides.

    Their difference is a slide in the plane, so that one of five twists is lost.
    """
    found = only(limb("planar", "type: cylindrical, axis: [0, 0, 1]"))
    assert found.complete
    level = {"a": 0, "b": 0}
    on = [
        component
        for component in found.components
        if all(sympy.sympify(str(e)).subs(level) == 0 for e in component.equations)
    ]
    assert [component.rank for component in on] == [4]
    assert on[0].codimension == 2


def test_a_normal_that_turns_freely_is_left_undecided() -> None:
    """No field of tangents on the sphere is zero nowhere."""
    case = limb("plane", normal="[u, v, w]", symbols=ANGLES + ", u: 1, v: 2, w: 3")
    with pytest.raises(UndecidedError, match="normal of joint 'N'"):
        singularities(case)
    text = FILE.format(
        kind="plane",
        first="type: spherical",
        normal="[u, v, w]",
        rotation=EULER,
        symbols=ANGLES + ", u: 1, v: 2, w: 3",
    )
    at_numbers = load_text(text, set_values={"u": "1", "v": "2", "w": "3"})
    assert singularities(at_numbers).limb[0].components == ()
