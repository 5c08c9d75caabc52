"""Reciprocal meets vanish together exactly where limbs are dependent.

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
from screwkit.loci.reciprocal_meets import reciprocal_meets
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
