"""Determinants, minors and ranks of the passive twists against floats."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from loci import nao
from loci.numeric import freedoms, loop_matrix

from screwkit.algebra.compiled import compile_polynomials
from screwkit.loci.actuation import passive_joints
from screwkit.loci.passive import PassiveSystem

SCHEMES = [
    ("1", "2", "3", "7"),
    ("1", "8", "9", "10"),
    ("1", "2", "9", "10"),
    ("1", "4", "5", "9"),
    ("3", "5", "6", "10"),
    ("1", "2", "3", "4"),
]


def postures(count: int) -> list[dict[str, float]]:
    source = np.random.default_rng(4)
    return [
        {
            **{name: float(source.uniform(0.2, 2)) for name in nao.LENGTHS},
            **{name: float(source.uniform(-3, 3)) for name in nao.VARIABLES},
        }
        for _ in range(count)
    ]


@pytest.mark.parametrize("actuated", SCHEMES)
def test_determinants_are_those_of_the_assembled_matrix(
    actuated: tuple[str, ...],
) -> None:
    """Not up to a constant: up to one sign, lengths varying as well."""
    system = PassiveSystem(nao.assembly())
    passive = passive_joints(nao.assembly(), actuated)
    assert system.fills(passive)
    (exact,) = system.maximal_minors(passive)
    ring = nao.assembly().common_twists.ring
    compiled = compile_polynomials(ring, exact.expanded(ring))
    signs = set()
    for at in postures(8):
        chosen = [[j in passive for j in limb] for limb in nao.LIMBS]
        wanted = float(np.linalg.det(loop_matrix(nao.limbs_at(at), chosen)))
        found = float(compiled(at))
        assert abs(found) == pytest.approx(abs(wanted), rel=1e-9, abs=1e-13)
        signs.add(np.sign(found * wanted))
    assert len(signs) == 1


@pytest.mark.parametrize(
    ("size", "admissible"), [(4, 139), (5, 196), (6, 182)], ids=str
)
def test_admissible_sets_of_four_five_and_six(size: int, admissible: int) -> None:
    """Published counts; every set also by singular values."""
    system = PassiveSystem(nao.assembly())
    limbs = nao.limbs_at(postures(1)[0])
    count = 0
    for actuated in combinations(nao.assembly().joints, size):
        passive = passive_joints(nao.assembly(), actuated)
        state = system.generic_state(passive)
        measured = freedoms(
            [
                limb[:, [j in passive for j in joints]]
                for limb, joints in zip(limbs, nao.LIMBS, strict=True)
            ]
        )
        assert (state.limbs, state.loop) == (measured.limbs, measured.loop)
        assert state.platform_freedom == measured.platform
        count += state.platform_freedom == 0
    assert count == admissible


def test_without_passive_joints_nothing_moves() -> None:
    state = PassiveSystem(nao.assembly()).generic_state(())
    assert (state.mobility, state.platform_freedom) == (0, 0)
