"""The symmetry that exchanges two limbs, if there is one.

A reflection or half turn of the base frame may map the twists of one limb, at every
posture, onto those of another at the posture with some joint variables reversed.  It is
found joint by joint at a random exact posture and confirmed at a second one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

from screwkit.algebra.modular import ModularRing, prime_for
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.placement import joint_twists

Signs = tuple[int, int, int]


def mirrored_joints(assembly: Assembly) -> tuple[tuple[str, str], ...]:
    """Pairs of joints of two limbs that a symmetry exchanges; empty without one."""
    if len(assembly.limbs) != 2 or assembly.mechanism.geometry != "mdh":
        return ()
    first, second = assembly.limbs
    if len(first.joints) != len(second.joints):
        return ()
    for x, y, z in product((1, -1), repeat=3):
        signs = (x, y, z)
        if signs == (1, 1, 1):
            continue
        turns = _matching(assembly, (first, second), signs)
        if turns is not None and _confirmed(assembly, (first, second), signs, turns):
            return tuple(zip(first.joints, second.joints, strict=True))
    return ()


def _matching(
    assembly: Assembly, pair: tuple[LimbChain, LimbChain], signs: Signs
) -> list[tuple[int, int]] | None:
    """For each joint of ``second`` the sign of its angle, and a shift by π."""
    first, _ = pair
    turns: list[tuple[int, int]] = []
    while True:
        matched = _agreement(assembly, pair, signs, turns, seed=5)
        if matched < len(turns) + 1:
            return None
        if len(turns) == len(first.joints):
            return turns
        for choice in ((1, 0), (-1, 0), (1, 1), (-1, 1)):
            tried = [*turns, choice]
            wanted = min(len(tried) + 1, len(first.joints))
            agreed = _agreement(assembly, pair, signs, tried, seed=5)
            if agreed >= wanted:
                turns = tried
                break
        else:
            return None
        if len(turns) == len(first.joints):
            return turns


def _confirmed(
    assembly: Assembly,
    pair: tuple[LimbChain, LimbChain],
    signs: Signs,
    turns: Sequence[tuple[int, int]],
) -> bool:
    agreed = _agreement(assembly, pair, signs, turns, seed=6)
    return agreed == len(pair[0].joints)


def _agreement(
    assembly: Assembly,
    pair: tuple[LimbChain, LimbChain],
    signs: Signs,
    turns: Sequence[tuple[int, int]],
    seed: int,
) -> int:
    """How many leading joints of the limbs are images of each other."""
    first, second = pair
    prime = prime_for(12, [Fraction(2), Fraction(3)], seed)
    ring = _LinkedRing(seed, prime, _links(assembly, pair, turns))
    mechanism = assembly.mechanism
    chains = (*first.chain, *second.chain)
    twists = joint_twists(mechanism, ring, mechanism.base, chains)
    count = 0
    for a, b in zip(first.joints, second.joints, strict=True):
        image = _image(twists[a].coordinates, signs)
        if not _proportional(image, twists[b].coordinates):
            return count
        count += 1
    return count


def _links(
    assembly: Assembly,
    pair: tuple[LimbChain, LimbChain],
    turns: Sequence[tuple[int, int]],
) -> dict[str, tuple[str, int, int]]:
    links = {}
    pairs = zip(pair[0].joints, pair[1].joints, strict=True)
    for (a, b), (sign, shifted) in zip(pairs, turns, strict=False):
        variable, other = assembly.variable_of(a), assembly.variable_of(b)
        if variable is not None and other is not None:
            links[other] = (variable, sign, shifted)
    return links


class _LinkedRing(ModularRing):
    """Residues in which some variables follow others."""

    def __init__(
        self, seed: int, prime: int, links: Mapping[str, tuple[str, int, int]]
    ) -> None:
        super().__init__(seed, prime)
        self._links = links

    def cosine_sine(self, angle: str) -> tuple[Any, Any]:
        if angle not in self._links:
            return super().cosine_sine(angle)
        other, sign, shifted = self._links[angle]
        cosine, sine = super().cosine_sine(other)
        if shifted:
            cosine, sine = -cosine, -sine
        return cosine, sine if sign > 0 else -sine

    def symbol(self, name: str) -> Any:
        if name not in self._links:
            return super().symbol(name)
        other, sign, _ = self._links[name]
        value = super().symbol(other)
        return value if sign > 0 else -value


def _image(twist: Sequence[Any], signs: Signs) -> list[Any]:
    """A twist under diag(signs): ω is an axial vector, v a true one."""
    turn = signs[0] * signs[1] * signs[2]
    turning = [w if turn * s > 0 else -w for w, s in zip(twist[:3], signs, strict=True)]
    moving = [v if s > 0 else -v for v, s in zip(twist[3:], signs, strict=True)]
    return turning + moving


def _proportional(left: Sequence[Any], right: Sequence[Any]) -> bool:
    return all(
        left[i] * right[j] == left[j] * right[i]
        for i in range(6)
        for j in range(i + 1, 6)
    )
