"""What the derivation of a singular locus took for granted, in words."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from screwkit.mechanism.model import Mechanism

if TYPE_CHECKING:
    from screwkit.algebra.factor_library import FactorLibrary
    from screwkit.algebra.trigonometric import TrigonometricRing


def assumptions_in_words(
    mechanism: Mechanism, positive: Collection[str], nonzero: Collection[str]
) -> tuple[str, ...]:
    """The signs that are declared, and that the dimensions are not special.

    Args:
        mechanism: Whose symbols these are.
        positive: Symbols that are positive.
        nonzero: Symbols that are not 0, those among them.
    """
    words = [f"{name} > 0" for name in sorted(positive)]
    words += [f"{name} ≠ 0" for name in sorted({*nonzero} - {*positive})]
    parameters = [p.name for p in mechanism.parameters if not p.free]
    if parameters:
        words.append(
            f"no special relation between the dimensions {', '.join(parameters)}"
            if len(parameters) > 1
            else f"no special value of the dimension {parameters[0]}"
        )
    return tuple(words)


def unsplit(
    libraries: Mapping[TrigonometricRing, FactorLibrary], listed: Sequence[str]
) -> list[str]:
    """Equations that were not shown to be irreducible, in words.

    Args:
        libraries: The factors met, by ring.
        listed: The equations of an answer.
    """
    from screwkit.algebra.polynomial_text import equation_text  # noqa: PLC0415

    lengths = {
        equation_text(ring, factor.polynomial): len(factor.polynomial)
        for ring, library in libraries.items()
        for factor in library.factors.values()
        if not factor.certified and factor.form is None
    }
    found = sorted({lengths[text] for text in listed if text in lengths})
    return [f"that the equation of {terms} terms does not split" for terms in found]
