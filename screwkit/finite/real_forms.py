"""Signs of second-order conditions over the reals, from residues modulo two primes.

The entries of a quadratic form are found back as exact numbers up to a common factor.
Its eigenvalues are then computed in floating point and count only where they exceed the
rounding errors by far, so that a sign that is given is the true one.  Where the
geometry has free symbols there are no numbers, and nothing is claimed.

References: [ConnellyWhiteley1996] (prestress stability).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.reconstruction import Reconstruction
from screwkit.finite.higher_order import Form
from screwkit.kinematics.exact_postures import ExactPosture

Matrix: TypeAlias = NDArray[np.float64]

MARGIN = 1e-9
"""Eigenvalues above this part of the largest have a certain sign: the error bound of
a symmetric eigenvalue problem is a few units of 1e-16 times the norm."""

_STEPS = 300


def real_forms(
    postures: tuple[ExactPosture, ExactPosture],
    forms: tuple[Sequence[Form], Sequence[Form]],
) -> list[Matrix] | None:
    """The forms, each up to a factor, as numbers; None where they are none.

    Args:
        postures: With different primes and the same constants.
        forms: The same forms modulo both primes.
    """
    one, other = postures
    if len(forms[0]) != len(forms[1]) or one.prime == other.prime:
        return None
    known = Reconstruction(
        one.field, (one.prime, other.prime), (one.constants, other.constants)
    )
    found = []
    for first, second in zip(*forms, strict=True):
        size = len(first)
        numbers = known.direction(
            [x for row in first for x in row], [x for row in second for x in row]
        )
        if numbers is None:
            return None
        matrix = np.array([float(x) for x in numbers]).reshape(size, size)
        found.append(matrix / np.abs(matrix).max())
    return found


def indefinite(form: Matrix) -> bool:
    """Whether the form certainly takes both signs."""
    values = np.linalg.eigvalsh(form)
    least = MARGIN * np.abs(values).max()
    return bool(values[0] < -least and values[-1] > least)


def turns_around(forms: Sequence[Matrix]) -> bool:
    """Whether two binary forms certainly map a circle twice around the origin.

    So they do if no combination of them is definite or has a double root: then the
    determinant of λA + μB, a form in (λ, μ), is negative everywhere.

    Args:
        forms: Two forms in more variables, which two linear ones determine.
    """
    both = np.concatenate(forms)
    (one, other) = (form / np.abs(both).max() for form in forms)
    across = np.linalg.svd(both)[2][:2]
    a, b = (across @ form @ across.T for form in (one, other))
    mixed = a[0, 0] * b[1, 1] + a[1, 1] * b[0, 0] - 2 * a[0, 1] * b[0, 1]
    first, second = np.linalg.det(a), np.linalg.det(b)
    return bool(
        first < -MARGIN and second < -MARGIN and 4 * first * second - mixed**2 > MARGIN
    )


def definite_combination(forms: Sequence[Matrix]) -> bool:
    """Whether a definite combination of the forms was found.

    Ascent of the least eigenvalue over the unit sphere of coefficients; any real
    coefficients prove that the forms have no common zero but 0.
    """
    if not forms:
        return False
    stack = np.array(forms)
    start = np.einsum("kii->k", stack)
    for first in (start, -start, *np.eye(len(forms)), *-np.eye(len(forms))):
        coefficients = first / (np.linalg.norm(first) or 1.0)
        for step in range(_STEPS):
            values, vectors = np.linalg.eigh(np.tensordot(coefficients, stack, 1))
            if values[0] > MARGIN * np.abs(values).max():
                return True
            lowest = vectors[:, 0]
            slope = np.einsum("kij,i,j->k", stack, lowest, lowest)
            coefficients = coefficients + slope / (1 + step) / (
                np.linalg.norm(slope) or 1.0
            )
            coefficients /= np.linalg.norm(coefficients) or 1.0
            if len(forms) == 1:
                break
    return False
