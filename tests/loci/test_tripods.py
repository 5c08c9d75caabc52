"""Three legs with axes that are not tangent to one circle: 3-RPS with tilted axes.

Each leg carries a force through its spherical centre parallel to its axis.  Axes of
independent directions have independent forces wherever the centres are, so that there
is no constraint singularity: a proof without any computation.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from screwkit.analyses.singularities import constraint_singularities
from screwkit.case import Case, load_text

SQUARE = "(1 + u^2 + v^2 + w^2)"
TURNED = (
    ("1 + u^2 - v^2 - w^2", "2*u*v - 2*w", "2*u*w + 2*v"),
    ("2*u*v + 2*w", "1 - u^2 + v^2 - w^2", "2*v*w - 2*u"),
    ("2*u*w - 2*v", "2*v*w + 2*u", "1 - u^2 - v^2 + w^2"),
)
Place = tuple[int, int, int]


def scaled(factors: Place, terms: tuple[str, ...]) -> str:
    return " + ".join(f"({f})*({t})" for f, t in zip(factors, terms, strict=True))


def tripod(axes: tuple[Place, ...], feet: tuple[Place, ...], order: str) -> Case:
    """Each centre Bₖ stays in the plane through its foot Aₖ normal to its axis aₖ.

    Of the platform's place p that is aₖ·p = aₖ·(Aₖ − R bₖ), solved for p.
    """
    centres: tuple[Place, ...] = ((1, 0, 0), (0, 1, 0), (-1, -1, 1))
    inverse = np.linalg.inv(np.array(axes, dtype=float))
    size = round(float(np.linalg.det(np.array(axes, dtype=float))))
    place = []
    for row in inverse:
        terms = []
        for number, share in enumerate(row):
            axis, foot, centre = axes[number], feet[number], centres[number]
            turned = [scaled(centre, line) for line in TURNED]
            level = sum(a * f for a, f in zip(axis, foot, strict=True))
            along = " + ".join(
                f"({a})*({t})" for a, t in zip(axis, turned, strict=True)
            )
            part = Fraction(round(float(share) * size), size)
            terms.append(f"({part})*(({level})*{SQUARE} - ({along}))")
        place.append(f'"({" + ".join(terms)})/{SQUARE}"')
    lines = [
        "screwkit: 1\nname: tripod\ntitle: Tripod\nsource: constructed\nunits: m",
        "space: spatial\ngeometry: posture\nbase: base\nplatform: platform",
        "links: [base, platform, a1, b1, a2, b2, a3, b3]",
        "variables: {u: 1/5, v: 1/7, w: 1/3}",
        f"pose: {{translation: [{', '.join(place)}], "
        "rotation: {quaternion: [1, u, v, w]}}",
        "vectors:",
        *(f"  t{n + 1}: {list(axis)}" for n, axis in enumerate(axes)),
        "points:",
        *(f"  A{n + 1}: {list(foot)}" for n, foot in enumerate(feet)),
        *(
            f"  B{n + 1}: {{link: platform, at: {list(c)}}}"
            for n, c in enumerate(centres)
        ),
        "joints:",
    ]
    for n in order:
        lines += [
            f"  - {{name: R{n}, type: revolute, parent: base, child: a{n}, "
            f"axis: t{n}, point: A{n}}}",
            f"  - {{name: P{n}, type: prismatic, parent: a{n}, child: b{n}, "
            f"axis: B{n} - A{n}, point: A{n}}}",
            f"  - {{name: S{n}, type: spherical, parent: b{n}, child: platform, "
            f"point: B{n}}}",
        ]
    lines.append("actuated: [P1, P2, P3]")
    return load_text("\n".join(lines) + "\n")


def test_forces_along_independent_axes_stay_independent() -> None:
    """Axes from a point above the feet, the legs in another order than their names."""
    axes = (2, 0, -1), (0, 2, -1), (-2, -1, -1)
    feet = (2, 0, 0), (0, 2, 0), (-2, -1, 0)
    assert np.linalg.matrix_rank(np.array(axes)) == 3
    answer = constraint_singularities(tripod(axes, feet, "312").assembly)
    assert answer.generic_rank == 12
    assert answer.complete
    assert not answer.components
