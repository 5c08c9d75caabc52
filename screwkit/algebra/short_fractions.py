"""The short fraction that a residue stands for.

References: [WangGuyDavenport1982].
"""

from __future__ import annotations

from fractions import Fraction


def short_fraction(residue: int, modulus: int, largest: int) -> Fraction | None:
    """The fraction with this residue whose parts are short, by Euclid's algorithm.

    There is at most one where twice the square of the largest part is less than the
    modulus.

    Args:
        residue: From 0 to the modulus.
        modulus: Prime to the denominator that is looked for.
        largest: Numerator and denominator, at most.

    Returns:
        None where there is none.
    """
    above, rest, last, below = modulus, residue, 0, 1
    while rest > largest:
        times = above // rest
        above, rest = rest, above - times * rest
        last, below = below, last - times * below
    return None if abs(below) > largest else Fraction(rest, below)
