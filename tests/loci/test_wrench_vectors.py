"""Wrenches from minors: reciprocal to the twists, and as many as are left."""

from __future__ import annotations

import pytest
from loci import nao

from screwkit.algebra.branches import restricted
from screwkit.algebra.modular import rank
from screwkit.algebra.points import residue
from screwkit.analyses.singularities import constraint_singularities
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.pieces import Piece, lies_in, told_apart
from screwkit.loci.rank_drop import extensors, generic_rank
from screwkit.loci.wrench_vectors import overlap_minors, spanning_wrenches
from screwkit.mechanism.files import read_mechanism


def assembly(name: str) -> Assembly:
    return Assembly(read_mechanism(nao.ROOT / "cases" / f"{name}.yaml"))


@pytest.mark.parametrize("name", ["4ruu", "3rps", "nao_t14"])
def test_wrenches_annihilate_the_twists_and_span_all_that_do(name: str) -> None:
    case = assembly(name)
    ring = case.common_twists.ring
    root, library = case.root(ring), case.library(ring)
    limb = case.told(case.limbs[0].joints)
    size, height = generic_rank(root, limb), len(limb[0])
    chart = extensors(root, limb, size, library)[0]
    vectors = spanning_wrenches(root, chart, height, size)
    for point, prime in root.points:
        rows = [[residue(x, point, prime) for x in v] for v in vectors]
        twists = [[residue(x, point, prime) for x in c] for c in limb]
        assert rank(rows, prime) == height - size
        for row in rows:
            for twist in twists:
                assert sum(a * b for a, b in zip(row, twist, strict=True)) % prime == 0


def test_the_couples_of_the_4ruu_are_parallel_where_their_minors_vanish() -> None:
    """Each limb carries the couple across h: the minors are sines of differences."""
    case = assembly("4ruu")
    ring = case.common_twists.ring
    root, library = case.root(ring), case.library(ring)
    vectors = []
    for chain in case.limbs:
        limb = case.told(chain.joints)
        chart = extensors(root, limb, 5, library)[0]
        vectors += spanning_wrenches(root, chart, 6, 5)
    assert len(vectors) == 4
    found = overlap_minors(root, vectors, root.points[0], 10**4, 10**4)
    pairs = {("eta1", "eta2"), ("eta1", "eta3"), ("eta1", "eta4")}
    pairs |= {("eta2", "eta3"), ("eta2", "eta4"), ("eta3", "eta4")}
    wanted = set()
    for one, two in pairs:
        (c, s), (d, t) = ring.cosine_sine(one), ring.cosine_sine(two)
        wanted |= {str(s * d - c * t), str(c * t - s * d)}
    assert len(found) == len(pairs)
    assert {str(m) for m in found} <= wanted


def test_no_component_of_the_3rrr_lies_in_the_equations_of_another() -> None:
    """Two limbs on one line are no case of three limbs through one point."""
    case = assembly("3rrr_planar")
    answer = constraint_singularities(case)
    assert answer.complete
    assert [c.codimension for c in answer.components] == [4, 4, 4, 4]
    # Three determinants vanish on other sets too, until more are added.
    assert max(len(c.equations) for c in answer.components) > 4


def test_pieces_are_told_apart_by_a_known_condition() -> None:
    """u·v = u·z = 0 holds on v = z = 0 and on u = 0, where v does not vanish."""
    case = assembly("3rps")
    ring = case.common_twists.ring
    root = case.root(ring)
    u, v, z = (ring.symbol(name) for name in ("u", "v", "z"))
    (on_v,) = restricted(root, v)
    (line,) = restricted(on_v, z)
    (plane,) = restricted(root, u)
    one, other = Piece((u * v, u * z), (line,)), Piece((u,), (plane,))
    assert lies_in(plane, one)
    first, second = told_apart([one, other], [v])
    assert first.equations == (u * v, u * z, v)
    assert second.equations == (u,)
    assert not lies_in(plane, first)
