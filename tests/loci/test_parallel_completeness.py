"""Are the singular loci of parallel robots complete?  Asked of numbers alone.

Twists are written down here from the geometry of each robot, in floats and without the
engine.  Random-start Newton looks for postures where they depend on each other; each
one found must lie on a component.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from loci import nao
from loci.numeric import Array, Posture, closed_at, loop_matrix, rank
from loci.searching import posture_on, singular_postures

from screwkit.analyses.singularities import (
    constraint_singularities,
    limb_singularities,
)
from screwkit.kinematics.assembly import Assembly
from screwkit.mechanism.files import read_mechanism
from screwkit.results.singularities import Component

ON = 1e-6
STARTS = 6
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Robot:
    """A robot in floats: the twists of its limbs at a posture."""

    name: str
    limbs: Callable[[Posture], list[Array]]
    constants: dict[str, float]
    variables: tuple[str, ...]

    def assembly(self) -> Assembly:
        return Assembly(read_mechanism(nao.ROOT / "cases" / f"{self.name}.yaml"))


def turn(axis: Array, point: Array) -> Array:
    """(ω; v) of a rotation."""
    return np.concatenate([axis, np.cross(point, axis)])


def slide(direction: Array) -> Array:
    return np.concatenate([np.zeros(3), direction])


def rotation(u: float, v: float, w: float = 0.0) -> Array:
    """Of the quaternion (1, u, v, w), by Rodrigues' formula."""
    axis = np.array([u, v, w])
    cross = np.array([[0, -w, v], [w, 0, -u], [-v, u, 0]])
    size = 1 + axis @ axis
    return np.asarray(np.eye(3) + 2 / size * (cross + cross @ cross))


def spokes() -> list[tuple[Array, Array]]:
    """Radial and tangential directions, 120° apart."""
    found = []
    for k in range(3):
        angle = 2 * math.pi * k / 3
        radial = np.array([math.cos(angle), math.sin(angle), 0.0])
        found.append((radial, np.cross(UP, radial)))
    return found


def leaning(at: Posture) -> list[Array]:
    """Spherical centres of a platform that leans without torsion."""
    b, u, v = at["b"], at["u"], at["v"]
    size = 1 + u * u + v * v
    centre = np.array([b * (u * u - v * v) / size, -2 * b * u * v / size, at["z"]])
    turned = rotation(u, v)
    return [centre + turned @ (b * radial) for radial, _ in spokes()]


def about(point: Array) -> list[Array]:
    return [turn(axis, point) for axis in np.eye(3)]


def legs_3rps(at: Posture) -> list[Array]:
    limbs = []
    for (radial, tangent), sphere in zip(spokes(), leaning(at), strict=True):
        foot = at["a"] * radial
        own = [turn(tangent, foot), slide(sphere - foot), *about(sphere)]
        limbs.append(np.array(own).T)
    return limbs


def legs_3prs(at: Posture) -> list[Array]:
    limbs = []
    for k, ((radial, tangent), sphere) in enumerate(
        zip(spokes(), leaning(at), strict=True)
    ):
        foot = at[f"s{k + 1}"] * radial
        own = [slide(radial), turn(tangent, foot), *about(sphere)]
        limbs.append(np.array(own).T)
    return limbs


def legs_wrist(at: Posture) -> list[Array]:
    turned = rotation(at["u"], at["v"], at["w"])
    corner = np.array([at["b"], 2 * at["b"], at["c"]])
    limbs = []
    for k in range(3):
        foot = at["a"] * np.eye(3)[k]
        joint = turned @ np.roll(corner, k)
        inner = np.cross(foot, joint)
        own = [
            turn(np.eye(3)[k], foot),
            turn(inner, foot),
            slide(joint - foot),
            turn(inner, joint),
            turn(joint, joint),
        ]
        limbs.append(np.array(own).T)
    return limbs


ROBOTS = [
    Robot("3rps", legs_3rps, {"a": 1.7, "b": 0.9}, ("z", "u", "v")),
    Robot("3prs", legs_3prs, {"b": 1.1}, ("z", "u", "v", "s1", "s2", "s3")),
    Robot("3upu_wrist", legs_wrist, {"a": 1.9, "b": 0.7, "c": 1.2}, ("u", "v", "w")),
]
names = [robot.name for robot in ROBOTS]


def missed(
    matrix: Callable[[Posture], Array], robot: Robot, components: Sequence[Component]
) -> list[dict[str, float]]:
    """Singular postures on no component; larger families are shut out one by one."""
    families = [component.equations for component in components]
    return [
        posture
        for known in sorted({0, *(c.codimension for c in components)})
        for posture in singular_postures(
            matrix,
            robot.variables,
            robot.constants,
            [c.equations for c in components if c.codimension <= known],
            STARTS,
        )
        if np.min(closed_at(families, posture)) > ON and _is_real(matrix, posture)
    ]


def _is_real(matrix: Callable[[Posture], Array], posture: Posture) -> bool:
    """Not where an axis has no length, nor far out where all twists look alike."""
    at = matrix(posture)
    lengths = np.linalg.norm(at, axis=0)
    far = max(abs(value) for value in posture.values())
    return bool(lengths.min() > ON * lengths.max() and far < 1e3)


@pytest.mark.parametrize("robot", ROBOTS, ids=names)
def test_loops_lose_rank_on_the_components_alone(robot: Robot) -> None:
    answer = constraint_singularities(robot.assembly())
    assert answer.complete, answer.reason

    def matrix(posture: Posture) -> Array:
        return loop_matrix(robot.limbs(posture))

    assert not missed(matrix, robot, answer.components)
    for component in answer.components:
        at = posture_on(component.equations, robot.variables, robot.constants)
        assert rank(matrix(at)) == component.rank < answer.generic_rank


@pytest.mark.parametrize("robot", ROBOTS, ids=names)
def test_limbs_lose_rank_on_the_components_alone(robot: Robot) -> None:
    assembly = robot.assembly()
    for number, limb in enumerate(assembly.limbs[:2]):
        answer = limb_singularities(assembly, limb)
        assert answer.complete, answer.reason

        def matrix(posture: Posture, number: int = number) -> Array:
            return robot.limbs(posture)[number].T

        def turned(posture: Posture, number: int = number) -> Array:
            return robot.limbs(posture)[number]

        lost = [
            at
            for at in missed(matrix, robot, answer.components)
            if _is_real(turned, at)
        ]
        assert not lost, lost[:1]
        for component in answer.components:
            at = posture_on(component.equations, robot.variables, robot.constants)
            assert rank(matrix(at)) == component.rank < answer.generic_rank


def test_the_search_finds_what_is_there() -> None:
    """A negative control: with the component forgotten, the search finds it."""

    def matrix(posture: Posture) -> Array:
        return legs_3prs(posture)[0].T

    assert missed(matrix, ROBOTS[1], ())


def test_the_forces_of_a_leaning_platform_are_never_dependent() -> None:
    """Equal forces along the tangents have the moment 3 b/(1 + u² + v²) about z."""
    source = np.random.default_rng(3)
    for _ in range(20):
        u, v, z = source.normal(size=3)
        at = {"b": 1.3, "u": float(u), "v": float(v), "z": float(z)}
        moment = sum(
            float(np.cross(sphere, tangent)[2])
            for (_, tangent), sphere in zip(spokes(), leaning(at), strict=True)
        )
        assert moment == pytest.approx(3 * 1.3 / (1 + u * u + v * v))
