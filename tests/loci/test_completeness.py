"""Nothing is missing: singular postures found by numbers lie on reported components.

`complete` claims that every singular posture lies on a component.  Here postures are
found without the engine (`searching`), and each must satisfy all equations of one
component to 1e-5 (lengths and sines are of order one; the residuals of the search are
below 1e-11, and two components may meet, where an equation is the square root of a
residual).  Regular postures drawn at random must lie on none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import combinations

import numpy as np
import pytest
from loci import nao
from loci.numeric import Array, Posture, closed_at, limb_columns, loop_matrix, rank
from loci.searching import singular_postures

from screwkit.analyses.singularities import (
    actuation_singularities,
    constraint_singularities,
    limb_singularities,
)
from screwkit.kinematics.assembly import Assembly
from screwkit.mechanism.files import read_mechanism
from screwkit.results.singularities import Component

ON = 1e-5
OFF = 1e-3


@dataclass(frozen=True, eq=False)
class Bundled:
    """A bundled case at lengths of its own."""

    assembly: Assembly
    lengths: dict[str, float]

    @property
    def variables(self) -> tuple[str, ...]:
        return self.assembly.mechanism.joint_variables

    def limbs_at(self, posture: Posture) -> list[Array]:
        return [
            _columns(self, x.joints, tuple(posture[v] for v in self.moving(x.joints)))
            for x in self.assembly.limbs
        ]

    def moving(self, joints: Sequence[str]) -> list[str]:
        mechanism = self.assembly.mechanism
        return [v for joint in joints for v in mechanism.joint(joint).variables]

    def random_posture(self, seed: int) -> dict[str, float]:
        source = np.random.default_rng(seed)
        angles = source.uniform(-3, 3, len(self.variables))
        return {
            **self.lengths,
            **dict(zip(self.variables, map(float, angles), strict=True)),
        }


@lru_cache(maxsize=64)
def _columns(
    case: Bundled, joints: tuple[str, ...], values: tuple[float, ...]
) -> Array:
    """Of a limb; slopes along the variables of another one ask for them again."""
    posture = {**case.lengths, **dict(zip(case.moving(joints), values, strict=True))}
    return limb_columns(case.assembly.mechanism, joints, posture)


@cache
def bundled(name: str) -> Bundled:
    mechanism = read_mechanism(nao.ROOT / "cases" / f"{name}.yaml")
    source = np.random.default_rng(9)
    lengths = {p.name: float(source.uniform(0.4, 1.6)) for p in mechanism.parameters}
    return Bundled(Assembly(mechanism), lengths)


def missed(
    matrix: Callable[[Posture], Array],
    case: Bundled,
    components: Sequence[Component],
    starts: int,
    seed: int = 0,
) -> list[dict[str, float]]:
    """Singular postures on no component; larger families are shut out one by one."""
    families = [component.equations for component in components]
    codimensions = sorted({component.codimension for component in components})
    rounds = [0, *codimensions] if codimensions else [0]
    return [
        posture
        for known in rounds
        for posture in singular_postures(
            matrix,
            case.variables,
            case.lengths,
            [c.equations for c in components if c.codimension <= known],
            starts,
            seed,
        )
        if np.min(closed_at(families, posture)) > ON
    ]


LIMBS = [
    ("nao_t14", 0),
    ("nao_t14", 1),
    ("unequal_arms", 0),
    ("unequal_arms", 1),
    ("dual_planar_arm", 0),
    ("dual_scara", 1),
    ("puma", 0),
    ("ur5", 0),
    ("iiwa", 0),
    ("three_arms", 2),
]


@pytest.mark.parametrize(("name", "number"), LIMBS)
def test_limbs_lose_rank_on_the_components_alone(name: str, number: int) -> None:
    case = bundled(name)
    limb = case.assembly.limbs[number]
    answer = limb_singularities(case.assembly, limb)
    assert answer.complete
    regular = case.limbs_at(case.random_posture(1))[number]
    assert rank(regular) == answer.generic_rank
    rows = _row_space(regular)

    def matrix(posture: Posture) -> Array:
        columns = case.limbs_at(posture)[number]
        if columns.shape[1] > answer.generic_rank:  # more joints than rank: rows fail
            return rows.T @ columns
        return columns.T

    assert not missed(matrix, case, answer.components, 8)
    families = [component.equations for component in answer.components]
    for seed in range(5):
        assert np.min(closed_at(families, case.random_posture(seed))) > OFF


def _row_space(matrix: Array) -> Array:
    """Orthonormal basis of the coordinates in which a limb moves at all."""
    u, sizes, _ = np.linalg.svd(matrix)
    return np.asarray(u[:, : int(np.sum(sizes > 1e-9))])


LOOPS = [("nao_t14", 12), ("unequal_arms", 12), ("dual_planar_arm", 12)]


@pytest.mark.parametrize(("name", "starts"), LOOPS)
def test_loops_lose_rank_on_the_components_alone(name: str, starts: int) -> None:
    case = bundled(name)
    answer = constraint_singularities(case.assembly)
    generic = loop_matrix(case.limbs_at(case.random_posture(1)))
    assert rank(generic) == answer.generic_rank
    rows = _row_space(generic)
    if answer.generic_rank < 6:  # planar arms: three rows are empty everywhere
        other = loop_matrix(case.limbs_at(case.random_posture(2)))
        assert np.allclose(rows @ (rows.T @ other), other)

    def matrix(posture: Posture) -> Array:
        return np.asarray(rows.T @ loop_matrix(case.limbs_at(posture)))

    assert answer.complete
    lost = missed(matrix, case, answer.components, starts)
    assert not lost, lost[:1]


SCHEMES = [("1", "2", "3", "7"), ("1", "2", "4", "5"), ("2", "4", "6", "9")]


@pytest.mark.parametrize("actuated", SCHEMES)
def test_passive_joints_are_dependent_on_the_components_alone(
    actuated: tuple[str, ...],
) -> None:
    case = bundled("nao_t14")
    answer = actuation_singularities(case.assembly, actuated)
    known = (*answer.components, *answer.idle)
    passive = [[j not in actuated for j in limb] for limb in nao.LIMBS]

    def matrix(posture: Posture) -> Array:
        return loop_matrix(case.limbs_at(posture), passive)

    hypersurfaces = [c for c in known if c.codimension == 1]
    assert not missed(matrix, case, hypersurfaces, 6)
    families = [component.equations for component in known]
    for seed in range(5):
        at = case.random_posture(seed)
        assert rank(matrix(at)) == 6
        assert np.min(closed_at(families, at)) > 1e-5


def test_the_search_finds_what_is_there() -> None:
    """A negative control: with one component forgotten, the search finds it."""
    case = bundled("nao_t14")
    answer = limb_singularities(case.assembly, case.assembly.limbs[0])

    def matrix(posture: Posture) -> Array:
        return case.limbs_at(posture)[0].T

    for kept in combinations(answer.components, 1):
        assert missed(matrix, case, kept, 6)
