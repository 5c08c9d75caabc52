"""What is the same wherever it is asked for is found once, and found to be the same."""

from __future__ import annotations

import random
from collections.abc import Mapping
from itertools import combinations, permutations
from math import comb
from typing import Any

import pytest

import screwkit as sk
from screwkit.algebra.minors import minor_table, minors_of_size
from screwkit.kinematics.told_parts import own_parts
from screwkit.loci import limb_systems
from screwkit.loci.brackets import Bracket, monomials_of, shortest_monomials
from screwkit.loci.limb_drops import limb_drop
from screwkit.loci.limb_systems import limb_system
from screwkit.loci.rank_drop import extensors

P = 2**61 - 1


def test_a_limb_is_searched_once_on_each_branch() -> None:
    assembly = sk.load("nao_t14").assembly
    right, left = assembly.limbs
    root = assembly.root(assembly.limb_twists[right.name].ring)
    assert root is assembly.root(assembly.limb_twists[right.name].ring)
    drop = limb_drop(assembly, right, root)
    assert limb_drop(assembly, right, root) is drop
    (below, *_) = drop.decomposition.branches
    assert limb_drop(assembly, right, below) is not drop
    other = assembly.root(assembly.limb_twists[left.name].ring)
    assert limb_drop(assembly, left, other) is not drop
    again = sk.load("nao_t14").assembly
    mine = again.root(again.limb_twists[right.name].ring)
    assert limb_drop(again, again.limbs[0], mine) is not drop


def test_minors_of_all_columns_are_those_of_the_table() -> None:
    assembly = sk.load("nao_t14").assembly
    ring = assembly.common_twists.ring
    for size in (2, 3, 4, 5):
        columns = assembly.told(assembly.joints[:size])
        height = len(columns[0])
        table = minor_table(ring, columns, height)[(1 << size) - 1]
        found = minors_of_size(ring, columns, size)
        assert sorted(map(str, found)) == sorted(map(str, table.values()))
        assert len(found) <= comb(height, size)


def test_brackets_are_asked_about_once() -> None:
    """Six lines through eight points, of which 0 1 2 3 and 4 5 6 7 lie in planes."""
    lines = [(0, 4), (1, 5), (2, 6), (3, 7), (0, 5), (1, 6)]
    flat = {(0, 1, 2, 3), (4, 5, 6, 7)}
    asked: list[Bracket] = []

    def vanishes(four: Bracket) -> bool:
        asked.append(four)
        return four in flat

    found = shortest_monomials(lines, vanishes)
    assert len(asked) == len(set(asked)) <= comb(8, 4)
    source = random.Random(4)
    orders = source.sample([*permutations(range(6))], 60)
    tried = [monomials_of([lines[i] for i in o], flat.__contains__) for o in orders]
    assert len(found) <= min(map(len, tried))


@pytest.mark.parametrize("name", ["delta_4r", "h4"])
def test_chains_that_a_condition_leaves_alone_are_joined_once(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The same system as when every chain is taken anew."""
    assembly = sk.load(name).assembly
    limb = assembly.limbs[0]
    ring = assembly.limb_twists[limb.name].ring
    parts, height = own_parts(assembly, limb)
    root, library = assembly.root(ring), assembly.library(ring)
    once = limb_system(root, parts, height, library)
    taken: list[Any] = []

    def counted(*given: Any) -> Any:
        taken.append(given)
        return extensors(*given)

    monkeypatch.setattr(limb_systems, "extensors", counted)
    assert limb_system(root, parts, height, library) == once
    assert not taken
    anew = limb_system(root, parts, height, type(library)(ring))
    assert taken
    assert anew.dimension == once.dimension
    assert _proportional(anew.extensor, once.extensor)


def _proportional(one: Mapping[int, Any], other: Mapping[int, Any]) -> bool:
    pairs = combinations(sorted({*one, *other}), 2)
    return all(one[a] * other[b] == one[b] * other[a] for a, b in pairs)
