"""Laws that hold for any small mechanism: ranks, determinants, names and orders."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from loci.numeric import Array, limb_columns, loop_matrix, measured_rank
from strategies import Arms, arms

from screwkit.algebra.batch import BatchRing
from screwkit.algebra.compiled import compile_polynomials
from screwkit.algebra.modular import ModularRing, prime_for, rank
from screwkit.algebra.points import rank_at
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.placement import joint_twists
from screwkit.loci.passive import PassiveSystem

laws = settings(max_examples=25, derandomize=True)
seeds = st.integers(0, 2**20)


def limbs_at(system: Arms, posture: dict[str, float]) -> list[Array]:
    mechanism = system.mechanism()
    return [limb_columns(mechanism, joints, posture) for joints in system.joints]


@laws
@given(arms(), seeds)
def test_generic_ranks_are_singular_value_ranks(system: Arms, seed: int) -> None:
    assembly = Assembly(system.mechanism())
    limbs = limbs_at(system, system.posture(seed))
    matrices = [*limbs, loop_matrix(limbs)]
    exact = [assembly.generic_rank(joints) for joints in system.joints]
    exact.append(assembly.loop_rank)
    for matrix, found in zip(matrices, exact, strict=True):
        measured = measured_rank(matrix)
        assume(measured.gap > 1e3)  # no clear gap: the random posture is near singular
        assert found == measured.rank


@laws
@given(arms(), seeds)
def test_names_orders_and_frames_change_no_rank(system: Arms, seed: int) -> None:
    assembly = Assembly(system.mechanism())
    count = len(system.limbs)
    turned = tuple((i + 1 + seed) % count for i in range(count))
    other = Assembly(system.mechanism("body", turned))
    assert other.loop_rank == assembly.loop_rank
    for joints in system.joints:
        assert other.generic_rank(joints) == assembly.generic_rank(joints)
    states = [
        PassiveSystem(each).generic_state(each.joints) for each in (assembly, other)
    ]
    assert states[0].platform_freedom == states[1].platform_freedom
    assert sorted(states[0].limbs) == sorted(states[1].limbs)


@laws
@given(arms(2, 5), seeds)
def test_scaling_all_lengths_scales_moments(system: Arms, seed: int) -> None:
    """Numbers of the exact columns at two sizes differ by powers of the scale only."""
    framed = Assembly(system.mechanism()).base_twists
    compiled = compile_polynomials(framed.ring, framed.columns)
    small, large = (compiled(system.posture(seed, x)) for x in (1.0, 3.0))
    factor = np.where(np.any(small[:, :3] != 0, axis=1), 3.0, 1.0)
    np.testing.assert_allclose(large[:, :3], small[:, :3], atol=1e-12)
    np.testing.assert_allclose(
        large[:, 3:], small[:, 3:] * factor[:, None], rtol=1e-9, atol=1e-12
    )


@laws
@given(arms(2, 5), seeds)
def test_rings_agree(system: Arms, seed: int) -> None:
    """Polynomials at a point are the floats there, and the residues there."""
    mechanism = system.mechanism()
    assembly = Assembly(mechanism)
    framed = assembly.base_twists
    posture = system.posture(seed)
    floats = joint_twists(mechanism, BatchRing(posture), "ground")
    exact = compile_polynomials(framed.ring, framed.columns)(posture)
    mdh = np.hstack(limbs_at(system, posture)).T
    for number, joint in enumerate(framed.joints):
        wanted = np.array([float(x) for x in floats[joint].coordinates])
        np.testing.assert_allclose(exact[number], wanted, atol=1e-9)
    order = [joint for joints in system.joints for joint in joints]
    rows = [framed.joints.index(joint) for joint in order]
    np.testing.assert_allclose(exact[rows], mdh, atol=1e-9)

    prime = prime_for(12, [], seed)
    ring = ModularRing(seed, prime)
    try:
        residues = joint_twists(mechanism, ring, "ground")
    except ArithmeticError:
        return
    found = rank([list(residues[j].coordinates) for j in order], prime)
    assert found == assembly.generic_rank(order)


@laws
@given(arms(2, 5), seeds, st.data())
def test_passive_determinants_are_those_of_floats(
    system: Arms, seed: int, data: st.DataObject
) -> None:
    order = [joint for joints in system.joints for joint in joints]
    passive = sorted(
        data.draw(st.permutations(order), label="order")[:6], key=order.index
    )
    assembly = Assembly(system.mechanism())
    passives = PassiveSystem(assembly)
    assume(passives.fills(passive))
    fall = passives.generic_state(passive).loop < 6
    minors = [] if fall else list(passives.maximal_minors(passive))
    chosen = [[joint in passive for joint in joints] for joints in system.joints]
    ring = assembly.common_twists.ring
    products = [minor.expanded(ring) for minor in minors]
    for number in range(3):
        posture = system.posture(seed + number)
        limbs = limbs_at(system, posture)
        wanted = abs(float(np.linalg.det(loop_matrix(limbs, chosen))))
        found = (
            abs(float(compile_polynomials(ring, products[0])(posture)))
            if products
            else 0
        )
        size = float(np.prod(1 + np.linalg.norm(np.hstack(limbs), axis=0)))
        assert abs(found - wanted) < 1e-10 * size


@laws
@given(arms(2, 5))
def test_residues_of_polynomials_have_the_generic_rank(system: Arms) -> None:
    """The polynomials at their own exact points; the kinematics over residues."""
    assembly = Assembly(system.mechanism())
    framed = assembly.common_twists
    for joints in system.joints:
        columns = [framed.column(joint) for joint in joints]
        found = max(
            rank_at(columns, point, prime)
            for point, prime in assembly.root(framed.ring).points
        )
        assert found == assembly.generic_rank(joints)
