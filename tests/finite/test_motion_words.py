"""Kinds of motion told from residues, against the ones measured in numbers."""

from __future__ import annotations

import random

import numpy as np
import pytest

from screwkit.finite.lie_closure import Displacement, composed, random_step
from screwkit.finite.motion_invariants import motion_in_words
from screwkit.finite.motion_words import words_of

PRIME = 2**61 - 1
X, Y, Z = (0, 0, 0, 1, 0, 0), (0, 0, 0, 0, 1, 0), (0, 0, 0, 0, 0, 1)
ABOUT_Z = (0, 0, 1, 2, 5, 0)  # through (−5, 2, 0)
ALSO_Z = (0, 0, 1, 0, 0, 0)
THROUGH = (1, 2, 2, 0, 0, 0), (3, 0, 4, 0, 0, 0)  # two axes through the origin
ASKEW = (3, 1, 2, 3, 0, 1)


def residues(screws: tuple[tuple[int, ...], ...]) -> list[Displacement]:
    """Products of the screws' displacements at random values."""
    source, found = random.Random(3), []
    for _ in range(6):
        here: Displacement = (((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0))
        for screw in screws:
            value = source.randrange(PRIME), source.randrange(PRIME)
            here = composed(here, random_step(screw, *value, PRIME), PRIME)
        found.append(here)
    return found


def numbers(screws: tuple[tuple[int, ...], ...]) -> np.ndarray:
    """The same in floating point."""
    source, found = np.random.default_rng(3), []
    for _ in range(12):
        here = np.eye(4)
        for screw in screws:
            hat = np.zeros((4, 4))
            x, y, z = screw[:3]
            hat[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
            hat[:3, 3] = screw[3:]
            angle = source.uniform(0.2, 0.9)
            step, term = np.eye(4), np.eye(4)
            for order in range(1, 40):
                term = term @ hat * (angle / order)
                step = step + term
            here = here @ step
        found.append(here)
    return np.array(found)


@pytest.mark.parametrize(
    ("screws", "words"),
    [
        ((), "at rest"),
        ((X,), "straight line"),
        ((X, Y), "pure translation in a plane"),
        ((X, Y, Z), "pure translation"),
        ((ABOUT_Z,), "rotation about a fixed axis"),
        ((ABOUT_Z, ALSO_Z), "planar"),
        ((ABOUT_Z, X), "planar"),
        ((ABOUT_Z, Z), "rotation about and translation along a fixed axis"),
        ((ABOUT_Z, ALSO_Z, Z), "Schönflies"),
        (THROUGH, "rotation about a fixed point"),
        ((THROUGH[0], ASKEW), ""),
        ((THROUGH[0], ABOUT_Z), ""),
    ],
)
def test_kinds_are_told_as_numbers_tell_them(
    screws: tuple[tuple[int, ...], ...], words: str
) -> None:
    measured = motion_in_words(numbers(screws))
    told = words_of(residues(screws), PRIME, coupled=False)
    assert told == measured == words


def test_a_fixed_ratio_of_slide_and_turn_is_left_open() -> None:
    """A helix of pitch 1: angles are no residues."""
    helix = ((0, 0, 1, 0, 0, 1),)
    assert words_of(residues(helix), PRIME, coupled=True) is None
