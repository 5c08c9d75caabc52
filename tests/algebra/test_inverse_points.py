"""Random points know the inverses of divisors: places are tried where they are."""

from __future__ import annotations

import pytest

import screwkit as sk
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.points import residue


@pytest.mark.parametrize("name", ["3rps", "sprint_z3", "myard5", "dual_planar_3r"])
def test_an_inverse_times_its_divisor_is_one(name: str) -> None:
    ring = sk.load(name).assembly.base_twists.ring
    assert ring.divisors_of
    for point, prime in Branch(ring, Assumptions()).points:
        for generator, divisor in ring.divisors_of.items():
            product = ring.generator(generator) * divisor
            assert residue(product, point, prime) == 1


def test_forces_through_places_with_divisors_are_named() -> None:
    """Hunt's platform: each limb carries a force through its centre along its axis."""
    answer = sk.screws(sk.load("3rps"))
    for i, limb in enumerate(answer.limbs, 1):
        (force,) = limb.wrenches
        assert force.description == (
            f"force through the centre of S{i}3, parallel to axis R{i}1"
        )
