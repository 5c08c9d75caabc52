"""The degree of a polynomial that is known by its values alone, along a random line.

References: [vonzurGathenGerhard2013] §5.2 (interpolation).
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import nmod_mat, nmod_poly


def determinant(rows: Sequence[Sequence[int]], prime: int) -> int:
    """Of a square matrix of residues."""
    size = len(rows)
    return int(nmod_mat(size, size, [x for row in rows for x in row], prime).det())


def degree_along(
    values: Sequence[int], divisors: Sequence[Sequence[int]], prime: int
) -> int | None:
    """The degree of a polynomial without the factors that some divisors give it.

    Args:
        values: Of the polynomial at 0, 1, 2, …
        divisors: Values there of each divisor, which is taken out as often as it goes.
        prime: The modulus.

    Returns:
        None where the polynomial is zero, or the values are too few to tell.
    """
    whole = _interpolated(values, prime)
    if whole is None:
        return None
    for own in divisors:
        divisor = _interpolated(own, prime)
        if divisor is None:
            return None
        while divisor.degree() > 0 and whole % divisor == 0:
            whole = whole // divisor
    return int(whole.degree())


def _interpolated(values: Sequence[int], prime: int) -> nmod_poly | None:
    """Newton's form summed up; None where its degree is that of the places or it is 0.

    Two values more than the degree needs confirm it.
    """
    differences = list(values)
    for order in range(1, len(values)):
        for k in range(len(values) - 1, order - 1, -1):
            above = differences[k] - differences[k - 1]
            differences[k] = above * pow(order, -1, prime) % prime
    if any(differences[-2:]):
        return None
    total = nmod_poly([0], prime)
    for place in range(len(values) - 1, -1, -1):
        total = total * nmod_poly([-place % prime, 1], prime) + differences[place]
    return total if total != 0 else None
