"""Reciprocal products vanish together exactly where limbs are dependent.

Whether they are is judged by the rank of the loop equations at residues, which knows
nothing of wrenches, and by geometry.
"""

from __future__ import annotations

import pytest
from loci import nao

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.points import residue
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.loop_drop import loop_state
from screwkit.loci.rank_drop import extensors, generic_rank
from screwkit.loci.reciprocal_minors import reciprocal_meets, reciprocal_minors
from screwkit.loci.wrench_vectors import spanning_wrenches
from screwkit.mechanism.files import read_mechanism


def assembly(name: str) -> Assembly:
    return Assembly(read_mechanism(nao.ROOT / "cases" / f"{name}.yaml"))


def where(case: Assembly, branch: Branch, *zeros: str) -> Branch:
    """The first sheet of the branch where sines and cosines are zero: ``sin qA4``."""
    for text in zeros:
        kind, name = text.split()
        cosine, sine = case.common_twists.ring.cosine_sine(name)
        value = branch.value(sine if kind == "sin" else cosine)
        if value != 0:
            branch = restricted(branch, value)[0]
    return branch


STRETCHED = ("sin qA4", "sin qB4")
LEVEL = ("cos qA2", "cos qB2")
TO_ONE_SIDE = ("sin qA1", "sin qB1")


@pytest.mark.parametrize(
    ("more", "dependent"),
    [
        ((), False),
        (LEVEL, False),
        (TO_ONE_SIDE, False),
        ((*LEVEL, "sin qA1"), False),
        ((*LEVEL, *TO_ONE_SIDE), True),
    ],
)
def test_stretched_arms_share_a_force_along_the_line_of_their_shoulders(
    more: tuple[str, ...], dependent: bool
) -> None:
    """A stretched arm carries a force along its axis 3; both shoulders lie on y = 0."""
    case = assembly("dual_iiwa")
    ring = case.common_twists.ring
    root, library = case.root(ring), case.library(ring)
    branch = where(case, root, *STRETCHED)
    limbs = [case.told(limb.joints) for limb in case.limbs]
    twists = [[tuple(branch.column(c)) for c in limb] for limb in limbs]
    charts = [
        extensors(branch, limb, generic_rank(branch, limb), library)[0]
        for limb in limbs
    ]
    meets = reciprocal_meets(branch, twists, charts, 6)
    inside = where(case, branch, *more)
    vanish = not any(residue(m, *at) for m in meets for at in inside.points)
    generic, state = loop_state(root, limbs), loop_state(inside, limbs)
    assert generic is not None
    assert state is not None
    assert vanish == dependent == (state.loop < generic.loop)


def test_couples_that_overlap_are_compared_with_one_limb_alone() -> None:
    """Each limb of the 4-RUU carries a horizontal couple, normal to h and vertical.

    Of four, two are independent: that falls where the others are along one of them.
    """
    case = assembly("4ruu")
    ring = case.common_twists.ring
    root, library = case.root(ring), case.library(ring)
    limbs = [case.told(limb.joints) for limb in case.limbs]
    twists = [[tuple(c) for c in limb] for limb in limbs]
    spans = [
        spanning_wrenches(root, extensors(root, limb, 5, library)[0], 6, 5)
        for limb in limbs
    ]
    at = root.points[0]
    found = reciprocal_minors(root, twists, spans, [1] * 4, at, 4_000)
    assert any(residue(m, *at) for m in found)
    parallel = where(case, root, "sin eta1", "sin eta2", "sin eta3", "sin eta4")
    assert not any(residue(m, *p) for m in found for p in parallel.points)
    # Where three are parallel and one is not, some product is left.
    three = where(case, root, "sin eta1", "sin eta2", "sin eta3")
    assert any(residue(m, *p) for m in found for p in three.points)
